// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/problem.h"

/// Standard functions with known optima; the boxes are not symmetric, so that a pull to the centre does not
/// help.
namespace linkwright::test {}
namespace linkwright::optimise::test {
using namespace linkwright::test;  // shared by the tests of all modules

struct Value {
  double cost = 0;
  double violation = 0;
};

inline Problem make_problem(std::size_t dimension, double lower, double upper,
                            std::function<Value(std::span<const double>)> f) {
  Problem problem;
  for (std::size_t j = 0; j < dimension; ++j)
    problem.variables.push_back({fmt::format("x{}", j), lower, upper});
  problem.evaluate = [f = std::move(f)](const PopulationView& candidates, std::span<double> cost,
                                        std::span<double> violation) {
    std::vector<double> x(candidates.dimension);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      const Value v = f(x);
      cost[i] = v.cost;
      violation[i] = v.violation;
    }
  };
  return problem;
}

/// 0 at the origin.
inline Problem sphere(std::size_t n) {
  return make_problem(n, -5, 3, [](std::span<const double> x) {
    double sum = 0;
    for (const double v : x) sum += v * v;
    return Value{sum};
  });
}

/// 0 at (1, ..., 1).
inline Problem rosenbrock(std::size_t n) {
  return make_problem(n, -2, 3, [](std::span<const double> x) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
    return Value{sum};
  });
}

/// 0 at the origin, a minimum near every point of whole numbers.
inline Problem rastrigin(std::size_t n) {
  return make_problem(n, -4, 5.12, [](std::span<const double> x) {
    double sum = 0;
    for (const double v : x) sum += v * v + 10 * (1 - std::cos(2 * pi * v));
    return Value{sum};
  });
}

/// 0 at the origin.
inline Problem ackley(std::size_t n) {
  return make_problem(n, -20, 32, [](std::span<const double> x) {
    double squares = 0, cosines = 0;
    for (const double v : x) {
      squares += v * v;
      cosines += std::cos(2 * pi * v);
    }
    const auto count = static_cast<double>(x.size());
    return Value{20 * (1 - std::exp(-0.2 * std::sqrt(squares / count))) + std::numbers::e -
                 std::exp(cosines / count)};
  });
}

/// Problem g06 of Michalewicz and Schoenauer 1996, in its own box: -6961.81388 at (14.095, 0.84296), both
/// constraints active. The feasible part is 0.007 % of the box.
inline Problem g06() {
  Problem problem = make_problem(2, 0, 100, [](std::span<const double> x) {
    const double g1 = -std::pow(x[0] - 5, 2) - std::pow(x[1] - 5, 2) + 100;
    const double g2 = std::pow(x[0] - 6, 2) + std::pow(x[1] - 5, 2) - 82.81;
    return Value{std::pow(x[0] - 10, 3) + std::pow(x[1] - 20, 3), std::max(g1, 0.0) + std::max(g2, 0.0)};
  });
  problem.variables[0].lower = 13;
  return problem;
}

/// Problem of several objectives: f writes them to `costs` and returns the violation.
inline Problem make_problem(std::size_t dimension, double lower, double upper, std::size_t objectives,
                            std::function<double(std::span<const double>, std::span<double>)> f) {
  Problem problem = make_problem(dimension, lower, upper, nullptr);
  problem.objectives = objectives;
  problem.evaluate = [objectives, f = std::move(f)](const PopulationView& candidates, std::span<double> cost,
                                                    std::span<double> violation) {
    std::vector<double> x(candidates.dimension);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      violation[i] = f(x, cost.subspan(i * objectives, objectives));
    }
  };
  return problem;
}

/// Mean squares of the distances from the origin and from (2, ..., 2) (Schaffer 1985, in n variables). The
/// front is on the line between them: sqrt(f1) + sqrt(f2) = 2.
inline Problem schaffer(std::size_t n) {
  return make_problem(n, -5, 3, 2, [](std::span<const double> x, std::span<double> costs) {
    costs[0] = costs[1] = 0;
    for (const double v : x) {
      costs[0] += v * v / static_cast<double>(x.size());
      costs[1] += (v - 2) * (v - 2) / static_cast<double>(x.size());
    }
    return 0.0;
  });
}

/// Binh and Korn 1997, in [0, 5] x [0, 3] taken as a square: two objectives, two constraints.
inline Problem binh_korn() {
  Problem problem = make_problem(2, 0, 5, 2, [](std::span<const double> x, std::span<double> costs) {
    costs[0] = 4 * x[0] * x[0] + 4 * x[1] * x[1];
    costs[1] = std::pow(x[0] - 5, 2) + std::pow(x[1] - 5, 2);
    const double g1 = std::pow(x[0] - 5, 2) + x[1] * x[1] - 25;
    const double g2 = 7.7 - std::pow(x[0] - 8, 2) - std::pow(x[1] + 3, 2);
    return std::max(g1, 0.0) + std::max(g2, 0.0);
  });
  problem.variables[1].upper = 3;
  return problem;
}

/// Keys of the fields of options.
template <class Options>
std::vector<std::string> keys(Options options) {
  std::vector<std::string> found;
  fields([&](const Field& field, auto&) { found.emplace_back(field.key); }, options);
  return found;
}

}  // namespace linkwright::optimise::test
