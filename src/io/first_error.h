// The first of several errors.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace clearway {

// Keeps the first thing that is wrong with a file. A check that goes on after it reads defaults,
// and its result counts for nothing.
class FirstError {
 public:
  // INVALID_ARGUMENT: "<place>: <why>".
  void Set(const std::string& place, const std::string& why) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(place.empty() ? why : absl::StrCat(place, ": ", why));
  }
  bool ok() const { return status_.ok(); }
  const absl::Status& status() const { return status_; }

 private:
  absl::Status status_;
};

}  // namespace clearway
