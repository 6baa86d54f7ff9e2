// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise_largest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;
using Numbers = std::span<const double>;
using Out = std::span<double>;

/// (x - 1)^2 and (x + 2)^2: the larger is least where they cross, at -1/2, 9/4.
void parabolas(Numbers x, Out f, Out jacobian) {
  f[0] = (x[0] - 1) * (x[0] - 1);
  f[1] = (x[0] + 2) * (x[0] + 2);
  if (!jacobian.empty()) {
    jacobian[0] = 2 * (x[0] - 1);
    jacobian[1] = 2 * (x[0] + 2);
  }
}

/// First problem of Charalambous and Conn 1978: 1.9522245 at (1.1390378, 0.8995598).
void charalambous_conn(Numbers x, Out f, Out jacobian) {
  const double a = x[0], b = x[1], e = 2 * std::exp(b - a);
  f[0] = a * a + std::pow(b, 4);
  f[1] = (2 - a) * (2 - a) + (2 - b) * (2 - b);
  f[2] = e;
  if (!jacobian.empty()) {
    const double rows[] = {2 * a, 4 * b * b * b, -2 * (2 - a), -2 * (2 - b), -e, e};
    std::copy(std::begin(rows), std::end(rows), jacobian.begin());
  }
}

TEST(MinimiseLargest, TwoParabolasCross) {
  RunContext context;
  for (const double start : {-7.0, -0.5, 0.0, 20.0}) {
    std::vector<double> x = {start};
    const LocalReport report = minimise_largest(2, parabolas, {}, x, {}, {}, {}, context);
    EXPECT_EQ(report.status, Status::done) << start << " " << name_of(report.end);
    EXPECT_NEAR(x[0], -0.5, 1e-8) << start;
    EXPECT_NEAR(report.cost, 2.25, 1e-8) << start;
  }
  // References 4 and 1: |x - 1| / 2 = |x + 2|, at -1, where both ratios are 1.
  const std::vector<double> references = {4, 1};
  std::vector<double> x = {3};
  EXPECT_NEAR(minimise_largest(2, parabolas, references, x, {}, {}, {}, context).cost, 1, 1e-8);
  EXPECT_NEAR(x[0], -1, 1e-8);
}

TEST(MinimiseLargest, FirstProblemOfCharalambousAndConn) {
  RunContext context;
  for (const std::vector<double>& start : {std::vector<double>{1, -0.1}, {2, 2}, {-1, 1}}) {
    std::vector<double> x = start;
    const LocalReport report = minimise_largest(3, charalambous_conn, {}, x, {}, {}, {}, context);
    EXPECT_EQ(report.status, Status::done) << start[0] << " " << name_of(report.end);
    EXPECT_NEAR(report.cost, 1.9522245, 1e-7);  // last printed digit
    EXPECT_NEAR(x[0], 1.1390378, 1e-5);
    EXPECT_NEAR(x[1], 0.8995598, 1e-5);
    double f[3];
    charalambous_conn(x, f, {});
    EXPECT_EQ(report.cost, std::max({f[0], f[1], f[2]}));
    EXPECT_LT(report.evaluations, 60);
  }
}

TEST(MinimiseLargest, ConstraintsAndBoundsHold) {
  RunContext context;
  // x >= 0 moves the least of the larger parabola to 0, where it is 4.
  const auto above_zero = [](Numbers x, Out g, Out jacobian) {
    g[0] = -x[0];
    if (!jacobian.empty()) jacobian[0] = -1;
  };
  std::vector<double> x = {-5};  // violates it
  const LocalReport report = minimise_largest(2, parabolas, {}, 1, above_zero, x, {}, {}, {}, context);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_NEAR(x[0], 0, 1e-8);
  EXPECT_NEAR(report.cost, 4, 1e-7);
  EXPECT_EQ(report.violation, 0);
  const std::vector<double> low = {1}, high = {3};
  x = {7};
  EXPECT_NEAR(minimise_largest(2, parabolas, {}, x, low, high, {}, context).cost, 9, 1e-8);
  EXPECT_EQ(x[0], 1);
  // x <= -1 and x >= 0.
  const auto apart = [](Numbers at, Out g, Out jacobian) {
    g[0] = -at[0];
    g[1] = at[0] + 1;
    if (!jacobian.empty()) {
      jacobian[0] = -1;
      jacobian[1] = 1;
    }
  };
  x = {2};
  const LocalReport none = minimise_largest(2, parabolas, {}, 2, apart, x, {}, {}, {}, context);
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_GE(none.violation, 0.5);
}

TEST(MinimiseLargest, EndsWithTheBestWhenCancelled) {
  RunContext context;
  double least = HUGE_VAL;
  int calls = 0;
  const auto watched = [&](Numbers x, Out f, Out jacobian) {
    charalambous_conn(x, f, jacobian);
    if (calls > 0) least = std::min(least, std::max({f[0], f[1], f[2]}));
    if (++calls == 5) context.cancel();
  };
  std::vector<double> x = {2, 2};
  const LocalReport report = minimise_largest(3, watched, {}, x, {}, {}, {}, context);
  EXPECT_EQ(report.status, Status::cancelled);
  EXPECT_EQ(report.cost, least);
  double f[3];
  charalambous_conn(x, f, {});
  EXPECT_EQ(std::max({f[0], f[1], f[2]}), least);
}

TEST(MinimiseLargest, ValuesThatDoNotExistEndTheSearch) {
  RunContext context;
  std::vector<double> x = {1};
  const LocalReport report = minimise_largest(
      1, [](Numbers, Out f, Out) { f[0] = std::nan(""); }, {}, x, {}, {}, {}, context);
  EXPECT_EQ(report.status, Status::not_converged);
  EXPECT_EQ(report.end, LocalEnd::not_finite);
  EXPECT_EQ(x[0], 1);
}

TEST(MinimiseLargest, SaysWhatIsWrong) {
  RunContext context;
  std::vector<double> x = {1};
  const std::vector<double> three = {1, 1, 1}, zero = {1, 0};
  EXPECT_THAT(message([&] { minimise_largest(2, parabolas, three, x, {}, {}, {}, context); }),
              HasSubstr("3 references for 2 functions"));
  EXPECT_THAT(message([&] { minimise_largest(2, parabolas, zero, x, {}, {}, {}, context); }),
              HasSubstr("reference 1 must be more than 0, got 0"));
  EXPECT_THAT(message([&] { minimise_largest(0, parabolas, {}, x, {}, {}, {}, context); }),
              HasSubstr("needs functions to minimise the largest of"));
  EXPECT_THAT(message([&] {
                minimise_largest(2, parabolas, {}, x, {}, {}, {.method = LocalMethod::cobyla}, context);
              }),
              HasSubstr("needs slsqp, got cobyla"));
  EXPECT_THAT(message([&] { minimise_largest(2, parabolas, {}, x, three, {}, {}, context); }),
              HasSubstr("3 lower and 0 upper bounds for 1 variables"));
}

}  // namespace
}  // namespace linkwright::optimise
