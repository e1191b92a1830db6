// SPDX-License-Identifier: Apache-2.0
#pragma once
/// C (z - A)^-1 B + D at many z: A is brought to Hessenberg's form once, and each z then costs one
/// elimination below the diagonal.

#include <Eigen/Eigenvalues>
#include <complex>

#include "tests/margins/linkage_on_oil.hpp"

namespace graben::margins {

class FrequencyResponse {
 public:
  explicit FrequencyResponse(const Discrete& system) : d_(system.d) {
    const Eigen::HessenbergDecomposition<Eigen::MatrixXd> form(system.a);
    const Eigen::MatrixXd turn = form.matrixQ();
    a_ = form.matrixH();
    b_ = turn.transpose() * system.b;
    c_ = system.c * turn;
  }

  [[nodiscard]] Eigen::MatrixXcd at(std::complex<double> z) const {
    const Eigen::Index last = a_.rows() - 1;
    Rows left = -a_;
    left.diagonal().array() += z;
    Rows right = b_;
    for (Eigen::Index row = 0; row < last; ++row) {
      if (std::abs(left(row, row)) < std::abs(left(row + 1, row))) {
        left.row(row).tail(last + 1 - row).swap(left.row(row + 1).tail(last + 1 - row));
        right.row(row).swap(right.row(row + 1));
      }
      const std::complex<double> share = left(row + 1, row) / left(row, row);
      left.row(row + 1).tail(last + 1 - row) -= share * left.row(row).tail(last + 1 - row);
      right.row(row + 1) -= share * right.row(row);
    }
    left.triangularView<Eigen::Upper>().solveInPlace(right);
    return c_ * right + d_;
  }

 private:
  using Rows = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::MatrixXd a_;
  Eigen::MatrixXd b_;
  Eigen::MatrixXd c_;
  Eigen::MatrixXd d_;
};

}  // namespace graben::margins
