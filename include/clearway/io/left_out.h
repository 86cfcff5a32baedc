// What files hold that cannot be used.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace clearway {

// Rows of tables, and frames without what they need, that a reader left out. One thread.
struct LeftOut {
  static constexpr std::size_t kMaxReasons = 10;

  std::uint64_t rows = 0;
  std::uint64_t frames = 0;
  // Of the first ones: "groundtruth.txt, line 3, word 8: 'nan', expected a finite number".
  std::vector<std::string> reasons;

  bool Empty() const { return rows == 0 && frames == 0; }
  void AddRow(std::string reason);
  void AddFrame(std::string reason);
  void Add(const LeftOut& other);
};

}  // namespace clearway
