// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/seven_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "linkwright/core/numbers.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

/// Rods that fit all positions within `tolerance`, and how far the nearest is from `link`.
double nearest(const SevenPoseReport& report, const CornerLink& link, double tolerance) {
  double best = infinity;
  for (const SevenPoseRod& rod : report.rods)
    if (rod.rms < tolerance) best = std::min(best, largest_distance(rod.link, link));
  return best;
}

TEST(SevenPoses, PublishedPositionsHaveTheirTwentySolutions) {
  const test::Example e = test::published_example("ex1-forward");
  for (const char* id : {"ss-seven-poses-unsteered", "ss-seven-poses-steered"}) {
    const Value& given = published(id);
    const bool moved = test::at(given, "inputs.body_point_moves_with_rack").as_bool();
    CarrierTargets chosen = e.targets;
    chosen.poses.clear();
    for (const double place : test::numbers(test::at(given, "inputs.positions_1based")))
      chosen.poses.push_back(e.targets.poses[static_cast<std::size_t>(place) - 1]);
    const SevenPoseReport report = seven_pose_rods(chosen, moved);
    EXPECT_EQ(report.status, Status::done);
    EXPECT_EQ(report.solutions, test::number_at(given, "computed.number_of_solutions"));
    const auto& wanted = test::at(given, "computed.real_solutions").as_array();
    EXPECT_EQ(report.rods.size(), wanted.size());
    for (const Value& rod : wanted) {
      const CornerLink link{.body = {point(test::at(rod, "body_m"))},
                            .carrier = {point(test::at(rod, "carrier_m"))}};
      EXPECT_LT(nearest(report, link, 1), 1e-6 * (1 + norm(link.body[0]) + norm(link.carrier[0]))) << id;
    }
  }
}

// Each of the twenty keeps its length in all seven positions, complex ones too: by the equation itself,
// |q_i - y|^2 = |q_0 - y|^2 without conjugates.
TEST(SevenPoses, AllSolutionsAreKept) {
  const test::Example e = test::published_example("ex1-forward");
  const LinkMotion motion = link_motion(e.targets, false, e.targets.wheel.centre);
  const SevenPoseReport report = seven_pose_rods(e.targets, false);
  ASSERT_EQ(report.solutions, 20);
  ASSERT_EQ(report.all.size(), 20u);
  int real = 0, pairs = 0;
  for (const SevenPoseSolution& one : report.all) {
    using Complex3 = std::array<std::complex<double>, 3>;
    const Vec3 o = e.targets.wheel.centre;
    const Complex3 x{one.carrier[0] - o.x, one.carrier[1] - o.y, one.carrier[2] - o.z},
        y{one.body[0] - o.x, one.body[1] - o.y, one.body[2] - o.z};
    const auto square = [&](const Complex3& q) {
      std::complex<double> sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += (q[k] - y[k]) * (q[k] - y[k]);
      return sum;
    };
    double size = 1;
    for (std::size_t k = 0; k < 3; ++k) size += std::norm(x[k]) + std::norm(y[k]);
    for (const std::size_t i : report.positions) {
      Complex3 q;
      const std::array<double, 3> shift{motion.shift[i].x, motion.shift[i].y, motion.shift[i].z};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& row = motion.rotation[i].row[k];
        q[k] = row.x * x[0] + row.y * x[1] + row.z * x[2] + shift[k];
      }
      EXPECT_LT(std::abs(square(q) - square(x)), 1e-10 * size);
    }
    if (one.rod >= 0) {
      EXPECT_EQ(one.rod, real++);
      EXPECT_LT(norm(Vec3{one.body[0].real(), one.body[1].real(), one.body[2].real()} -
                     report.rods[one.rod].link.body[0]),
                1e-15 * size);
      continue;
    }
    for (const SevenPoseSolution& other : report.all)
      pairs += std::abs(std::conj(one.body[1]) - other.body[1]) +
                   std::abs(std::conj(one.carrier[2]) - other.carrier[2]) <
               1e-7 * size;
  }
  EXPECT_EQ(real, static_cast<int>(report.rods.size()));
  EXPECT_EQ(pairs, 20 - real);  // each complex one has its conjugate
}

TEST(SevenPoses, LinksOfAMechanismAreWhatFitsAllPositions) {
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward", "mechanism-5US"}) {
    const test::Example e = test::published_example(id);
    for (const bool moved : {false, true}) {
      const SevenPoseReport report = seven_pose_rods(e.targets, moved);
      for (const CornerLink& link : e.links) {
        if (link.type != LinkType::US || link.moved_by_rack != moved) continue;
        // Conditions of 1e7 in examples 3 and 4.
        EXPECT_LT(nearest(report, link, 1e-9), 1e-6) << id << " " << link.name;
      }
    }
  }
}

TEST(SevenPoses, EverySubsetOfPositionsTellsTheLinks) {
  const test::Example e = test::published_example("ex1-forward");
  const LinkMotion motion = link_motion(e.targets, false, e.targets.wheel.centre);
  int complete = 0, all_links = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random({seed});
    SixPositions six{};
    for (std::size_t i = 0; i < 6;) {
      six[i] = random.below(static_cast<std::uint32_t>(motion.size()));
      i += std::find(six.begin(), six.begin() + static_cast<std::ptrdiff_t>(i), six[i]) ==
           six.begin() + static_cast<std::ptrdiff_t>(i);
    }
    const SevenPoseReport report = seven_pose_rods(motion, six, e.targets.wheel.centre, false, seed);
    complete += report.solutions == 20;
    bool found = true;
    for (const CornerLink& link : e.links)
      found = found && (link.moved_by_rack || nearest(report, link, 1e-9) < 1e-6);
    all_links += found;
  }
  EXPECT_EQ(complete, 60);
  EXPECT_EQ(all_links, 60);
}

TEST(SevenPoses, ArmsComeAsFamilies) {
  for (const char* id : {"mechanism-RS-3US", "mechanism-2RS-US", "mechanism-2SR-US", "ex3-forward"}) {
    const test::Example e = test::published_example(id);
    const SevenPoseReport report = seven_pose_rods(e.targets, false);
    EXPECT_EQ(report.status, Status::singular) << id;
    for (const CornerLink& link : e.links) {
      if (link.type != LinkType::RS && link.type != LinkType::SR) continue;
      const bool rs = link.type == LinkType::RS;
      const auto& axis = rs ? link.body : link.carrier;
      bool found = false;
      for (const CornerLink& arm : report.arms) {
        if (arm.type != link.type) continue;
        const double shared = rs ? norm(arm.carrier[0] - link.carrier[0]) : norm(arm.body[0] - link.body[0]);
        double off = 0;
        for (const Vec3& p : rs ? arm.body : arm.carrier)
          off = std::max(off, norm(cross(p - axis[0], math::unit(axis[1] - axis[0]))));
        found = found || (shared < 1e-6 && off < 1e-6);
      }
      EXPECT_TRUE(found) << id << " " << link.name << " among " << report.arms.size();
    }
  }
}

TEST(SevenPoses, NeedsSevenPositions) {
  test::Example e = test::published_example("ex1-forward");
  e.targets.poses.resize(6);
  EXPECT_THAT(linkwright::test::message([&] { seven_pose_rods(e.targets, false); }),
              ::testing::HasSubstr("needs six positions besides the reference, got 5"));
}

}  // namespace
}  // namespace linkwright::suspension
