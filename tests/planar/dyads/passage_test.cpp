// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/passage.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/planar/dyads/solve.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;
using linkwright::test::number_at;

TEST(Passage, DefectsOfTheStoredFourBars) {
  for (const char* id : {"MO-5-anchor", "MO-5-smooth-two-dyads", "MO-5-smooth-four-dyads",
                         "MO-5-slider-crank", "MO-5-inverted"}) {
    const std::vector<BodyPose> poses = stored_poses(id);
    const GuidingDyads dyads = solve_dyads(poses);
    // Numbers count the RR dyads alone.
    std::vector<GuidingDyad> links;
    for (const Value& value : at(synthesis_case(id), "computed.dyads").as_array())
      if (const GuidingDyad listed = listed_dyad(value); listed.type == GuidingDyadType::rr)
        links.push_back(dyads.found[static_cast<std::size_t>(nearest(dyads.real(), listed).index)]);
    for (const Value& value : at(synthesis_case(id), "computed.four_bars_with_driver").as_array()) {
      const auto driver = static_cast<std::size_t>(number_at(value, "driver"));
      const auto other = static_cast<std::size_t>(number_at(value, "other"));
      EXPECT_EQ(name_of(passage(poses, links[driver], links[other]).defect), at(value, "defect").as_string())
          << id << " " << driver << " " << other;
    }
  }
}

// Every pair that passes is moved from the first to the last pose, and must come by all poses and no dead
// point.
void follow(const std::vector<BodyPose>& poses, const GuidingDyad& driver, const GuidingDyad& other,
            const Passage& p) {
  // The pose of the body from the place of the driven pin, by Newton on the gaps of both dyads from the last
  // pose.
  BodyPose pose = poses[0];
  std::size_t next = 1;
  const bool rotation = driver.type == GuidingDyadType::rr;
  double least = pi / 2;
  constexpr int steps = 4000;
  for (int k = 0; k <= steps; ++k) {
    const double x = p.drive.front() + (p.drive.back() - p.drive.front()) * k / steps;
    const Complex pin = rotation ? driver.fixed + std::polar(driver.length, x)
                                 : (driver.offset + Complex(0, x)) * driver.normal;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto at_angle = [&](double angle) {
        return BodyPose{pin - std::polar(1.0, angle) * driver.moving, angle};
      };
      const double g = gap(other, at_angle(pose.angle)), h = 1e-6;
      const double slope =
          (gap(other, at_angle(pose.angle + h)) - gap(other, at_angle(pose.angle - h))) / (2 * h);
      pose = at_angle(pose.angle - g / slope);
    }
    ASSERT_LT(std::abs(gap(other, pose)), 1e-9);
    if (other.type == GuidingDyadType::rr) {
      const Complex coupler = place(pose, other.moving) - pin, rod = place(pose, other.moving) - other.fixed;
      const double sine = std::abs(std::imag(std::conj(coupler) * rod)) / std::abs(coupler) / std::abs(rod);
      least = std::min(least, std::asin(std::min(1.0, sine)));
    }
    while (next < poses.size() &&
           (p.drive.back() > p.drive.front() ? x >= p.drive[next] - 1e-12 : x <= p.drive[next] + 1e-12)) {
      // Within a step of the pose.
      EXPECT_LT(std::abs(pose.origin - poses[next].origin), 0.05 * (1 + std::abs(poses[next].origin)));
      ++next;
    }
  }
  EXPECT_EQ(next, poses.size());
  if (other.type == GuidingDyadType::rr) {
    EXPECT_NEAR(least, p.pair_angle, 1e-4);
  }
}

TEST(Passage, WhatPassesMovesThroughAllPoses) {
  int passed = 0, slides = 0;
  for (const char* id : {"MO-5-anchor", "MO-5-smooth-two-dyads", "MO-5-smooth-four-dyads",
                         "MO-5-slider-crank", "MO-5-inverted"}) {
    const std::vector<BodyPose> poses = stored_poses(id);
    const GuidingDyads dyads = solve_dyads(poses);
    for (const GuidingDyad& driver : dyads.real())
      for (const GuidingDyad& other : dyads.real()) {
        if (&driver == &other || driver.type == GuidingDyadType::rp) continue;
        const Passage p = passage(poses, driver, other);
        if (p.defect != PoseDefect::none) continue;
        ++passed;
        slides += driver.type != GuidingDyadType::rr || other.type != GuidingDyadType::rr;
        follow(poses, driver, other, p);
      }
  }
  EXPECT_GE(passed, 9);
  EXPECT_GE(slides, 2);
}

TEST(Passage, TheSliderCrankOfTheStoredPoses) {
  const std::vector<BodyPose> poses = stored_poses("MO-5-slider-crank");
  const GuidingDyads dyads = solve_dyads(poses);
  const GuidingDyad crank = dyads.found[static_cast<std::size_t>(
      nearest(dyads.real(), GuidingDyad{GuidingDyadType::rr, 0, 0, 0.5, 0, 0}).index)];
  const GuidingDyad slide = dyads.found[static_cast<std::size_t>(dyads.count - 1)];
  ASSERT_EQ(slide.type, GuidingDyadType::pr);
  const Passage by_crank = passage(poses, crank, slide);
  EXPECT_EQ(by_crank.defect, PoseDefect::none);
  EXPECT_TRUE(by_crank.drive_turns);
  // Crank angles 15, 80, 150, 215 and 300 degrees.
  const double degrees[] = {15, 80, 150, 215, 300};
  for (std::size_t j = 0; j < 5; ++j)
    EXPECT_NEAR(by_crank.drive[j] - by_crank.drive[0], (degrees[j] - degrees[0]) * pi / 180, 1e-9);
  // The slider comes back: it cannot drive through all of them.
  EXPECT_EQ(passage(poses, slide, crank).defect, PoseDefect::branch);
}

TEST(Passage, ASlideOnTheBodyDrivesAsOneOnTheGroundSeenFromTheBody) {
  const std::vector<BodyPose> poses = random_poses(4, 12);
  std::vector<BodyPose> seen;
  for (const BodyPose& pose : poses) seen.push_back(inverse(pose));
  const GuidingDyad slide = *slide_dyad(poses, GuidingDyadType::rp),
                    other = *slide_dyad(poses, GuidingDyadType::pr);
  const Passage a = passage(poses, slide, other), b = passage(seen, inverse(slide), inverse(other));
  EXPECT_EQ(a.defect, b.defect);
  EXPECT_EQ(a.drive, b.drive);
}

TEST(Passage, TakesTheLeastPairAngleBetweenThePoses) {
  // Crank-rocker over a whole turn but a little: the least transmission angle is met at |ground - crank|.
  const FourBar l{.ground = 2, .crank = 0.8, .coupler = 1.7, .rocker = 1.5};
  std::vector<BodyPose> poses;
  for (const double angle : {0.5, 2.0, 3.5, 5.0, 6.5}) {
    const FourBarPosition position_at = position(l, angle);
    poses.push_back({position_at.crank_pin, position_at.coupler_angle});
  }
  const GuidingDyad crank{GuidingDyadType::rr, 0, 0, 0.8, 0, 0},
      rocker{GuidingDyadType::rr, 2, 1.7, 1.5, 0, 0};
  const Passage p = passage(poses, crank, rocker);
  EXPECT_EQ(p.defect, PoseDefect::none);
  EXPECT_TRUE(p.drive_turns);
  EXPECT_NEAR(p.pair_angle, position(l, 0).transmission_angle, 1e-12);
  // The rocker cannot drive through its dead points.
  EXPECT_EQ(passage(poses, rocker, crank).defect, PoseDefect::branch);
  std::swap(poses[1], poses[2]);
  EXPECT_EQ(passage(poses, crank, rocker).defect, PoseDefect::order);
  EXPECT_THROW((void)passage(std::span(poses).first(1), crank, rocker), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
