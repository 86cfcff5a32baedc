// What is said of a table that lacks a column.
#pragma once

#include <string>
#include <string_view>

namespace clearway {

// "no column tx; there are frame_id, x, y", of a header of these names.
template <typename Names>
std::string NoColumn(std::string_view name, const Names& header) {
  constexpr std::size_t kMostBytes = 200;
  std::string text = "no column " + std::string(name) + "; there are ";
  const std::size_t most = text.size() + kMostBytes, first = text.size();
  for (const auto& there : header) {
    if (text.size() > first) text += ", ";
    text += there;
  }
  if (text.size() > most) text.replace(most, std::string::npos, "...");
  return text;
}

}  // namespace clearway
