// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "linkwright/planar/simulation/simulation.h"
#include "planar/linkages.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// The result of a simulation, with copies of its rows.
struct SimulationRun {
  struct Row {
    double time;
    Status status;
    std::vector<InputMotion> inputs;
    double kinetic, potential, work, drift;
    std::vector<PartState<double>> parts;
    std::optional<LinkageForces> held;  // while joints stick
    double friction_loss = 0;
  };
  SimulationReport report;
  std::vector<Row> rows;
};

using SimulationFunction = decltype(&simulate);

inline SimulationRun simulated(const Linkage& l, const LinkagePlan& plan,
                               const std::vector<InputDrive>& drives, const std::vector<double>& times,
                               const SimulationOptions& options = {}, SimulationFunction route = simulate) {
  SimulationRun run;
  run.report = route(
      l, plan, drives, times, options,
      [&](const SimulationInstant& now) {
        run.rows.push_back({now.time,
                            now.status,
                            {now.inputs.begin(), now.inputs.end()},
                            now.kinetic,
                            now.potential,
                            now.work,
                            now.drift,
                            now.motion->parts,
                            now.held ? std::optional(*now.held) : std::nullopt,
                            now.friction_loss});
        return true;
      },
      nullptr);
  return run;
}

inline std::vector<double> evenly(double from, double to, int samples) {
  std::vector<double> times;
  for (int i = 0; i < samples; ++i) times.push_back(from + (to - from) * i / (samples - 1));
  return times;
}

/// `links` uniform bars of 1 m and 1 kg in a row, all joints free inputs.
inline Linkage pendulum(int links) {
  Linkage l = grounded({{"base", {0, 0}}});
  std::string last = "ground.base";
  for (int k = 1; k <= links; ++k) {
    const std::string n = std::to_string(k);
    add_bar(l, "bar " + n, "from", "to", 1);
    set_uniform(l, "bar " + n, 1);
    add_pin(l, "pin " + n, last, "bar " + n + ".from");
    add_drive(l, "pin " + n);
    last = "bar " + n + ".to";
  }
  return l;
}

/// A body of 2 kg on a level slide, joint "slide"; nothing acts on it along the slide.
inline Linkage slider() {
  Linkage l = grounded({{"O", {0, 0}}, {"wall", {-1, 0}}});
  add_body(l, "block", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{2, 0, 0};
  add_slide(l, "slide", "ground.O", "block.B");
  add_drive(l, "slide");
  return l;
}

}  // namespace linkwright::planar::test
