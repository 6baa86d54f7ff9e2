// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "support/published.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // what the tests of all modules share

using linkwright::test::at;
using linkwright::test::number_at;
using linkwright::test::numbers;

inline const Value& path_case(std::string_view id) {
  return linkwright::test::published_case("path-synthesis.json", id);
}

inline FourBar four_bar(const Value& design, Branch branch = Branch::open) {
  const auto value = [&](std::string_view key) {
    return design.find(key) ? design.find(key)->as_number() : 0.0;
  };
  if (const Value* b = design.find("branch")) branch = b->as_number() > 0 ? Branch::open : Branch::crossed;
  return {.ground = value("L1_m"),
          .crank = value("L2_m"),
          .coupler = value("L3_m"),
          .rocker = value("L4_m"),
          .coupler_u = value("l1_m"),
          .coupler_v = value("l2_m"),
          .pivot_x = value("x0_m"),
          .pivot_y = value("y0_m"),
          .frame_angle = value("theta0_rad"),
          .branch = branch};
}

inline void set_points(PathProblem& problem, const Value& points) {
  for (const Value& point : points.as_array()) {
    problem.x.push_back(point.as_array()[0].as_number());
    problem.y.push_back(point.as_array()[1].as_number());
  }
}

inline void set_bounds(PathProblem& problem, double link_low, double link_high, double others) {
  problem.bounds = derive_bounds(problem.x, problem.y);
  for (std::size_t j = 0; j < 8; ++j)
    problem.bounds[j] = j < 4 ? Range{link_low, link_high} : Range{-others, others};
}

/// Boskovic 2018, Eqs. (4.28)-(4.30): 18 points, 20 degree steps, published bounds.
inline PathProblem printed_eighteen_points() {
  PathProblem problem;
  set_points(problem, at(path_case("T4.1-Boskovic2018"), "inputs.target_points_m"));
  problem.timing = Timing::equal_steps;
  problem.step = number_at(path_case("T4.1-Boskovic2018"), "inputs.theta2_step_rad");
  set_bounds(problem, 0, 50, 50);
  return problem;
}

/// For comparisons of bits, not of values.
inline std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> out;
  for (const double v : values) out.push_back(std::bit_cast<std::uint64_t>(v));
  return out;
}

inline double sum_of_squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return sum;
}

/// What restored() says about a seed's kept value after a change; "none" when it takes it.
template <class Problem, class Change>
std::string refusal(Value kept, const Problem& problem, Change&& change) {
  change(kept);
  try {
    restored(kept, problem, "seed 3");
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "none";
}
/// The same with one number of its first design changed.
template <class Problem>
std::string refusal_of_number(const Value& kept, const Problem& problem, std::size_t index, double number) {
  return refusal(kept, problem, [&](Value& v) {
    Value& design = v["designs"].as_array()[0];
    std::vector<double> numbers = unpack_numbers(design, "test");
    numbers[index] = number;
    design = pack_numbers(numbers);
  });
}

}  // namespace linkwright::planar::test
