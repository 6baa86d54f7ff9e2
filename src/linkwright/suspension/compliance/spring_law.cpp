// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/spring_law.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

double secant(const ForceCurve& curve, std::size_t piece) {
  return (curve.force[piece + 1] - curve.force[piece]) /
         (curve.compression[piece + 1] - curve.compression[piece]);
}

/// Slope at a point: inside the weighted harmonic mean of both secants, 0 where they differ in sign; at the
/// ends the secant.
double slope(const ForceCurve& curve, std::size_t at) {
  const std::size_t last = curve.compression.size() - 1;
  if (at == 0) return secant(curve, 0);
  if (at == last) return secant(curve, last - 1);
  const double before = secant(curve, at - 1), after = secant(curve, at);
  if (!(before * after > 0)) return 0;
  const double h0 = curve.compression[at] - curve.compression[at - 1],
               h1 = curve.compression[at + 1] - curve.compression[at];
  const double share = (h0 + 2 * h1) / (3 * (h0 + h1));
  return before * after / (share * after + (1 - share) * before);
}

}  // namespace

std::string problem(const ForceCurve& curve) {
  if (curve.compression.size() != curve.force.size())
    return fmt::format("{} compressions and {} forces", curve.compression.size(), curve.force.size());
  if (curve.compression.size() < 2) return "a characteristic needs at least two points";
  for (std::size_t i = 0; i < curve.force.size(); ++i) {
    if (!std::isfinite(curve.force[i]) || !std::isfinite(curve.compression[i]))
      return fmt::format("point {} is not finite", i + 1);
    if (i > 0 && !(curve.compression[i] > curve.compression[i - 1]))
      return fmt::format("the compressions do not ascend at point {}", i + 1);
  }
  return {};
}

SpringForce force_of(const ForceCurve& curve, double compression) {
  const std::string bad = problem(curve);
  LINKWRIGHT_REQUIRE(bad.empty(), "{}", bad);
  const auto& x = curve.compression;
  const std::size_t last = x.size() - 1;
  if (compression <= x.front())
    return {curve.force.front() + slope(curve, 0) * (compression - x.front()), slope(curve, 0)};
  if (compression >= x.back())
    return {curve.force.back() + slope(curve, last) * (compression - x.back()), slope(curve, last)};
  const auto above = std::upper_bound(x.begin(), x.end(), compression);
  const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
  const double h = x[i + 1] - x[i], t = (compression - x[i]) / h, rise = secant(curve, i);
  const double from = slope(curve, i), to = slope(curve, i + 1);
  // Hermite's cubic by its end slopes.
  const double c2 = 3 * rise - 2 * from - to, c3 = from + to - 2 * rise;
  return {curve.force[i] + h * t * (from + t * (c2 + t * c3)), from + t * (2 * c2 + 3 * t * c3),
          (2 * c2 + 6 * t * c3) / h};
}

std::optional<double> compression_of(const ForceCurve& curve, double force) {
  const std::string bad = problem(curve);
  LINKWRIGHT_REQUIRE(bad.empty(), "{}", bad);
  if (!std::is_sorted(curve.force.begin(), curve.force.end()) || force < curve.force.front() ||
      force > curve.force.back())
    return std::nullopt;
  double low = curve.compression.front(), high = curve.compression.back();
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return middle;
    (force_of(curve, middle).force < force ? low : high) = middle;
  }
}

SpringForce force_of(const SpringLaw& law, double compression) {
  if (law.curve) return force_of(*law.curve, law.start + compression);
  LINKWRIGHT_REQUIRE(law.stiffness >= 0 && std::isfinite(law.stiffness), "stiffness {} N/m", law.stiffness);
  return {law.preload + law.stiffness * compression, law.stiffness};
}

SpringForce force_of(const StopLaw& law, double compression) {
  LINKWRIGHT_REQUIRE(law.stiffness >= 0 && std::isfinite(law.stiffness), "stiffness {} N/m", law.stiffness);
  const double own = compression - law.clearance;
  if (!(own > 0)) return {};
  return law.curve ? force_of(*law.curve, own) : SpringForce{law.stiffness * own, law.stiffness};
}

bool bottoms(const StopLaw& law, double compression) {
  return law.solid_at && compression - law.clearance >= *law.solid_at;
}

}  // namespace linkwright::suspension
