// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_pins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/core/numbers.h"

namespace linkwright::clearance {
namespace {

// A four-bar whose crank pin and ground pin have clearance, somewhere in motion.
struct Moving {
  planar::Linkage linkage = as_linkage(published_four_bar("gamma-design2-table3-g9.81-w20"));
  std::vector<ContactJoint> joints;
  OpenLinkage open;

  explicit Moving(PinSide side) {
    for (const char* name : {"A", "O4"})
      joints.push_back({.joint = planar::joint_index(linkage, name),
                        .clearance = 1e-3,
                        .bush_radius = 0.01,
                        .law = {.stiffness = 1e9},
                        .pin = side});
    open = open_linkage(linkage, std::vector{joints[0].joint, joints[1].joint}, std::vector{0.4});
  }
  // Moves on uniformly for a time, s.
  planar::LinkageMotion motion(double t) const {
    planar::LinkageMotion out(open.plan);
    std::vector<planar::InputMotion> inputs;
    for (std::size_t k = 0; k < open.start.size(); ++k) {
      const double rate = 3 - 1.5 * static_cast<double>(k);
      inputs.push_back({open.start[k] + rate * (0.01 + t), rate, 0});
    }
    planar::solve_motion(open.plan, inputs, out);
    return out;
  }
};

// Rates and accelerations are those of the places, by central differences of 1e-5 s: what they leave is their
// square times third derivatives, below 1e-6 of the value.
TEST(ContactPins, RatesAreThoseOfThePlaces) {
  for (const PinSide side : {PinSide::first, PinSide::second}) {
    Moving m(side);
    ASSERT_EQ(m.open.status, Status::done) << m.open.message;
    ContactPins pins(m.open, m.joints);
    const double h = 1e-5;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto at = [&](double t) {
        pins.place(m.motion(t));
        return pins[k];
      };
      const PinPlace before = at(-h), after = at(h), now = at(0);
      EXPECT_NEAR(norm((0.5 / h) * (after.eccentricity - before.eccentricity) - now.rate), 0,
                  1e-6 * norm(now.rate));
      EXPECT_NEAR((after.depth - before.depth) / (2 * h), now.depth_rate, 1e-6 * norm(now.rate));
      const planar::LinkageMotion here = m.motion(0);
      pins.place(here);
      const math::Vec2 acceleration = pins.acceleration(here, k);
      EXPECT_NEAR(norm((0.5 / h) * (after.rate - before.rate) - acceleration), 0, 1e-6 * norm(acceleration));
      EXPECT_NEAR((after.depth_rate - before.depth_rate) / (2 * h), pins.depth_acceleration(here, k),
                  1e-6 * norm(acceleration));
    }
  }
}

// The sides of a pin say who carries it, nothing else: the eccentricity turns round.
TEST(ContactPins, SidesExchangePinAndBush) {
  Moving first(PinSide::first), second(PinSide::second);
  ContactPins a(first.open, first.joints), b(second.open, second.joints);
  a.place(first.motion(0));
  b.place(second.motion(0));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(norm(a[k].eccentricity + b[k].eccentricity), 0, 1e-15);
    EXPECT_NEAR(a[k].depth, b[k].depth, 1e-15);
    EXPECT_NEAR(a[k].depth_rate, b[k].depth_rate, 1e-12);
  }
  // The frame of the ground is the global one; that of the rocker turns.
  EXPECT_NEAR(
      b.bush_angle(second.motion(0), 1),
      std::remainder(math::angle_of(b[1].eccentricity) -
                         math::angle_of(planar::body_state(second.open.plan, second.motion(0), 0).direction),
                     2 * pi),
      1e-14);
}

// Pin and bush feel opposite forces at one point: together no force and no moment.
TEST(ContactPins, ForcesBalance) {
  Moving m(PinSide::first);
  ContactPins pins(m.open, m.joints);
  const planar::LinkageMotion motion = m.motion(0);
  pins.place(motion);
  const std::vector<PinForce> forces{{120, 7}, {0, 0}};
  pins.press(forces);
  math::Vec2 sum{0, 0};
  double moment = 0, largest = 0;
  for (const planar::PointForce& f : m.open.linkage.forces) {
    const math::Vec2 force = math::vec(f.force);
    const auto where = planar::point_motion(m.open.plan, motion, f.point.body,
                                            m.open.linkage.bodies[static_cast<std::size_t>(f.point.body)]
                                                .points[static_cast<std::size_t>(f.point.point)]
                                                .at)
                           .position;
    sum = sum + force;
    moment += cross(where, force);
    largest = std::max(largest, norm(force));
  }
  for (const planar::BodyTorque& t : m.open.linkage.torques) moment += t.torque;
  EXPECT_NEAR(norm(sum), 0, 1e-12);
  EXPECT_NEAR(moment, 0, 1e-12);
  EXPECT_NEAR(largest, std::hypot(120, 7), 1e-12);
}

}  // namespace
}  // namespace linkwright::clearance
