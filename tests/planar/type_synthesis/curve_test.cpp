// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

struct Rows {
  std::vector<double> x = std::vector<double>(8), y = std::vector<double>(8), tx = std::vector<double>(8),
                      ty = std::vector<double>(8), quality = std::vector<double>(8),
                      worst = std::vector<double>(8), rows;
};

constexpr std::array<double, 8> angles{0.1, 0.9, 1.7, 2.6, 3.3, 4.4, 5.2, 6.1};
constexpr std::array<double, 8> nx{1, 0, 0.6, -0.8, 0.28, 0.96, -1, 0.6},
    ny{0, 1, 0.8, 0.6, 0.96, -0.28, 0, -0.8};

Rows rows_of(const MachineShape& shape, const CurveKernel& kernel, const std::array<double, 8>& at = angles) {
  Rows out;
  out.rows.resize(8 * shape.x.size());
  kernel.curve({.program = shape.program,
                .x = shape.x.data(),
                .signs = shape.signs,
                .angle = at.data(),
                .count = 8,
                .px = out.x.data(),
                .py = out.y.data(),
                .tx = out.tx.data(),
                .ty = out.ty.data(),
                .quality = out.quality.data(),
                .worst = out.worst.data(),
                .nx = nx.data(),
                .ny = ny.data(),
                .rows = out.rows.data(),
                .stride = 8});
  return out;
}

/// Central difference of sixth order.
template <class Value>
double difference(const Value& value, double step) {
  return (45 * (value(step) - value(-step)) - 9 * (value(2 * step) - value(-2 * step)) +
          (value(3 * step) - value(-3 * step))) /
         (60 * step);
}

TEST(MachineCurves, HaveTheDerivativesOfTheirDifferences) {
  const CurveKernel& kernel = *widest_of<machine_curve_kernels>().run;
  for (const PointProgram* p : test::all_programs()) {
    MachineShape shape = test::some_shape(*p, 5);
    const std::size_t scale = shape.x.size() - 2;
    shape.x[scale - 2] = 0.3, shape.x[scale - 1] = -0.7, shape.x[scale] = 0.8, shape.x[scale + 1] = 0.5;
    const Rows at = rows_of(shape, kernel);
    std::vector<double> gradient(shape.x.size());
    for (std::size_t i = 0; i < shape.x.size(); ++i)
      for (std::size_t k = 0; k < 8; ++k) {
        const auto moved = [&](double by) {
          MachineShape other = shape;
          other.x[i] += by;
          return rows_of(other, kernel);
        };
        const double step = 1e-3 * std::max(0.1, std::abs(shape.x[i]));
        const double along = difference(
            [&](double by) {
              const Rows r = moved(by);
              return nx[k] * r.x[k] + ny[k] * r.y[k];
            },
            step);
        EXPECT_NEAR(at.rows[8 * i + k], along, 2e-8 * (1 + std::abs(along))) << p->name << " parameter " << i;
        const double value =
            quality_gradient(*p, shape.x, shape.signs, angles[k], static_cast<int>(at.worst[k]), gradient);
        EXPECT_NEAR(value, at.quality[k], 1e-12);
        const double slope = difference(
            [&](double by) {
              MachineShape other = shape;
              other.x[i] += by;
              std::vector<double> unused(shape.x.size());
              return quality_gradient(*p, other.x, shape.signs, angles[k], static_cast<int>(at.worst[k]),
                                      unused);
            },
            step);
        EXPECT_NEAR(gradient[i], slope, 2e-8 * (1 + std::abs(slope))) << p->name << " parameter " << i;
      }
    for (std::size_t k = 0; k < 8; ++k) {
      const auto turned = [&](double by, bool imaginary) {
        std::array<double, 8> moved = angles;
        moved[k] += by;
        const Rows r = rows_of(shape, kernel, moved);
        return imaginary ? r.y[k] : r.x[k];
      };
      EXPECT_NEAR(at.tx[k], difference([&](double by) { return turned(by, false); }, 1e-3),
                  1e-8 * (1 + std::abs(at.tx[k])))
          << p->name;
      EXPECT_NEAR(at.ty[k], difference([&](double by) { return turned(by, true); }, 1e-3),
                  1e-8 * (1 + std::abs(at.ty[k])))
          << p->name;
    }
  }
}

/// Angle of the traced bar and its derivatives.
struct BarRows {
  std::array<double, 8> x{}, y{}, tx{}, ty{}, bx{}, by{}, rate{};
  std::vector<double> rows;
};

BarRows bar_rows_of(const MachineShape& shape, const std::array<double, 8>& at = angles) {
  static constexpr std::array<double, 8> none{}, one{1, 1, 1, 1, 1, 1, 1, 1};
  BarRows out;
  out.rows.resize(8 * shape.x.size());
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = at.data(),
                 .count = 8,
                 .px = out.x.data(),
                 .py = out.y.data(),
                 .tx = out.tx.data(),
                 .ty = out.ty.data(),
                 .bx = out.bx.data(),
                 .by = out.by.data(),
                 .rate = out.rate.data(),
                 .nx = none.data(),
                 .ny = none.data(),
                 .na = one.data(),
                 .rows = out.rows.data(),
                 .stride = 8});
  return out;
}

TEST(MachineCurves, HaveTheDerivativesOfTheAngleOfTheTracedBar) {
  for (const PointProgram* p : test::all_programs()) {
    MachineShape shape = test::some_shape(*p, 5);
    const std::size_t scale = shape.x.size() - 2;
    shape.x[scale] = 0.8, shape.x[scale + 1] = 0.5;
    const BarRows at = bar_rows_of(shape);
    const auto turned = [&](const BarRows& moved, std::size_t k) {
      return std::arg(std::complex<double>(moved.bx[k], moved.by[k]) /
                      std::complex<double>(at.bx[k], at.by[k]));
    };
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t i = 0; i < shape.x.size(); ++i) {
        const double along = difference(
            [&](double by) {
              MachineShape other = shape;
              other.x[i] += by;
              return turned(bar_rows_of(other), k);
            },
            1e-3 * std::max(0.1, std::abs(shape.x[i])));
        EXPECT_NEAR(at.rows[8 * i + k], along, 3e-8 * (1 + std::abs(along))) << p->name << " parameter " << i;
      }
      const double rate = difference(
          [&](double by) {
            std::array<double, 8> moved = angles;
            moved[k] += by;
            return turned(bar_rows_of(shape, moved), k);
          },
          1e-3);
      EXPECT_NEAR(at.rate[k], rate, 1e-8 * (1 + std::abs(rate))) << p->name;
    }
  }
}

TEST(MachineCurves, AreTheSameWithAllRegisters) {
  for (const PointProgram* p : test::all_programs()) {
    const MachineShape shape = test::some_shape(*p, 7);
    const auto kernels = runnable(machine_curve_kernels());
    const Rows first = rows_of(shape, *kernels[0].run);
    for (const auto& kernel : kernels) {
      const Rows other = rows_of(shape, *kernel.run);
      for (std::size_t i = 0; i < first.rows.size(); ++i)
        EXPECT_NEAR(first.rows[i], other.rows[i], 1e-9 * (1 + std::abs(first.rows[i])))
            << p->name << ' ' << kernel.name;
      for (std::size_t k = 0; k < 8; ++k)
        EXPECT_NEAR(first.x[k], other.x[k], 1e-11 * (1 + std::abs(first.x[k])))
            << p->name << ' ' << kernel.name;
    }
  }
}

TEST(MachineCurves, SumProductsOfRows) {
  std::vector<double> rows(5 * 16);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = std::sin(static_cast<double>(3 * i + 1));
  for (const auto& kernel : runnable(machine_curve_kernels())) {
    std::vector<double> out(15);
    kernel.run->products({.rows = rows.data(), .stride = 16, .count = 16, .columns = 5, .out = out.data()});
    std::size_t at = 0;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < 16; ++k) sum += rows[16 * i + k] * rows[16 * j + k];
        EXPECT_NEAR(out[at++], sum, 1e-13) << kernel.name;
      }
  }
}

}  // namespace
}  // namespace linkwright::planar
