#include "io/keyed_rows.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

bool HasKey(const Row& row, std::initializer_list<std::string_view> keys) {
  std::string_view key = row.Text(0);
  if (key.ends_with(':')) key.remove_suffix(1);
  return std::ranges::find(keys, key) != keys.end();
}

bool HaveSameValues(const Row& a, const Row& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (a.Text(i) != b.Text(i)) return false;
  }
  return true;
}

}  // namespace

absl::StatusOr<Row*> RowOfKey(WordRows& rows, std::initializer_list<std::string_view> keys) {
  Row* found = nullptr;
  for (Row& row : rows.rows) {
    if (!HasKey(row, keys)) continue;
    if (found == nullptr) {
      found = &row;
    } else if (!HaveSameValues(*found, row)) {
      return row.Error(absl::StrCat("a second ", std::string(*keys.begin()),
                                    " of other values; the first: line ", found->line()));
    }
  }
  return found;
}

}  // namespace clearway
