#include "clearway/report/table.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace clearway {
namespace {

// Code points of UTF-8: all bytes but continuations.
std::size_t Width(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
}

bool StartsLikeNumber(const std::string& text) {
  const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  return text.empty() || text == "-" ||
         (text.size() > sign && std::isdigit(static_cast<unsigned char>(text[sign])));
}

std::string Padded(const std::string& text, std::size_t width, bool right) {
  const std::string space(width - std::min(width, Width(text)), ' ');
  return right ? space + text : text + space;
}

}  // namespace

Table::Table(std::vector<std::string> header) : header_(std::move(header)) {}

void Table::AddRow(std::vector<std::string> cells) {
  cells.resize(header_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::ToString() const {
  std::string rule;
  std::vector<std::string> lines(rows_.size() + 1);
  for (std::size_t column = 0; column < header_.size(); ++column) {
    std::size_t width = Width(header_[column]);
    bool right = !rows_.empty();
    for (const std::vector<std::string>& row : rows_) {
      width = std::max(width, Width(row[column]));
      right = right && StartsLikeNumber(row[column]);
    }
    const std::string gap(column == 0 ? 0 : 2, ' ');
    rule += gap + std::string(width, '-');
    lines[0] += gap + Padded(header_[column], width, right);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      lines[i + 1] += gap + Padded(rows_[i][column], width, right);
    }
  }
  lines.insert(lines.begin() + 1, rule);
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace clearway
