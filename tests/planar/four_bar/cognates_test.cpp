// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/four_bars.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Complex = std::complex<double>;

void expect_linkage(const FourBar& found, const Value& expected) {
  const FourBar l = four_bar(expected);
  EXPECT_NEAR(found.ground, l.ground, 1e-10);
  EXPECT_NEAR(found.crank, l.crank, 1e-10);
  EXPECT_NEAR(found.coupler, l.coupler, 1e-10);
  EXPECT_NEAR(found.rocker, l.rocker, 1e-10);
  EXPECT_NEAR(found.coupler_u, l.coupler_u, 1e-10);
  EXPECT_NEAR(found.coupler_v, l.coupler_v, 1e-10);
  EXPECT_NEAR(found.pivot_x, l.pivot_x, 1e-10);
  EXPECT_NEAR(found.pivot_y, l.pivot_y, 1e-10);
  EXPECT_NEAR(math::angle_difference(found.frame_angle, l.frame_angle), 0, 1e-10);
}

// Crank angle of the second cognate where the original has this coupler angle: both relative to their own
// ground link, and the cognate's input is parallel to the original's coupler turned by arg(lambda).
double second_angle(const FourBarPosition& pose) { return pose.coupler_angle; }

TEST(Cognates, MeetThePublishedOnes) {
  const Value& entry = path_case("COG-1");
  const FourBar original = four_bar(at(entry, "inputs.design"));
  for (const auto& [degrees, point, place] : at(entry, "computed.coupler_points_at_theta2_deg").as_object()) {
    const double angle = math::radians(std::stod(degrees));
    const auto found = cognates(original, angle);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_FALSE(found[0].same_timing);
    EXPECT_TRUE(found[1].same_timing);
    expect_linkage(found[0].linkage, at(entry, "computed.second"));
    expect_linkage(found[1].linkage, at(entry, "computed.third"));
    EXPECT_EQ(sign(found[1].linkage.branch), number_at(entry, "computed.third_branch"));
    const auto expected = numbers(point);
    const Complex target(expected[0], expected[1]);
    const auto pose = position(original, angle);
    EXPECT_LT(std::abs(pose.coupler_point - target), 1e-10) << degrees;
    EXPECT_LT(std::abs(position(found[0].linkage, second_angle(pose)).coupler_point - target), 1e-10);
    EXPECT_LT(std::abs(position(found[1].linkage, angle).coupler_point - target), 1e-10);
  }
}

// Cognates grow as 1 / sin of the angle between the links that they share with the original, so positions
// blur by the size of the largest and by the toggles that are near.
RC_GTEST_PROP(Cognates, TraceTheSamePoint, ()) {
  const FourBar l = *any_four_bar();
  const double angle = *any_angle();
  const auto pose = position(l, angle);
  RC_PRE(pose.status == Status::done && pose.transmission_angle > 0.05);
  // The second passes its toggle where the original's crank and rocker are parallel.
  const double second_toggle = std::abs(std::sin(pose.rocker_angle - angle));
  for (const Cognate& cognate : cognates(l, angle)) {
    if (!cognate.same_timing && second_toggle < 0.05) continue;
    const double input = cognate.same_timing ? angle : second_angle(pose);
    const auto other = position(cognate.linkage, input);
    const FourBar& c = cognate.linkage;
    const double size = l.ground + l.crank + l.coupler + l.rocker + c.ground + c.crank + c.coupler +
                        c.rocker + std::abs(Complex(l.coupler_u, l.coupler_v)) +
                        std::abs(Complex(c.coupler_u, c.coupler_v));
    RC_ASSERT(other.status == Status::done);
    RC_ASSERT(std::abs(other.coupler_point - pose.coupler_point) <
              1e-10 * (1 + size * size / std::min(c.coupler, l.coupler)));
  }
}

// Over a whole turn the cognate with the same timing keeps its branch.
RC_GTEST_PROP(Cognates, SameTimingHoldsOverATurn, ()) {
  const FourBar l = *turning_four_bar();
  RC_PRE(std::abs(Complex(l.coupler_u, l.coupler_v) - l.coupler) > 1e-3);
  const FourBar third = cognates(l, 0.0).back().linkage;
  for (int i = 0; i < 36; ++i) {
    const double angle = i * pi / 18;
    RC_ASSERT(std::abs(position(third, angle).coupler_point - position(l, angle).coupler_point) < 1e-9);
  }
}

RC_GTEST_PROP(Cognates, OfTheTimedCognateLeadBack, ()) {
  FourBar l = *turning_four_bar();
  RC_PRE(std::abs(Complex(l.coupler_u, l.coupler_v) - l.coupler) > 0.1);
  const FourBar back = cognates(cognates(l, 0.3).back().linkage, 0.3).back().linkage;
  RC_ASSERT(back.branch == l.branch);
  for (double FourBar::*member :
       {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker, &FourBar::coupler_u,
        &FourBar::coupler_v, &FourBar::pivot_x, &FourBar::pivot_y})
    RC_ASSERT(std::abs(back.*member - l.*member) < 1e-9);
  RC_ASSERT(std::abs(math::angle_difference(back.frame_angle, l.frame_angle)) < 1e-9);
}

TEST(Cognates, OfATracingPointOnAPin) {
  const FourBar on_a{.ground = 2.2, .crank = 0.75, .coupler = 1.9, .rocker = 1.6};
  const auto from_a = cognates(on_a, 0.4);
  ASSERT_EQ(from_a.size(), 1u);
  EXPECT_TRUE(from_a[0].same_timing);
  EXPECT_LT(std::abs(position(from_a[0].linkage, 0.4).coupler_point - position(on_a, 0.4).crank_pin), 1e-14);
  FourBar on_b = on_a;
  on_b.coupler_u = on_b.coupler;
  const auto from_b = cognates(on_b, 0.4);
  ASSERT_EQ(from_b.size(), 1u);
  EXPECT_FALSE(from_b[0].same_timing);
  EXPECT_LT(std::abs(position(from_b[0].linkage, position(on_b, 0.4).coupler_angle).coupler_point -
                     position(on_b, 0.4).coupler_pin),
            1e-14);
}

TEST(Cognates, RejectWhatIsNoLinkage) {
  EXPECT_THAT([] { cognates({.rocker = -2}, 0); },
              ThrowsMessage<ContractError>(HasSubstr("got ground 1, crank 1, coupler 1, rocker -2")));
}

RC_GTEST_PROP(Cognates, AnswerAnyInput, ()) {
  const auto wild = rc::gen::oneOf(log_between(1e-300, 1e300), log_between(1e-30, 1e30), rc::gen::just(nan),
                                   between(-1, 1));
  FourBar l{.ground = *wild, .crank = *wild, .coupler = *wild, .rocker = *wild};
  l.coupler_u = *wild;
  l.coupler_v = *wild;
  try {
    RC_ASSERT(cognates(l, *any_angle()).size() <= 2u);
  } catch (const ContractError&) {
  }
}

}  // namespace
}  // namespace linkwright::planar
