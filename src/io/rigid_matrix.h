// Poses out of matrices that files hold.
#pragma once

#include <Eigen/Core>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// INVALID_ARGUMENT, beginning with `where`, if the matrix' left part is no rotation within 0.001.
absl::StatusOr<Pose> PoseOfMatrix(const Eigen::Matrix<double, 3, 4>& matrix,
                                  const std::string& where);

}  // namespace clearway
