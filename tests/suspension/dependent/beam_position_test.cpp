// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_position.h"

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
using test::position_at;
using test::twist_axle;
using test::watt_axle;

constexpr double rounding = 1e-13;  ///< m: residual 1e-14 m by the condition of these axles

TEST(BeamPosition, ALevelPanhardRodShiftsAPlanarAxleByItsArc) {
  constexpr double length = 0.9;
  BeamAxle axle = planar_axle();
  axle.rods.push_back({"Panhard rod", {0, 0.45, 0.3}, {0, -0.45, 0.3}, {}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  for (const double heave : {-0.12, -0.05, 0.03, 0.1}) {
    const BeamPosition p = position_at(plan, heave, 0);
    ASSERT_EQ(p.status, Status::done) << p.reason;
    const double angle = std::asin(heave / length);
    EXPECT_NEAR(p.place.centre.y, length * (1 - std::cos(angle)), rounding);
    EXPECT_NEAR(p.place.centre.z, 0.32 + heave, rounding);
    EXPECT_NEAR(p.place.centre.x, 0, rounding);
  }
}

TEST(BeamPosition, ParallelLinksAndAPanhardRodKeepTheBeamParallel) {
  // Three equal parallel links of length a along x and a rod of length l along y: circles that meet in closed
  // form, x = -(l / a) y and (1 + l^2 / a^2) y^2 - 2 l y + z^2 = 0.
  constexpr double a = 0.5, l = 0.9;
  BeamAxle axle = bare_axle();
  test::add_pair(axle, "left", "right", {a, 0.5, 0.25}, {0, 0.5, 0.25});
  axle.rods.push_back({"upper", {a, 0, 0.45}, {0, 0, 0.45}, {}});
  axle.rods.push_back({"Panhard rod", {0, 0.45, 0.3}, {0, -0.45, 0.3}, {}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  for (const double z : {-0.08, 0.04, 0.1}) {
    const BeamPosition p = position_at(plan, z, 0);
    ASSERT_EQ(p.status, Status::done) << p.reason;
    const double k = 1 + l * l / (a * a), y = (l - std::sqrt(l * l - k * z * z)) / k;
    EXPECT_NEAR(p.place.centre.y, y, rounding);
    EXPECT_NEAR(p.place.centre.x, l / a * y, rounding);
    EXPECT_NEAR(norm(math::turn_of(p.place.rotation)), 0, rounding);
  }
}

TEST(BeamPosition, RodsKeepTheirLengthsOverHeaveAndRoll) {
  for (const BeamAxle& axle : {four_link_axle(), panhard_axle(), watt_axle(), arm_axle(), twist_axle()}) {
    const BeamAxlePlan plan = prepare_beam_axle(axle);
    for (const double heave : {-0.08, 0.0, 0.08})
      for (const double roll : {-0.07, 0.0, 0.05}) {
        const BeamPosition p = position_at(plan, heave, roll);
        ASSERT_EQ(p.status, Status::done) << p.reason;
        for (const AxleRod& r : axle.rods)
          EXPECT_NEAR(norm(on_beam(plan, p.place, r.beam) - r.body), norm(r.beam - r.body), rounding);
        for (const AxleArm& arm : axle.arms)
          for (const Vec3& body : arm.body)
            EXPECT_NEAR(norm(on_beam(plan, p.place, arm.beam[0]) - body), norm(arm.beam[0] - body), rounding);
        for (std::size_t k = 0; k < 2 && !axle.watts.empty(); ++k) {
          const AxleWatt& w = axle.watts[0];
          const Vec3 end = crank_end(plan, p.place, 0, k);
          EXPECT_NEAR(norm(end - w.ends[k]), norm(w.crank[k] - w.ends[k]), rounding);
          EXPECT_NEAR(norm(end - on_beam(plan, p.place, w.pivot)), norm(w.crank[k] - w.pivot), rounding);
        }
        for (std::size_t k = 0; k < 2 && axle.twist; ++k) {
          const Vec3 moved = on_beam(plan, p.place, axle.twist->pivots[k]) - axle.twist->pivots[k];
          EXPECT_NEAR(moved.x, 0, rounding);
          EXPECT_NEAR(moved.z, 0, rounding);
          const Vec3 other = on_beam(plan, p.place, axle.twist->pivots[1 - k]) - axle.twist->pivots[1 - k];
          EXPECT_NEAR(moved.y, -other.y, rounding);  // both bushings give way alike
          EXPECT_LT(std::abs(moved.y), 1e-3);
        }
        const Vec3 left = contact_point(plan, p.place, Side::left),
                   right = contact_point(plan, p.place, Side::right);
        EXPECT_NEAR((left.z + right.z) / 2, heave, rounding);
        EXPECT_NEAR(std::atan2(left.z - right.z, left.y - right.y), roll, rounding);
      }
  }
}

TEST(BeamPosition, APositionDoesNotDependOnItsPathOrOnItsInputs) {
  for (const BeamAxle& axle : {four_link_axle(), panhard_axle(), watt_axle(), arm_axle(), twist_axle()}) {
    const BeamAxlePlan plan = prepare_beam_axle(axle);
    const BeamPosition direct = position_at(plan, 0.06, 0.05);
    const BeamPosition detour =
        solve_position(plan, {AxleInputs::heave_roll, 0.06, 0.05}, position_at(plan, -0.05, -0.04));
    EXPECT_NEAR(norm(direct.place.centre - detour.place.centre), 0, rounding);
    for (const AxleInputs inputs : {AxleInputs::wheel_centres, AxleInputs::contacts}) {
      const std::array<double, 2> values = beam_inputs(plan, direct.place, inputs);
      const BeamPosition by = solve_position(plan, {inputs, values[0], values[1]}, reference_position(plan));
      ASSERT_EQ(by.status, Status::done) << by.reason;
      EXPECT_NEAR(norm(direct.place.centre - by.place.centre), 0, rounding);
    }
  }
}

TEST(BeamPosition, MirroredAxlesMoveAsMirrorImages) {
  const BeamAxle axle = panhard_axle();
  BeamAxle other = axle;
  for (AxleRod& r : other.rods) r.body = math::mirrored(r.body), r.beam = math::mirrored(r.beam);
  const BeamPosition p = position_at(prepare_beam_axle(axle), 0.05, 0.06),
                     q = position_at(prepare_beam_axle(other), 0.05, -0.06);
  EXPECT_NEAR(norm(p.place.centre - math::mirrored(q.place.centre)), 0, rounding);
  EXPECT_NEAR(norm(math::turn_of(p.place.rotation) + math::mirrored(math::turn_of(q.place.rotation))), 0,
              rounding);
}

TEST(BeamPosition, AWattLinkageWithEqualRodsMovesItsPivotAlmostStraight) {
  BeamAxle axle = planar_axle();
  axle.watts.push_back({.name = "Watt linkage",
                        .pivot_on_beam = true,
                        .pivot = {0, 0, 0.3},
                        .axis = {1, 0, 0},
                        .crank = {Vec3{0, 0, 0.37}, Vec3{0, 0, 0.23}},
                        .ends = {Vec3{0, 0.5, 0.37}, Vec3{0, -0.5, 0.23}}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  const double up = position_at(plan, 0.08, 0).place.centre.y,
               down = position_at(plan, -0.08, 0).place.centre.y;
  EXPECT_NEAR(up, -down, rounding);  // the curve of the pivot is point-symmetric
  EXPECT_LT(std::abs(up), 0.3e-3);   // a Panhard rod twice as long shifts it by 3.2 mm
  // With the pivot on the body and the rods on the beam it is the same linkage seen from the beam.
  BeamAxle on_body = axle;
  on_body.watts[0].pivot_on_beam = false;
  const double other = position_at(prepare_beam_axle(on_body), -0.08, 0).place.centre.y;
  EXPECT_NEAR(other, -up, 1e-12);
}

TEST(BeamPosition, RatesAgreeWithDifferences) {
  constexpr double step = 1e-5;  // truncation 1e-9, rounding 1e-9
  for (const BeamAxle& axle : {four_link_axle(), panhard_axle(), watt_axle(), arm_axle(), twist_axle()}) {
    const BeamAxlePlan plan = prepare_beam_axle(axle);
    const BeamPosition p = position_at(plan, 0.04, 0.03);
    for (const AxleInputs inputs :
         {AxleInputs::heave_roll, AxleInputs::wheel_centres, AxleInputs::contacts}) {
      const BeamRates rates = solve_rates(plan, p, inputs);
      ASSERT_EQ(rates.status, Status::done);
      const std::array<double, 2> values = beam_inputs(plan, p.place, inputs);
      for (const int k : {0, 1}) {
        const auto moved = [&](double by) {
          return solve_position(plan, {inputs, values[0] + (k == 0 ? by : 0), values[1] + (k == 1 ? by : 0)},
                                p)
              .place;
        };
        const BeamPlace low = moved(-step), high = moved(step);
        const BeamMotion& motion = k == 0 ? rates.first : rates.second;
        EXPECT_NEAR(norm((1 / (2 * step)) * (high.centre - low.centre) - motion.velocity), 0, 1e-8);
        const Vec3 turned = math::turn_of(high.rotation * math::transposed(low.rotation));
        EXPECT_NEAR(norm((1 / (2 * step)) * turned - motion.turning), 0, 1e-8);
        EXPECT_NEAR((high.cranks[0] - low.cranks[0]) / (2 * step), motion.cranks[0], 1e-7);
      }
    }
  }
}

TEST(BeamPosition, BeyondTheReachOfTheLinksThereIsNone) {
  BeamAxle axle = planar_axle();
  axle.rods.push_back({"Panhard rod", {0, 0.1, 0.3}, {0, -0.1, 0.3}, {}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  const BeamPosition p = position_at(plan, 0.3, 0);
  EXPECT_EQ(p.status, Status::no_assembly);
  EXPECT_NEAR(p.input.first, 0.2, 1e-8);  // the rod stands upright
  EXPECT_NEAR(p.reached, 2.0 / 3, 1e-7);
  EXPECT_NE(p.reason.find("the motion to heave 300.000 mm and roll 0.000 deg ends at heave 200.000 mm"),
            std::string::npos)
      << p.reason;
  EXPECT_NE(p.reason.find("'Panhard rod'"), std::string::npos) << p.reason;
  EXPECT_THROW(solve_position(plan, {}, p), ContractError);
}

TEST(BeamPosition, APrescribedLengthMovesTheReference) {
  BeamAxle axle = panhard_axle();
  axle.rods[3].length = norm(axle.rods[3].body - axle.rods[3].beam) + 0.003;
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  const BeamPosition p = reference_position(plan);
  ASSERT_EQ(p.status, Status::done) << p.reason;
  EXPECT_NEAR(norm(on_beam(plan, p.place, axle.rods[3].beam) - axle.rods[3].body), *axle.rods[3].length,
              rounding);
  EXPECT_LT(p.place.centre.y, -0.0029);
  axle.rods[3].length = 2.5;
  const BeamPosition far = reference_position(prepare_beam_axle(axle));
  EXPECT_EQ(far.status, Status::no_assembly);
  EXPECT_NE(far.reason.find("'Panhard rod' is"), std::string::npos) << far.reason;
}

}  // namespace
}  // namespace linkwright::suspension
