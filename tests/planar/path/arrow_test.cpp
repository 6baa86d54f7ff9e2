// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/arrow.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "support/allocations.h"

namespace linkwright::planar {
namespace {

using Shared = ArrowEquations::Shared;

// The same rows as a dense least-squares problem.
struct Rows {
  std::size_t shared, points;
  bool with_angles;
  std::vector<Eigen::VectorXd> by;
  std::vector<double> weight, r;
  void add(double w, double value, const Shared& s, std::vector<std::pair<std::size_t, double>> angles) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(shared + points));
    for (std::size_t i = 0; i < shared; ++i) row[static_cast<Eigen::Index>(i)] = s[i];
    for (const auto& [k, d] : angles) row[static_cast<Eigen::Index>(shared + k)] += d;
    by.push_back(row);
    weight.push_back(w);
    r.push_back(value);
  }
};

Shared random_row(RandomStream& random, std::size_t n) {
  Shared out{};
  for (std::size_t i = 0; i < n; ++i) out[i] = random.normal();
  return out;
}

void compare(bool with_angles, bool with_steps, double lambda, std::size_t hold) {
  constexpr std::size_t n = 9, points = 12;
  const std::vector<double> regular(n, 1e-14);
  ArrowEquations arrow(regular, points, with_angles);
  Rows rows{n, points, with_angles, {}, {}, {}};
  RandomStream random({.seed = 5});
  arrow.clear();
  for (std::size_t k = 0; k < points; ++k) {
    const Shared x = random_row(random, n), y = random_row(random, n);
    const double tx = with_angles ? random.normal() : 0, ty = with_angles ? random.normal() : 0;
    const double rx = random.normal(), ry = random.normal();
    arrow.add_point(k, rx, ry, x, y, tx, ty);
    rows.add(1, rx, x, {{k, tx}});
    rows.add(1, ry, y, {{k, ty}});
  }
  const Shared limit = random_row(random, n);
  arrow.add_row(7, 0.3, limit, 4, with_angles ? 0.5 : 0);
  rows.add(7, 0.3, limit, {{4, with_angles ? 0.5 : 0}});
  if (with_steps)
    for (std::size_t k = 0; k + 1 < points; k += 2) {
      arrow.add_step(3, 0.2, k, -1);
      rows.add(3, 0.2, {}, {{k, 1}, {k + 1, -1}});
    }
  std::array<bool, n> held{};
  if (hold < n) held[hold] = true;
  ASSERT_TRUE(arrow.solve(lambda, held));

  const auto all = static_cast<Eigen::Index>(with_angles ? n + points : n);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(all);
  for (std::size_t i = 0; i < rows.by.size(); ++i) {
    const Eigen::VectorXd d = rows.by[i].head(all);
    a += rows.weight[i] * d * d.transpose();
    g += rows.weight[i] * rows.r[i] * d;
  }
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(arrow.gradient()[i], g[static_cast<Eigen::Index>(i)], 1e-12);
  a.diagonal() *= 1 + lambda;
  if (hold < n) {
    const auto h = static_cast<Eigen::Index>(hold);
    a.row(h).setZero();
    a.col(h).setZero();
    a(h, h) = 1;
    g[h] = 0;
  }
  const Eigen::VectorXd step = a.ldlt().solve(-g);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(arrow.step()[i], step[static_cast<Eigen::Index>(i)], 1e-9);
  for (std::size_t k = 0; with_angles && k < points; ++k)
    EXPECT_NEAR(arrow.angle_step()[k], step[static_cast<Eigen::Index>(n + k)], 1e-9) << k;
}

TEST(ArrowEquations, StepsAreThoseOfTheDenseEquations) {
  for (const double lambda : {0.01, 1.0, 100.0})
    for (const std::size_t hold : {std::size_t{2}, std::size_t{99}}) {
      compare(true, true, lambda, hold);
      compare(true, false, lambda, hold);
      compare(false, false, lambda, hold);
    }
}

TEST(ArrowEquations, TheCornerIsAnUpperBound) {
  const std::vector<double> regular(1, 1.0);
  ArrowEquations arrow(regular, 3, true);
  arrow.clear();
  for (std::size_t k = 0; k < 3; ++k) arrow.add_point(k, 0, 0, {}, {}, 1, 0);
  arrow.add_step(2, 0.5, 2, 1);  // from the last point to the first
  ASSERT_TRUE(arrow.solve(0, std::array{false}));
  EXPECT_NEAR(arrow.angle_step()[0], -1.0 / 5, 1e-12);  // gradient 1, diagonal 1 + 2 * 2
  EXPECT_NEAR(arrow.angle_step()[2], 1.0 / 5, 1e-12);
  EXPECT_EQ(arrow.angle_step()[1], 0);
}

TEST(ArrowEquations, SaysWhenThereIsNoStep) {
  const std::vector<double> none(2, 0.0);
  ArrowEquations arrow(none, 3, false);
  arrow.clear();
  EXPECT_FALSE(arrow.solve(1, std::array{false, false}));
  EXPECT_TRUE(arrow.solve(1, std::array{true, true}));
  const std::vector<double> many(11, 0.0);
  EXPECT_THROW(ArrowEquations(many, 3, false), ContractError);
}

TEST(ArrowEquations, AllocatesNothing) {
  const std::vector<double> regular(9, 1e-14);
  ArrowEquations arrow(regular, 5, true);
  const std::array<bool, 9> held{};
  const std::size_t before = linkwright::test::allocations();
  arrow.clear();
  for (std::size_t k = 0; k < 5; ++k) arrow.add_point(k, 1, 1, {1, 2}, {2, 1}, 1, 0);
  arrow.solve(1, held);
  EXPECT_EQ(linkwright::test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::planar
