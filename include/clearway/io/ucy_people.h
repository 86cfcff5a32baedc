// Tables of people on the ground as the UCY and ETH recordings have them (obsmat.txt).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"

namespace clearway {

// A row: where someone was at one frame.
struct UcyPerson {
  int id = 0;
  double frame = 0;  // of the video
  Eigen::Vector2d p_W_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d v_W_mps = Eigen::Vector2d::Zero();
  int line = 0;
};

// Reads lines of frame, id, x, z, y, vx, vz, vy, with blanks or commas between them; rows come as
// in the file. Bad rows are left out and named: what is no finite number or out of range, another
// number of words, a second row of a person in one frame. NOT_FOUND; INVALID_ARGUMENT, with the
// line, for a file that is no such table or seems cut off.
absl::StatusOr<std::vector<UcyPerson>> ReadUcyPeople(const std::filesystem::path& path,
                                                     LeftOut& left_out);

}  // namespace clearway
