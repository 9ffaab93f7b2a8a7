// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace episcope::capture {

/// Solves the normal equations M x = b by LDLᵀ. Takes every size, so that Eigen's decomposition is
/// compiled once. `matrix`: n×n, symmetric, positive semidefinite; only its lower triangle is read.
/// `right`: n×m. Returns x, n×m; an empty matrix where the reciprocal condition number of M
/// (1-norm, estimated) is below `least_condition`.
[[nodiscard]] Eigen::MatrixXd solve_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                              const Eigen::Ref<const Eigen::MatrixXd>& right,
                                              double least_condition = 0);

}  // namespace episcope::capture
