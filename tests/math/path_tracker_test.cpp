// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/path_tracker.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

// x^2 + y = p0 and y^2 + x = p1: four solutions.
struct TwoParabolas {
  static constexpr std::size_t unknowns = 2, data = 2;
  static constexpr double largest_chart = 1e6;
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    values[0] = z[0] * z[0] + z[1] - p[0];
    values[1] = z[1] * z[1] + z[0] - p[1];
    jacobian[0][0] = z[0] + z[0], jacobian[1][1] = z[1] + z[1];
    jacobian[0][1] = jacobian[1][0] = C(Complex<double>(1, 0));
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    evaluate(z, p, values, jacobian);
    for (std::size_t i = 0; i < unknowns; ++i) values_rate[i] = -rate[i];
  }
  template <class Z>
  LINKWRIGHT_KERNEL bool better_chart(Z&) const {
    return false;
  }
};

// z^2 = p, with the chart changed to -z, another solution, when |z| is above the limit and z on the right:
// tells whether and where charts are asked for.
struct SquareRoot {
  static constexpr std::size_t unknowns = 1, data = 1;
  static constexpr double largest_chart = 2;
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    values[0] = z[0] * z[0] - p[0];
    jacobian[0][0] = z[0] + z[0];
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    evaluate(z, p, values, jacobian);
    values_rate[0] = -rate[0];
  }
  template <class Z>
  bool better_chart(Z& z) const {
    if (static_cast<double>(z[0].re) < 0) return false;
    z[0] = -z[0];
    return true;
  }
};

template <class T, class System>
std::vector<TrackedPath<typename Lanes<T>::Single, System::unknowns>> tracked(
    const std::array<Complex<double>, System::data>& from,
    const std::array<Complex<double>, System::data>& to,
    const std::vector<TrackedPath<typename Lanes<T>::Single, System::unknowns>>& starts,
    const TrackerOptions& options = {}) {
  auto ends = starts;
  track_paths<T>(System(), from, to, std::span(std::as_const(starts)), options, std::span(ends));
  return ends;
}

using Batch = BaselineBatch;
using Path = TrackedPath<double, 2>;

// For p = (0, 0): x = -y^2 and y^4 + y = 0. Without 0, which has no size that steps could be relative to.
std::vector<Path> roots_at_zero() {
  std::vector<Path> out;
  for (const double angle : {1.0, 3.0, 5.0}) {
    const std::complex<double> y = std::polar(1.0, angle * 3.14159265358979323846 / 3), x = -y * y;
    out.push_back({.z = {Complex<double>(x.real(), x.imag()), Complex<double>(y.real(), y.imag())}});
  }
  return out;
}

TEST(PathTracker, BringsEverySolutionToTheTarget) {
  RandomStream random({.seed = 4});
  for (int trial = 0; trial < 50; ++trial) {
    std::array<Complex<double>, 2> to;
    for (auto& p : to) p = {random.normal(), random.normal()};
    const auto ends = tracked<Batch, TwoParabolas>({}, to, roots_at_zero());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      EXPECT_TRUE(ends[i].arrived);
      EXPECT_EQ(ends[i].at, 1);
      Complex<double> values[2], jacobian[2][2];
      TwoParabolas().evaluate(ends[i].z.data(), to.data(), values, jacobian);
      EXPECT_LT(norm(values[0]) + norm(values[1]),
                1e-12);  // the last correction was below 1e-5 and went by its square
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(norm(ends[i].z[0] - ends[j].z[0]) + norm(ends[i].z[1] - ends[j].z[1]), 1e-6);
    }
  }
}

// A lane knows nothing of its neighbours: alone, in any order and in registers of any size, with the same
// instructions.
TEST(PathTracker, APathDoesNotDependOnItsNeighbours) {
  const std::array<Complex<double>, 2> to = {Complex<double>(0.3, 1.1), Complex<double>(-0.7, 0.4)};
  const auto starts = roots_at_zero();
  const auto together = tracked<Batch, TwoParabolas>({}, to, starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto alone = tracked<Batch, TwoParabolas>({}, to, {starts[i]});
    EXPECT_EQ(alone[0].steps, together[i].steps);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(alone[0].z[k].re),
                std::bit_cast<std::uint64_t>(together[i].z[k].re));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(alone[0].z[k].im),
                std::bit_cast<std::uint64_t>(together[i].z[k].im));
    }
  }
}

TEST(PathTracker, TwiceTheDigitsEndAtTheSamePlace) {
  const std::array<Complex<double>, 2> to = {Complex<double>(0.3, 1.1), Complex<double>(-0.7, 0.4)};
  const auto ends = tracked<Batch, TwoParabolas>({}, to, roots_at_zero());
  std::vector<TrackedPath<DoubleDouble, 2>> starts;
  for (const Path& path : roots_at_zero())
    starts.push_back({.z = {Complex<DoubleDouble>(path.z[0]), Complex<DoubleDouble>(path.z[1])}});
  const auto fine = tracked<DoubleDouble, TwoParabolas>({}, to, starts, {.corrected = 1e-12});
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_TRUE(fine[i].arrived);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT(norm(ends[i].z[k] - Complex<double>(static_cast<double>(fine[i].z[k].re),
                                                    static_cast<double>(fine[i].z[k].im))),
                1e-18);
  }
}

TEST(PathTracker, StopsBeforeAPlaceWhereSolutionsMeet) {
  const auto ends =
      tracked<Batch, SquareRoot>({Complex<double>(1, 0)}, {Complex<double>(-1, 0)},
                                 {{.z = {Complex<double>(1, 0)}}, {.z = {Complex<double>(-1, 0)}}});
  for (const auto& end : ends) {
    EXPECT_FALSE(end.arrived);
    EXPECT_NEAR(end.at, 0.5, 1e-3);
  }
}

TEST(PathTracker, AsksForABetterChart) {
  const auto ends = tracked<Batch, SquareRoot>({Complex<double>(1, 0)}, {Complex<double>(9, 0)},
                                               {{.z = {Complex<double>(1, 0)}}});
  EXPECT_TRUE(ends[0].arrived);
  EXPECT_NEAR(ends[0].z[0].re, -3, 1e-9);
}

TEST(PathTracker, AStartThatIsNoSolutionIsNotFollowed) {
  const auto ends = tracked<Batch, SquareRoot>({Complex<double>(1, 0)}, {Complex<double>(2, 1)},
                                               {{.z = {Complex<double>(0.2, 0)}}});
  EXPECT_FALSE(ends[0].arrived);
  EXPECT_EQ(ends[0].at, 0);
}

TEST(PathTracker, SolvesLinearEquations) {
  RandomStream random({.seed = 5});
  constexpr std::size_t n = 5;
  for (int trial = 0; trial < 50; ++trial) {
    tracker::Lu<double, n> lu;
    Complex<double> a[n][n], solution[2][n], right[2][n];
    for (auto& row : a)
      for (auto& value : row) value = {random.normal(), random.normal()};
    a[0][0] = {0, 0};  // a pivot has to be looked for
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t i = 0; i < n; ++i) solution[r][i] = {random.normal(), random.normal()};
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t i = 0; i < n; ++i) {
        right[r][i] = {};
        for (std::size_t j = 0; j < n; ++j) {
          right[r][i] = right[r][i] + a[i][j] * solution[r][j];
          lu.a[i][j] = a[i][j];
        }
      }
    lu.solve(right);
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t i = 0; i < n; ++i) EXPECT_LT(norm(right[r][i] - solution[r][i]), 1e-22);
  }
}

}  // namespace
}  // namespace linkwright::math
