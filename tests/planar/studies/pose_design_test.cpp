// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/pose_design.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

PoseDesign of_types(GuidingDyadType driver, GuidingDyadType other) {
  PoseDesign out;
  out.driver.type = driver;
  out.other.type = other;
  return out;
}

TEST(PoseDesign, IsCalledByItsDyads) {
  using enum GuidingDyadType;
  EXPECT_EQ(name_of_linkage(of_types(rr, rr)), "four-bar");
  EXPECT_EQ(name_of_linkage(of_types(pr, rr)), "slider-crank");
  EXPECT_EQ(name_of_linkage(of_types(rr, rp)), "inverted slider-crank");
  EXPECT_EQ(name_of_linkage(of_types(rp, pr)), "slide and sleeve");
  EXPECT_EQ(name_of_linkage(of_types(pr, pr)), "double slider");
  EXPECT_EQ(type_of(of_types(pr, rr)), "PR+RR");
  EXPECT_EQ(drive_of(of_types(pr, rr)), "a slide");
  EXPECT_EQ(drive_of(of_types(rp, rr)), "a cylinder");
}

TEST(PoseDesign, TellsItsDefect) {
  PoseDesign d = of_types(GuidingDyadType::rr, GuidingDyadType::rr);
  EXPECT_EQ(defect_text(d), "");
  d.passage.defect = PoseDefect::branch;
  d.passage.from = 1, d.passage.to = 2;
  EXPECT_EQ(defect_text(d), "branch: poses 2 and 3 are on both sides of a dead point");
  d.passage.from = 2;
  EXPECT_EQ(defect_text(d), "branch: at a dead point at pose 3");
  EXPECT_TRUE(defective(d));
}

// The four-bar that a pair of links is has the body where the links hold it.
TEST(PoseDesign, IsTheFourBarOfItsLinks) {
  PoseDesign d = of_types(GuidingDyadType::rr, GuidingDyadType::rr);
  const BodyPose body{{0.3, 0.8}, 0.5};
  d.driver.fixed = {0.1, -0.2};
  d.driver.moving = {-0.2, -0.5};
  d.other.fixed = {1.2, 0.1};
  d.other.moving = {0.6, -0.3};
  d.driver.length = std::abs(place(body, d.driver.moving) - d.driver.fixed);
  d.other.length = std::abs(place(body, d.other.moving) - d.other.fixed);
  const std::complex<double> pin = place(body, d.driver.moving), other = place(body, d.other.moving);
  d.passage.side = (std::conj(d.other.fixed - pin) * (other - pin)).imag() > 0 ? 1 : -1;
  const FourBar four_bar = four_bar_of(d);
  const double crank = std::arg(pin - d.driver.fixed) - four_bar.frame_angle;
  const FourBarPosition at = position(four_bar, crank);
  EXPECT_LT(std::abs(at.coupler_point - body.origin), 1e-12);
  EXPECT_LT(std::abs(at.crank_pin - pin), 1e-12);
  EXPECT_LT(std::abs(at.coupler_pin - other), 1e-12);
}

TEST(PoseDesign, IsShownOverATurnOrFromPoseToPose) {
  PoseDesign d = of_types(GuidingDyadType::rr, GuidingDyadType::rr);
  d.passage.drive = {1, 0.5, -0.5};
  EXPECT_EQ(shown_inputs(d, 4), (std::vector<double>{1, 0.5, 0, -0.5}));
  d.passage.drive_turns = true;
  EXPECT_NEAR(shown_inputs(d, 4).back(), 1 - 2 * pi, 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
