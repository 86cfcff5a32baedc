#include "cli/slice_picture.h"

#include <gtest/gtest.h>

namespace clearway::cli {
namespace {

SliceOccupancy SliceOf(std::uint32_t columns, std::uint32_t rows) {
  SliceOccupancy slice;
  slice.columns = columns;
  slice.rows = rows;
  slice.cells.assign(columns * rows, SpaceStatus::kFree);
  slice.objects.assign(columns * rows, kStaticLabel);
  return slice;
}

using Lines = std::vector<std::string>;

TEST(SlicePicture, Empty) {
  EXPECT_EQ(FoldedLines({}, 1, 1), Lines{});
  EXPECT_EQ(PictureOf({}, 0, 1), "");
}

TEST(SlicePicture, TellsObjectsFromTheStaticMap) {
  EXPECT_EQ(SymbolOf(SpaceStatus::kOccupied, 0), '#');
  EXPECT_EQ(SymbolOf(SpaceStatus::kOccupied, 1), '1');
  EXPECT_EQ(SymbolOf(SpaceStatus::kOccupied, 10), 'A');
  EXPECT_EQ(SymbolOf(SpaceStatus::kOccupied, 36), '1');
  EXPECT_EQ(SymbolOf(SpaceStatus::kUnknownSpace, 3), ' ');
}

TEST(SlicePicture, DrawsTheHighestYFirst) {
  SliceOccupancy slice = SliceOf(3, 2);
  slice.cells[3] = SpaceStatus::kOccupied;  // x 0, y 1
  EXPECT_EQ(PictureOf(FoldedLines(CellRows(slice, 0), 1, 1), -1, 1),
            "     0.5 | #..\n    -0.5 | ...\n");
}

TEST(SlicePicture, FoldingLosesNothingThatBlocks) {
  SliceOccupancy slice = SliceOf(5, 3);
  slice.cells[0] = SpaceStatus::kOccupied;
  slice.cells[6] = SpaceStatus::kOccupied;
  slice.objects[6] = 2;
  slice.cells[14] = SpaceStatus::kUnknownSpace;
  EXPECT_EQ(FoldedLines(CellRows(slice, 0), 2, 2), (Lines{"2..", ".."}));
}

TEST(SlicePicture, LeavesOutLinesAtTheEndsOnly) {
  EXPECT_EQ(PictureOf({"", "#", "", ".", ""}, 0, 2), "     7.0 | .\n     5.0 | \n     3.0 | #\n");
}

TEST(SlicePicture, KeepsTimesApart) {
  SliceOccupancy slice = SliceOf(2, 2);
  slice.rows = 1;
  slice.cells = {SpaceStatus::kFree, SpaceStatus::kFree, SpaceStatus::kBeyondHorizon,
                 SpaceStatus::kOutOfBounds};
  EXPECT_EQ(CellRows(slice, 0), std::vector<std::string>{".."});
  EXPECT_EQ(CellRows(slice, 1), std::vector<std::string>{"~x"});
}

TEST(SlicePicture, SurvivesAnAnswerThatIsTooShort) {
  SliceOccupancy slice = SliceOf(2, 2);
  slice.cells.resize(1);
  EXPECT_EQ(FoldedLines(CellRows(slice, 0), 1, 1), (Lines{".", ""}));
}

}  // namespace
}  // namespace clearway::cli
