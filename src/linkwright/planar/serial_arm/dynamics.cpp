// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <cmath>
#include <complex>
#include <limits>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {

std::vector<double> mass_matrix(std::span<const ArmElement> arm, std::span<const double> angles) {
  const std::size_t n = arm.size();
  LINKWRIGHT_REQUIRE(angles.size() == n, "{} angles for {} links", angles.size(), n);
  std::vector<double> matrix(n * n);
  double beyond = 0;  // mass of the links after k
  for (std::size_t k = n; k-- > 0;) {
    const std::complex<double> moment = arm[k].base.moment + arm[k].length * beyond;
    matrix[k * n + k] = arm[k].base.inertia + arm[k].length * arm[k].length * beyond;
    for (std::size_t j = 0; j < k; ++j)
      matrix[j * n + k] = matrix[k * n + j] =
          arm[j].length * (moment * std::polar(1.0, angles[k] - angles[j])).real();
    beyond += arm[k].base.mass;
  }
  return matrix;
}

Status accelerate(std::span<const ArmElement> arm, std::span<const double> absolute_torques, double gravity,
                  std::span<math::Motion> motion) {
  const std::size_t n = arm.size();
  LINKWRIGHT_REQUIRE(absolute_torques.size() == n && motion.size() == n,
                     "{} torques and {} motions for {} links", absolute_torques.size(), motion.size(), n);
  std::vector<double> angles(n);
  for (std::size_t k = 0; k < n; ++k) {
    angles[k] = motion[k].value;
    motion[k].acceleration = 0;
  }
  std::vector<ArmLinkRates> r(n);
  std::vector<ArmJointLoads> loads(n);
  rates(arm, 0, motion, r);
  reactions(arm, r, gravity, loads);
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::VectorXd right(size);
  for (std::size_t k = 0; k < n; ++k)
    right(static_cast<Eigen::Index>(k)) = absolute_torques[k] - loads[k].absolute_torque;
  const std::vector<double> matrix = mass_matrix(arm, angles);
  const Eigen::LLT<Eigen::MatrixXd> factors(Eigen::Map<const Eigen::MatrixXd>(matrix.data(), size, size));
  // At this reciprocal of the condition no digit of the answer is left.
  const bool good = factors.info() == Eigen::Success &&
                    factors.rcond() > static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  const Eigen::VectorXd solution =
      good ? Eigen::VectorXd(factors.solve(right)) : Eigen::VectorXd::Constant(size, std::nan(""));
  for (std::size_t k = 0; k < n; ++k) motion[k].acceleration = solution(static_cast<Eigen::Index>(k));
  return good ? Status::done : Status::singular;
}

}  // namespace linkwright::planar
