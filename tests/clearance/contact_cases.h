// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "clearance/clearance_linkages.h"
#include "clearance/published_four_bar.h"
#include "linkwright/clearance/contact_simulation.h"
#include "linkwright/core/numbers.h"

namespace linkwright::clearance {

/// Slider-crank of the literature (Flores, Ambrosio and Claro 2004): crank and rod in line at the start.
inline planar::Linkage contact_slider_crank() {
  using namespace planar;
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "B", 0.12);
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.O", "slider.B");
  add_drive(l, "O");
  set_start(l, "rod", {0.05, 0}, 0);
  set_start(l, "slider", {0.17, 0}, 0);
  l.bodies[1].mass = BodyMass{0.3, 1e-4, {0.025, 0}};
  l.bodies[2].mass = BodyMass{0.21, 2.5e-4, {0.06, 0}};
  l.bodies[3].mass = BodyMass{0.14, 0, {0, 0}};
  l.gravity = 0;
  return l;
}
inline constexpr double slider_crank_speed = 5000 * 2 * pi / 60;
inline ContactJoint slider_crank_joint(const planar::Linkage& l, double friction = 0,
                                       const char* joint = "B") {
  return {.joint = planar::joint_index(l, joint),
          .clearance = 5e-4,
          .bush_radius = 0.01,
          .law = {.stiffness = pin_stiffness(0.01, 0.0095),
                  .restitution = 0.9,
                  .damping = ContactDamping::lankarani_nikravesh,
                  .friction = friction}};
}

/// Uniformly rotating crank from angle 0.
inline planar::InputDrive uniform_crank(double speed) { return {math::ConstantSpeed{0, speed}, 0, 0}; }

}  // namespace linkwright::clearance
