// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/math/dual.h"
#include "linkwright/planar/type_synthesis/detail/link_group.h"
#include "planar/type_synthesis_cases.h"

// Derivatives of the reverse pass against dual numbers that go forward through formulas of their own.
namespace linkwright::planar::gradient_checks {
namespace {

/// A number with its derivatives by all parameters of a machine and, last, by the crank angle.
constexpr int directions = static_cast<int>(max_machine_parameters) + 1, by_angle = directions - 1;
using Number = math::Dual<directions>;

struct Point {
  Number x, y;
};
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(const Point& a, const Point& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
Number square(const Point& a) { return a.x * a.x + a.y * a.y; }

/// All points of a machine and the squared sines of its pair angles, step by step.
struct Pass {
  std::vector<Point> points;
  std::vector<Number> quality;
  Point traced, bar;  ///< in the plane that the machine is placed in

  Pass(const MachineShape& shape, double angle) {
    const PointProgram& program = *shape.program;
    std::vector<Number> x;
    for (std::size_t i = 0; i < shape.x.size(); ++i)
      x.push_back(Number::variable(shape.x[i], static_cast<int>(i)));
    const auto complex_at = [&](int i) {
      return Point{x[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(i + 1)]};
    };
    const auto turned = [&](double ratio) {
      const Number theta = ratio * Number::variable(angle, by_angle);
      return Point{cos(theta), sin(theta)};
    };
    for (const PointStep& step : program.steps) {
      const bool minus = step.sign >= 0 && (shape.signs >> static_cast<unsigned>(step.sign) & 1u) != 0;
      const auto at = static_cast<std::size_t>(step.parameter);
      const auto place = [&](int i) { return points[static_cast<std::size_t>(i)]; };
      Number sine(1.0);
      Point p;
      switch (step.operation) {
        case PointOperation::crank_pin:
          p = turned(1);
          break;
        case PointOperation::ground_on_axis:
          p = {x[at], 0.0};
          break;
        case PointOperation::ground:
          p = complex_at(step.parameter);
          break;
        case PointOperation::crank_plate:
          p = complex_at(step.parameter) * turned(1);
          break;
        case PointOperation::plate:
          p = place(step.first) + complex_at(step.parameter) * (place(step.second) - place(step.first));
          break;
        case PointOperation::pair:
          p = pin(place(step.first), place(step.second), x[at], x[at + 1], minus, sine);
          break;
        case PointOperation::slide: {
          const Number rise = x[at + 1] - place(step.first).y;
          p = {place(step.first).x + sqrt(x[at] * x[at] - rise * rise), x[at + 1]};
          sine = 1 - rise * rise / (x[at] * x[at]);
          break;
        }
        case PointOperation::sleeve: {
          // The rod has the pivot at the distance `offset` to its right: its direction is that to the pivot,
          // turned by the angle whose sine is offset / distance.
          const Point to = Point{x[at], 0.0} - place(step.first);
          const Number distance = sqrt(square(to)), share = x[at + 1] / distance;
          const Number cosine = (minus ? -1.0 : 1.0) * sqrt(1 - share * share);
          p = place(step.first) + Point{to.x / distance, to.y / distance} * Point{cosine, share};
          sine = 1 - (x[at + 1] * x[at + 1] + sleeve_clearance * sleeve_clearance) / square(to);
          break;
        }
        case PointOperation::geared_crank:
          p = complex_at(step.parameter) + complex_at(step.parameter + 2) * turned(program.gear_ratio);
          break;
        case PointOperation::group_point:
          if (static_cast<int>(points.size()) == program.group) solve_group(shape, angle, complex_at);
          p = place(step.first) +
              complex_at(step.parameter) * (link_group::is_on_crank(program, step) ? of_crank : of_ground);
          break;
      }
      points.push_back(p), quality.push_back(sine);
    }
    const PointStep& last = program.steps.back();
    traced = complex_at(program.place()) + complex_at(program.scale()) * points.back();
    bar = complex_at(program.scale()) *
          (points[static_cast<std::size_t>(last.second)] - points[static_cast<std::size_t>(last.first)]);
  }

 private:
  Point of_ground, of_crank;  ///< directions of the two links of a group of four

  /// Newton's method on numbers with derivatives: at its end the derivatives are those of the solution.
  template <class ComplexAt>
  void solve_group(const MachineShape& shape, double angle, const ComplexAt& complex_at) {
    const int first = link_group::first_parameter(*shape.program);
    double a0 = 0, b0 = 0;
    ASSERT_TRUE(link_group::interpolate(link_group::turn_of(*shape.program, shape.x.data()), angle, a0, b0));
    Number a(a0), b(b0);
    const Point ground = points.back(), crank = points.front(), one{1.0, 0.0};
    for (int pass = 0; pass < 8; ++pass) {
      of_ground = {cos(a), sin(a)}, of_crank = {cos(b), sin(b)};
      std::array<Number, 2> residual, by_a, by_b;
      for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Point t = complex_at(first + 2 + 2 * i), s = complex_at(first + 6 + 2 * i);
        const Point on_ground = of_ground * t, on_crank = of_crank * s;
        const Point bar = ground + on_ground - crank - on_crank;
        residual[k] = 0.5 * (square(bar) - square(ground + t - one - s));
        by_a[k] = bar.y * on_ground.x - bar.x * on_ground.y;
        by_b[k] = bar.x * on_crank.y - bar.y * on_crank.x;
      }
      const Number determinant = by_a[0] * by_b[1] - by_a[1] * by_b[0];
      a = a - (residual[0] * by_b[1] - residual[1] * by_b[0]) / determinant;
      b = b - (residual[1] * by_a[0] - residual[0] * by_a[1]) / determinant;
    }
    of_ground = {cos(a), sin(a)}, of_crank = {cos(b), sin(b)};
  }

  /// The intersection of two circles, by the foot of its height on the line of their centres.
  static Point pin(const Point& p, const Point& q, const Number& l1, const Number& l2, bool minus,
                   Number& sine) {
    const Number distance = sqrt(square(q - p));
    const Point along{(q.x - p.x) / distance, (q.y - p.y) / distance};
    const Number foot = 0.5 * (distance + (l1 - l2) * (l1 + l2) / distance);
    const Number height = (minus ? -1.0 : 1.0) * sqrt((l1 - foot) * (l1 + foot));
    const Number area = distance * height / (l1 * l2);  // twice that of the triangle, by both bars
    sine = area * area;
    return p + along * Point{foot, height};
  }
};

constexpr std::array<double, 8> angles{0.1, 0.9, 1.7, 2.6, 3.3, 4.4, 5.2, 6.1},
    nx{1, 0, 0.6, -0.8, 0.28, 0.96, -1, 0.6}, ny{0, 1, 0.8, 0.6, 0.96, -0.28, 0, -0.8},
    na{0.5, -1, 2, 0.1, 1, -0.3, 0.7, 1};

/// Largest difference of `found` from what is `expected`, in units of the largest of them.
template <class Expected>
double difference(const std::vector<double>& found, const Expected& expected) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, std::abs(expected(i)));
    apart = std::max(apart, std::abs(found[i] - expected(i)));
  }
  return largest > 0 ? apart / largest : apart;
}

void expect_the_same(const PointProgram& p, std::uint64_t seed) {
  MachineShape shape = test::some_shape(p, seed);
  const std::size_t n = shape.x.size(), place = n - 4;
  shape.x[place] = 0.3, shape.x[place + 1] = -0.7, shape.x[place + 2] = 0.8, shape.x[place + 3] = 0.5;
  std::array<double, 8> px{}, py{}, tx{}, ty{}, bx{}, by{}, rate{};
  std::vector<double> rows(8 * n);
  CurveTask task{.program = &p,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angles.data(),
                 .count = 8,
                 .px = px.data(),
                 .py = py.data(),
                 .tx = tx.data(),
                 .ty = ty.data()};
  task.bx = bx.data(), task.by = by.data(), task.rate = rate.data();
  task.nx = nx.data(), task.ny = ny.data(), task.rows = rows.data(), task.stride = 8;
  for (const bool with_angle : {false, true}) {
    task.na = with_angle ? na.data() : nullptr;
    compute_curve(task);
    for (std::size_t k = 0; k < 8; ++k) {
      const Pass pass(shape, angles[k]);
      const Number angle = atan2(pass.bar.y, pass.bar.x);
      const auto at = [&](const Number& number) { return number.by[static_cast<std::size_t>(by_angle)]; };
      std::vector<double> row;
      for (std::size_t i = 0; i < n; ++i) row.push_back(rows[8 * i + k]);
      EXPECT_LT(difference(row,
                           [&](std::size_t i) {
                             return nx[k] * pass.traced.x.by[i] + ny[k] * pass.traced.y.by[i] +
                                    (with_angle ? na[k] * angle.by[i] : 0.0);
                           }),
                1e-10)
          << p.name << " at " << angles[k];
      const std::array<double, 3> motion{at(pass.traced.x), at(pass.traced.y), at(angle)};
      EXPECT_LT(difference({tx[k], ty[k], rate[k]}, [&](std::size_t i) { return motion[i]; }), 1e-10)
          << p.name;
      EXPECT_NEAR(px[k], pass.traced.x.value, 1e-10 * (1 + std::abs(px[k]))) << p.name;
      EXPECT_NEAR(py[k], pass.traced.y.value, 1e-10 * (1 + std::abs(py[k]))) << p.name;
    }
  }
  std::vector<double> gradient(n);
  for (std::size_t step = 0; step < p.steps.size(); ++step) {
    const PointOperation operation = p.steps[step].operation;
    if (operation != PointOperation::pair && operation != PointOperation::slide &&
        operation != PointOperation::sleeve)
      continue;
    for (const double angle : angles) {
      const Number expected = Pass(shape, angle).quality[step];
      const double value = quality_gradient(p, shape.x, shape.signs, angle, static_cast<int>(step), gradient);
      EXPECT_NEAR(value, expected.value, 1e-10) << p.name << " step " << step;
      EXPECT_LT(difference(gradient, [&](std::size_t i) { return expected.by[i]; }), 1e-10)
          << p.name << " step " << step << " at " << angle;
    }
  }
}

TEST(MachineGradients, AreThoseOfDualNumbersInEveryFamily) {
  for (const PointProgram* p : test::all_programs())
    for (const std::uint64_t seed : {5U, 6U, 7U}) expect_the_same(*p, seed);
}

// Ten-bars have no programs of their own: they are grown.
TEST(MachineGradients, AreThoseOfDualNumbersOfTenBars) {
  for (const auto& pairs : {std::vector<PairOfBars>{{1, 0}, {1, 3}, {4, 5}, {6, 0}},
                            std::vector<PairOfBars>{{1, 0}, {2, 3}, {5, 1}, {7, 2}}})
    for (const bool second : {false, true}) expect_the_same(program_of_pairs(pairs, second), 8);
}

}  // namespace
}  // namespace linkwright::planar::gradient_checks
