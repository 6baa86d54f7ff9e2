// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/screw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::test;

const Screw m20{.lead = 0.0025, .pitch_diameter = 0.018376, .friction = 0.15, .flank_angle = pi / 3};

TEST(Screw, RaisesLowersAndLocks) {
  const Value& wanted = at(published_case("planar-machines.json", "screw-M20"), "computed");
  const ScrewThread thread = thread_of(m20);
  EXPECT_NEAR(math::degrees(thread.lead_angle), number_at(wanted, "lead_angle_deg"), 1e-12);
  EXPECT_NEAR(math::degrees(thread.friction_angle), number_at(wanted, "friction_angle_deg"), 1e-12);
  EXPECT_NEAR(thread.efficiency, number_at(wanted, "efficiency_raise"), 1e-14);
  EXPECT_NEAR(thread.margin, number_at(wanted, "self_locking_margin"), 1e-13);
  EXPECT_NEAR(spindle_torque(m20, 10000, 0.01, 0), number_at(wanted, "raise_N_m"), 1e-12);
  // Lowering turns the spindle back, against the friction alone.
  EXPECT_NEAR(spindle_torque(m20, 10000, -0.01, 0), -number_at(wanted, "lower_N_m"), 1e-12);
  EXPECT_EQ(spindle_torque(m20, 10000, 0, 0), 0);
  EXPECT_NEAR(spindle_torque(m20, -10000, -0.01, 0), -number_at(wanted, "raise_N_m"), 1e-12);
}
TEST(Screw, WithoutFrictionKeepsThePower) {
  Screw screw{.lead = 0.01, .spindle_inertia = 2e-5};
  EXPECT_NEAR(spindle_torque(screw, 500, 0.2, 0) * spindle_turning(screw) * 0.2, 500 * 0.2, 1e-12);
  EXPECT_NEAR(spindle_torque(screw, 0, 0.2, 3), 2e-5 * full_turn / 0.01 * 3, 1e-15);
  screw.left_hand = true;
  EXPECT_NEAR(spindle_torque(screw, 500, 0.2, 0) * spindle_turning(screw) * 0.2, 500 * 0.2, 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
