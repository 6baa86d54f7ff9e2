// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <string_view>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "support/published.h"

namespace linkwright::planar::test {

inline const Value& exact_case(std::string_view id) {
  return linkwright::test::published_case("exact-path-synthesis.json", id);
}

inline std::vector<std::complex<double>> places(const Value& points) {
  std::vector<std::complex<double>> out;
  for (const Value& point : points.as_array())
    out.emplace_back(point.as_array()[0].as_number(), point.as_array()[1].as_number());
  return out;
}
/// The points of a case (m).
inline std::vector<std::complex<double>> exact_points(std::string_view id) {
  return places(linkwright::test::at(exact_case(id), "inputs.points_m"));
}

/// The folder in which tests keep the start set of nine points, which takes seconds to find and is the same
/// in each of them.
inline std::filesystem::path starts_folder() {
  return std::filesystem::path(testing::TempDir()) / "linkwright-nine-point-starts";
}

/// Any crank and any timing, open.
inline PathProblem exact_problem(const std::vector<std::complex<double>>& points) {
  PathProblem problem;
  for (const auto& point : points) problem.x.push_back(point.real()), problem.y.push_back(point.imag());
  problem.closed = false;
  problem.crank_rotates_fully = false;
  problem.bounds = derive_bounds(problem.x, problem.y);
  return problem;
}

}  // namespace linkwright::planar::test
