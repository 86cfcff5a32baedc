// A horizontal slice of the scene as characters.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clearway/client/scene_client.h"

namespace clearway::cli {

// What a character of a picture means, for the line below it.
inline constexpr char kSliceLegend[] =
    "# static   1-9 A-Z object   ~ beyond horizon   . free   (blank) unknown   x out of bounds";

// '#' for the static map, 1-9 then A-Z for objects by id (35 and more wrap around).
char SymbolOf(SpaceStatus status, ObjectId object);

// One string per row of cells at the slice's time `time_index`, lowest y first.
std::vector<std::string> CellRows(const SliceOccupancy& slice, std::size_t time_index);

// The lines of a picture, lowest y first: folds `columns_per_char` x `rows_per_char` cells into
// each character so that nothing thin gets lost. What blocks wins over what is free, objects over
// the static map, free over unknown.
std::vector<std::string> FoldedLines(const std::vector<std::string>& rows, int columns_per_char,
                                     int rows_per_char);

// Those lines as a map is drawn, highest y first, with the y of each line's middle at its left.
// Lines without anything at the top and bottom are left out. Line 0 starts at min_y_m.
std::string PictureOf(const std::vector<std::string>& lines, double min_y_m, double line_m);

}  // namespace clearway::cli
