// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/symmetric_system.h"

#include <Eigen/Cholesky>

namespace episcope::capture {

Eigen::MatrixXd solve_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                const Eigen::Ref<const Eigen::MatrixXd>& right,
                                double least_condition) {
  const Eigen::LDLT<Eigen::MatrixXd> decomposition(matrix);
  if (least_condition > 0 && decomposition.rcond() < least_condition) return {};
  return decomposition.solve(right);
}

}  // namespace episcope::capture
