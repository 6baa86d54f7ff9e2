// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "linkwright/planar/studies/balancing.h"
#include "planar/studies.h"

// Balancing studies as texts, and what is read from them.
namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// A four-bar of which all masses, mass centres and inertias are open.
inline const std::string four_bar_masses = R"(schema = 1
kind = "balancing"
[mechanism]
type = "planar.four_bar"
[mechanism.parameters]
crank_m   = 0.1
coupler_m = 0.4
rocker_m  = 0.32
ground_m  = 0.6
[mechanism.mass.crank]
mass_kg            = { min = 0.01, max = 3.0, initial = 0.36 }
inertia_kg_m2      = { min = 2e-4, max = 60e-4, initial = 4.13e-4 }
centre_distance_mm = { min = 1.0, max = 100.0, initial = 50.0 }
centre_angle_deg   = { min = 0.0, max = 360.0, initial = 0.0 }
[mechanism.mass.coupler]
mass_kg            = { min = 0.8, max = 1.6, initial = 1.296 }
inertia_kg_m2      = 1.87e-2
centre_distance_mm = { min = 1.0, max = 400.0, initial = 200.0 }
centre_angle_deg   = { min = -180.0, max = 180.0, initial = 0.0 }
[mechanism.mass.rocker]
mass_kg            = 1.046
inertia_kg_m2      = 9.85e-3
centre_distance_mm = 160.0
[drive]
speed_rpm = 300.0
[sweep.crank_angle]
from_deg = 0.0
to_deg   = 360.0
samples  = 61
[[objective]]
quantity = "shaking_force_x_N"
measure  = "rms"
[[objective]]
quantity = "shaking_moment_with_drive_N_m"
)";

/// A four-bar as a linkage, with counterweights at given places.
inline const std::string linkage_weights = R"(schema = 1
kind = "balancing"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0], B0 = [600, 0] }
[[mechanism.body]]
name      = "crank"
points_mm = { O = [0, 0], A = [100, 0] }
mass_kg   = 0.36
[[mechanism.body.attached]]
name    = "crank counterweight"
mass_kg = { min = 0.0, max = 3.0, initial = 0.1 }
at_mm   = [-80, 0]
[[mechanism.body.attached]]
name    = "bolt"
mass_kg = 0.05
at_mm   = [20, 10]
[[mechanism.body]]
name      = "coupler"
points_mm = { A = [0, 0], B = [400, 0] }
mass_kg   = 1.3
[[mechanism.body]]
name      = "rocker"
points_mm = { B0 = [0, 0], B = [320, 0] }
mass_kg   = 1.05
[[mechanism.body.attached]]
name    = "rocker counterweight"
mass_kg = { min = 0.0, max = 3.0, initial = 0.0 }
at_mm   = [-120, 30]
[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "crank.O"
[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "coupler.A"
[[mechanism.joint]]
name   = "B"
first  = "coupler.B"
second = "rocker.B"
[[mechanism.joint]]
name   = "B0"
first  = "ground.B0"
second = "rocker.B0"
[[mechanism.assembly]]
bodies = ["coupler", "rocker"]
mode   = "plus"
[[drive]]
joint     = "O"
speed_rpm = 300.0
[sweep]
type = "grid"
[[sweep.input]]
joint    = "O"
from_deg = 0.0
to_deg   = 360.0
samples  = 61
[[objective]]
quantity = "shaking_force_N"
[[objective]]
quantity = "O_drive_torque_N_m"
measure  = "mean_abs"
weight   = 0.25
)";

/// An engine with a counterweight that may swing.
inline const std::string engine = R"(schema = 1
kind = "balancing"
[mechanism]
type = "planar.slider_crank"
[mechanism.parameters]
crank_mm = 45.0
rod_mm   = 150.0
[mechanism.mass]
slider_kg = 0.42
[mechanism.mass.crank]
mass_kg            = 2.1
inertia_kg_m2      = 3.1e-3
centre_distance_mm = 0.0
[[mechanism.mass.crank.attached]]
mass_kg     = { min = 0.0, max = 2.0, initial = 0.0 }
distance_mm = { min = 20.0, max = 40.0, initial = 40.0 }
angle_deg   = { min = 90.0, max = 270.0, initial = 180.0 }
[mechanism.mass.rod]
mass_kg            = 0.55
inertia_kg_m2      = 1.9e-3
centre_distance_mm = 45.0
[[drive]]
speed_rpm = 3000.0
[sweep]
type = "grid"
[[sweep.input]]
from_deg = 0.0
to_deg   = 360.0
samples  = 61
[[objective]]
quantity = "shaking_force_N"
measure  = "max_abs"
)";

/// Two rods with counterweights behind their joints: Boskovic 2018, section 3.3.
inline const std::string arm_weights = R"(schema = 1
kind = "balancing"
[mechanism]
type = "planar.serial_arm"
[[mechanism.link]]
length_m = 0.5
mass_kg  = 12.0
[[mechanism.link.attached]]
mass_kg    = { min = 0.0, max = 12.0, initial = 0.0 }
distance_m = -1.0
[[mechanism.link]]
length_m = 0.5
mass_kg  = 6.0
[[mechanism.link.attached]]
mass_kg    = 4.0
distance_m = 0.5
[[mechanism.link.attached]]
mass_kg    = { min = 0.0, max = 12.0, initial = 0.0 }
distance_m = { min = -0.5, max = 0.0, initial = 0.0 }
[[drive]]
link       = "link1"
law        = "cycloidal"
from_deg   = 0.0
to_deg     = 180.0
duration_s = 10.0
[[drive]]
link       = "link2"
law        = "cycloidal"
from_deg   = 0.0
to_deg     = 270.0
duration_s = 10.0
[environment]
gravity_m_per_s2 = 0.0
[sweep.time]
to_s    = 10.0
samples = 61
[[objective]]
quantity  = "O1_N"
measure   = "rss_over_n"
reference = 1.0
[[objective]]
quantity  = "O2_N"
measure   = "rss_over_n"
reference = 1.0
)";

/// The study of a text that must have no problems.
inline BalancingStudy balancing_study(const std::string& text) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  study::DocumentReader reader(document, "study.toml", diagnostics);
  study::ObjectReader root = reader.root();
  BalancingStudy s = read_balancing_study(root, {});
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return s;
}

/// Its task, evaluated the general way.
inline BalancingTask task_of(const BalancingStudy& s) {
  BalancingTask task;
  task.closes = closes(s);
  std::vector<std::string> columns;
  for (const study::DesignVariable& n : s.designed.numbers) {
    task.variables.push_back({n.key, n.lower, n.upper});
    task.initial.push_back(n.initial);
  }
  for (const BalancingGoal& o : s.objectives) columns.push_back(o.quantity);
  for (const BalancingLimit& c : s.constraints) columns.push_back(c.quantity);
  task.objectives = s.objectives;
  task.constraints = s.constraints;
  task.table = [&s, columns](std::span<const double> x) { return design_table(s, x, columns); };
  return task;
}

}  // namespace linkwright::planar::test
