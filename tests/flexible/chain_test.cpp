// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

constexpr Kinematics all[] = {Kinematics::chord_consistent, Kinematics::hub_axis,
                              Kinematics::source_linearised};

TEST(Chain, MassesOfSimpsonsRule) {
  for (const int n : {1, 2, 3, 7}) {
    const Beam beam = stub();
    const Chain chain = discretise(beam, n);
    ASSERT_EQ(chain.cells.size(), 2 * n);
    double mass = chain.root_mass, inertia = chain.root_inertia, first_moment = 0, second_moment = 0, x = 0;
    for (const Cell& cell : chain.cells) {
      x += cell.length;
      mass += cell.mass;
      inertia += cell.inertia;
      first_moment += cell.mass * x;
      second_moment += cell.mass * x * x;
    }
    // Simpson's rule is exact for the mass, its centre and its moment of inertia; rounding of a few sums.
    EXPECT_NEAR(mass, 78 + 2, 1e-12);
    EXPECT_NEAR(inertia, 7800 * beam.second_moment + 0.01, 1e-14);
    EXPECT_NEAR(first_moment, 39 + 2, 1e-12);
    EXPECT_NEAR(second_moment, 26 + 2, 1e-12);
    EXPECT_NEAR(chain.length(), 1, 1e-15);
  }
}

TEST(Chain, MassesAndStiffnessesAsPrinted) {
  // (3.1)-(3.4) with two divisions.
  const Beam beam = stub();
  const Chain chain = discretise(beam, 2);
  const double m = 78, l = 0.25, ei = beam.bending_stiffness();
  EXPECT_DOUBLE_EQ(chain.root_mass, m / 12);
  EXPECT_DOUBLE_EQ(chain.cells[0].mass, m / 3);
  EXPECT_DOUBLE_EQ(chain.cells[1].mass, m / 6);
  EXPECT_DOUBLE_EQ(chain.cells[2].mass, m / 3);
  EXPECT_DOUBLE_EQ(chain.cells[3].mass, m / 12 + 2);
  EXPECT_DOUBLE_EQ(chain.cells[3].bending, ei / l);
  const double phi = 12 * ei / (beam.shear_stiffness() * l * l);
  EXPECT_DOUBLE_EQ(chain.cells[0].shear, 12 * ei / (l * l * l * (1 + phi)));
}

TEST(Chain, StraightAndTurnedShapes) {
  for (const Kinematics kinematics : all) {
    const Chain chain = discretise(torque_beam(), 2, kinematics);
    ChainState state = state_at_rest(chain);
    const bool linear = kinematics == Kinematics::source_linearised;
    const ChainShape straight = shape(chain, state.q);
    for (int j = 0; j <= 4; ++j) EXPECT_NEAR(straight.node[j].x, 0.05 + 0.45 * j, 1e-15);
    // A turn of the first joint alone turns all that follows about its middle.
    state.q[turn] = 0.3;
    const ChainShape turned = shape(chain, state.q);
    EXPECT_DOUBLE_EQ(turned.angle[4], 0.3);
    const double arm = 1.8 - 0.225;
    if (linear) {
      EXPECT_NEAR(turned.node[4].y, arm * 0.3, 1e-15);
      EXPECT_NEAR(turned.node[4].x, 1.85, 1e-15);
    } else {
      const double e = kinematics == Kinematics::chord_consistent ? 0.45 * 0.09 / 12 : 0;
      EXPECT_NEAR(turned.node[4].y, arm * std::sin(0.3) + e * std::sin(0.15), 1e-15);
      EXPECT_NEAR(turned.node[4].x, 0.05 + 0.225 + arm * std::cos(0.3) + e * std::cos(0.15), 1e-15);
    }
    EXPECT_DOUBLE_EQ(largest_kink(chain, state.q), 0.3);
  }
}

TEST(Chain, SlidesGoWhereTheKinematicsSay) {
  const double w = 0.01, bend = 0.4;
  for (const Kinematics kinematics : all) {
    const Chain chain = discretise(torque_beam(), 1, kinematics);
    ChainState state = state_at_rest(chain);
    state.q[turn] = bend;
    const math::Vec2 before = shape(chain, state.q).node[2];
    state.q[coordinates_per_cell + slide] = w;
    const math::Vec2 moved = shape(chain, state.q).node[2] - before;
    if (kinematics == Kinematics::chord_consistent) {
      // Across the second joint's bars, both at 0.4 rad, and shorter by c2 w^2 / l, c2 = 0.6 without shear.
      const double shorter = 0.6 * w * w / 0.9;
      EXPECT_NEAR(moved.x, -w * std::sin(bend) - shorter * std::cos(bend), 1e-15);
      EXPECT_NEAR(moved.y, w * std::cos(bend) - shorter * std::sin(bend), 1e-15);
    } else {
      EXPECT_NEAR(moved.x, 0, 1e-15);
      EXPECT_NEAR(moved.y, w, 1e-15);
    }
  }
}

TEST(Chain, ShortensAsTheCubicLineThroughItsNodes) {
  // A cell bent to a cubic by small end forces and couples: shortening = integral of y'^2 / 2. Slide w and
  // turn delta give y' = slopes of a circle plus those of the cubic bubble; orders above the second are 1e-4
  // of it.
  const Chain chain = discretise(spin_up_beam(), 1);
  const double l = 4, w = 1e-3, delta = 1e-3;
  ChainState state = state_at_rest(chain);
  state.q[turn] = delta;
  state.q[slide] = w;
  const double chord = shape(chain, state.q).node[1].x;
  // Clamped at the hub: y(0) = y'(0) = 0, y'(l) = delta, y(l) = w + l delta / 2.
  const double end = w + l * delta / 2;
  const double a = (3 * end - l * delta) / (l * l), b = (l * delta - 2 * end) / (l * l * l);
  double shorter = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = (i + 0.5) * l / 1000, slope = 2 * a * x + 3 * b * x * x;
    shorter += slope * slope / 2 * l / 1000;
  }
  EXPECT_NEAR(l - chord, shorter, 1e-5 * shorter);
}

TEST(Chain, RefusesWhatTheKinematicsDoNotKnow) {
  EXPECT_EQ(test::message([] { discretise(spin_up_beam(), 0); }),
            "discretise: 0 divisions: at least 1 [divisions >= 1]");
  Beam beam = spin_up_beam();
  beam.gravity = 9.81;
  EXPECT_NE(test::message([&] {
              discretise(beam, 2, Kinematics::source_linearised);
            }).find("source_linearised has no gravity, damping or springs along the link"),
            std::string::npos);
  beam.length = 0;
  EXPECT_NE(test::message([&] { discretise(beam, 2); }).find("length = 0 m: it must be positive"),
            std::string::npos);
  const Chain chain = discretise(spin_up_beam(), 2);
  EXPECT_NE(test::message([&] { shape(chain, std::vector<double>(3)); }).find("3 coordinates for 4 cells"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::flexible
