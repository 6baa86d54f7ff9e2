// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

TEST(PiCurves, AreThoseOfTheFigures) {
  const Value& expected = *computed("pi-curves").find("prototype");
  auto at = test::numbers(test::at(expected, "theta_deg"));
  for (double& angle : at) angle = math::radians(angle);
  const auto curves = pi_curves(pi_prototype(), {.drive = pi_prototype_drive()}, at);
  ASSERT_EQ(curves.size(), at.size());
  const auto column = [&](const char* key, auto&& of) {
    const auto values = test::numbers(test::at(expected, key));
    for (std::size_t i = 0; i < values.size(); ++i) expect_same(of(curves[i]), values[i]);
  };
  column("d_m", [](const PiCurvePoint& p) { return p.diagonal; });
  column("torque_Nm", [](const PiCurvePoint& p) { return p.output.torque; });
  column("speed_rad_s", [](const PiCurvePoint& p) { return p.output.speed; });
  column("resolution_rad", [](const PiCurvePoint& p) { return p.output.resolution; });
  for (const PiCurvePoint& p : curves) {
    EXPECT_DOUBLE_EQ(p.jacobian * p.inverse_jacobian, 1);
    EXPECT_NEAR(p.jacobian, 0.17 * std::sin(p.angles.transmission), 1e-16);
  }
}

TEST(PiCurves, HoldWhatTheEquipmentTells) {
  const double at[] = {0.3};
  const PiCurvePoint bare = pi_curves(pi_prototype(), {}, at).front();
  for (double unknown : {bare.output.torque, bare.output.speed, bare.output.resolution, bare.stiffness,
                         bare.inertia, bare.holding_torque, bare.holding_force})
    EXPECT_TRUE(std::isnan(unknown));
  const PiEquipment equipment{.bars = PiBars{.diagonal = 1e7},
                              .masses = PiMasses{.coupler_mass = 2},
                              .load = {.gravity_y = -10, .torque = 0.5}};
  const PiCurvePoint full = pi_curves(pi_prototype(), equipment, at).front();
  EXPECT_DOUBLE_EQ(full.stiffness, full.jacobian * full.jacobian * 1e7);
  EXPECT_DOUBLE_EQ(full.inertia, 2 * 0.17 * 0.17);
  EXPECT_DOUBLE_EQ(full.holding_torque, 20 * 0.17 * std::cos(0.3) - 0.5);
  EXPECT_DOUBLE_EQ(full.holding_force, full.holding_torque / full.jacobian);
  EXPECT_TRUE(std::isnan(full.output.torque));
}

}  // namespace
}  // namespace linkwright::parallel
