// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/speed_fluctuation.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// The cycle drawn with the forces that it has at the mean speed.
study::Scene drawn(const SpeedFluctuationStudy& s, const SpeedFluctuation& cycle) {
  LinkageMotion motion(s.plan);
  LinkageForces forces;
  std::vector<LinkageRecord> records;
  for (const double value : cycle.input) {
    const InputMotion input{value, s.setup.mean_speed, 0};
    solve_motion(s.plan, std::span(&input, 1), motion);
    solve_forces(s.linkage, s.plan, motion, 0, value, forces);
    records.push_back(record_of(s.linkage, s.plan, motion, &forces, value));
  }
  return linkage_scene(s.linkage, s.plan, records, s.traces, input_key(s.linkage, s.plan, 0),
                       input_joint(s.linkage, 0).name + " angle");
}

}  // namespace

study::Result run_speed_fluctuation(const SpeedFluctuationStudy& s, RunContext& context) {
  study::Result result;
  const study::AddWarning warn{result.diagnostics};
  const SpeedFluctuation cycle = speed_fluctuation(s.linkage, s.plan, s.setup, &context);
  result.status = cycle.status;
  if (cycle.speed.empty()) {
    result.headline = "No cycle: " + cycle.message + ".";
    warn(cycle.message);
    return result;
  }
  const std::string key = input_key(s.linkage, s.plan, 0), label = input_label(s.linkage, s.plan, 0);
  Table table{.name = "cycle"};
  table.add(key, label, cycle.input);
  table.add("inertia_kg_m2", "reduced inertia (kg m2)", cycle.inertia);
  table.add("load_torque_N_m", "torque of weight and loads on the input (N m)", cycle.torque);
  table.add("excess_energy_J", "excess energy with a constant motor torque (J)", cycle.energy);
  table.add("speed_rad_per_s", "speed without flywheel (rad/s)", cycle.speed);
  table.add("speed_with_flywheel_rad_per_s", "speed with flywheel (rad/s)", cycle.with_flywheel);
  table.status.assign(cycle.input.size(), "done");
  result.tables.push_back(std::move(table));
  result.scenes.push_back(drawn(s, cycle));
  const study::AddPlot plot{result, {.table = "cycle", .x = key, .scene = "motion"}};
  plot("inertia", "Reduced inertia", {"inertia_kg_m2"});
  plot("torque", "Torque of weight and loads on the input", {"load_torque_N_m"});
  plot("energy", "Excess energy with a constant motor torque", {"excess_energy_J"});
  plot("speed", "Speed without and with the flywheel", {"speed_rad_per_s", "speed_with_flywheel_rad_per_s"});
  const study::AddFact fact{result.facts};
  const Measured mean_speed = measured("rpm", s.setup.mean_speed, 5);
  fact("constant motor torque",
       say("{} ({} at {})", newton_metres(cycle.motor_torque, 6),
           measured("W", cycle.motor_torque * s.setup.mean_speed, 5), at_place("mean_speed", mean_speed)));
  report_assumed_masses(s.linkage, result);
  fact("fluctuation of energy", measured("J", cycle.energy_fluctuation, 6));
  fact("coefficient of fluctuation without flywheel", plain_number(cycle.fluctuation, 5));
  const bool found = cycle.status == Status::done;  // else interrupted, with the cycle, without the flywheel
  const auto flywheel = [&](int digits) { return measured("kg_m2", cycle.flywheel, digits).spelled(); };
  fact("flywheel on the input", !found               ? "not found: " + cycle.message
                                : cycle.flywheel > 0 ? say("{} for a coefficient of {}", flywheel(6),
                                                           plain_number(s.setup.fluctuation))
                                                     : Sentence("none is needed"));
  result.statistics["motor_torque_N_m"] = cycle.motor_torque;
  result.statistics["energy_fluctuation_J"] = cycle.energy_fluctuation;
  result.statistics["fluctuation"] = cycle.fluctuation;
  result.statistics["flywheel_kg_m2"] = cycle.flywheel;
  result.headline =
      !found ? say("The speed varies by {} of its mean of {}; {}.", plain_number(cycle.fluctuation),
                   mean_speed, cycle.message)
      : cycle.flywheel > 0
          ? say("A flywheel of {} on {} keeps the speed within {} of its mean of {}.", flywheel(5),
                input_joint(s.linkage, 0).name, plain_number(s.setup.fluctuation), mean_speed)
          : say("The speed stays within {} of its mean of {} without a flywheel.",
                plain_number(cycle.fluctuation), mean_speed);
  if (!found) warn(cycle.message);
  if (!found || !s.has_motor) return result;

  const SteadyCycle steady = steady_cycle(s.linkage, s.plan, s.setup, &context);
  if (steady.status != Status::done) {
    result.status = steady.status;
    warn("with the motor, without flywheel: " + steady.message);
    return result;
  }
  Table with{.name = "steady"};
  with.add(key, label, steady.input);
  with.add("speed_rad_per_s", "speed with the motor, without flywheel (rad/s)", steady.speed);
  with.status.assign(steady.input.size(), "done");
  result.tables.push_back(std::move(with));
  study::AddPlot{result, {.table = "steady", .x = key}}("steady", "Speed with the motor, without flywheel",
                                                        {"speed_rad_per_s"});
  fact("steady mean speed with the motor",
       say("{}, coefficient of fluctuation {}", measured("rpm", steady.mean_speed, 6),
           plain_number(steady.fluctuation, 5)));
  result.statistics["steady_mean_speed_rad_per_s"] = steady.mean_speed;
  result.statistics["steady_fluctuation"] = steady.fluctuation;
  return result;
}

}  // namespace linkwright::planar
