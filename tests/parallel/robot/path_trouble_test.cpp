// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/path_trouble.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/tool/motion.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

using test::at;
using test::number_at;
using ::testing::HasSubstr;

double falls_to(const Value& path, const char* least, const char* key) {
  const Value* found = at(path, "index_falls_to").find(least);
  return found ? number_at(*found, key) : std::nan("");
}

// Paths are straight lines run by the double S; times and shares of the way come from the motion.
struct Line {
  Robot robot;
  ToolMotion motion;
  double least = 0;

  Line(const Robot& r, const Vec3& from, const std::vector<Vec3>& to,
       const ToolLimits& limits = {2, 20, 1000})
      : robot(r), motion(path_of(to), limits, Pose{from}), home{from} {}
  static ToolPath path_of(const std::vector<Vec3>& to) {
    ToolPath out;
    for (const Vec3& p : to) out.steps.push_back({ToolLine{.to = {p.x, p.y, p.z}}});
    return out;
  }

  Pose home;
  struct Found {
    std::optional<PathTrouble> trouble;
    std::string why;
  };
  Found look() const {
    const auto task = trouble_task(robot, home, all_positive, 1, least);
    const auto pose = [&](double t) { return Pose{motion(t).position}; };
    const auto between = [&](double a, double b) { return motion.way(a, b); };
    const PlatformWay way{pose, between};
    Found out{first_trouble(*task, way, motion.breaks()), {}};
    if (out.trouble) out.why = cause(*task, way, *out.trouble);
    return out;
  }
};

Line line_of(const Robot& robot, const Value& path) {
  return {robot, point(at(path, "from_m")), {point(at(path, "to_m"))}};
}

class ConstraintPaths : public ::testing::TestWithParam<const char*> {};
TEST_P(ConstraintPaths, AreThoseOfTheReference) {
  const Value& path = at(computed("delta-constraint-path"), std::string("paths.") + GetParam());
  const Line line =
      line_of(delta_of(at(inputs("delta-constraint-path"), std::string("robots.") + GetParam())), path);
  const Value& zero = at(path, "zeros").as_array().at(0);
  const double duration = number_at(zero, "duration_s");
  EXPECT_NEAR(line.motion.duration(), duration, 1e-12);
  const auto [trouble, why] = line.look();
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, Trouble::constraint);
  ASSERT_TRUE(trouble->zero);
  EXPECT_NEAR(*trouble->zero, number_at(zero, "time_s"), 1e-9 * duration);
  EXPECT_NEAR(*line.motion.share_at(*trouble->zero), number_at(zero, "fraction_of_way"), 1e-9);
  EXPECT_NEAR(*trouble->zero / duration, number_at(zero, "fraction_of_time"), 1e-9);
  EXPECT_EQ(why, "the rods of legs 2 and 3 lie level; the platform can turn about y");
  // A few dozen poses suffice.
  EXPECT_LT(trouble->looks, 200);
  const Pose pose{line.motion(*trouble->zero).position};
  EXPECT_NEAR(norm(pose.position - point(at(zero, "p_m"))), 0, 1e-9);
  const ArmAngles arms = inverse(line.robot, pose);
  const auto alpha = test::numbers(at(zero, "alpha_rad"));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(arms.angle[i], alpha[static_cast<std::size_t>(i)], 1e-9);
  const Jacobians here = jacobians(line.robot, pose, arms.angle);
  const Quality q = quality(line.robot, here, 1);
  EXPECT_NEAR(q.transmission, number_at(zero, "lti"), 1e-9);
  EXPECT_NEAR(q.rods, number_at(zero, "det_rods"), 1e-9);
  // Two rods lie level.
  EXPECT_NEAR(here.rod[1].z, 0, 1e-12);
  EXPECT_NEAR(here.rod[2].z, 0, 1e-12);
  for (const auto& [key, least] : {std::pair{"0.2", 0.2}, {"0.1", 0.1}, {"0.001", 0.001}}) {
    Line asked = line;
    asked.least = least;
    const auto found = asked.look().trouble;
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->begin, falls_to(path, key, "time_s"), 1e-9 * duration) << key;
    EXPECT_NEAR(*line.motion.share_at(found->begin), falls_to(path, key, "fraction_of_way"), 1e-9) << key;
  }
}
INSTANTIATE_TEST_SUITE_P(PathTrouble, ConstraintPaths, ::testing::Values("clear", "flat", "mean"),
                         [](const auto& instance) { return std::string(instance.param); });

const Robot& clear_robot() {
  static const Robot out = delta({.base_radius = 0.145, .platform_radius = 0.045, .arm = 0.5, .rod = 0.5});
  return out;
}

// The closed form of the zero: rods 2 and 3 are level where cos and sin of alpha_2 fit.
TEST(PathTrouble, ZeroOfTheClearCaseHasAClosedForm) {
  const auto found = Line(clear_robot(), {0, 0, -0.6}, {{0.3, 0, -0.44}}).look().trouble;
  ASSERT_TRUE(found && found->zero);
  const Line line(clear_robot(), {0, 0, -0.6}, {{0.3, 0, -0.44}});
  const double share = *line.motion.share_at(*found->zero);
  const double sine = (0.6 - 0.16 * share) / 0.5, cosine = std::sqrt(1 - sine * sine);
  const double a = 0.15 * share + 0.1 + 0.5 * cosine;
  EXPECT_NEAR(a * a + 0.75 * std::pow(0.3 * share, 2), 0.25, 1e-12);
  // Travel and transmission see nothing of it.
  for (int n = 0; n <= 200; ++n) {
    const Pose pose{Vec3{0, 0, -0.6} + n / 200.0 * Vec3{0.3, 0, 0.16}};
    const ArmAngles arms = inverse(clear_robot(), pose);
    EXPECT_GT(quality(clear_robot(), jacobians(clear_robot(), pose, arms.angle), 1).transmission, 0.76);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GT(arms.angle[i], math::radians(-45));
      EXPECT_LT(arms.angle[i], math::radians(100));
    }
  }
}

TEST(PathTrouble, CrossingTwiceBetweenSamplesIsSeen) {
  const Value& path = at(computed("delta-constraint-between-samples"), "crosses_twice");
  const Line line = line_of(clear_robot(), path);
  // The mark is home's at both ends, and at most of a hundred samples.
  const auto found = line.look().trouble;
  ASSERT_TRUE(found && found->zero);
  EXPECT_NEAR(*line.motion.share_at(found->begin), falls_to(path, "0.001", "fraction_of_way"), 1e-9);
  EXPECT_NEAR(found->begin, falls_to(path, "0.001", "time_s"), 1e-10);
  const auto& zeros = at(path, "zeros").as_array();
  EXPECT_NEAR(*line.motion.share_at(*found->zero), number_at(zeros.at(0), "fraction_of_way"), 1e-9);
  EXPECT_NEAR(*found->zero, number_at(zeros.at(0), "time_s"), 1e-10);
  // The other one, from the other end.
  const Line reversed(clear_robot(), point(at(path, "to_m")), {point(at(path, "from_m"))});
  const auto other = reversed.look().trouble;
  ASSERT_TRUE(other && other->zero);
  EXPECT_NEAR(1 - *reversed.motion.share_at(*other->zero), number_at(zeros.at(1), "fraction_of_way"), 1e-9);
}

TEST(PathTrouble, PassingTooCloseFailsWithoutAZero) {
  const Value& path = at(computed("delta-constraint-between-samples"), "passes_close");
  const Line line = line_of(clear_robot(), path);
  const auto found = line.look().trouble;
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Trouble::constraint);
  EXPECT_FALSE(found->zero);
  EXPECT_NEAR(*line.motion.share_at(found->begin), falls_to(path, "0.001", "fraction_of_way"), 1e-9);
  const Pose middle{{0.2583, 0, -0.45}};
  EXPECT_NEAR(regular_at(clear_robot(), middle, all_positive, 1).constraint, number_at(path, "middle.index"),
              1e-12);
  EXPECT_FALSE(Line(clear_robot(), {0.25, -0.15, -0.45}, {{0.25, 0.15, -0.45}}).look().trouble);
}

TEST(PathTrouble, EndsBeforeTheZeroWork) {
  const Vec3 from{0, 0, -0.6}, to{0.3, 0, -0.44};
  const auto part = [&](double share) { return from + share * (to - from); };
  EXPECT_FALSE(Line(clear_robot(), from, {part(0.9028965667510668 - 0.05)}).look().trouble);
  // Out and back.
  EXPECT_FALSE(Line(clear_robot(), from, {part(0.85), from}).look().trouble);
  EXPECT_TRUE(Line(clear_robot(), from, {to, from}).look().trouble);
  Line asked(clear_robot(), from, {part(0.6)});
  asked.least = 0.2;
  EXPECT_FALSE(asked.look().trouble);
  Line longer(clear_robot(), from, {part(0.7)});
  longer.least = 0.2;
  EXPECT_TRUE(longer.look().trouble);
}

TEST(PathTrouble, LeavingTheReachIsFoundToTheLastDigit) {
  const Value& expected = at(computed("delta-constraint-between-samples"), "leaves_the_reach");
  const Line line(reference_delta(), {0, 0, -1}, {{0, 0, -1.145}, {0, 0, -1}}, {2, 40, 5000});
  const auto [trouble, why] = line.look();
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, Trouble::reach);
  EXPECT_NEAR(trouble->begin, number_at(expected, "time_s"), 1e-9 * 0.13);
  EXPECT_NEAR(*line.motion.share_at(trouble->begin), number_at(expected, "fraction_of_way"), 1e-9);
  EXPECT_NEAR(line.motion.duration(), 2 * number_at(expected, "duration_s"), 1e-12);
  EXPECT_EQ(why, "leg 1 is straight and reaches no farther");
}

// Planar robots: rods in line, and the bound of a table of points.
TEST(PathTrouble, TypeTwoOfAFiveBarIsFoundOnASpline) {
  const Robot robot = reference_five_bar();
  const Pose home{{0, 0.45, 0}};
  const WorkingMode mode{1, -1, 1, 1, 1, 1};
  const auto task = trouble_task(robot, home, mode, 1);
  ASSERT_TRUE(task);
  ToolPath path;
  path.steps.push_back(
      {ToolTable{.times = {0, 0.5, 1}, .points = {{0, 0.45, 0}, {0.02, 0.3, 0}, {0, 0.1, 0}}}});
  const ToolMotion motion(path, {}, home);
  const auto pose = [&](double t) { return Pose{motion(t).position}; };
  const auto between = [&](double a, double b) { return motion.way(a, b); };
  const auto found = first_trouble(*task, {pose, between}, motion.breaks());
  // The other route: where the sign of det Jx first differs from home's on a fine grid, or a leg gives out.
  double first = 2;
  for (int n = 0; n <= 100000 && first > 1; ++n)
    if (regular_at(robot, pose(n * 1e-5), mode, 1).marks != task->home) first = n * 1e-5;
  ASSERT_EQ(found.has_value(), first <= 1);
  if (!found) return;
  EXPECT_NEAR(found->zero.value_or(found->begin), first, 2e-5);
}

TEST(PathTrouble, TurnOfAHexaEndsAtItsSingularYaw) {
  const Robot robot = reference_hexa();
  const Pose home{{0, 0, -0.5}};
  const auto task = trouble_task(robot, home, all_positive, 0.09);
  const Value& expected = computed("hexa-other-assembly");
  for (const auto& [yaw, joined] : {std::pair{0, true}, {60, true}, {90, true}, {100, false}, {170, false}}) {
    const Pose to{home.position, math::turn_z(math::radians(yaw))};
    const RegularAt there = regular_at(robot, to, all_positive, 0.09);
    const Value& row = *at(expected, "by_yaw_deg").find(std::to_string(yaw));
    EXPECT_NEAR(there.rods, number_at(row, "least_singular_value"), 1e-10);
    const ArmAngles arms = inverse(robot, to);
    EXPECT_NEAR(quality(robot, jacobians(robot, to, arms.angle), 0.09).rods, number_at(row, "det"), 1e-9);
    EXPECT_EQ(there.marks == task->home, joined) << yaw;
    const auto found = first_trouble(*task, home, to);
    EXPECT_EQ(!found, joined) << yaw;
    if (yaw != 170) continue;
    ASSERT_TRUE(found && found->zero);
    EXPECT_EQ(found->kind, Trouble::type2);
    EXPECT_NEAR(math::radians(170) * *found->zero,
                test::numbers(at(computed("hexa-singular-yaw"), "yaw_rad")).at(1), 1e-9);
  }
}

// No stretch that is called free hides a place of another mark: random lines against dense samples.
TEST(PathTrouble, FreeLinesHaveOneMarkAllAlong) {
  RandomStream random({.seed = 11});
  int free = 0, blocked = 0;
  while (free + blocked < 400) {
    const Robot robot = delta({.base_radius = random.uniform(0.02, 0.3),
                               .arm = random.uniform(0.2, 0.5),
                               .rod = random.uniform(0.4, 0.8)});
    const auto place = [&] {
      return Vec3{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.8, -0.2)};
    };
    const Pose from{place()}, to{place()};
    const RegularAt start = regular_at(robot, from, all_positive, 1);
    if (!start.reached || start.constraint < 0.01 || start.rods < 0.01) continue;
    const auto task = trouble_task(robot, from, all_positive, 1);
    const auto found = first_trouble(*task, from, to);
    (found ? blocked : free) += 1;
    const double end = found ? found->from : 1;
    for (int n = 0; n <= 500; ++n) {
      const RegularAt there = regular_at(robot, straight_between(from, to, end * n / 500), all_positive, 1);
      ASSERT_TRUE(there.reached);
      EXPECT_EQ(there.marks, task->home);
      EXPECT_GE(there.constraint, 5e-4);
      EXPECT_GE(there.rods, 5e-4);
    }
    if (!found) continue;
    const RegularAt there = regular_at(robot, straight_between(from, to, found->begin), all_positive, 1);
    if (found->kind == Trouble::constraint) {
      EXPECT_NEAR(there.constraint, 1e-3, 1e-10);
    }
    if (found->kind == Trouble::type2) {
      EXPECT_NEAR(there.rods, 1e-3, 1e-10);
    }
    if (found->kind == Trouble::reach) {
      EXPECT_NEAR(there.reach, 0, 1e-12);
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
}

}  // namespace
}  // namespace linkwright::parallel
