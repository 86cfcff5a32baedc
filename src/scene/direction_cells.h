// Small cells of the directions about a sensor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

namespace clearway {

// Cells on the six faces of a cube about the sensor, so many each way: kMostAcross, of 0.9 degrees,
// or fewer, then larger ones. Around each face is a rim of cells: in it are, once more, directions
// of the faces beside it.
class DirectionCells {
 public:
  static constexpr int kMostAcross = 100;
  static constexpr int kRow = kMostAcross + 2;
  static constexpr int kBefore = kRow + 1;  // cells that are none, so that each has neighbours
  static constexpr int kCount = 6 * kRow * kRow + 2 * kBefore;

  explicit DirectionCells(int across = kMostAcross) : across_(across) {}

  // The cell that each point, seen from `from_W`, is in on the face that it is on.
  void Find(std::span<const Eigen::Vector3f> points_W, const Eigen::Vector3f& from_W,
            std::uint32_t* cells) const;

  // Calls add(cell) for those in rims that the direction d is in, too. `own`: its cell as Find
  // tells it.
  template <class Add>
  void ForEachInRims(std::uint32_t own, const Eigen::Vector3f& d, Add&& add) const;

  // The first cells of the three rows of three about a cell.
  static std::array<std::uint32_t, 3> RowsAbout(std::uint32_t cell) {
    return {cell - kRow - 1, cell - 1, cell + kRow - 1};
  }

 private:
  std::uint32_t InRim(int axis, bool negative, const Eigen::Vector3f& d) const;

  int across_;
};

// Implementation.

template <class Add>
void DirectionCells::ForEachInRims(std::uint32_t own, const Eigen::Vector3f& d, Add&& add) const {
  const int number = (static_cast<int>(own) - kBefore) / kRow;
  const int u = (static_cast<int>(own) - kBefore) % kRow - 1, v = number % kRow - 1;
  const int axis = number / kRow / 2;
  if (u == 0 || u == across_ - 1) add(InRim((axis + 1) % 3, u == 0, d));
  if (v == 0 || v == across_ - 1) add(InRim((axis + 2) % 3, v == 0, d));
}

}  // namespace clearway
