// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/damping.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/study/remarks.h"

namespace linkwright::suspension {
namespace {

constexpr double missing = WheelParameters::missing;

/// The damper at a position of the wheel and a speed of it.
struct Damped {
  double speed = 0;              ///< of the damper's compression, m/s
  DamperForce damper;            ///< force of the damper and its slope
  double wheel_force = 0;        ///< N, against the rise of the wheel
  double secant = 0, slope = 0;  ///< damping at the wheel, N s/m: force by speed, and its slope
  double ratio = missing;        ///< damping ratio by the secant
};

Damped damped(const DamperDescription& damper, const RideForm& ride, const DampedPosition& at,
              double wheel_speed) {
  Damped out{.speed = -at.ratio * wheel_speed};
  out.damper = damper.curve ? force_of(*damper.curve, out.speed)
                            : DamperForce{*damper.damping * out.speed, *damper.damping};
  out.wheel_force = -out.damper.force * at.ratio;
  out.secant = out.wheel_force / wheel_speed;
  out.slope = out.damper.damping * at.ratio * at.ratio;
  if (ride.sprung_mass && at.rate > 0) out.ratio = out.secant / (2 * std::sqrt(at.rate * *ride.sprung_mass));
  return out;
}

/// Speeds of the wheel, ascending: the given ones, or those at which the damper of this position has the
/// speeds of its curve.
std::vector<double> speeds_of(const DamperDescription& damper, const RideForm& ride,
                              const DampedPosition& at) {
  std::vector<double> out;
  if (ride.wheel_speeds) out = *ride.wheel_speeds;
  if (!ride.wheel_speeds && std::abs(at.ratio) > 1e-9)
    for (const double speed : damper.curve->speed)
      if (speed != 0) out.push_back(-speed / at.ratio);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void add_damping(study::Result& result, const DamperDescription& damper, const RideForm& ride,
                 std::span<const DampedPosition> positions, std::size_t stated) {
  const std::vector<double> speeds = speeds_of(damper, ride, positions[stated]);
  if (speeds.empty()) return;
  Table table{.name = "damping"};
  std::vector<double> travel, wheel_speed;
  std::vector<Damped> rows;
  for (const DampedPosition& at : positions)
    for (const double speed : speeds) {
      travel.push_back(at.travel);
      wheel_speed.push_back(speed);
      rows.push_back(damped(damper, ride, at, speed));
    }
  const auto add = [&](std::string key, std::string label, auto&& value) {
    std::vector<double> column;
    for (const Damped& row : rows) column.push_back(value(row));
    table.add(std::move(key), std::move(label), std::move(column));
  };
  table.add("travel_m", "travel (m)", std::move(travel));
  table.add("wheel_speed_m_per_s", "speed of the wheel, upwards (m/s)", std::move(wheel_speed));
  add("damper_speed_m_per_s", "speed of the damper's compression (m/s)",
      [](const Damped& d) { return d.speed; });
  add("damper_force_N", "force of the damper (N)", [](const Damped& d) { return d.damper.force; });
  add("wheel_damper_force_N", "force of the damper at the wheel, against its rise (N)",
      [](const Damped& d) { return d.wheel_force; });
  add("wheel_damping_N_s_per_m", "damping at the wheel, force by speed (N s/m)",
      [](const Damped& d) { return d.secant; });
  add("wheel_damping_slope_N_s_per_m", "damping at the wheel, slope of the force by speed (N s/m)",
      [](const Damped& d) { return d.slope; });
  if (ride.sprung_mass)
    add("damping_ratio", "damping ratio, c / (2 sqrt(k m)) by the wheel rate and the force by speed",
        [](const Damped& d) { return d.ratio; });
  result.tables.push_back(std::move(table));
  const study::AddPlot plot{result, {.table = "damping", .x = "wheel_speed_m_per_s", .group = "travel_m"}};
  plot("damping", "Force of the damper at the wheel over its speed", {"wheel_damper_force_N"});

  // The slowest speed in either sense.
  const study::AddFact fact{result.facts};
  const auto upwards = std::upper_bound(speeds.begin(), speeds.end(), 0.0);
  const auto state = [&](double speed) {
    const Damped at = damped(damper, ride, positions[stated], speed);
    const Sentence where = say(" at {} of the wheel, {}", measured("m_per_s", std::abs(speed)),
                               speed > 0 ? "rising" : "falling");
    fact("damping at the wheel" + where, measured("N_s_per_m", at.secant).fixed(2));
    if (std::isfinite(at.ratio)) fact("damping ratio" + where, plain_number(at.ratio).fixed(3));
  };
  if (upwards != speeds.end()) state(*upwards);
  if (upwards != speeds.begin()) state(*std::prev(upwards));
}

}  // namespace linkwright::suspension
