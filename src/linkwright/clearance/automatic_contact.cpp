// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/automatic_contact.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <utility>

#include "linkwright/core/check.h"

namespace linkwright::clearance {
namespace {
// Pins part with the third power of time: that share of the clearance keeps errors of the integration from
// being taken for contacts.
constexpr double free_share = 1e-9;
}  // namespace

std::vector<JointClearance> continuous_joints(std::span<const AutomaticPin> pins) {
  std::vector<JointClearance> out;
  for (const AutomaticPin& p : pins)
    out.push_back(
        {.joint = p.contact.joint, .clearance = p.contact.clearance, .angle = p.angle, .rate = p.rate});
  return out;
}

std::vector<ContactJoint> contact_joints(std::span<const AutomaticPin> pins,
                                         std::span<const ClearanceState> states) {
  LINKWRIGHT_REQUIRE(pins.size() == states.size(), "{} pins, {} states", pins.size(), states.size());
  std::vector<ContactJoint> out;
  for (std::size_t k = 0; k < pins.size(); ++k) {
    out.push_back(pins[k].contact);
    ContactJoint& joint = out.back();
    const double depth =
        std::pow(std::max(states[k].tension, 0.0) / joint.law.stiffness, 1 / joint.law.exponent);
    // The clearance link points from the first body to the second.
    const double sign = joint.pin == PinSide::second ? 1 : -1;
    const std::complex<double> e = std::polar(joint.clearance + depth, states[k].angle) * sign;
    joint.start.eccentricity = depth > 0 ? e : e * (1 - free_share);
    joint.start.rate = std::complex<double>(0, states[k].rate) * e;
  }
  return out;
}

AutomaticContactRun simulate_automatic_contact(const planar::Linkage& linkage,
                                               std::span<const AutomaticPin> pins,
                                               std::span<const planar::InputDrive> drives,
                                               std::span<const double> times, const ContactOptions& options,
                                               const AutomaticContactOutput& output,
                                               const RunContext* context) {
  AutomaticContactRun run;
  bool stopped = false;
  double start_energy = 0;
  bool started = false;
  for (const AutomaticPin& p : pins) require_valid(p.contact.law);
  run.continuous = simulate_joint_clearance(
      linkage, continuous_joints(pins), drives, times,
      {.relative_tolerance = options.tolerance,
       .absolute_tolerance = 0.1 * options.tolerance,
       .max_steps = options.max_steps},
      [&](const JointClearanceRow& row) {
        if (!started) start_energy = row.instant.kinetic + row.instant.potential;
        started = true;
        stopped = output.continuous && !output.continuous(row);
        return !stopped;
      },
      context, AtSeparation::stop, options.stop_when_hopeless ? AtHopeless::stop : AtHopeless::go_on);
  const JointClearanceRun& before = run.continuous;
  run.status = before.status;
  run.message = before.message;
  run.time = before.simulation.time;
  run.steps = before.simulation.steps;
  run.evaluations = before.simulation.evaluations;
  run.largest_drift = before.simulation.largest_drift;
  run.peak_energy = before.simulation.peak_energy;
  if (before.parted < 0 || run.status != Status::done || stopped) return run;
  run.switched = run.time;
  run.pin = before.parted;
  run.inputs = before.inputs;
  const double left = 1e-12 * std::max({1.0, std::abs(times.front()), std::abs(times.back())});
  if (times.back() - run.switched <= left) return run;

  std::vector<double> rest{run.switched};
  std::copy_if(times.begin(), times.end(), std::back_inserter(rest),
               [&](double t) { return t > run.switched + left; });
  std::vector<planar::InputDrive> now(drives.begin(), drives.end());
  for (std::size_t k = 0; k < now.size(); ++k)
    if (!now[k].law) now[k].value = before.inputs[k].value, now[k].rate = before.inputs[k].rate;
  ContactOptions remaining = options;
  remaining.max_steps = std::max(options.max_steps - run.steps, 1L);
  const double energy = before.kinetic + before.potential;
  const double drift = started ? energy - start_energy - before.work : 0;
  bool first = true;
  run.contact = simulate_contact(
      linkage, contact_joints(pins, before.end), now, rest, remaining,
      [&](const ContactRow& now_row) {
        if (first) run.energy_step = now_row.kinetic + now_row.potential + now_row.elastic - energy;
        const bool at_switch = std::exchange(first, false);
        ContactRow row = now_row;
        row.work += before.work;
        row.drift += drift + run.energy_step;
        run.largest_drift = std::max(run.largest_drift, std::abs(row.drift));
        // The instant of the switch is a row where it is the start.
        if (at_switch && row.time > times.front()) return true;
        return !output.contact || output.contact(row);
      },
      context);
  run.status = run.contact.status;
  run.message = run.contact.message;
  run.time = run.contact.time;
  run.steps += run.contact.steps;
  run.evaluations += run.contact.evaluations;
  run.peak_energy = std::max(run.peak_energy, run.contact.peak_energy);
  return run;
}

}  // namespace linkwright::clearance
