// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// Angle between coupler and rocker, folded to [0, pi/2], at squared distance r2 of A and B0; 0 beyond the
// toggles.
double folded_transmission(const FourBar& l, double r2) {
  const double reach = l.coupler + l.rocker, fold = l.coupler - l.rocker;
  const double sine = std::sqrt(std::max(0.0, (reach * reach - r2) * (r2 - fold * fold)));
  return std::atan2(sine, std::abs(l.coupler * l.coupler + l.rocker * l.rocker - r2));
}

double squared_distance(const FourBar& l, double crank_angle) {
  // (L1 - L2)^2 + 4 L1 L2 sin^2: no cancellation for small angles.
  const double s = std::sin(0.5 * crank_angle), difference = l.ground - l.crank;
  return difference * difference + 4 * l.ground * l.crank * s * s;
}

TransmissionAngles over_squared_distances(const FourBar& l, double lowest, double highest) {
  const double fold = (l.coupler - l.rocker) * (l.coupler - l.rocker);
  const double reach = (l.coupler + l.rocker) * (l.coupler + l.rocker);
  lowest = std::clamp(lowest, fold, reach);
  highest = std::clamp(highest, fold, reach);
  const double a = folded_transmission(l, lowest), b = folded_transmission(l, highest);
  TransmissionAngles out{std::min(a, b), std::max(a, b)};
  const double right = l.coupler * l.coupler + l.rocker * l.rocker;  // coupler and rocker at a right angle
  if (lowest <= right && right <= highest) out.maximum = pi / 2;
  return out;
}

// Crank angle in [0, pi] at which A and B0 are `distance` apart; cos = (L1^2 + L2^2 - distance^2) / (2 L1
// L2), by half-angles so that the ends of the range keep their digits.
double crank_angle_at(const FourBar& l, double distance) {
  const double difference = l.ground - l.crank, sum = l.ground + l.crank;
  const double towards = std::max(0.0, (distance - difference) * (distance + difference));
  const double away = std::max(0.0, (sum - distance) * (sum + distance));
  return 2 * std::atan2(std::sqrt(towards), std::sqrt(away));
}

}  // namespace

std::string in_words(FourBarType type) {
  for (const auto& entry : names(FourBarType{}))
    if (entry.value == type && !entry.summary.empty())
      return fmt::format("{} ({})", entry.summary, entry.name);
  return std::string(name_of(type));
}

FourBarClass classify(const FourBar& l, double tolerance) {
  require_lengths(l);
  LINKWRIGHT_REQUIRE(tolerance >= 0, "tolerance must not be negative, got {}", tolerance);
  const double t1 = l.ground - l.crank + l.coupler - l.rocker;
  const double t2 = l.ground - l.crank - l.coupler + l.rocker;
  const double t3 = l.coupler + l.rocker - l.ground - l.crank;
  const double epsilon = tolerance * (l.ground + l.crank + l.coupler + l.rocker);

  FourBarClass out;
  if (std::min({std::abs(t1), std::abs(t2), std::abs(t3)}) <= epsilon) {
    out.type = FourBarType::change_point;
  } else {
    constexpr FourBarType by_signs[] = {// index: 4 [T1 > 0] + 2 [T2 > 0] + [T3 > 0]
                                        FourBarType::triple_rocker_00,      FourBarType::double_crank,
                                        FourBarType::grashof_double_rocker, FourBarType::triple_rocker_pipi,
                                        FourBarType::rocker_crank,          FourBarType::triple_rocker_pi0,
                                        FourBarType::triple_rocker_0pi,     FourBarType::crank_rocker};
    out.type = by_signs[4 * (t1 > 0) + 2 * (t2 > 0) + (t3 > 0)];
  }
  out.grashof = t1 * t2 * t3 > 0 || out.type == FourBarType::change_point;
  out.circuits = out.grashof && out.type != FourBarType::change_point ? 2 : 1;
  out.crank_margin = std::min(l.coupler + l.rocker - l.ground - l.crank,
                              std::abs(l.ground - l.crank) - std::abs(l.coupler - l.rocker));
  out.crank_rotates_fully = out.crank_margin >= 0;
  if (out.crank_rotates_fully) {
    out.inputs = {{-pi, pi}};
    return out;
  }
  const double nearest = std::abs(l.ground - l.crank), farthest = l.ground + l.crank;
  const double fold = std::abs(l.coupler - l.rocker), reach = l.coupler + l.rocker;
  if (fold > farthest || reach < nearest) {
    out.circuits = 0;  // one link is longer than the other three together
    return out;
  }
  const double low = fold <= nearest ? 0 : crank_angle_at(l, fold);
  const double high = reach >= farthest ? pi : crank_angle_at(l, reach);
  if (low == 0) {
    out.inputs = {{-high, high}};
  } else if (high == pi) {
    out.inputs = {{low, 2 * pi - low}};
  } else {
    out.inputs = {{-high, -low}, {low, high}};
  }
  return out;
}

TransmissionAngles transmission_angles(const FourBar& l) {
  require_lengths(l);
  const double difference = l.ground - l.crank, sum = l.ground + l.crank;
  return over_squared_distances(l, difference * difference, sum * sum);
}

TransmissionAngles transmission_angles(const FourBar& l, double from, double to) {
  require_lengths(l);
  LINKWRIGHT_REQUIRE(from <= to, "the arc must run upwards, got {} to {}", from, to);
  double lowest = std::min(squared_distance(l, from), squared_distance(l, to));
  double highest = std::max(squared_distance(l, from), squared_distance(l, to));
  // The distance of A and B0 is least at whole turns and greatest at half turns.
  if (2 * pi * std::floor(to / (2 * pi)) >= from) lowest = squared_distance(l, 0);
  if (2 * pi * std::floor((to - pi) / (2 * pi)) + pi >= from) highest = squared_distance(l, pi);
  return over_squared_distances(l, lowest, highest);
}

}  // namespace linkwright::planar
