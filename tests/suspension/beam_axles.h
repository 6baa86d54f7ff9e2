// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/dependent/beam_position.h"

// Rigid axles with coordinates (m) that are plausible for road cars.
namespace linkwright::suspension::test {

/// An axle without links, wheel centres 0.32 m above the ground.
inline BeamAxle bare_axle() {
  BeamAxle axle;
  axle.left = {.centre = {0, 0.75, 0.32}, .toe = 0, .camber = 0, .tyre_diameter = 0.64};
  axle.right = {.centre = {0, -0.75, 0.32}, .toe = 0, .camber = 0, .tyre_diameter = 0.64};
  return axle;
}
inline void add_pair(BeamAxle& axle, const char* left, const char* right, const Vec3& body,
                     const Vec3& beam) {
  axle.rods.push_back({left, body, beam, {}});
  axle.rods.push_back({right, math::mirrored(body), math::mirrored(beam), {}});
}
inline BeamAxle with_lower_links() {
  BeamAxle axle = bare_axle();
  add_pair(axle, "left lower link", "right lower link", {0.50, 0.52, 0.31}, {-0.02, 0.52, 0.24});
  return axle;
}
/// Four links, the upper ones converge rearward.
inline BeamAxle four_link_axle() {
  BeamAxle axle = bare_axle();
  add_pair(axle, "left lower link", "right lower link", {0.52, 0.45, 0.30}, {0.02, 0.55, 0.25});
  add_pair(axle, "left upper link", "right upper link", {0.33, 0.40, 0.47}, {-0.03, 0.10, 0.45});
  return axle;
}
/// Two lower links, an upper link off the middle and a Panhard rod.
inline BeamAxle panhard_axle() {
  BeamAxle axle = with_lower_links();
  axle.rods.push_back({"upper link", {0.34, 0.08, 0.45}, {-0.01, 0.10, 0.46}, {}});
  axle.rods.push_back({"Panhard rod", {-0.14, 0.50, 0.33}, {-0.15, -0.48, 0.27}, {}});
  return axle;
}
/// The same with a Watt linkage, its pivot on the beam.
inline BeamAxle watt_axle() {
  BeamAxle axle = with_lower_links();
  axle.rods.push_back({"upper link", {0.34, 0.0, 0.45}, {-0.01, 0.0, 0.46}, {}});
  axle.watts.push_back({.name = "Watt linkage",
                        .pivot_on_beam = true,
                        .pivot = {-0.12, 0, 0.30},
                        .axis = {1, 0, 0},
                        .crank = {Vec3{-0.12, 0, 0.37}, Vec3{-0.12, 0, 0.23}},
                        .ends = {Vec3{-0.12, 0.50, 0.37}, Vec3{-0.12, -0.50, 0.23}}});
  return axle;
}
/// Lower links and an A-arm with its ball joint on the beam.
inline BeamAxle arm_axle() {
  BeamAxle axle = with_lower_links();
  axle.arms.push_back({"A-arm", {{0.30, 0.35, 0.46}, {0.30, -0.35, 0.46}}, {{-0.04, 0.0, 0.48}}});
  return axle;
}
/// A twist beam with its shear centre between the bushings and the wheels.
inline BeamAxle twist_axle() {
  BeamAxle axle = bare_axle();
  axle.twist = AxleTwist{.name = "twist beam",
                         .pivots = {Vec3{0.42, 0.52, 0.36}, Vec3{0.42, -0.52, 0.36}},
                         .shear_centre = {0.25, 0, 0.38},
                         .axis = {0, 1, 0}};
  return axle;
}
/// Three guides hold the beam in the transverse plane: all of its motion is planar.
inline BeamAxle planar_axle() {
  BeamAxle axle = bare_axle();
  axle.guides.push_back({"left guide", {0, 0.6, 0.32}, {1, 0, 0}});
  axle.guides.push_back({"right guide", {0, -0.6, 0.32}, {1, 0, 0}});
  axle.guides.push_back({"upper guide", {0, 0, 0.5}, {1, 0, 0}});
  return axle;
}

inline BeamPosition position_at(const BeamAxlePlan& plan, double heave, double roll) {
  return solve_position(plan, {AxleInputs::heave_roll, heave, roll}, reference_position(plan));
}

}  // namespace linkwright::suspension::test
