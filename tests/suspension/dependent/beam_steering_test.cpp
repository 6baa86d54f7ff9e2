// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_steering.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/message.h"
#include "suspension/beam_axles.h"

namespace linkwright::suspension {
namespace {

/// A truck's front axle: inclined kingpins, drag link ahead to a Pitman arm, track rod behind the axle.
BeamSteering truck_steering() {
  return {.kingpin = {Vec3{0.01, 0.69, 0.22}, Vec3{-0.005, 0.66, 0.43}},
          .pitman_axis = {Vec3{0.75, 0.45, 0.60}, Vec3{0.75, 0.55, 0.60}},
          .drag_body = {0.74, 0.56, 0.36},
          .drag_knuckle = {0.02, 0.55, 0.44},
          .track_rod = {Vec3{-0.19, 0.60, 0.27}, Vec3{-0.19, -0.60, 0.27}}};
}

/// A point of a knuckle, turned about its kingpin on the beam.
Vec3 on_knuckle(const BeamAxlePlan& plan, const BeamPlace& place, const BeamSteer& steer, bool right,
                const Vec3& straight) {
  const BeamSteering s = truck_steering();
  Vec3 low = s.kingpin[0], high = s.kingpin[1];
  if (right) low = math::mirrored(low), high = math::mirrored(high);
  const Vec3 at = on_beam(plan, place, low), axis = unit(on_beam(plan, place, high) - at);
  return at + math::turn_about(steer.turn[right ? 1 : 0] * axis) * (on_beam(plan, place, straight) - at);
}

// Both rods keep their lengths, wherever the beam and the Pitman arm are.
TEST(BeamSteering, RodsKeepTheirLengths) {
  const BeamAxlePlan plan = prepare_beam_axle(test::panhard_axle());
  const BeamPosition reference = reference_position(plan);
  const BeamSteering s = truck_steering();
  const Vec3 shaft = unit(s.pitman_axis[1] - s.pitman_axis[0]);
  for (const double heave : {-0.08, 0.0, 0.06})
    for (const double roll : {-0.06, 0.0, 0.05})
      for (const double pitman : {-0.1, 0.0, 0.08}) {
        const BeamPosition at = solve_position(plan, {AxleInputs::heave_roll, heave, roll}, reference);
        ASSERT_EQ(at.status, Status::done);
        const BeamSteer steer = steer_beam(plan, s, at.place, pitman);
        ASSERT_EQ(steer.status, Status::done) << steer.reason;
        const Vec3 joint =
            s.pitman_axis[0] + math::turn_about(pitman * shaft) * (s.drag_body - s.pitman_axis[0]);
        const Vec3 drag = on_knuckle(plan, at.place, steer, false, s.drag_knuckle),
                   left = on_knuckle(plan, at.place, steer, false, s.track_rod[0]),
                   right = on_knuckle(plan, at.place, steer, true, s.track_rod[1]);
        EXPECT_NEAR(norm(drag - joint), norm(s.drag_knuckle - s.drag_body), 1e-14);
        EXPECT_NEAR(norm(right - left), 1.2, 1e-14);
        // The wheels are where the axes of the turned knuckles point to.
        const Vec3 axis = math::turn_about(steer.turn[0] * unit(on_beam(plan, at.place, s.kingpin[1]) -
                                                                on_beam(plan, at.place, s.kingpin[0]))) *
                          (half_rotation(plan, at.place, Side::left) * plan.axes[0]);
        EXPECT_NEAR(steer.angles[0].toe, std::atan2(axis.x, axis.y), 1e-14);
        EXPECT_NEAR(steer.angles[0].camber, -std::asin(axis.z), 1e-14);
        EXPECT_EQ(steer.steer[0], -steer.angles[0].toe);
        EXPECT_EQ(steer.steer[1], steer.angles[1].toe);
      }
  const BeamSteer straight = steer_beam(plan, s, reference.place, 0);
  for (const std::size_t i : {0U, 1U}) EXPECT_NEAR(straight.turn[i], 0, 1e-14);
}

// A track rod behind the axle, shorter than the distance of the kingpins, turns the inner wheel more. Without
// a slope of the kingpins it is the planar trapezoid.
TEST(BeamSteering, TrapezoidBehindTheAxle) {
  const BeamAxlePlan plan = prepare_beam_axle(test::panhard_axle());
  const BeamPosition reference = reference_position(plan);
  BeamSteering s = truck_steering();
  s.kingpin = {Vec3{0, 0.68, 0.2}, Vec3{0, 0.68, 0.4}};
  s.track_rod = {Vec3{-0.2, 0.62, 0.27}, Vec3{-0.2, -0.62, 0.27}};
  const BeamSteer to_left = steer_beam(plan, s, reference.place, 0.2);
  ASSERT_EQ(to_left.status, Status::done);
  const double inner = std::max(std::abs(to_left.steer[0]), std::abs(to_left.steer[1])),
               outer = std::min(std::abs(to_left.steer[0]), std::abs(to_left.steer[1]));
  EXPECT_GT(inner, outer + 1e-3);
  EXPECT_EQ(std::abs(to_left.steer[to_left.steer[0] > 0 ? 0 : 1]), inner);
  // Left arm at the angle of the drawing plus its turn, and likewise right: their ends stay 1.24 m apart.
  const auto end = [&](double side, double turn) {
    const double x = -0.2, y = side * (0.62 - 0.68);
    return Vec3{x * std::cos(turn) - y * std::sin(turn),
                side * 0.68 + x * std::sin(turn) + y * std::cos(turn), 0};
  };
  EXPECT_NEAR(norm(end(1, to_left.steer[0]) - end(-1, to_left.steer[1])), 1.24, 1e-14);
}

TEST(BeamSteering, TellsWhatDoesNotReachOrTurn) {
  const BeamAxlePlan plan = prepare_beam_axle(test::panhard_axle());
  const BeamPosition reference = reference_position(plan);
  const BeamSteer far = steer_beam(plan, truck_steering(), reference.place, -0.5);
  EXPECT_EQ(far.status, Status::no_assembly);
  EXPECT_THAT(far.reason, ::testing::StartsWith("the drag link does not reach, by "));
  EXPECT_TRUE(std::isnan(far.steer[0]));
  BeamSteering s = truck_steering();
  s.drag_knuckle = s.kingpin[0];
  EXPECT_EQ(problem(s), "the drag link points at the kingpin: it cannot turn the knuckle");
  s = truck_steering();
  std::swap(s.kingpin[0], s.kingpin[1]);
  EXPECT_EQ(problem(s), "the second point of the kingpin is not above the first one");
  s = truck_steering();
  s.track_rod = {Vec3{0.01, 0.69, 0.22}, Vec3{0.01, -0.69, 0.22}};
  EXPECT_EQ(problem(s), "the track rod points at a kingpin: it cannot turn the knuckle");
  EXPECT_THAT(::linkwright::test::message([&] { steer_beam(plan, s, reference.place, 0); }),
              ::testing::StartsWith("steer_beam: the track rod points at a kingpin"));
}

}  // namespace
}  // namespace linkwright::suspension
