// Text files of words between blanks, a record a line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// A line's words; the first error is kept, so that a line is read like a struct.
class Words {
 public:
  Words(std::string where, std::vector<std::string> words)
      : where_(std::move(where)), words_(std::move(words)) {}

  std::size_t size() const { return words_.size(); }
  // "labels.txt, line 12", for messages.
  const std::string& where() const { return where_; }
  const std::string& Text(std::size_t i) const { return words_[i]; }
  // Within kMaxFileCoordinate_m either way.
  double Number(std::size_t i);
  double Positive(std::size_t i);
  int Integer(std::size_t i, int min, int max = 99'999'999);
  // Seconds, not below 0, exactly as far as they are written with up to nine decimals.
  Time Stamp(std::size_t i);
  // x, y, z, then a quaternion's x, y, z, w, which is normalised: files round it.
  Pose PoseFrom(std::size_t i);
  void Fail(std::size_t i, const std::string& expected);
  const absl::Status& status() const { return status_; }

 private:
  std::string where_;
  std::vector<std::string> words_;
  absl::Status status_;
};

// INVALID_ARGUMENT: "labels.txt, line 12: 3 words, expected <expected>".
absl::Status WrongCount(const Words& line, const std::string& expected);

// Whether a file whose last line does not end is taken: one that ends in a number might be cut off
// in the middle of it.
enum class LastLine { kEnds, kMayBeOpen };
// What follows a # up to the end of the line.
enum class Comments { kNone, kHash };

// Lines that hold words. NOT_FOUND, RESOURCE_EXHAUSTED above 256 MB, INVALID_ARGUMENT for a file
// that seems cut off.
absl::StatusOr<std::vector<Words>> ReadWordLines(const std::filesystem::path& path, LastLine last,
                                                 Comments comments = Comments::kNone);

// Takes the next word off the front of a line; empty if there is none.
std::string_view TakeWord(std::string_view& line);

}  // namespace clearway
