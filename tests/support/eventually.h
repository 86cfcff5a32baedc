// Waiting for a state that another thread or process reaches.
#pragma once

#include <chrono>
#include <thread>

namespace clearway::testing_support {

// Whether holds() became true within a deadline that is generous for a busy machine.
template <class Condition>
bool Eventually(Condition&& holds, std::chrono::seconds deadline = std::chrono::seconds(60)) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace clearway::testing_support
