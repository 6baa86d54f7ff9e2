// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_axle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "suspension/beam_axles.h"

namespace linkwright::suspension {
namespace {

using test::arm_axle;
using test::bare_axle;
using test::four_link_axle;
using test::panhard_axle;
using test::planar_axle;
using test::twist_axle;
using test::watt_axle;
using test::with_lower_links;

TEST(BeamAxleModel, CountsTheConstraintsOfItsParts) {
  EXPECT_EQ(constraints_of(four_link_axle()), 4);
  EXPECT_EQ(constraints_of(panhard_axle()), 4);
  EXPECT_EQ(constraints_of(watt_axle()), 4);
  EXPECT_EQ(constraints_of(arm_axle()), 4);
  EXPECT_EQ(constraints_of(twist_axle()), 4);
  for (const BeamAxle& axle : {four_link_axle(), panhard_axle(), watt_axle(), arm_axle(), twist_axle()})
    EXPECT_EQ(check_beam_axle(axle).message, "");
}

TEST(BeamAxleModel, TooFewAndTooManyConstraintsAreCountedByName) {
  BeamAxle axle = panhard_axle();
  axle.rods.pop_back();
  AxleFault fault = check_beam_axle(axle);
  EXPECT_EQ(
      fault.message,
      "the links take 3 of the six freedoms of the axle (3 rods: 3); four leave heave and roll: the axle is "
      "not located");
  EXPECT_EQ(fault.hint, "add 1 more, for example a Panhard rod");
  axle = arm_axle();
  axle.rods.push_back({"Panhard rod", {-0.14, 0.50, 0.33}, {-0.15, -0.48, 0.27}, {}});
  fault = check_beam_axle(axle);
  EXPECT_EQ(
      fault.message,
      "the links take 5 of the six freedoms of the axle (3 rods: 3, 1 A-arm: 2); four leave heave and roll: "
      "the axle is overconstrained");
  EXPECT_EQ(check_beam_axle(bare_axle()).message,
            "the links take 0 of the six freedoms of the axle (there are none); four leave heave and roll: "
            "the axle "
            "is not located");
}

TEST(BeamAxleModel, FourParallelLinksDoNotLocateItLaterally) {
  BeamAxle axle = with_lower_links();
  test::add_pair(axle, "left upper link", "right upper link", {0.50, 0.40, 0.51}, {-0.02, 0.40, 0.44});
  const AxleFault fault = check_beam_axle(axle);
  EXPECT_EQ(
      fault.message,
      "the links leave the axle free in shifting along y at given heave and roll, since 'left lower link', "
      "'right lower link', 'left upper link', 'right upper link' constrain it alike");
  EXPECT_NE(fault.hint.find("Panhard"), std::string::npos);
  EXPECT_THROW(prepare_beam_axle(axle), ContractError);
}

TEST(BeamAxleModel, ALinkThatRepeatsAnotherIsNamed) {
  BeamAxle axle = panhard_axle();
  axle.rods[2] = axle.rods[0];
  axle.rods[2].name = "copy";
  const AxleFault fault = check_beam_axle(axle);
  EXPECT_NE(fault.message.find("since 'left lower link', 'copy' constrain it alike"), std::string::npos)
      << fault.message;
}

TEST(BeamAxleModel, PointsInOnePlaceAndExchangedWheelsAreReported) {
  BeamAxle axle = panhard_axle();
  axle.rods[3].beam = axle.rods[3].body;
  EXPECT_EQ(check_beam_axle(axle).message, "both joints of 'Panhard rod' are in one place");
  axle = panhard_axle();
  std::swap(axle.left, axle.right);
  EXPECT_EQ(check_beam_axle(axle).message,
            "the left wheel is at y = -750 mm and the right one at y = 750 mm");
  axle = arm_axle();
  axle.arms[0].beam[0] = {0.30, 0.1, 0.46};
  EXPECT_EQ(check_beam_axle(axle).message, "the ball joint of 'A-arm' lies on the axis of its hinge");
  axle = watt_axle();
  axle.watts[0].crank[1] = {-0.3, 0, 0.30};
  EXPECT_EQ(check_beam_axle(axle).message, "end 2 of the bellcrank of 'Watt linkage' lies on its axis");
}

/// Central differences of all equations against their derivatives, at a place off the reference.
void compare_with_differences(const BeamAxle& axle, AxleInputs inputs) {
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  BeamPlace place{plan.centre + Vec3{0.01, -0.02, 0.03}, math::turn_about(Vec3{0.05, -0.03, 0.02}), {0.1}};
  const std::array<double, 2> values{0.01, 0.04};
  AxleEquations at, low, high;
  evaluate(plan, place, inputs, values, at);
  constexpr double step = 1e-5;  // truncation 1e-10, rounding 1e-11
  for (int j = 0; j < plan.unknowns; ++j) {
    const auto moved = [&](double by) {
      BeamPlace out = place;
      if (j < 3)
        out.centre += Vec3{j == 0 ? by : 0, j == 1 ? by : 0, j == 2 ? by : 0};
      else if (j < 6)
        out.rotation =
            math::turn_about(Vec3{j == 3 ? by : 0, j == 4 ? by : 0, j == 5 ? by : 0}) * place.rotation;
      else
        out.cranks[static_cast<std::size_t>(j - 6)] += by;
      return out;
    };
    evaluate(plan, moved(-step), inputs, values, low);
    evaluate(plan, moved(step), inputs, values, high);
    for (std::size_t i = 0; i < static_cast<std::size_t>(plan.unknowns); ++i)
      EXPECT_NEAR(at.jacobian[i][static_cast<std::size_t>(j)],
                  (high.residual[i] - low.residual[i]) / (2 * step), 2e-9)
          << "equation " << i << ", unknown " << j;
  }
}

TEST(BeamAxleModel, DerivativesAgreeWithDifferences) {
  for (const AxleInputs inputs : {AxleInputs::heave_roll, AxleInputs::wheel_centres, AxleInputs::contacts}) {
    BeamAxle axle = watt_axle();
    axle.left.toe = axle.right.toe = 0.02;
    axle.left.camber = axle.right.camber = -0.03;
    compare_with_differences(axle, inputs);
    axle.watts[0].pivot_on_beam = false;  // the rods now lead from the body's bellcrank to the beam
    compare_with_differences(axle, inputs);
    compare_with_differences(arm_axle(), inputs);
    BeamAxle twist = twist_axle();
    twist.left.toe = twist.right.toe = 0.02;
    twist.left.camber = twist.right.camber = -0.03;
    compare_with_differences(twist, inputs);
    BeamAxle planar = planar_axle();
    planar.rods.push_back({"Panhard rod", {0, 0.50, 0.33}, {0, -0.48, 0.27}, {}});
    compare_with_differences(planar, inputs);
    BeamAxle tube = bare_axle();
    tube.ball_joints.push_back({"torque tube", {0.9, 0, 0.4}});
    tube.rods.push_back({"Panhard rod", {-0.14, 0.50, 0.33}, {-0.15, -0.48, 0.27}, {}});
    compare_with_differences(tube, inputs);
  }
}

}  // namespace
}  // namespace linkwright::suspension
