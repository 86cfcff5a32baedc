// Files whose lines each begin with a key.
#pragma once

#include <initializer_list>
#include <string_view>

#include "absl/status/statusor.h"
#include "io/word_table.h"

namespace clearway {

// The row of one of these keys, which mean the same, with or without a colon behind it; null if
// there is none. Of rows that are alike the first; INVALID_ARGUMENT, naming both lines, if they are
// not.
absl::StatusOr<Row*> RowOfKey(WordRows& rows, std::initializer_list<std::string_view> keys);

}  // namespace clearway
