// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/workspace/workspace.h"
#include "support/published.h"

/// Robots of the reference figures, and those figures.
namespace linkwright::parallel {

inline constexpr double degree = pi / 180;

inline Robot reference_delta() {
  return delta({.base_radius = 0.2, .platform_radius = 0.045, .arm = 0.35, .rod = 0.8});
}
inline Robot reference_hexa() {
  return hexa({.base_radius = 0.25,
               .base_offset = 0.06,
               .platform_radius = 0.09,
               .platform_angle = 0.7853981633974483,
               .arm = 0.25,
               .rod = 0.55});
}
inline Robot reference_five_bar() {
  return planar({.base_x = -0.15, .arm = 0.25, .rod = 0.35}, {.base_x = 0.15, .arm = 0.25, .rod = 0.35});
}
/// Platform of constant orientation.
inline Robot reference_platform() {
  return planar({.base_x = -0.15, .arm = 0.25, .rod = 0.35, .platform_x = -0.05},
                {.base_x = 0.15, .arm = 0.25, .rod = 0.35, .platform_x = 0.05});
}

/// Home of a workspace of "delta-constraint-workspace".
inline Pose constraint_home(const std::string& name) { return {{0, 0, name == "mean" ? -0.42 : -0.6}}; }
/// Its task, without conditions of the constraint.
inline WorkspaceTask constraint_task(const std::string& name) {
  const bool mean = name == "mean";
  const Robot robot = mean ? delta({.base_radius = 0.057690979999999996,
                                    .platform_radius = 0.045,
                                    .arm = 0.53428657,
                                    .rod = 0.66571343})
                           : delta({.base_radius = 0.145, .platform_radius = 0.045, .arm = 0.5, .rod = 0.5});
  WorkspaceTask out{.conditions = {.robot = robot, .assembly = assembly_at(robot, constraint_home(name))}};
  if (mean) {
    out.conditions.min_transmission = out.conditions.min_conditioning = 0.4;
    out.grid = {{-0.4, -0.4, -0.54446}, {0.4, 0.4, -0.29446}, 0.025};
  } else {
    out.conditions.min_transmission = 0.5;
    for (Drive& d : out.conditions.drives) d.lowest = -0.7853981633974483, d.highest = 1.7453292519943295;
    out.grid = {{-0.5, -0.5, -0.9}, {0.5, 0.5, -0.2}, 0.025};
  }
  return out;
}

/// Pi-joints of the reference DELTA and HEXA, within 60 deg to both sides.
inline Drives reference_drives() {
  Drives out;
  out.fill({.type = DriveType::pi_joint,
            .ratio = 0.4,
            .mounting = 0.5235987755982988,
            .lowest = -1.0471975511965976,
            .highest = 1.0471975511965976,
            .quantum = 1.27e-5});
  return out;
}
/// Pi-joints of the planar robots: the second is a mirror image.
inline Drives mirrored_drives() {
  Drives out = reference_drives();
  out[0].mounting = 2.0943951023931953;
  out[1].mounting = 1.0471975511965976;
  out[1].mirror = -1;
  return out;
}

/// A case of tests/published/pi-joint-parallel-robots.json: what it computes, and what went in.
inline const Value& computed(std::string_view id) {
  return test::at(test::published_case("pi-joint-parallel-robots.json", id), "computed");
}
inline double computed_number(std::string_view id, std::string_view key) {
  return test::number_at(computed(id), key);
}
inline const Value& inputs(std::string_view id) {
  return test::at(test::published_case("pi-joint-parallel-robots.json", id), "inputs");
}
/// A DELTA of the reference figures.
inline Robot delta_of(const Value& robot) {
  return delta({.base_radius = test::number_at(robot, "Rb_m"),
                .platform_radius = test::number_at(robot, "rp_m"),
                .arm = test::number_at(robot, "La_m"),
                .rod = test::number_at(robot, "Lf_m")});
}
inline Vec3 point(const Value& array) {
  const auto at = test::numbers(array);
  return {at.at(0), at.at(1), at.size() > 2 ? at[2] : 0};
}

}  // namespace linkwright::parallel
