// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/four_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "planar/four_bars.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Complex = std::complex<double>;

TEST(FourBarPosition, MeetsTheCouplerPointsOfBothBranches) {
  const Value& entry = path_case("JAC-1");
  for (const auto& [key, branch] :
       {std::pair{"branch_plus", Branch::open}, {"branch_minus", Branch::crossed}}) {
    const FourBar linkage = four_bar(at(entry, "inputs.x"), branch);
    const auto pose = position(linkage, number_at(entry, "inputs.x.theta2_first_rad"));
    const auto expected = numbers(at(entry, std::string("computed.") + key + ".C_m"));
    EXPECT_EQ(pose.status, Status::done);
    EXPECT_NEAR(pose.coupler_point.real(), expected[0], 1e-10) << key;
    EXPECT_NEAR(pose.coupler_point.imag(), expected[1], 1e-10) << key;
  }
}

TEST(FourBarPosition, OfARightAngledLinkage) {
  // A 3-4-5 triangle A-B0-B over the crank that points along the ground: everything can be written down.
  const FourBar linkage{.ground = 6, .crank = 1, .coupler = 4, .rocker = 3, .coupler_u = 2, .pivot_x = 10};
  const auto open = position(linkage, 0);
  EXPECT_EQ(open.crank_pin, Complex(11, 0));
  EXPECT_NEAR(open.coupler_pin.real(), 11 + 3.2, 1e-14);
  EXPECT_NEAR(open.coupler_pin.imag(), 2.4, 1e-14);
  EXPECT_NEAR(open.coupler_point.real(), 11 + 1.6, 1e-14);
  EXPECT_NEAR(open.coupler_angle, std::atan2(3, 4), 1e-15);
  EXPECT_NEAR(open.rocker_angle, std::atan2(2.4, -1.8), 1e-15);
  EXPECT_NEAR(open.transmission_angle, pi / 2, 1e-15);
  EXPECT_EQ(open.gap, 0);
  FourBar crossed = linkage;
  crossed.branch = Branch::crossed;
  EXPECT_NEAR(position(crossed, 0).coupler_pin.imag(), -2.4, 1e-14);
}

TEST(FourBarPosition, TellsByHowMuchTheLinksMiss) {
  // Crank backwards: A and B0 are 7 apart, coupler and rocker reach 6.5.
  const auto far = position({.ground = 5, .crank = 2, .coupler = 3, .rocker = 3.5}, pi);
  EXPECT_EQ(far.status, Status::no_assembly);
  EXPECT_NEAR(far.gap, 0.5, 1e-14);
  EXPECT_NEAR(far.crank_pin.real(), -2, 1e-15);
  EXPECT_TRUE(std::isnan(far.coupler_point.real()) && std::isnan(far.coupler_angle));
  // Crank forwards: 3 apart, but the coupler is 4 longer than the rocker.
  const auto near = position({.ground = 5, .crank = 2, .coupler = 6, .rocker = 2}, 0);
  EXPECT_EQ(near.status, Status::no_assembly);
  EXPECT_NEAR(near.gap, 1, 1e-14);
}

TEST(FourBarPosition, AToggleIsSingularAndStillHasItsPosition) {
  // Coupler and rocker stretched: 7 = 3 + 4.
  const auto stretched = position({.ground = 5, .crank = 2, .coupler = 3, .rocker = 4, .coupler_u = 3}, pi);
  EXPECT_EQ(stretched.status, Status::singular);
  EXPECT_NEAR(std::abs(stretched.coupler_pin - Complex(1, 0)), 0, 1e-7);  // square root of rounding
  EXPECT_LT(stretched.transmission_angle, tolerance::toggle_angle);
  // Folded: 3 = 7 - 4.
  const auto folded = position({.ground = 5, .crank = 2, .coupler = 7, .rocker = 4}, 0);
  EXPECT_EQ(folded.status, Status::singular);
  EXPECT_NEAR(std::abs(folded.coupler_pin - Complex(9, 0)), 0, 1e-6);
}

TEST(FourBarPosition, OfACrankPinOnTheRockerPivot) {
  // Equal coupler and rocker may then point anywhere.
  const auto any = position({.ground = 2, .crank = 2, .coupler = 3, .rocker = 3}, 0);
  EXPECT_EQ(any.status, Status::singular);
  EXPECT_TRUE(std::isnan(any.coupler_point.real()));
  EXPECT_EQ(any.gap, 0);
  // Unequal ones cannot meet at all.
  const auto none = position({.ground = 2, .crank = 2, .coupler = 3, .rocker = 4}, 0);
  EXPECT_EQ(none.status, Status::no_assembly);
  EXPECT_NEAR(none.gap, 1, 1e-15);
}

TEST(FourBarPosition, RejectsWhatIsNoLinkage) {
  const auto with = [](double FourBar::*member, double value) {
    return [=] {
      FourBar linkage;
      linkage.*member = value;
      position(linkage, 0.1);
    };
  };
  EXPECT_THAT(with(&FourBar::crank, -1),
              ThrowsMessage<ContractError>(HasSubstr(
                  "link lengths must be positive and finite (1e-70 to 1e+70 m), got ground 1, crank -1, "
                  "coupler 1, rocker 1")));
  for (double FourBar::*length : {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker})
    for (double value : {0.0, -1e-300, nan, infinity, 1e-300, 1e300})
      EXPECT_THAT(with(length, value), ThrowsMessage<ContractError>(HasSubstr("link lengths must be")));
  for (double FourBar::*other : {&FourBar::coupler_u, &FourBar::coupler_v, &FourBar::pivot_x,
                                 &FourBar::pivot_y, &FourBar::frame_angle})
    EXPECT_THAT(with(other, nan), ThrowsMessage<ContractError>(HasSubstr("must be finite")));
  EXPECT_THAT([] { position({}, nan); }, ThrowsMessage<ContractError>(HasSubstr("crank angle nan")));
}

// Rounding of a position, relative to the size of the linkage: some tens of roundings, times what a direction
// gains near a toggle, 1 / sin(transmission angle), where the conditions below keep away from.
constexpr double rounding = 1e-13;

double size(const FourBar& l) {
  return l.ground + l.crank + l.coupler + l.rocker + std::abs(l.coupler_u) + std::abs(l.coupler_v);
}

// The conditions under which a position is well determined.
bool clear_of_toggles(const FourBarPosition& pose) {
  return pose.status == Status::done && pose.transmission_angle > 0.02;
}

RC_GTEST_PROP(FourBarPosition, ClosesTheLoopOnItsBranch, ()) {
  const FourBar l = *any_four_bar();
  const auto pose = position(l, *any_angle());
  RC_PRE(pose.status == Status::done);
  const double tolerance = 1e-12 * size(l);
  const Complex o = crank_pivot(l), b0 = rocker_pivot(l), a = pose.crank_pin, b = pose.coupler_pin;
  RC_ASSERT(std::abs(std::abs(b0 - o) - l.ground) < tolerance);
  RC_ASSERT(std::abs(std::abs(a - o) - l.crank) < tolerance);
  RC_ASSERT(std::abs(std::abs(b - a) - l.coupler) < tolerance);
  RC_ASSERT(std::abs(std::abs(b - b0) - l.rocker) < tolerance * (1 + l.coupler / std::abs(b0 - a)));
  const double left = std::imag(std::conj(b0 - a) * (b - a));
  RC_ASSERT(sign(l.branch) * left > 0);
  // The tracing point moves with the coupler, and both angles are those of the links.
  const Complex local = (pose.coupler_point - a) / ((b - a) / l.coupler);
  RC_ASSERT(std::abs(local - Complex(l.coupler_u, l.coupler_v)) < 1e-11 * size(l));
  RC_ASSERT(std::abs(math::angle_difference(pose.coupler_angle + l.frame_angle, std::arg(b - a))) < 1e-11);
  RC_ASSERT(std::abs(math::angle_difference(pose.rocker_angle + l.frame_angle, std::arg(b - b0))) <
            1e-11 * (1 + size(l) / l.rocker));
}

RC_GTEST_PROP(FourBarPosition, AssemblesExactlyWhenTheTriangleDoes, ()) {
  const FourBar l = *any_four_bar();
  const auto pose = position(l, *any_angle());
  const double distance = std::abs(rocker_pivot(l) - pose.crank_pin);
  const double short_by = distance - (l.coupler + l.rocker),
               long_by = std::abs(l.coupler - l.rocker) - distance;
  const double gap = std::max({0.0, short_by, long_by}), blurred = 1e-11 * size(l);
  RC_PRE(std::abs(short_by) > blurred && std::abs(long_by) > blurred);
  RC_ASSERT((pose.status == Status::no_assembly) == (gap > 0));
  RC_ASSERT(std::abs(pose.gap - gap) < blurred);
}

RC_GTEST_PROP(FourBarPosition, DoesNotDependOnPlaceDirectionOrScale, ()) {
  const FourBar l = *any_four_bar();
  const double angle = *any_angle(), turn = *any_angle(), scale = *log_between(1e-3, 1e3);
  const Complex shift(*between(-5, 5), *between(-5, 5));
  const auto pose = position(l, angle);
  RC_PRE(clear_of_toggles(pose));
  FourBar moved = l;
  for (double FourBar::*length : {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker,
                                  &FourBar::coupler_u, &FourBar::coupler_v})
    moved.*length *= scale;
  const Complex map = scale * std::polar(1.0, turn), pivot = map * crank_pivot(l) + shift;
  moved.pivot_x = pivot.real();
  moved.pivot_y = pivot.imag();
  moved.frame_angle += turn;
  const auto other = position(moved, angle);
  const double tolerance = 100 * rounding * (scale * (size(l) + 10) + 10) / std::sin(pose.transmission_angle);
  RC_ASSERT(std::abs(other.coupler_point - (map * pose.coupler_point + shift)) < tolerance);
  RC_ASSERT(std::abs(other.coupler_pin - (map * pose.coupler_pin + shift)) < tolerance);
  RC_ASSERT(std::abs(other.transmission_angle - pose.transmission_angle) < 1e-9);
  RC_ASSERT(std::abs(math::angle_difference(other.coupler_angle, pose.coupler_angle)) < 1e-9);
}

RC_GTEST_PROP(FourBarPosition, TransmissionAngleByTheLawOfCosines, ()) {
  const FourBar l = *any_four_bar();
  const auto pose = position(l, *any_angle());
  RC_PRE(clear_of_toggles(pose));
  const double distance = std::abs(rocker_pivot(l) - pose.crank_pin);
  const double cosine =
      (l.coupler * l.coupler + l.rocker * l.rocker - distance * distance) / (2 * l.coupler * l.rocker);
  const double mu = std::acos(std::clamp(cosine, -1.0, 1.0));
  // acos blurs by 1 / sin(mu), the difference of squares by size^2 / (L3 L4).
  const double tolerance = 10 * rounding * size(l) * size(l) / (l.coupler * l.rocker) / std::sin(mu);
  RC_ASSERT(std::abs(pose.transmission_angle - std::min(mu, pi - mu)) < tolerance);
}

RC_GTEST_PROP(FourBarPosition, BranchesMirrorEachOther, ()) {
  FourBar l = *any_four_bar();
  l.frame_angle = l.pivot_x = l.pivot_y = l.coupler_v = 0;
  const double angle = *any_angle();
  const auto pose = position(l, angle);
  l.branch = other(l.branch);
  const auto mirrored = position(l, -angle);
  RC_ASSERT(pose.status == mirrored.status);
  RC_PRE(pose.status == Status::done);
  RC_ASSERT(mirrored.coupler_point == std::conj(pose.coupler_point));
}

// Any numbers give an answer or a ContractError, never a "done" without a position.
RC_GTEST_PROP(FourBarPosition, AnswersAnyInput, ()) {
  const auto wild = rc::gen::oneOf(log_between(1e-300, 1e300), rc::gen::just(nan), rc::gen::just(0.0),
                                   log_between(1e-69, 1e69), between(-2, 2));
  FourBar l{.ground = *wild, .crank = *wild, .coupler = *wild, .rocker = *wild};
  l.coupler_u = *wild;
  l.coupler_v = *wild;
  l.pivot_x = *wild;
  l.frame_angle = *wild;
  l.branch = *any_branch();
  const auto usable = [](double length) { return length >= shortest_link && length <= max_link; };
  bool thrown = false;
  try {
    const auto pose = position(l, *rc::gen::oneOf(any_angle(), rc::gen::just(0.0), rc::gen::just(pi)));
    if (pose.status == Status::done) {
      RC_ASSERT(std::isfinite(pose.coupler_angle) && std::isfinite(pose.rocker_angle));
      RC_ASSERT(pose.transmission_angle > 0 && pose.transmission_angle <= pi / 2);
    } else {
      RC_ASSERT(pose.status == Status::no_assembly || pose.status == Status::singular);
      RC_ASSERT((pose.gap > 0) == (pose.status == Status::no_assembly));
    }
  } catch (const ContractError&) {
    thrown = true;
  }
  RC_ASSERT(thrown == !(usable(l.ground) && usable(l.crank) && usable(l.coupler) && usable(l.rocker) &&
                        std::isfinite(l.coupler_u) && std::isfinite(l.coupler_v) &&
                        std::isfinite(l.pivot_x) && std::isfinite(l.frame_angle)));
}

}  // namespace
}  // namespace linkwright::planar
