// The points of a cloud by the direction in which they are seen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/direction_cells.h"
#include "scene/label_ranges.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// A point of a cloud in a cell.
struct DirectionEntry {
  std::uint32_t cell, index;
  bool is_copy;  // in the rim of a face that the point is not on
};

// Which points of a cloud are neighbours as its sensor sees them: within about a degree, or within
// up to four where rays are so far apart that else there would be hardly any; and as far away up to
// 3 % and 0.2 m. Of several sensors, as the first one would see them. Knows the points that are
// near an object's, but none that has gone through to the end of its ray's range. They have places
// from 0 to size() - 1, by direction. Where points are dense, some of them are taken for all. Const
// methods may run on any number of threads.
class DirectionGrid {
 public:
  explicit DirectionGrid(const LabelledCloud& cloud);

  std::size_t size() const { return indices_.size(); }
  std::uint32_t IndexOf(std::size_t place) const { return indices_[place]; }  // into the cloud
  // A few points have a second place or a third, where no question may be asked.
  bool IsCopy(std::size_t place) const { return is_copy_[place] != 0; }

  // Of a point's neighbours, those that have its label and those that have another. If enough of
  // them are within 1.5 % of the range and 0.1 m, these alone.
  struct Votes {
    std::uint32_t fellows = 0, others = 0;
  };
  Votes VotesOn(std::size_t place) const;

  // Whether VotesOn's `fellows`, or its `others`, can be more than 0: faster.
  bool HasFellow(std::size_t place) const;
  bool MayHaveOthers(std::size_t place) const;

 private:
  void Fill(const LabelledCloud& cloud, const DirectionCells& cells);
  void CountCells(const std::vector<DirectionEntry>& entries);
  void FindRanges();
  // The places in each of the three rows of cells about a place's.
  struct Run {
    std::size_t begin, end;
  };
  std::array<Run, 3> RunsAboutCell(std::uint32_t cell) const;
  std::array<Run, 3> RunsAbout(std::size_t place) const { return RunsAboutCell(cells_[place]); }
  // Whether points have so few others about them that votes mean nothing.
  bool IsSparse() const;

  std::uint32_t first_cell_ = 0;      // that begin_ knows of
  std::vector<std::uint32_t> begin_;  // of a cell's points; one more at the end

  // By place.
  std::vector<std::uint32_t> indices_, cells_;
  std::vector<char> is_copy_;
  std::vector<ObjectId> labels_;
  std::vector<std::uint32_t> filled_;              // its cell's place among those with points
  std::vector<float> x_m_, y_m_, z_m_, ranges_m_;  // from the sensor

  std::vector<LabelRanges> ranges_about_;  // by filled_: of the cell's points and those about it
};

}  // namespace clearway
