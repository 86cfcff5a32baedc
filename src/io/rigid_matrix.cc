#include "io/rigid_matrix.h"

#include <Eigen/LU>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

// Tables round to six digits; beyond this a matrix is no rotation.
constexpr double kRotationTolerance = 1e-3;

}  // namespace

absl::StatusOr<Pose> PoseOfMatrix(const Eigen::Matrix<double, 3, 4>& matrix,
                                  const std::string& where) {
  const Eigen::Matrix3d R = matrix.leftCols<3>();
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (R.determinant() < 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": not a rotation but a mirror image (its determinant is below 0)"));
  }
  if (!(error <= kRotationTolerance)) {
    return absl::InvalidArgumentError(absl::StrCat(
        where, ": not a rotation (its columns are off unit length and right angles by ",
        NumberText(error), "; the limit is ", NumberText(kRotationTolerance), ")"));
  }
  return Pose::FromMatrix(matrix);
}

}  // namespace clearway
