#include "cli/slice_picture.h"

#include "absl/strings/str_format.h"

namespace clearway::cli {
namespace {

constexpr char kDigits[] = "123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr int kDigitCount = sizeof(kDigits) - 1;

int Weight(char symbol) {
  switch (symbol) {
    case ' ':
      return 0;
    case 'x':
      return 1;
    case '.':
      return 2;
    case '~':
      return 3;
    case '#':
      return 4;
    default:
      return 5;
  }
}

}  // namespace

char SymbolOf(SpaceStatus status, ObjectId object) {
  switch (status) {
    case SpaceStatus::kFree:
      return '.';
    case SpaceStatus::kBeyondHorizon:
      return '~';
    case SpaceStatus::kOccupied:
      return object <= 0 ? '#' : kDigits[(object - 1) % kDigitCount];
    case SpaceStatus::kOutOfBounds:
      return 'x';
    case SpaceStatus::kUnknownSpace:
    case SpaceStatus::kUnresolved:
      break;
  }
  return ' ';
}

std::vector<std::string> CellRows(const SliceOccupancy& slice, std::size_t time_index) {
  const std::size_t columns = slice.columns, per_time = columns * slice.rows;
  std::vector<std::string> rows(slice.rows, std::string(columns, ' '));
  for (std::size_t i = 0; i < per_time; ++i) {
    const std::size_t cell = time_index * per_time + i;
    if (cell >= slice.cells.size() || cell >= slice.objects.size()) break;
    rows[i / columns][i % columns] = SymbolOf(slice.cells[cell], slice.objects[cell]);
  }
  return rows;
}

std::vector<std::string> FoldedLines(const std::vector<std::string>& rows, int columns_per_char,
                                     int rows_per_char) {
  const int height = static_cast<int>(rows.size());
  const int width = height == 0 ? 0 : static_cast<int>(rows[0].size());
  std::vector<std::string> lines(
      (height + rows_per_char - 1) / rows_per_char,
      std::string((width + columns_per_char - 1) / columns_per_char, ' '));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      char& folded = lines[y / rows_per_char][x / columns_per_char];
      if (Weight(rows[y][x]) > Weight(folded)) folded = rows[y][x];
    }
  }
  for (std::string& line : lines) line.erase(line.find_last_not_of(' ') + 1);
  return lines;
}

std::string PictureOf(const std::vector<std::string>& lines, double min_y_m, double line_m) {
  int first = 0, end = static_cast<int>(lines.size());
  while (first < end && lines[first].empty()) ++first;
  while (end > first && lines[end - 1].empty()) --end;
  std::string picture;
  for (int line = end - 1; line >= first; --line) {
    absl::StrAppendFormat(&picture, "%8.1f | %s\n", min_y_m + (line + 0.5) * line_m, lines[line]);
  }
  return picture;
}

}  // namespace clearway::cli
