// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/dexterity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/robot/robot.h"
#include "linkwright/parallel/workspace/prescribed_region.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

struct Sample {
  RobotFamily family;
  std::vector<double> values;
  Vec3 place;
  Mat3 rotation{};
};

/// Poses within reach, away from crossings of singular values.
std::vector<Sample> samples() {
  return {{RobotFamily::delta, {0.155, 0.35, 0.8, 0.65}, {0.21, -0.13, -0.17}},
          {RobotFamily::delta, {0.01, 0.53, 0.67, 0.3}, {0.35, 0.2, -0.2}},
          {RobotFamily::delta, {0.01, 0.53, 0.67, 0.3}, {0.39, 0, -0.01}},
          {RobotFamily::hexa, {0.25, 0.06, 0.09, 0.78, 0.25, 0.55, 0.4}, {0.05, 0.03, -0.1}},
          {RobotFamily::hexa,
           {0.25, 0.06, 0.09, 0.78, 0.25, 0.55, 0.4},
           {0.03, -0.05, -0.12},
           math::turn_z(0.2) * math::turn_x(-0.15)},
          {RobotFamily::five_bar, {0.15, 0.25, 0.35, 0.2}, {0.07, 0.11, 0}}};
}

struct Flat {
  std::vector<double> value;
  std::vector<std::array<double, max_dimensions>> by;
};

Flat flat(const Sample& sample, const std::vector<double>& values) {
  const DesignedRobot designed = design(sample.family, values);
  PoseDexterity<double> at;
  measure(designed, elbows_out(sample.family), {.length = 0.09, .output = true, .constraint = true},
          sample.place, sample.rotation, at);
  Flat out;
  const auto add = [&](double value, const std::array<double, max_dimensions>& by) {
    out.value.push_back(value);
    out.by.push_back(by);
  };
  add(at.conditioning, at.conditioning_by);
  add(at.constraint, at.constraint_by);
  for (int i = 0; i < designed.robot.legs(); ++i) {
    add(at.input_square[i], at.input_square_by[i]);
    add(std::atan2(at.sine[i], at.cosine[i]), at.angle_by[i]);
    add(at.side[i], at.side_by[i]);
    add(at.output[i], at.output_by[i]);
  }
  return out;
}

// The second way to the same indices: jacobians.h, which inverts Jx.
TEST(Dexterity, HasTheIndicesOfThePose) {
  for (const Sample& sample : samples()) {
    const DesignedRobot designed = design(sample.family, sample.values);
    const WorkingMode mode = elbows_out(sample.family);
    const Pose pose{sample.place + designed.offset * designed.ahead, sample.rotation};
    const ArmAngles arms = inverse(designed.robot, pose, mode);
    ASSERT_EQ(arms.status, Status::done);
    const Quality there = quality(designed.robot, jacobians(designed.robot, pose, arms.angle), 0.09);
    PoseDexterity<double> here;
    measure(designed, mode, {.length = 0.09, .output = true, .constraint = true}, sample.place,
            sample.rotation, here);
    const bool held = sample.family == RobotFamily::delta;
    EXPECT_NEAR(std::abs(here.constraint), held ? there.constraint_index : 1, 1e-13);
    if (held) {
      EXPECT_GT(here.constraint * there.constraint, 0);
    }
    // Rounding times the condition of Jx, below 10 for these poses.
    EXPECT_NEAR(here.conditioning, 1 / there.condition, 1e-13);
    for (int i = 0; i < designed.robot.legs(); ++i) {
      EXPECT_NEAR(std::sqrt(here.input_square[i]), std::abs(there.input[i]), 1e-13);
      EXPECT_NEAR(here.output[i], there.output[i], 1e-13);
      const double outward = std::atan2(here.sine[i], here.cosine[i]);
      EXPECT_NEAR(math::wrap_angle(arm_angle_of(designed, i, outward) - arms.angle[i]), 0, 1e-13);
    }
  }
}

TEST(Dexterity, DerivativesAreThoseOfDifferences) {
  for (const Sample& sample : samples()) {
    const Flat at = flat(sample, sample.values);
    // Central differences: error h^2/6 f''' + eps/h with h = 1e-5 and derivatives up to some 1e3.
    constexpr double h = 1e-5;
    for (std::size_t j = 0; j < sample.values.size(); ++j) {
      std::vector<double> more = sample.values, less = sample.values;
      more[j] += h;
      less[j] -= h;
      const Flat up = flat(sample, more), down = flat(sample, less);
      for (std::size_t k = 0; k < at.value.size(); ++k) {
        const double difference = (up.value[k] - down.value[k]) / (2 * h);
        EXPECT_NEAR(at.by[k][j], difference, 1e-7 * std::max(1.0, std::abs(difference)))
            << name_of(sample.family) << " value " << k << " dimension " << j;
      }
    }
  }
}

// Exact: on the axis of a DELTA all rods stand alike, (s_r, s_z) in the plane of the arm, and the singular
// values of Jx are sqrt(3/2) s_r, twice, and sqrt(3) s_z.
TEST(Dexterity, OnTheAxisConditioningHasAClosedForm) {
  const double radius = 0.12, arm = 0.4, rod = 0.7, offset = 0.55;
  const std::vector<double> x{radius, arm, rod, offset};
  PoseDexterity<double> at;
  measure(design(RobotFamily::delta, x), all_positive, {}, {}, {}, at);
  const double alpha = std::atan2(at.sine[0], at.cosine[0]);
  const double sr = -(radius + arm * std::cos(alpha)), sz = -(offset - arm * std::sin(alpha));
  const double ratio = std::abs(sr) / (std::sqrt(2) * std::abs(sz));
  EXPECT_NEAR(at.conditioning, std::min(ratio, 1 / ratio), 1e-14);
  // d alpha / d offset from s . ds = 0 in the plane: sz dz = -(s . u') l dalpha.
  const double across = -sr * std::sin(alpha) - sz * std::cos(alpha);
  const double turned = -sz / (arm * across);
  EXPECT_NEAR(at.angle_by[0][3], turned, 1e-13);
  const double by = ratio * (arm * std::sin(alpha) * turned / sr - (arm * std::cos(alpha) * turned - 1) / sz);
  EXPECT_NEAR(at.conditioning_by[3], ratio < 1 ? by : -by / (ratio * ratio), 1e-12);
}

// Beyond reach the squares of the input indices go on smoothly, and the conditioning is the least of them.
TEST(Dexterity, BeyondReachTellsHowFar) {
  const Sample far{RobotFamily::delta, {0.155, 0.35, 0.8, 1.2}, {0.3, 0.1, -0.1}};
  const Flat at = flat(far, far.values);
  EXPECT_LT(at.value[0], 0);
  EXPECT_EQ(at.value[0], std::min({at.value[2], at.value[6], at.value[10]}));
  EXPECT_EQ(at.value[1], at.value[0]);
  constexpr double h = 1e-6;
  for (std::size_t j = 0; j < 4; ++j) {
    std::vector<double> more = far.values, less = far.values;
    more[j] += h;
    less[j] -= h;
    const double difference = (flat(far, more).value[0] - flat(far, less).value[0]) / (2 * h);
    EXPECT_NEAR(at.by[0][j], difference, 1e-8 * std::max(1.0, std::abs(difference)));
  }
}

TEST(Dexterity, SetsOfPosesHaveTheSameIndicesAndAllocateNothing) {
  for (const Sample& sample : samples()) {
    const DesignedRobot designed = design(sample.family, sample.values);
    const WorkingMode mode = elbows_out(sample.family);
    const DexterityMeasures what{.length = 0.09, .output = true, .constraint = true};
    PoseSet poses;
    poses.rotation = sample.rotation;
    RandomStream random({.seed = 3});
    for (int i = 0; i < 37; ++i) {
      const bool plane = sample.family == RobotFamily::five_bar;
      poses.x.push_back(random.uniform(-0.3, 0.3));
      poses.y.push_back(random.uniform(plane ? 0 : -0.3, 0.3));
      poses.z.push_back(plane ? 0 : random.uniform(-0.3, 0));
    }
    SetDexterity set;
    measure(designed, mode, what, poses, true, set);
    const auto before = test::allocations();
    measure(designed, mode, what, poses, true, set);
    EXPECT_EQ(test::allocations(), before);
    int reached = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      PoseDexterity<double> one;
      measure(designed, mode, what, {poses.x[k], poses.y[k], poses.z[k]}, poses.rotation, one);
      reached += one.conditioning > 0;
      // Registers may fuse products and sums: rounding times condition.
      EXPECT_NEAR(set.conditioning[k], one.conditioning, 1e-12);
      if (sample.family == RobotFamily::delta) {
        EXPECT_NEAR(set.constraint[k], one.constraint, 1e-12);
      }
      for (int j = 0; j < designed.count; ++j)
        EXPECT_NEAR(set.conditioning_by[j][k], one.conditioning_by[j],
                    1e-9 * std::max(1.0, std::abs(one.conditioning_by[j])));
      for (int i = 0; i < designed.robot.legs(); ++i) {
        EXPECT_NEAR(set.input_square[i][k], one.input_square[i], 1e-13);
        EXPECT_NEAR(set.side[i][k], one.side[i], 1e-13);
        EXPECT_NEAR(set.output[i][k], one.output[i], 1e-12);
        EXPECT_NEAR(set.sine[i][k] * one.cosine[i], one.sine[i] * set.cosine[i][k], 1e-12);
      }
    }
    EXPECT_GT(reached, 5);
  }
}

}  // namespace
}  // namespace linkwright::parallel
