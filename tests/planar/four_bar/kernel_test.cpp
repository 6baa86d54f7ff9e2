// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/kernel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>

#include "linkwright/core/random.h"
#include "linkwright/math/differences.h"
#include "linkwright/math/dual.h"
#include "linkwright/math/simd.h"
#include "planar/four_bars.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

constexpr std::size_t parameter_count = 10;  // L1 L2 L3 L4 l1 l2 x0 y0 theta0 theta2, as in [JAC-1]

// Coupler point from the kernel, for any scalar.
template <class T>
std::array<T, 2> coupler_point(const std::array<T, parameter_count>& q, double branch) {
  using std::cos, std::sin;
  const T wx = q[1] * cos(q[9]), wy = q[1] * sin(q[9]);
  const Closure<T> closure = close_loop(q[0], T(0.0), wx, wy, q[2], q[3], T(branch));
  const math::Vector2<T> v = coupler_direction(closure, q[2]);
  const T zx = wx + q[4] * v.x - q[5] * v.y, zy = wy + q[4] * v.y + q[5] * v.x;
  const T c = cos(q[8]), s = sin(q[8]);
  return {q[6] + c * zx - s * zy, q[7] + s * zx + c * zy};
}

using Dual = math::Dual<parameter_count>;
std::array<Dual, 2> derivatives(const std::array<double, parameter_count>& q, double branch) {
  std::array<Dual, parameter_count> parameters;
  for (int i = 0; i < static_cast<int>(parameter_count); ++i) parameters[i] = Dual::variable(q[i], i);
  return coupler_point(parameters, branch);
}

TEST(FourBarKernel, DualNumbersMeetThePublishedDerivatives) {
  const Value& entry = path_case("JAC-1");
  std::array<double, parameter_count> q;
  std::size_t i = 0;
  for (const auto& member : at(entry, "inputs.x").as_object()) q.at(i++) = member.value.as_number();
  ASSERT_EQ(i, parameter_count);
  for (const auto& [key, branch] :
       {std::pair{"computed.branch_plus", 1.0}, {"computed.branch_minus", -1.0}}) {
    const auto point = derivatives(q, branch);
    const auto expected_point = numbers(at(at(entry, key), "C_m"));
    const auto& expected = at(at(entry, key), "dC_dx").as_array();
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(point[axis].value, expected_point[axis], 1e-10);
      for (std::size_t j = 0; j < parameter_count; ++j)
        EXPECT_NEAR(point[axis].by[j], numbers(expected[j])[axis], 1e-10) << key << " quantity " << j;
    }
  }
}

RC_GTEST_PROP(FourBarKernel, DualNumbersAgreeWithDifferences, ()) {
  const FourBar l = *any_four_bar();
  const double angle = *any_angle(), branch = sign(l.branch);
  const auto pose = position(l, angle);
  RC_PRE(pose.status == Status::done && pose.transmission_angle > 0.2);
  const std::array<double, parameter_count> q = {l.ground,      l.crank,     l.coupler, l.rocker,
                                                 l.coupler_u,   l.coupler_v, l.pivot_x, l.pivot_y,
                                                 l.frame_angle, angle};
  const double size =
      l.ground + l.crank + l.coupler + l.rocker + std::abs(l.coupler_u) + std::abs(l.coupler_v);
  const double shortest = std::min({l.ground, l.crank, l.coupler, l.rocker});
  const double distance = std::abs(rocker_pivot(l) - pose.crank_pin);
  // Lengths over which the point bends: the triangle's sides and height.
  const double bend = std::min({shortest, distance, 1.0}) * std::sin(pose.transmission_angle);
  std::array<double, parameter_count> scale;
  for (std::size_t j = 0; j < parameter_count; ++j) scale[j] = j < 8 ? bend : bend / (1 + size);
  const auto point = [&](std::span<const double> at, std::span<double> c, std::span<double>) {
    std::array<double, parameter_count> moved;
    std::copy(at.begin(), at.end(), moved.begin());
    const auto found = coupler_point(moved, branch);
    std::copy(found.begin(), found.end(), c.begin());
    return true;
  };
  std::array<double, 2 * parameter_count> differences;
  RC_ASSERT(math::central_jacobian(point, 2, q, differences, scale) == Status::done);
  const auto exact = derivatives(q, branch);
  // The error of differences is some eps^(2/3) = 4e-11 of size / bend.
  for (std::size_t j = 0; j < parameter_count; ++j)
    for (std::size_t axis = 0; axis < 2; ++axis)
      RC_ASSERT(std::abs(differences[2 * j + axis] - exact[axis].by[j]) < 1e-7 * (1 + size / bend));
}

TEST(FourBarKernel, BatchesGiveTheBitsOfTheScalar) {
  using Batch = math::BaselineBatch;
  RandomStream random({.seed = 5});
  int assembled = 0, apart = 0;
  for (int i = 0; i < 10000; ++i) {
    // Every quantity differs between the lanes; some lanes assemble and some do not.
    double q[7][2];
    for (auto& lanes : q)
      for (double& lane : lanes)
        lane = random.uniform(0.1, 3) * (&lanes - q < 4 && random.bits() % 2 ? -1 : 1);
    const double side[2] = {1, -1};
    const auto lanes = [&](int j) { return Batch::load_unaligned(q[j]); };
    const Closure<Batch> batch =
        close_loop(lanes(0), lanes(1), lanes(2), lanes(3), lanes(4), lanes(5), Batch::load_unaligned(side));
    const math::Vector2<Batch> direction = coupler_direction(batch, lanes(4));
    double out[6][2];
    const Batch results[6] = {batch.nx, batch.ny, batch.r2, batch.radicand, direction.x, direction.y};
    for (int j = 0; j < 6; ++j) results[j].store_unaligned(out[j]);
    for (int lane = 0; lane < 2; ++lane) {
      const Closure<double> one =
          close_loop(q[0][lane], q[1][lane], q[2][lane], q[3][lane], q[4][lane], q[5][lane], side[lane]);
      const math::Vec2 v = coupler_direction(one, q[4][lane]);
      const double expected[6] = {one.nx, one.ny, one.r2, one.radicand, v.x, v.y};
      for (int j = 0; j < 6; ++j)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(out[j][lane]), std::bit_cast<std::uint64_t>(expected[j]));
      ++(one.radicand >= 0 ? assembled : apart);
      if (one.radicand >= 0) {
        EXPECT_NEAR(std::hypot(v.x, v.y), 1, 1e-12);  // far lengths, no cancellation beyond a few digits
      } else {
        EXPECT_GT(std::hypot(v.x, v.y), 1);  // finite, and to be flagged by the caller
      }
    }
  }
  EXPECT_GT(assembled, 1000);
  EXPECT_GT(apart, 1000);
}

// The product form keeps 1 - c^2 near a toggle, where c^2 alone would lose half the digits.
TEST(FourBarKernel, KeepsDigitsNearAToggle) {
  for (const double gap : {1e-4, 1e-8, 1e-12}) {
    // Coupler and rocker 3 and 4, A and B0 apart by 7 - gap.
    const Closure<double> closure = close_loop(7 - gap, 0.0, 0.0, 0.0, 3.0, 4.0, 1.0);
    const double r = 7 - gap;
    const double apart = 7 - r;  // rest of the rounded distance
    const double exact = apart * (14 - apart) * (r * r - 1);
    EXPECT_NEAR(closure.radicand / exact, 1, 1e-15 * 49 * 7 / apart);
  }
}

}  // namespace
}  // namespace linkwright::planar
