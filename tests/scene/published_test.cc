#include "clearway/scene/published.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace clearway {
namespace {

TEST(Published, Empty) { EXPECT_EQ(Published<int>().Get(), nullptr); }

TEST(Published, AnOldValueOutlivesItsSuccessor) {
  Published<int> dut;
  dut.Set(std::make_shared<const int>(1));
  const auto held = dut.Get();
  dut.Set(std::make_shared<const int>(2));
  EXPECT_EQ(*held, 1);
  EXPECT_EQ(*dut.Get(), 2);
}

TEST(Published, ReadersNeverSeeAnOlderValueAfterANewerOne) {
  Published<int> dut;
  dut.Set(std::make_shared<const int>(0));
  std::atomic<bool> stop = false;
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      int last = 0;
      while (!stop) {
        const int now = *dut.Get();
        EXPECT_GE(now, last);
        last = now;
      }
    });
  }
  for (int i = 1; i <= 2000; ++i) dut.Set(std::make_shared<const int>(i));
  stop = true;
  for (auto& reader : readers) reader.join();
  EXPECT_EQ(*dut.Get(), 2000);
}

}  // namespace
}  // namespace clearway
