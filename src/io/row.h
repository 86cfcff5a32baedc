// One row of a table of text, read like a struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// A row's fields; the first error is kept. Fields are named in messages, as "column tx" if the
// table has a header, else as "word 3". The text that it was made from must outlive it.
class Row {
 public:
  // `file` must outlive it, too.
  explicit Row(const std::string& file) : file_(&file) {}

  std::size_t size() const { return fields_.size(); }
  int line() const { return line_; }
  // "labels.txt, line 12".
  std::string where() const;
  // Whether the table has that column.
  bool Has(std::size_t i) const { return fields_[i].data() != nullptr; }
  std::string_view Text(std::size_t i) const { return fields_[i]; }

  // At most 200 bytes of UTF-8 without control characters.
  std::string PlainText(std::size_t i);
  // A finite number; the others further limit it.
  double Number(std::size_t i);
  double NumberWithin(std::size_t i, double limit);
  double NumberBetween(std::size_t i, double min, double max);
  double Positive(std::size_t i);
  // Also an integer written as 7.0.
  std::int64_t Integer(std::size_t i, std::int64_t min, std::int64_t max);
  // Seconds, not below 0, exact as far as they are written with up to nine decimals.
  Time Stamp(std::size_t i);
  // Within kMaxFileCoordinate_m either way.
  double Coordinate(std::size_t i);
  // x, y, z as coordinates, then a quaternion's x, y, z, w, which is normalised.
  Pose PoseFrom(std::size_t i);
  // Checks that fields from `first` up to `end` are numbers, which need not be finite.
  void CheckNumbers(std::size_t first, std::size_t end);

  // "<where>, column tx: '1x' is not <expected>".
  void Fail(std::size_t i, const std::string& expected);
  // INVALID_ARGUMENT: "<where>: <why>".
  absl::Status Error(const std::string& why) const;
  // The same for a row that is not of the table's format: "3 words, expected <expected>".
  absl::Status WrongCount(const std::string& expected);

  const absl::Status& status() const { return status_; }
  // Whether it is not of the format: a number of fields or a text where a number belongs. What is
  // merely missing, out of range or NaN is of the format.
  bool malformed() const { return malformed_; }

  // For those who make rows.
  void SetNames(std::span<const std::string> names) { names_ = names; }
  // Begins a row without fields and errors.
  void Restart(int line);
  void Add(std::string_view field) { fields_.push_back(field); }
  void SetMalformed(const std::string& why);

 private:
  std::string NameOf(std::size_t i) const;
  std::string Named(std::size_t first, std::size_t last) const;

  const std::string* file_;
  int line_ = 0;
  std::vector<std::string_view> fields_;
  std::span<const std::string> names_;  // empty if there is no header
  absl::Status status_;
  bool malformed_ = false;
};

}  // namespace clearway
