// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;
const Pose origin{};

Coordinates coordinates(const Vec3& a) { return {a.x, a.y, a.z}; }
double apart(const Mat3& a, const Mat3& b) { return norm(turn_of(a * transposed(b))); }

// Largest of each kind relative to its limit.
struct Peaks {
  double speed = 0, acceleration = 0, jerk = 0, angular_speed = 0, angular_acceleration = 0;
};
Peaks peaks(const ToolMotion& motion, const ToolLimits& limits, int samples = 4000) {
  Peaks out;
  for (int i = 0; i <= samples; ++i) {
    const ToolState s = motion(motion.duration() * i / samples);
    out.speed = std::max(out.speed, norm(s.velocity) / limits.speed);
    out.acceleration = std::max(out.acceleration, norm(s.acceleration) / limits.acceleration);
    out.jerk = std::max(out.jerk, norm(s.jerk) / limits.jerk);
    out.angular_speed = std::max(out.angular_speed, norm(s.angular_velocity) / limits.angular_speed);
    out.angular_acceleration =
        std::max(out.angular_acceleration, norm(s.angular_acceleration) / limits.angular_acceleration);
  }
  return out;
}

// Every rate is the derivative of what it is the rate of, at times away from steps of the jerk.
void expect_consistent(const ToolMotion& motion, const ToolLimits& limits) {
  const double h = 1e-6;
  for (int i = 1; i < 200; ++i) {
    const double t = motion.duration() * i / 200;
    const ToolState a = motion(t - h), s = motion(t), b = motion(t + h);
    // A central difference deviates by h^2 / 6 of the third derivative, or by h / 2 of a step of the next one
    // within it, and by rounding, 1e-15 of values up to 1 over h.
    EXPECT_LT(norm((1 / (2 * h)) * (b.position - a.position) - s.velocity), h * h * limits.jerk + 2e-9);
    EXPECT_LT(norm((1 / (2 * h)) * (b.velocity - a.velocity) - s.acceleration), h * limits.jerk + 2e-9);
    const Vec3 turned = (1 / (2 * h)) * turn_of(b.rotation * transposed(a.rotation));
    EXPECT_LT(norm(turned - s.angular_velocity), h * h * limits.angular_jerk + 2e-9);
    EXPECT_LT(norm((1 / (2 * h)) * (b.angular_velocity - a.angular_velocity) - s.angular_acceleration),
              h * limits.angular_jerk + 2e-9);
    // The jerk steps; where it does not, the acceleration has it as derivative.
    if (norm(b.jerk - a.jerk) < 1e-3 * limits.jerk) {
      EXPECT_LT(norm((1 / (2 * h)) * (b.acceleration - a.acceleration) - s.jerk), 2e-3 * limits.jerk);
    }
  }
}

TEST(ToolMotion, LineTakesTheTimeOfTheDoubleS) {
  // Every limit met: L / V + V / A + A / J.
  const ToolLimits limits{.speed = 2, .acceleration = 4, .jerk = 40};
  const ToolMotion motion({.steps = {{ToolLine{.to = {0, 3, 0}}}}}, limits, origin);
  EXPECT_NEAR(motion.duration(), 2.1, 1e-14);
  const ToolState middle = motion(1.05);
  EXPECT_LT(norm(middle.position - Vec3{0, 1.5, 0}), 1e-14);
  EXPECT_LT(norm(middle.velocity - Vec3{0, 2, 0}), 1e-14);
  EXPECT_EQ(motion(-1).position, Vec3{});
  EXPECT_EQ(motion(-1).jerk, Vec3{});
  EXPECT_EQ(motion(2.2).position, (Vec3{0, 3, 0}));
  EXPECT_EQ(motion(0).jerk, (Vec3{0, 40, 0}));
  expect_consistent(motion, limits);
  const Peaks p = peaks(motion, limits);
  EXPECT_NEAR(p.speed, 1, 1e-12);
  EXPECT_NEAR(p.acceleration, 1, 1e-12);
  EXPECT_NEAR(p.jerk, 1, 1e-12);
  // A slower step.
  const ToolMotion slow({.steps = {{ToolLine{.to = {0, 3, 0}, .speed = 0.1}}}}, limits, origin);
  EXPECT_NEAR(slow.duration(), 30.1, 1e-13);
}

TEST(ToolMotion, OtherLawsMeetTheTightestLimit) {
  const ToolLimits limits{.speed = 2, .acceleration = 100, .jerk = 1e4};
  for (TimeLaw law : {TimeLaw::polynomial_345, TimeLaw::cycloidal}) {
    const ToolPath path{.steps = {{PickAndPlace{.to = {0.3, 0, 0}, .height = 0.05}}}, .law = law};
    const ToolMotion motion(path, limits, origin);
    expect_consistent(motion, limits);
    const Peaks p = peaks(motion, limits, 20000);
    EXPECT_LE(p.speed, 1 + 1e-9);
    // A peak at a joint is missed by the change of the jerk within a sample, 1 / 20000 of a law whose jerk
    // swings several times.
    EXPECT_NEAR(std::max(p.acceleration, p.jerk), 1, 5e-3);
  }
}

TEST(ToolMotion, CyclesOfPackagingRobots) {
  // 25 - 305 - 25 mm, there and back, by a fast DELTA.
  const ToolLimits limits{.speed = 10, .acceleration = 150, .jerk = 2e4};
  ToolPath path{.steps = {{PickAndPlace{.to = {0.305, 0, -0.7}, .height = 0.025, .back = true}}}};
  const Pose start{{0, 0, -0.7}, {}};
  const ToolMotion motion(path, limits, start);
  // The same way from rest to rest by the double S without any corner is a lower bound.
  const double straight_time = double_s(0.355 - 0.05 * 0.43, 0, 0, {10, 150, 2e4}).duration;
  EXPECT_GT(motion.duration() / 2, straight_time);
  EXPECT_LT(motion.duration() / 2, 2.5 * straight_time);
  expect_consistent(motion, limits);
  const Peaks p = peaks(motion, limits);
  EXPECT_LE(p.acceleration, 1 + 1e-9);
  EXPECT_LE(p.jerk, 1 + 1e-9);
  EXPECT_LT(norm(motion(motion.duration() / 2).position - Vec3{0.305, 0, -0.7}), 1e-12);
  EXPECT_EQ(motion(motion.duration()).position, start.position);
  // There and back are the same, mirrored in time.
  for (double share : {0.05, 0.1, 0.21, 0.33, 0.45}) {
    const ToolState a = motion(share * motion.duration()), b = motion((1 - share) * motion.duration());
    EXPECT_LT(norm(a.position - b.position), 1e-13);
    EXPECT_LT(norm(a.velocity + b.velocity), 1e-11);
    EXPECT_LT(norm(a.acceleration - b.acceleration), 1e-8);
  }
  // Never stops between its ends, nor leaves the gate.
  for (int i = 1; i < 1000; ++i) {
    const ToolState s = motion(motion.duration() / 2 * i / 1000);
    EXPECT_GT(norm(s.velocity), 1e-4);
    EXPECT_LE(s.position.z, -0.675 + 1e-15);
    EXPECT_GE(s.position.z, -0.7);
  }
  // Dwells add their time; larger corners save some.
  auto& gate = std::get<PickAndPlace>(path.steps[0].form);
  gate.dwell = 0.05;
  gate.back_dwell = 0.02;
  EXPECT_NEAR(ToolMotion(path, limits, start).duration(), motion.duration() + 0.07, 1e-14);
  gate.corner = 0.2;
  EXPECT_GT(ToolMotion(path, limits, start).duration(), motion.duration() + 0.07);
  // A leg that is all corner begins at rest in it.
  gate.corner = 1;
  const ToolMotion rounder(path, limits, start);
  EXPECT_LE(peaks(rounder, limits).jerk, 1 + 1e-9);
  expect_consistent(rounder, limits);
}

TEST(ToolMotion, BlendedLinesAndArcsDoNotStop) {
  const ToolLimits limits{.speed = 1, .acceleration = 5, .jerk = 200};
  ToolPath path{.steps = {{ToolLine{.to = {0.3, 0, 0}}},
                          {ToolArc{.through = {0.4, 0.1, 0}, .to = {0.3, 0.2, 0}}},
                          {ToolLine{.to = {0, 0.2, 0}}}}};
  const double stopping = ToolMotion(path, limits, origin).duration();
  path.blend = true;
  const ToolMotion motion(path, limits, origin);
  EXPECT_LT(motion.duration(), 0.8 * stopping);
  const Peaks p = peaks(motion, limits);
  EXPECT_LE(p.acceleration, 1 + 1e-9);
  EXPECT_LE(p.jerk, 1 + 1e-9);
  // The half circle of 0.1 m is run at the speed that its acceleration allows: v^2 / r = 5.
  const ToolState middle = motion(motion.duration() / 2);
  EXPECT_NEAR(norm(middle.velocity), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(norm(middle.acceleration), 5, 1e-12);
  EXPECT_EQ(motion.piece_at(motion.duration() / 2), 1);
  EXPECT_EQ(motion.piece_at(0), 0);
  EXPECT_EQ(motion.piece_at(motion.duration()), 2);
  EXPECT_EQ(motion.piece_at(motion.duration() + 1), 2);
  EXPECT_THAT(to_string(motion.where(motion.duration() / 2)), HasSubstr("step 2 (arc) at 0."));
  for (int i = 20; i <= 980; ++i) EXPECT_GT(norm(motion(motion.duration() * i / 1000).velocity), 0.05);
}

TEST(ToolMotion, TurnsGoWithTheTranslation) {
  const ToolLimits limits{.speed = 1,
                          .acceleration = 10,
                          .jerk = 500,
                          .angular_speed = 2,
                          .angular_acceleration = 20,
                          .angular_jerk = 400};
  const Pose start{{0.1, 0, 0}, math::turn_x(0.5)};
  const Mat3 target = math::turn_about({0.3, -0.8, 1.1});
  // A long way, a long turn, and a turn on the spot.
  ToolPath path{.steps = {{ToolLine{.to = {2, 0, 0}, .rotation = Coordinates{0.5, 0, 0.1}}},
                          {ToolLine{.to = {2, 0.01, 0}, .rotation = Coordinates{0.3, -0.8, 1.1}}},
                          {ToolLine{.to = {2, 0.01, 0}, .rotation = Coordinates{0, 0, 0}}}}};
  const ToolMotion motion(path, limits, start);
  expect_consistent(motion, limits);
  const Peaks p = peaks(motion, limits);
  EXPECT_NEAR(p.speed, 1, 1e-9);
  EXPECT_LE(p.angular_speed, 1 + 1e-9);
  EXPECT_LE(p.angular_acceleration, 1 + 1e-9);
  EXPECT_LT(apart(motion(0).rotation, start.rotation), 1e-15);
  EXPECT_EQ(motion(motion.duration()).rotation, Mat3{});
  // On the spot by the double S of its angle alone.
  const double angle = norm(turn_of(target));
  const double last = double_s(angle, 0, 0, {2, 20, 400}).duration, t = motion.duration() - last;
  EXPECT_LT(apart(motion(t).rotation, target), 1e-14);
  EXPECT_LT(norm(motion(t + last / 2).position - Vec3{2, 0.01, 0}), 1e-15);
  EXPECT_NEAR(norm(motion(t + last / 2).angular_velocity), 2, 1e-12);
  // Round the gate as well, and back.
  const ToolMotion gate(
      {.steps = {{PickAndPlace{
           .to = {0.4, 0, 0}, .height = 0.05, .back = true, .rotation = Coordinates{0, 0, pi}}}}},
      limits, start);
  expect_consistent(gate, limits);
  EXPECT_LE(peaks(gate, limits).angular_speed, 1 + 1e-9);
  EXPECT_LT(apart(gate(gate.duration() / 2).rotation, math::turn_z(pi)), 1e-12);
  EXPECT_EQ(gate(gate.duration()).rotation, start.rotation);
}

TEST(ToolMotion, TablesAreFollowedThroughAllPoints) {
  // A turn about a fixed axis that goes on beyond half a turn, given with rotation vectors of less.
  ToolTable table;
  for (int i = 0; i <= 20; ++i) {
    const double x = i / 20.0, angle = 5 * x;
    table.times.push_back(3 + x);
    table.points.push_back({0.2 * std::sin(2 * x), 0.1 * x * x, -0.5});
    table.rotations.push_back(coordinates(turn_of(math::turn_about(angle * math::unit({1, 2, -2})))));
  }
  const ToolLimits limits{.speed = 1, .acceleration = 10, .jerk = 1e3};
  const ToolMotion motion({.steps = {{ToolDwell{0.5}}, {table}, {ToolDwell{0.1}}}}, limits,
                          {{0, 0, -0.5}, {}});
  EXPECT_NEAR(motion.duration(), 1.6, 1e-15);
  // Its jerk is that of the spline, about 1e4 at the ends where it starts from rest.
  expect_consistent(motion, {.jerk = 3e4, .angular_jerk = 3e5});
  for (int i = 0; i <= 20; ++i) {
    const ToolState s = motion(0.5 + i / 20.0);
    EXPECT_LT(norm(s.position - Vec3{table.points[i][0], table.points[i][1], table.points[i][2]}), 1e-14);
    EXPECT_LT(apart(s.rotation, math::turn_about(5 * i / 20.0 * math::unit({1, 2, -2}))), 1e-13);
  }
  EXPECT_LT(norm(motion(1.499999999).velocity), 1e-6);
  EXPECT_EQ(motion.piece_at(1), 1);
  EXPECT_EQ(to_string(motion.where(1.55)), "step 3 (dwell) at 1.55 s");
  // A wandering axis: rates against differences.
  ToolTable wander;
  for (int i = 0; i <= 10; ++i) {
    wander.times.push_back(0.2 * i);
    wander.points.push_back({0, 0, -0.5});
    wander.rotations.push_back({std::sin(0.3 * i), 0.4 * (1 - std::cos(0.5 * i)), 0.2 * i});
  }
  expect_consistent(ToolMotion({.steps = {{wander}}}, limits, {{0, 0, -0.5}, {}}),
                    {.jerk = 1, .angular_jerk = 1e4});
}

// Lines, arcs, circles, gates and turns in any order.
ToolPath random_path(RandomStream& random, Vec3 here) {
  const auto point = [&] {
    return Vec3{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1, -0.5)};
  };
  ToolPath path{.law = names(TimeLaw{})[random.below(5) < 3 ? 0 : 1 + random.below(2)].value,
                .blend = random.below(2) == 0,
                .corner = random.below(2) == 0 ? 0 : random.uniform(0.001, 0.03)};
  const auto rotation = [&]() -> std::optional<Coordinates> {
    if (random.below(4) > 0) return std::nullopt;
    return Coordinates{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  for (std::uint32_t n = 1 + random.below(6); n > 0; --n) {
    const Vec3 to = point();
    switch (random.below(5)) {
      case 0:
        path.steps.push_back({ToolArc{coordinates(point()), coordinates(to), rotation(), {}}});
        break;
      case 2:
        path.steps.push_back({ToolCircle{.centre = coordinates(point()),
                                         .axis = coordinates(point()),
                                         .angle = random.uniform(-7, 7),
                                         .rotation = rotation()}});
        break;
      case 1:
        path.steps.push_back({PickAndPlace{.to = coordinates(to),
                                           .height = random.uniform(0.01, 0.1),
                                           .corner = random.uniform(0.1, 1),
                                           .rotation = rotation()}});
        break;
      default: {
        // Onwards in the same direction now and then.
        path.steps.push_back({ToolLine{coordinates(to), rotation(), {}}});
        if (random.below(3) == 0)
          path.steps.push_back({ToolLine{coordinates(to + 0.2 * (to - here)), {}, 0.5}});
      }
    }
    here = {};
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.to; }) here = {s.to[0], s.to[1], s.to[2]};
        },
        path.steps.back().form);
  }
  return path;
}

TEST(ToolMotion, RandomPathsKeepEveryLimitAndAreContinuous) {
  RandomStream random({.seed = 7});
  const Pose start{{0, 0, -0.7}, {}};
  int done = 0;
  for (int n = 0; n < 400; ++n) {
    const ToolLimits limits{.speed = std::pow(10, random.uniform(-1, 1)),
                            .acceleration = std::pow(10, random.uniform(0, 2.3)),
                            .jerk = std::pow(10, random.uniform(1.5, 5)),
                            .angular_speed = std::pow(10, random.uniform(0, 1)),
                            .angular_acceleration = std::pow(10, random.uniform(0, 2)),
                            .angular_jerk = std::pow(10, random.uniform(1, 4))};
    const ToolPath path = random_path(random, start.position);
    if (problem(path, limits, start)) continue;  // corners too large for a leg
    ++done;
    const ToolMotion motion(path, limits, start);
    const int samples = 3000;
    const double h = motion.duration() / samples;
    const Peaks p = peaks(motion, limits, samples);
    EXPECT_LE(p.speed, 1 + 1e-9);
    EXPECT_LE(p.acceleration, 1 + 1e-9);
    EXPECT_LE(p.jerk, 1 + 1e-9);
    EXPECT_LE(p.angular_speed, 1 + 1e-9);
    EXPECT_LE(p.angular_acceleration, 1 + 1e-9);
    ToolState before = motion(0);
    EXPECT_EQ(before.velocity, Vec3{});
    for (int i = 1; i <= samples; ++i) {
      // Nothing changes faster than the limit of its rate; joints of a direction within 1e-6 allowed for.
      const ToolState s = motion(i * h);
      EXPECT_LE(norm(s.position - before.position), h * limits.speed * (1 + 1e-9) + 1e-14);
      EXPECT_LE(norm(s.velocity - before.velocity),
                h * limits.acceleration * (1 + 1e-9) + 2e-6 * limits.speed);
      EXPECT_LE(apart(s.rotation, before.rotation), h * limits.angular_speed * (1 + 1e-9) + 1e-14);
      before = s;
    }
    EXPECT_LT(norm(motion(motion.duration() * (1 - 1e-15)).position - motion(motion.duration()).position),
              1e-12);
    int last = 0;
    for (int i = 0; i <= 100; ++i) {
      const int piece = motion.piece_at(motion.duration() * i / 100);
      EXPECT_GE(piece, last);
      last = piece;
    }
  }
  EXPECT_GT(done, 200);
}

TEST(ToolMotion, SamplesAreEvenAndEndAtTheEnd) {
  const ToolMotion motion({.steps = {{ToolDwell{0.35}}}}, {}, origin);
  const auto all = motion.samples(0.1);
  ASSERT_EQ(all.size(), 5);
  EXPECT_EQ(all[3].time, 0.1 * 3);
  EXPECT_EQ(all[4].time, 0.35);
  // An interval that divides the duration gives no short one at the end.
  EXPECT_EQ(motion.samples(0.05).size(), 8);
  EXPECT_THAT(test::message([&] { motion.samples(0); }), HasSubstr("the interval is 0 s"));
  EXPECT_THAT(test::message([&] { motion.samples(1e-9); }), HasSubstr("are too many samples"));
}

TEST(ToolMotion, NothingIsAllocatedWhileItRuns) {
  ToolTable table{.times = {0, 1}, .points = {{0.3, 0, 0}, {0.4, 0, 0}}, .rotations = {{0, 0, 0}, {0, 0, 1}}};
  const ToolMotion motion(
      {.steps = {{PickAndPlace{.to = {0.3, 0, 0}, .height = 0.03}}, {ToolDwell{0.1}}, {table}}}, {}, origin);
  const std::size_t before = test::allocations();
  double sum = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = motion.duration() * i / 100;
    sum += motion(t).position.x + motion.piece_at(t);
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(sum, 0);
}

TEST(ToolMotion, ThrowsTheTextOfItsProblem) {
  EXPECT_THAT(test::message([] { ToolMotion({.steps = {{ToolLine{}}}}, {}, origin); }),
              HasSubstr("step 1 (line): the line has no length"));
  EXPECT_THAT(test::message([] { ToolMotion({.steps = {{ToolDwell{}}}}, {.jerk = 0}, origin); }),
              HasSubstr("the limit jerk is 0 m/s3"));
  EXPECT_EQ(problem({.steps = {{ToolDwell{}}}}, {.jerk = 0}, origin)->key, "jerk");
  // A path without any duration is at rest all the time.
  const ToolMotion rest({.steps = {{ToolDwell{}}}}, {}, {{1, 2, 3}, {}});
  EXPECT_EQ(rest.duration(), 0);
  EXPECT_EQ(rest(0).position, (Vec3{1, 2, 3}));
}

// Lines, arcs, corners, turns, gates, rests and tables.
ToolPath everything() {
  ToolPath out;
  out.corner = 0.02;
  out.steps = {{ToolLine{.to = {0.3, 0, 0}}},
               {ToolLine{.to = {0.3, 0.2, 0}}},
               {ToolArc{.through = {0.25, 0.3, 0}, .to = {0.1, 0.3, 0.1}}},
               {ToolLine{.to = {0.1, 0.3, 0.1}, .rotation = Coordinates{0, 0.4, 0.2}}},
               {ToolDwell{0.1}},
               {PickAndPlace{.to = {0.2, 0.1, 0.1}, .height = 0.1, .back = true}},
               {ToolTable{.times = {0, 0.3, 0.5, 1},
                          .points = {{0.1, 0.3, 0.1}, {0.2, 0.35, 0.1}, {0.2, 0.2, 0.2}, {0.1, 0.1, 0}},
                          .rotations = {{0, 0.4, 0.2}, {0.2, 0.3, 0}, {0.5, 0, 0}, {0, 0, 0}}}}};
  return out;
}

TEST(ToolMotion, BetweenItsBreaksItIsSmooth) {
  for (const TimeLaw law : {TimeLaw::double_s, TimeLaw::cycloidal}) {
    ToolPath path = everything();
    path.law = law;
    const ToolMotion motion(path, {}, origin);
    const std::vector<double> breaks = motion.breaks();
    EXPECT_EQ(breaks.front(), 0);
    EXPECT_EQ(breaks.back(), motion.duration());
    EXPECT_GT(breaks.size(), 10u);
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      ASSERT_LT(breaks[k - 1], breaks[k]);
      // Halves of a smooth stretch: the jerk changes by ever less. A break within would leave a step.
      const double from = breaks[k - 1], to = breaks[k];
      const auto steepest = [&](int n) {
        double most = 0;
        for (int i = 0; i < n; ++i) {
          const double edge = 1e-6 * (to - from);
          const auto at = [&](int j) { return motion(from + edge + (to - from - 2 * edge) * j / n); };
          most = std::max(most, norm(at(i + 1).acceleration - at(i).acceleration));
        }
        return most;
      };
      const double coarse = steepest(64), fine = steepest(512);
      EXPECT_LE(fine, 0.5 * coarse + 1e-6) << from << " to " << to;
    }
  }
}

TEST(ToolMotion, WayBoundsWhatTheToolGoes) {
  const ToolMotion motion(everything(), {}, origin);
  const std::vector<double> breaks = motion.breaks();
  for (std::size_t k = 1; k < breaks.size(); ++k)
    for (const int parts : {1, 32}) {
      double gone = 0, bound = 0;
      for (int p = 0; p < parts; ++p) {
        const double from = breaks[k - 1] + (breaks[k] - breaks[k - 1]) * p / parts,
                     to = breaks[k - 1] + (breaks[k] - breaks[k - 1]) * (p + 1) / parts;
        const Displaced way = motion.way(from, to);
        double shift = 0, turn = 0;
        constexpr int steps = 200;
        for (int i = 0; i < steps; ++i) {
          const ToolState a = motion(from + (to - from) * i / steps),
                          b = motion(from + (to - from) * (i + 1) / steps);
          shift += norm(b.position - a.position);
          turn += apart(b.rotation, a.rotation);
        }
        EXPECT_LE(shift, way.shift + 1e-9);
        EXPECT_LE(turn, way.turn + 1e-7);
        gone += shift;
        bound += way.shift;
      }
      // Along curves it is the very length; along a table it tends to it.
      if (breaks[k] < motion.duration() - 1) {
        EXPECT_NEAR(gone, bound, 1e-5 * bound + 1e-12);
      } else if (parts == 32) {
        EXPECT_LT(bound, 1.2 * gone);
      }
    }
  const auto before = test::allocations();
  motion.way(0.01, 0.02);
  EXPECT_EQ(test::allocations(), before);
}

TEST(ToolMotion, TellsTheShareOfTheWayOfAStep) {
  const ToolMotion motion(
      {.steps = {{ToolLine{.to = {0.3, 0, 0}}}, {ToolDwell{1}}, {ToolLine{.to = {0, 0, 0}}}}}, {}, origin);
  EXPECT_EQ(motion.share_at(0), 0);
  const double first = (motion.duration() - 1) / 2;
  EXPECT_NEAR(*motion.share_at(first / 2), 0.5, 1e-12);
  EXPECT_NEAR(motion.share_at(first + 0.5).value_or(-1), -1, 0);
  EXPECT_NEAR(*motion.share_at(first * 1.5 + 1), 0.5, 1e-12);
  EXPECT_EQ(motion.share_at(motion.duration()), 1);
  EXPECT_THAT(to_string(motion.where_exactly(first / 2)), HasSubstr(" s, 50 % of its path"));
}

}  // namespace
}  // namespace linkwright::parallel
