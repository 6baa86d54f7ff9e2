// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/stiffness.h"

#include <fmt/core.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {

std::optional<std::string> problem(const PiBars& bars) {
  const auto check = [](double value, const char* what, const char* unit) -> std::optional<std::string> {
    if (value > 0) return {};
    return fmt::format("stiffness of the {} = {} {}", what, value, unit);
  };
  if (auto found = check(bars.arm, "arms", "N/m")) return found;
  if (auto found = check(bars.coupler, "coupler", "N/m")) return found;
  if (auto found = check(bars.diagonal, "diagonal", "N/m")) return found;
  return check(bars.screw, "screw", "N");
}

PiBarForces bar_forces(const PiJoint& joint, double angle, double share) {
  const PiTerms<double> t = pi_terms(joint, angle);
  const double sine = std::sin(angle), infinite = infinity;
  if (t.cosine == 0)
    return {.arm_base = infinite, .arm_top = infinite, .coupler = infinite, .diagonal = infinite};
  PiBarForces out;
  const double at_coupler = (1 - share) / (joint.arm * t.cosine);
  out.coupler = -at_coupler;
  out.arm_base = -at_coupler * sine;
  out.diagonal = 1 / pi_jacobian(t);
  // cot(mu) = (1 + k sin theta) / (k cos theta)
  out.arm_top = at_coupler * sine - pi_along(t) / (base_length(joint) * t.cosine);
  return out;
}

double compliance(const PiJoint& joint, const PiBars& bars, double angle, double share) {
  const PiBarForces n = bar_forces(joint, angle, share);
  // At an end the forces are infinite, and what no torque can hold yields even if its bars do not.
  if (std::isinf(n.diagonal)) return n.diagonal;
  return (n.arm_base * n.arm_base + n.arm_top * n.arm_top) / bars.arm + n.coupler * n.coupler / bars.coupler +
         n.diagonal * n.diagonal * (1 / bars.diagonal + diagonal(joint, angle) / bars.screw);
}

double stiffness(const PiJoint& joint, const PiBars& bars, double angle, double share) {
  return 1 / compliance(joint, bars, angle, share);
}

}  // namespace linkwright::parallel
