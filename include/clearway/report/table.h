// Tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace clearway {

// Rows of text in aligned columns. Used by one thread.
class Table {
 public:
  explicit Table(std::vector<std::string> header);

  // Missing cells are empty; surplus ones are left out.
  void AddRow(std::vector<std::string> cells);

  // The header, a rule and the rows, each line ended. A column whose cells all start like a number
  // is aligned to the right. Widths count code points, so that units may be spelt in UTF-8.
  std::string ToString() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace clearway
