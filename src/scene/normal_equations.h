// Linear least squares with few unknowns.
#pragma once

#include <array>
#include <cmath>

namespace clearway {

// The sums of rows of unknowns. They are written out: Eigen's depend on how wide the processor's
// vectors are, and scenes must not.
template <int kUnknowns>
class NormalEquations {
 public:
  using Row = std::array<double, kUnknowns>;

  // The wish that row * unknowns be `value`.
  void Add(double weight, const Row& row, double value) {
    for (int i = 0; i < kUnknowns; ++i) {
      for (int j = 0; j <= i; ++j) normal_[i][j] += weight * row[i] * row[j];
      sums_[i] += weight * row[i] * value;
    }
  }

  // By Cholesky's decomposition, in place. There must be one solution.
  Row Solve() {
    for (int i = 0; i < kUnknowns; ++i) {
      for (int j = 0; j <= i; ++j) {
        double left = normal_[i][j];
        for (int k = 0; k < j; ++k) left -= normal_[i][k] * normal_[j][k];
        normal_[i][j] = i == j ? std::sqrt(left) : left / normal_[j][j];
      }
    }
    for (int i = 0; i < kUnknowns; ++i) {
      for (int k = 0; k < i; ++k) sums_[i] -= normal_[i][k] * sums_[k];
      sums_[i] /= normal_[i][i];
    }
    for (int i = kUnknowns; i-- > 0;) {
      for (int k = i + 1; k < kUnknowns; ++k) sums_[i] -= normal_[k][i] * sums_[k];
      sums_[i] /= normal_[i][i];
    }
    return sums_;
  }

 private:
  std::array<Row, kUnknowns> normal_{};  // the lower triangle
  Row sums_{};
};

}  // namespace clearway
