// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/corner/suspension.h"
#include "support/allocations.h"
#include "support/message.h"
#include "suspension/pushrod_corner.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;

double apart(const Mat3& a, const Mat3& b) {
  double out = 0;
  for (int i = 0; i < 3; ++i) out = std::max(out, norm(a.row[i] - b.row[i]));
  return out;
}

TEST(CornerPosition, RotationAndAngularVelocityOfTheReferenceStayExact) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition here = reference_position(plan);
  EXPECT_EQ(here.status, Status::done);
  EXPECT_EQ(here.place.carrier.centre, plan.wheel.centre);
  EXPECT_EQ(here.place.carrier.rotation, Mat3{});
}

TEST(CornerPosition, EveryMechanismClosesAtTheReferenceStates) {
  for (const CornerSample& sample : corner_samples()) {
    if (sample.name.find('_') != std::string::npos || sample.name == "interconnected") continue;
    SCOPED_TRACE(sample.name);
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const Value& computed = at(published("mechanism-" + sample.name), "computed");
    int states = 0;
    for (const char* curve : {"wheel_travel", "rack_travel", "combined"}) {
      const Value* rows = computed.find(curve);
      if (!rows) continue;
      for (const Value& row : rows->as_array()) {
        const double travel = number_at(row, "travel_m"), rack = number_at(row, "rack_m");
        const CornerPosition found = solve(plan, travel, rack);
        ASSERT_EQ(found.status, Status::done) << found.reason;
        EXPECT_LE(found.residual, 1e-14);
        // Acceptance of the reference: 1e-9 m; both routes are exact, what is left is rounding times
        // condition.
        EXPECT_LT(distance(found.place.carrier.centre, point(at(row, "wheel_centre_m"))), 1e-12)
            << travel << " " << rack;
        ++states;
      }
    }
    EXPECT_GE(states, 9);
  }
}

TEST(CornerPosition, PublishedExamples) {
  const std::array<std::tuple<const char*, const char*, double>, 4> cases{
      {{"front_5US", "ex1-forward", 1e-12},
       {"strut_SP-3US", "ex2-forward", 1e-10},
       {"interconnected", "ex3-forward", 1e-10},
       {"rear_5US", "ex4-forward", 1e-10}}};
  for (const auto& [name, id, close] : cases) {
    const CornerPlan plan = prepare_suspension(corner_sample(name).suspension);
    for (const Value& row : at(published(id), "computed.positions").as_array()) {
      const CornerPosition found = solve(plan, number_at(row, "travel_m"), number_at(row, "rack_m"));
      ASSERT_EQ(found.status, Status::done) << found.reason;
      EXPECT_LT(distance(found.place.carrier.centre, point(at(row, "wheel_centre_m"))), close) << id;
    }
  }
}

TEST(CornerPosition, TravelLimitsAndWhatLiesBeyond) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const auto limits = test::numbers(at(published("mechanism-" + sample.name), "computed.travel_limits_m"));
    const TravelLimits found = travel_limits(plan, Driver::wheel_centre_z, 0, reference_position(plan));
    for (int i : {0, 1}) {
      EXPECT_EQ(found.status[i], Status::no_assembly);
      EXPECT_NEAR(found.value[i], limits[i], 2e-6);  // accuracy that the reference claims
      const double outward = i == 0 ? -1 : 1;
      const CornerPosition inside = solve(plan, limits[i] - outward * 1e-3);
      EXPECT_EQ(inside.status, Status::done) << inside.reason;
      const CornerPosition beyond = solve(plan, limits[i] + outward * 1e-3);
      EXPECT_EQ(beyond.status, Status::no_assembly);
      EXPECT_NEAR(beyond.input.value, limits[i], 2e-6);
      EXPECT_THAT(beyond.reason, ::testing::HasSubstr("mm at rack 0.000 mm, 1.00"));
      // The height changes with the square of the way along the motion: next to a fold by 1e-11 m this is
      // 1e-5.
      EXPECT_LT(weakest_motion(plan, beyond.place, 0, Driver::wheel_centre_z).singular_value, 1e-4);
    }
  }
}

TEST(CornerPosition, ReasonsInWords) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  EXPECT_THAT(solve(plan, 0.3).reason,
              ::testing::MatchesRegex(
                  "the height of the wheel centre cannot pass 250.877 mm at rack 0.000 mm, 49.123 "
                  "mm short of 300.000 mm: the motion turns back there .smallest singular value "
                  "[0-9e.-]+."));
  EXPECT_THAT(solve(plan, 0, 0.5).reason,
              ::testing::MatchesRegex(
                  "the rack cannot pass [0-9.]+ mm at height of the wheel centre 0.000 mm, [0-9.]+ "
                  "mm short of 500.000 mm: the motion turns back there .*"));
  EXPECT_THAT(solve(plan, 0.3, 0.1).reason,
              ::testing::MatchesRegex(
                  "the motion to height of the wheel centre 300.000 mm and rack 100.000 mm ends at "
                  "[0-9.]+ mm and [0-9.]+ mm: the motion turns back there .*"));
  Suspension torn = corner_sample("5US").suspension;
  torn.links[2].name = "tie rod";
  torn.links[2].length = 2.0;
  const CornerPosition found = reference_position(prepare_suspension(torn));
  EXPECT_EQ(found.status, Status::no_assembly);
  EXPECT_EQ(found.reason, "the links do not meet near the reference: tie rod is 1714.895 mm too long");
}

TEST(CornerPosition, FromALossOfRankThereIsNoWay) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links[4] = suspension.links[3];
  suspension.links[4].name = "double";
  const CornerPosition found = reference_position(prepare_suspension(suspension));
  EXPECT_EQ(found.status, Status::singular);
  EXPECT_THAT(found.reason, ::testing::StartsWith(
                                "at height of the wheel centre 0.000 mm and rack 0.000 mm the motion beyond "
                                "is not determined: the links lose rank (smallest singular value "));
}

TEST(CornerPosition, ALimitIsSymmetricInItsStart) {
  // From either side of the range, with other steps: the fold is the same to what bisection resolves.
  const CornerPlan plan = prepare_suspension(corner_sample("RR-US").suspension);
  const double one = solve(plan, 1).input.value;
  const CornerPosition low = solve(plan, -0.2);
  const double other = solve_position(plan, Driver::wheel_centre_z, {1, 0}, low, {0.003, 1e-11}).input.value;
  EXPECT_NEAR(one, other, 1e-10);
}

TEST(CornerPosition, LongStepsFindTheSameLimits) {
  for (const CornerSample& sample : corner_samples().first(12))
    for (double first : {0.002, 0.05, 0.3})
      for (double far : {-1.0, -0.5, 0.5, 1.0}) {
        SCOPED_TRACE(sample.name + " " + std::to_string(first) + " " + std::to_string(far));
        const CornerPlan plan = prepare_suspension(sample.suspension);
        const auto limits =
            test::numbers(at(published("mechanism-" + sample.name), "computed.travel_limits_m"));
        const CornerPosition found =
            solve_position(plan, Driver::wheel_centre_z, {far, 0}, reference_position(plan), {first, 1e-11});
        EXPECT_EQ(found.status, Status::no_assembly);
        EXPECT_NEAR(found.input.value, limits[far > 0 ? 1 : 0], 2e-6);
      }
}

TEST(CornerPosition, PathsMeet) {
  // Rack first and travel then, or both together: the same assembly.
  for (const char* name : {"2RS-US", "RS-SP-US", "RS-3US", "SP-3US", "5US"}) {
    const CornerPlan plan = prepare_suspension(corner_sample(name).suspension);
    const CornerPosition straight = solve(plan, 0.05, -0.04);
    const CornerPosition corner =
        solve_position(plan, Driver::wheel_centre_z, {0.05, -0.04}, solve(plan, 0, -0.04));
    EXPECT_LT(distance(straight.place.carrier.centre, corner.place.carrier.centre), 1e-13) << name;
    EXPECT_LT(apart(straight.place.carrier.rotation, corner.place.carrier.rotation), 1e-12) << name;
  }
}

TEST(CornerPosition, DriversAgree) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const CornerPlan plan = prepare_suspension(sample.suspension);
    const CornerPosition by_height = solve(plan, 0.06);
    for (Driver driver : {Driver::contact_z, Driver::spring}) {
      const double value = driver_value(plan, by_height.place, 0, driver);
      const CornerPosition again = solve(plan, value, 0, driver);
      ASSERT_EQ(again.status, Status::done) << again.reason;
      EXPECT_LT(distance(by_height.place.carrier.centre, again.place.carrier.centre), 1e-12);
      EXPECT_LT(apart(by_height.place.carrier.rotation, again.place.carrier.rotation), 1e-12);
    }
  }
}

TEST(CornerPosition, RatesAreDifferencesOfPositions) {
  constexpr double h = 1e-5;
  for (const CornerSample& sample : corner_samples())
    for (Driver driver : {Driver::wheel_centre_z, Driver::contact_z, Driver::spring}) {
      if (driver == Driver::spring && !sample.suspension.spring) continue;
      SCOPED_TRACE(sample.name + " " + std::string(name_of(driver)));
      const CornerPlan plan = prepare_suspension(sample.suspension);
      const double rack = 0.02;  // moves nothing where no link is on the rack
      const CornerPosition here = solve(plan, driver == Driver::spring ? 0.02 : 0.03, rack, driver);
      const CornerRates rates = solve_rates(plan, here, driver);
      ASSERT_EQ(rates.status, Status::done);
      for (bool steer : {false, true}) {
        const Twist& twist = steer ? rates.steer : rates.bump;
        const auto beside = [&](double by) {
          return solve_position(plan, driver,
                                {here.input.value + (steer ? 0 : by), here.input.rack + (steer ? by : 0)},
                                here)
              .place;
        };
        const CornerPlace more = beside(h), less = beside(-h);
        const double scale = 1 / (2 * h);
        // Truncation h^2 times third derivatives of some 10 to 100 /m2, rounding 1e-15 / h.
        EXPECT_LT(norm(scale * (more.carrier.centre - less.carrier.centre) - twist.velocity), 1e-8);
        const Mat3 turn = more.carrier.rotation * transposed(less.carrier.rotation);
        const Vec3 turning = (scale / 2) * Vec3{turn.row[2].y - turn.row[1].z, turn.row[0].z - turn.row[2].x,
                                                turn.row[1].x - turn.row[0].y};
        EXPECT_LT(norm(turning - twist.turning), 1e-7 * std::max(1.0, norm(twist.turning)));
        EXPECT_NEAR(scale * (more.arm - less.arm), twist.arm, 1e-8);
      }
    }
}

TEST(CornerPosition, RightWheelIsTheMirrorAtTheOppositeRack) {
  for (const char* name : {"2RS-US", "RS-SP-US", "RS-3US", "SP-3US", "5US"}) {
    const Suspension& left = corner_sample(name).suspension;
    const CornerPlan plan = prepare_suspension(left), other = prepare_suspension(mirrored(left));
    const CornerPlace a = solve(plan, 0.04, -0.03).place, b = solve(other, 0.04, 0.03).place;
    EXPECT_LT(distance(math::mirrored(a.carrier.centre), b.carrier.centre), 1e-13) << name;
    EXPECT_LT(apart(math::mirrored(a.carrier.rotation), b.carrier.rotation), 1e-13) << name;
  }
}

TEST(CornerPosition, TrapezoidalArmWithParallelAndMeetingAxes) {
  for (const Vec3& second : {Vec3{-0.12, 0.69, -0.112}, Vec3{-0.12, 0.705, -0.105}}) {
    Suspension suspension = corner_sample("RR-US").suspension;
    suspension.links[0].carrier[1] = second;
    // Axes parallel in the first case: the four points lie in a plane, where four distances lose rank.
    if (second.y == 0.69)
      suspension.links[0].carrier[1] =
          suspension.links[0].carrier[0] + 0.7 * (suspension.links[0].body[1] - suspension.links[0].body[0]);
    EXPECT_TRUE(check_structure(suspension).empty());
    const CornerPlan plan = prepare_suspension(suspension);
    for (double travel : {-0.08, 0.08}) {
      const CornerPosition found = solve(plan, travel);
      ASSERT_EQ(found.status, Status::done) << found.reason;
      // The distances of the four points, which are not among the equations.
      for (const Vec3& body : suspension.links[0].body)
        for (const Vec3& carrier : suspension.links[0].carrier)
          EXPECT_NEAR(norm(place(found.place.carrier, carrier, suspension.wheel.centre) - body),
                      norm(carrier - body), 1e-14);
    }
  }
}

TEST(CornerPosition, PrescribedLengthsAreMet) {
  Suspension suspension = corner_sample("front_5US").suspension;
  std::vector<double> lengths;
  for (CornerLink& link : suspension.links) {
    link.length = norm(link.carrier[0] - link.body[0]) + (lengths.size() % 2 == 0 ? 0.004 : -0.003);
    lengths.push_back(*link.length);
  }
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition found = reference_position(plan);
  ASSERT_EQ(found.status, Status::done);
  EXPECT_EQ(found.place.carrier.centre.z, suspension.wheel.centre.z);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_NEAR(norm(place(found.place.carrier, suspension.links[i].carrier[0], suspension.wheel.centre) -
                     suspension.links[i].body[0]),
                lengths[i], 1e-14);
}

TEST(CornerPosition, RotationsStayRotations) {
  // Twenty thousand positions, each from the one before: errors of rounding must not add up.
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  CornerPosition here = reference_position(plan);
  for (int i = 0; i < 20000; ++i) {
    const double angle = 0.1 * i;
    here =
        solve_position(plan, Driver::wheel_centre_z, {0.06 * std::sin(angle), 0.04 * std::cos(angle)}, here);
    ASSERT_EQ(here.status, Status::done);
  }
  const Mat3& rotation = here.place.carrier.rotation;
  EXPECT_LT(apart(rotation * transposed(rotation), Mat3{}), 1e-15);
}

TEST(CornerPosition, AllocatesNothing) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition start = reference_position(plan);
  const auto before = test::allocations();
  const CornerPosition found = solve_position(plan, Driver::wheel_centre_z, {0.08, 0.04}, start);
  const CornerRates rates = solve_rates(plan, found, Driver::contact_z);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_EQ(rates.status, Status::done);
}

// The rod is as long as the sum or the difference of the other two distances where it lies in line with the
// arm.
TEST(CornerPosition, EndsWhereARodComesIntoLineWithItsRocker) {
  const Suspension suspension = pushrod_corner();
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition reference = reference_position(plan);
  for (const double to : {-0.3, 0.3}) {
    const CornerPosition end = solve_position(plan, Driver::wheel_centre_z, {to, 0}, reference);
    EXPECT_EQ(end.status, Status::no_assembly);
    EXPECT_THAT(end.reason,
                ::testing::HasSubstr("the rod of rocker comes into line with its arm there (toggle"));
    const RockerConstants& rocker = plan.rockers[0];
    const Vec3 outer = place_of(plan, rocker.driver, end.place, 0) - rocker.at;
    const double along = dot(outer - rocker.rod, rocker.axis), arm = norm(cross(rocker.rod, rocker.axis)),
                 far = norm(cross(outer, rocker.axis)), across = far + (to < 0 ? -arm : arm);
    EXPECT_NEAR(rocker.length, std::hypot(along, across), 1e-9);
    // A long first step, and one that starts at the other side, find the same end.
    const CornerPosition again =
        solve_position(plan, Driver::wheel_centre_z, {to, 0}, reference, {.first = 0.2});
    EXPECT_NEAR(again.input.value, end.input.value, 1e-9);
    const TravelLimits limits = travel_limits(plan, Driver::wheel_centre_z, 0, reference, 0.3);
    EXPECT_EQ(limits.status[to > 0], Status::no_assembly);
    EXPECT_NEAR(limits.value[to > 0], end.input.value, 1e-9);
  }
}

TEST(CornerPosition, Contract) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition failed = solve(plan, 0.3);
  EXPECT_THAT(
      test::message([&] { solve_position(plan, Driver::wheel_centre_z, {}, failed); }),
      ::testing::StartsWith("solve_position: the start is no_assembly: the height of the wheel centre"));
  EXPECT_THAT(test::message([&] { solve(plan, NAN); }), ::testing::HasSubstr("input nan m, rack 0 m"));
}

}  // namespace
}  // namespace linkwright::suspension
