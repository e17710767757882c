#include "core/geometry/symmetric_matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace graspd {

EigenDecomposition decomposed(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd solved(const Eigen::MatrixXd& symmetric, const Eigen::VectorXd& right) {
  return symmetric.ldlt().solve(right);
}

}  // namespace graspd
