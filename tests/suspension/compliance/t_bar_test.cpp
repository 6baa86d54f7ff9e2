// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/t_bar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::suspension {
namespace {

/// An upright post with level droplinks that pull it forward.
TBar upright() {
  return {.foot = {1, 0, 0.2},
          .top = {1, 0, 0.4},
          .end = {Vec3{1, 0.15, 0.4}, Vec3{1, -0.15, 0.4}},
          .rod = {0.3, 0.3}};
}
PathPoint along(const Vec3& at, const Vec3& rate, const Vec3& change = {}) { return {at, rate, change}; }

TEST(TBar, TiltsAndTwistsByItsLevers) {
  const TBar bar = upright();
  const Vec3 left{1.3, 0.15, 0.4}, right{1.3, -0.15, 0.4}, forward{1, 0, 0};
  const TBarPosition equal = t_bar_position(bar, {along(left, forward), along(right, forward)});
  ASSERT_EQ(equal.status, Status::done);
  EXPECT_NEAR(equal.tilt, 0, 1e-15);
  EXPECT_NEAR(equal.tilt_rate, 1 / 0.2, 1e-12);  // height of the post
  EXPECT_NEAR(equal.twist_rate, 0, 1e-12);
  const TBarPosition opposite = t_bar_position(bar, {along(left, forward), along(right, -forward)});
  EXPECT_NEAR(opposite.tilt_rate, 0, 1e-12);
  EXPECT_NEAR(opposite.twist_rate, -1 / 0.15, 1e-12);  // half of the crossbar; the left end goes forward
}

// Distances computed here by turning the ends about the lateral axis and the post in plain coordinates.
TEST(TBar, KeepsTheLengthsOfItsDroplinksAlongAPath) {
  TBar bar = upright();
  bar.top = {0.97, 0, 0.41};
  bar.end = {Vec3{0.98, 0.16, 0.42}, Vec3{0.975, -0.14, 0.4}};
  bar.rod = {0.31, 0.29};
  const Vec3 v{0.4, 0.1, 0.7}, a{-1, 2, 0.5}, w{-0.6, 0.2, -0.3}, b{0.3, -1, 2};
  const auto at = [&](double s) {
    return std::array{along(Vec3{1.28, 0.18, 0.44} + s * v + (s * s / 2) * a, v + s * a, a),
                      along(Vec3{1.26, -0.13, 0.43} + s * w + (s * s / 2) * b, w + s * b, b)};
  };
  const auto length = [&](const TBarPosition& p, const Vec3& end, const Vec3& other) {
    const Vec3 post = unit(bar.top - bar.foot), r = end - bar.foot;
    // Rodrigues' formula.
    const Vec3 twisted = std::cos(p.twist) * r + std::sin(p.twist) * cross(post, r) +
                         ((1 - std::cos(p.twist)) * dot(post, r)) * post;
    const Vec3 tilted{std::cos(p.tilt) * twisted.x + std::sin(p.tilt) * twisted.z, twisted.y,
                      -std::sin(p.tilt) * twisted.x + std::cos(p.tilt) * twisted.z};
    return norm(other - bar.foot - tilted);
  };
  const auto solved = [&](double s) { return t_bar_position(bar, at(s)); };
  for (const double s : {0.0, 0.02, -0.03}) {
    const TBarPosition p = solved(s);
    ASSERT_EQ(p.status, Status::done) << s;
    for (const std::size_t i : {0U, 1U})
      EXPECT_NEAR(length(p, bar.end[i], at(s)[i].at), bar.rod[i], 1e-14) << s;
    const double h = 1e-3;
    const auto slope = [&](double TBarPosition::*of) {
      return (8 * (solved(s + h).*of - solved(s - h).*of) - (solved(s + 2 * h).*of - solved(s - 2 * h).*of)) /
             (12 * h);
    };
    EXPECT_NEAR(p.tilt_rate, slope(&TBarPosition::tilt), 1e-8 * (1 + std::abs(p.tilt_rate)));
    EXPECT_NEAR(p.twist_rate, slope(&TBarPosition::twist), 1e-8 * (1 + std::abs(p.twist_rate)));
    EXPECT_NEAR(p.twist_change, slope(&TBarPosition::twist_rate), 1e-7 * (1 + std::abs(p.twist_change)));
  }
}

TEST(TBar, DroplinksThatDoNotReachOrMoveNothing) {
  const TBar bar = upright();
  const Vec3 up{0, 0, 1};
  EXPECT_NE(t_bar_position(bar, {along({2, 0.15, 0.4}, up), along({2, -0.15, 0.4}, up)}).status,
            Status::done);
  TBar flat = bar;  // droplinks along the post
  const auto above = [&](double y) { return along({1, y, 0.7}, up); };
  EXPECT_NE(t_bar_position(flat, {above(0.15), above(-0.15)}).status, Status::done);
}

}  // namespace
}  // namespace linkwright::suspension
