// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/flexible/simulation.h"

namespace linkwright::flexible {

namespace {

// sign 1: largest, -1: smallest.
Extreme extreme(std::span<const Sample> samples, double Sample::*quantity, double from, double to,
                double sign) {
  std::size_t at = samples.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    if (s.time < from || s.time > to || std::isnan(s.*quantity)) continue;
    if (at == samples.size() || sign * (s.*quantity) > sign * (samples[at].*quantity)) at = i;
  }
  LINKWRIGHT_REQUIRE(at < samples.size(), "no sample between {} and {} s", from, to);
  Extreme out{samples[at].time, samples[at].*quantity};
  if (at == 0 || at + 1 == samples.size()) return out;
  const double before = samples[at - 1].*quantity, after = samples[at + 1].*quantity;
  const double left = out.time - samples[at - 1].time, right = samples[at + 1].time - out.time;
  // Parabola through three samples, equally spaced or nearly so.
  const double curvature = after - 2 * out.value + before, slope = (after - before) / 2;
  if (!(sign * curvature < 0) || std::abs(left - right) > 1e-6 * (left + right)) return out;
  const double shift = -slope / curvature;
  if (std::abs(shift) > 1) return out;  // the edge of the stretch, not an extreme
  out.time += shift * left;
  out.value += slope * shift / 2;
  return out;
}

}  // namespace

Extreme smallest(std::span<const Sample> samples, double Sample::*quantity, double from, double to) {
  return extreme(samples, quantity, from, to, -1);
}

Extreme largest(std::span<const Sample> samples, double Sample::*quantity, double from, double to) {
  return extreme(samples, quantity, from, to, 1);
}

double bending_stress(const Beam& beam, double moment, double fibre_distance) {
  LINKWRIGHT_REQUIRE(fibre_distance > 0, "the outer fibre at {} m", fibre_distance);
  return moment * fibre_distance / beam.second_moment;
}

Table table_of(std::span<const Sample> samples) {
  struct Entry {
    const char* key;
    const char* label;
    double Sample::*quantity;
  };
  constexpr Entry entries[] = {
      {"time_s", "time (s)", &Sample::time},
      {"hub_angle_rad", "angle of the hub (rad)", &Sample::angle},
      {"hub_speed_rad_per_s", "speed of the hub (rad/s)", &Sample::rate},
      {"hub_acceleration_rad_per_s2", "acceleration of the hub (rad/s2)", &Sample::acceleration},
      {"torque_N_m", "torque of the drive (N m)", &Sample::torque},
      {"tip_xi_m", "tip, along the link (m)", &Sample::tip_xi},
      {"tip_eta_m", "tip, across the link (m)", &Sample::tip_eta},
      {"tip_angle_rad", "angle of the tip (rad)", &Sample::tip_angle},
      {"reaction_xi_N", "force of the hub on the link, along (N)", &Sample::reaction_xi},
      {"reaction_eta_N", "force of the hub on the link, across (N)", &Sample::reaction_eta},
      {"moment_N_m", "couple of the hub on the link (N m)", &Sample::moment},
      {"bending_moment_N_m", "largest bending moment (N m)", &Sample::bending_moment},
      {"kinetic_energy_J", "kinetic energy (J)", &Sample::kinetic},
      {"potential_energy_J", "potential energy (J)", &Sample::potential},
      {"work_J", "work of the drive (J)", &Sample::work},
      {"dissipated_J", "dissipated energy (J)", &Sample::dissipated},
      {"angular_momentum_N_m_s", "angular momentum (N m s)", &Sample::angular_momentum},
  };
  Table out{.name = "response"};
  for (const Entry& e : entries) {
    Column& column = out.add(e.key, e.label);
    for (const Sample& s : samples) column.values.push_back(s.*e.quantity);
  }
  Column& balance = out.add("energy_balance_J", "energy less work since the start (J)");
  for (const Sample& s : samples)
    balance.values.push_back(s.energy_balance() - samples.front().energy_balance());
  return out;
}

}  // namespace linkwright::flexible
