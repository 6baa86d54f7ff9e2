// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/damper_law.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "linkwright/core/check.h"
#include "linkwright/suspension/compliance/spring_law.h"

namespace linkwright::suspension {

std::string problem(const DamperCurve& curve) {
  if (curve.speed.size() != curve.force.size())
    return fmt::format("{} speeds and {} forces", curve.speed.size(), curve.force.size());
  if (curve.speed.size() < 2) return "a characteristic needs at least two points";
  for (std::size_t i = 0; i < curve.speed.size(); ++i) {
    const double speed = curve.speed[i], force = curve.force[i];
    if (!std::isfinite(speed) || !std::isfinite(force)) return fmt::format("point {} is not finite", i + 1);
    if (i > 0 && !(speed > curve.speed[i - 1]))
      return fmt::format("the speeds do not ascend at point {}", i + 1);
    if (speed == 0 && force != 0)
      return fmt::format("the force at rest is {:.6g} N, but a damper has none: a gas force is a spring's",
                         force);
    if (speed * force < 0)
      return fmt::format("the force at point {} has another sign than the speed: it would drive the motion",
                         i + 1);
  }
  if (!(curve.speed.front() < 0 && curve.speed.back() > 0))
    return "speeds of extension (< 0) and of compression (> 0) are both needed";
  return {};
}

DamperCurve with_rest(DamperCurve curve) {
  const auto at = std::lower_bound(curve.speed.begin(), curve.speed.end(), 0.0);
  if (at != curve.speed.end() && *at == 0) return curve;
  curve.force.insert(curve.force.begin() + (at - curve.speed.begin()), 0.0);
  curve.speed.insert(at, 0.0);
  return curve;
}

DamperForce force_of(const DamperCurve& curve, double speed) {
  const std::string bad = problem(curve);
  LINKWRIGHT_REQUIRE(bad.empty(), "{}", bad);
  const SpringForce at = force_of(ForceCurve{curve.speed, curve.force}, speed);
  return {at.force, at.stiffness};
}

}  // namespace linkwright::suspension
