// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/reproductions.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/samples.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/studies/published.h"

namespace linkwright::flexible {
namespace {

constexpr const char* source = "Boskovic 2018, ";
/// Divisions of the source, and such that the lag is right to 1e-4 of itself.
constexpr int printed_divisions = 2, enough_divisions = 8;

Simulation spun_up(double speed, int divisions, Kinematics kinematics, RunContext& context) {
  static constexpr std::array breaks{15.0};
  return simulate_motion(
      discretise(spin_up_beam(), divisions, kinematics), SpinUp{speed, 15},
      {.end = 20, .output_interval = 0.01, .step = 0.005, .breaks = breaks, .context = &context});
}
Simulation driven_by_torque(double torque, int divisions, Kinematics kinematics, RunContext& context) {
  static constexpr std::array breaks{2.0};
  return simulate_torque(
      discretise(torque_beam(), divisions, kinematics), SinePulse{torque, 2},
      {.end = 5, .output_interval = 0.005, .step = 0.002, .breaks = breaks, .context = &context});
}

/// The largest lag of the tip between two times, m.
double largest_lag(const Simulation& run, double from, double to) {
  return -smallest(run.samples, &Sample::tip_eta, from, to).value;
}

study::Comparisons spin_up(const std::string&, RunContext& context) {
  study::Comparisons rows;
  for (const double speed : {0.6, 2.0, 4.0, 8.0, 12.0, 16.0}) {
    const double lag =
        largest_lag(spun_up(speed, enough_divisions, Kinematics::chord_consistent, context), 0, 15);
    const double printed =
        largest_lag(spun_up(speed, printed_divisions, Kinematics::source_linearised, context), 0, 15);
    rows.push_back({fmt::format("largest lag of the tip on the way to {:g} rad/s, m", speed),
                    std::string(source) + "figures 3.8 to 3.13", nan, lag, "not reproduced",
                    fmt::format("curves without numbers; the printed equations give {:.4f} m, {:.1f} % more",
                                printed, 100 * (printed / lag - 1))});
  }
  // Without tip mass, as frequencies of turning beams are tabulated.
  Beam beam = spin_up_beam();
  beam.tip_mass = 0;
  const double speed = 4 * beam.frequency_scale();
  const auto first = [&](int divisions, Kinematics kinematics, double at) {
    return modes(discretise(beam, divisions, kinematics), 1, {.speed = at})[0].frequency;
  };
  rows.push_back(
      {fmt::format("first frequency without tip mass on a hub that turns at {:.3f} rad/s, rad/s", speed),
       std::string(source) + "section 3.6.1", nan,
       first(enough_divisions, Kinematics::chord_consistent, speed), "corrected",
       fmt::format(
           "the speed is said to stiffen the link, but with the printed velocities, (3.11)-(3.15), it "
           "stays at {:.4f}; at rest it is {:.4f}",
           first(printed_divisions, Kinematics::source_linearised, speed),
           first(enough_divisions, Kinematics::chord_consistent, 0))});
  rows.push_back(
      {"speed that two divisions bear with the printed positions, rad/s",
       std::string(source) + "section 3.6.1", 16,
       critical_speed(discretise(spin_up_beam(), printed_divisions, Kinematics::hub_axis), 100).value_or(nan),
       "corrected",
       "convergent results are reported up to 16 rad/s; (3.6)-(3.9) differentiated exactly are unstable "
       "beyond "
       "this speed, so the figures come from the linearised velocities or from more divisions"});
  // For r_H = 0 and bars of half the length l = L / (2n), k_R phi_1 + lambda_3 comes to l/2 times the force.
  const Simulation run = spun_up(4, printed_divisions, Kinematics::chord_consistent, context);
  for (const Sample& s : run.samples)
    if (std::abs(s.time - 7.5) < 1e-9)
      rows.push_back({"couple at the weld at 7.5 s on the way to 4 rad/s, N m",
                      std::string(source) + "(3.49)", nan, s.moment, "corrected",
                      fmt::format("(3.49) as printed gives {:.1f}: k_R phi_1 is added to lambda_3, where it "
                                  "is taken off already, and so the elastic moment is lost",
                                  beam.length / (2 * printed_divisions) / 2 * s.reaction_eta)});
  return rows;
}

study::Comparisons torque(const std::string&, RunContext& context) {
  study::Comparisons rows;
  for (const double torque : {1.0, 2.0, 4.0, 6.0}) {
    const double lag =
        largest_lag(driven_by_torque(torque, enough_divisions, Kinematics::chord_consistent, context), 0, 1);
    const double printed = largest_lag(
        driven_by_torque(torque, printed_divisions, Kinematics::source_linearised, context), 0, 1);
    rows.push_back({fmt::format("first swing of the tip under {:g} N m, m", torque),
                    std::string(source) + "figures 3.14 to 3.17", nan, lag, "not reproduced",
                    fmt::format("curves without numbers; the printed equations give {:.4f} m, {:.1f} % more",
                                printed, 100 * (printed / lag - 1))});
  }
  return rows;
}

}  // namespace

std::vector<study::Reproduction> reproductions() {
  return study::reproductions_of(published::reproductions(),
                                 {{"boskovic-2018-spin-up", spin_up}, {"boskovic-2018-torque", torque}});
}

}  // namespace linkwright::flexible
