// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/planar/serial_arm/serial_arm.h"
#include "planar/serial_arm_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

// Links with inertia of their own, so that the mass matrix is far from singular.
SerialArm heavy_arm(std::size_t n) {
  SerialArm arm = test::any_arm(n);
  for (ArmLink& link : arm.links) link.body.inertia += 0.5;
  return arm;
}

RC_GTEST_PROP(SerialArmDynamicsProperty, AccelerationsAreThoseOfTheTorques, ()) {
  const std::size_t n = static_cast<std::size_t>(*rc::gen::inRange(1, 6));
  const SerialArm arm = heavy_arm(n);
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> motion = test::any_motion(n);
  const double gravity = *test::between(0, 20);
  std::vector<ArmLinkRates> r(n);
  std::vector<ArmJointLoads> loads(n);
  rates(e, arm.base, motion, r);
  reactions(e, r, gravity, loads);
  std::vector<double> torques;
  double largest = 1;
  for (const ArmJointLoads& l : loads) torques.push_back(l.absolute_torque);
  for (double t : torques) largest = std::max(largest, std::abs(t));
  std::vector<math::Motion> found = motion;
  for (math::Motion& m : found) m.acceleration = 1e6;  // not read
  RC_ASSERT(accelerate(e, torques, gravity, found) == Status::done);
  // Rounding of torques up to some thousand over a least inertia of 0.5.
  for (std::size_t k = 0; k < n; ++k)
    RC_ASSERT(std::abs(found[k].acceleration - motion[k].acceleration) <= 1e-11 * (largest + 1e4));
}

// The matrix is the change of the torques with each acceleration, and twice the kinetic energy.
RC_GTEST_PROP(SerialArmDynamicsProperty, MassMatrixIsThatOfTheEnergy, ()) {
  const std::size_t n = static_cast<std::size_t>(*rc::gen::inRange(1, 6));
  const SerialArm arm = heavy_arm(n);
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> motion = test::any_motion(n);
  std::vector<double> angles;
  for (const math::Motion& m : motion) angles.push_back(m.value);
  const std::vector<double> matrix = mass_matrix(e, angles);
  std::vector<ArmLinkRates> r(n);
  rates(e, arm.base, motion, r);
  double twice = 0, size = 1;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      RC_ASSERT(matrix[j * n + k] == matrix[k * n + j]);
      twice += matrix[j * n + k] * motion[j].rate * motion[k].rate;
      size += std::abs(matrix[j * n + k] * motion[j].rate * motion[k].rate);
    }
  RC_ASSERT(std::abs(twice - 2 * energy(e, r, 0).kinetic) <= 1e-13 * size);
}

TEST(SerialArmDynamics, FreePendulumKeepsItsEnergy) {
  const SerialArm arm{{0, 0}, {{1, {2, 0.1, 0.5, 0.2}, {}}, {0.8, {1, 0.05, 0.4, 0}, {{0.5, 0.8, 0}}}}};
  const std::vector<ArmElement> e = elements(arm);
  std::vector<math::Motion> motion = {{0.3, 1.5, 0, 0}, {-0.9, -2, 0, 0}};
  const std::vector<double> none(2);
  ASSERT_EQ(accelerate(e, none, 9.81, motion), Status::done);
  std::vector<ArmLinkRates> r(2);
  rates(e, arm.base, motion, r);
  EXPECT_NEAR(energy_rate(e, r, 9.81), 0, 1e-12);
  EXPECT_GT(std::abs(motion[0].acceleration), 1);
}

TEST(SerialArmDynamics, OfALinkWithoutInertiaIsSingular) {
  const SerialArm arm{0, {{1, {2, 0.1, 0.5, 0}, {}}, {0.8, {}, {}}}};
  const std::vector<ArmElement> e = elements(arm);
  std::vector<math::Motion> motion(2);
  const std::vector<double> torques = {1, 0};
  EXPECT_EQ(accelerate(e, torques, 9.81, motion), Status::singular);
  EXPECT_TRUE(std::isnan(motion[0].acceleration));
}

TEST(SerialArmDynamics, RejectsWhatDoesNotFit) {
  const std::vector<ArmElement> e = elements({0, {{1, {}, {}}}});
  EXPECT_THAT(test::message([&] { mass_matrix(e, {}); }), HasSubstr("0 angles for 1 links"));
  EXPECT_THAT(test::message([&] { accelerate(e, {}, 0, {}); }),
              HasSubstr("0 torques and 0 motions for 1 links"));
}

}  // namespace
}  // namespace linkwright::planar
