#pragma once

#include <Eigen/Core>

namespace graspd {

/// The eigenvalues of a symmetric matrix, ascending, and the eigenvector of each, unit length: a column each.
struct EigenDecomposition {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Solvers for symmetric matrices of any size, which allocate. Wherever time does not count they stand in for Eigen's
/// own, of which every size takes long to compile.
[[nodiscard]] EigenDecomposition decomposed(const Eigen::MatrixXd& symmetric);

/// The x for which `symmetric` times x is `right`; `symmetric` is positive or negative semi-definite.
[[nodiscard]] Eigen::VectorXd solved(const Eigen::MatrixXd& symmetric, const Eigen::VectorXd& right);

}  // namespace graspd
