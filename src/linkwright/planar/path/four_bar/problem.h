// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/mechanism.h"

namespace linkwright::planar {

/// The design variables, in the order of the variables of the ten-unknown problem.
enum class FourBarParameter : std::size_t {
  ground,
  crank,
  coupler,
  rocker,
  coupler_u,
  coupler_v,
  pivot_x,
  pivot_y,
  frame_angle,
  start_angle
};
inline constexpr std::size_t four_bar_parameter_count = 10;
constexpr std::size_t index(FourBarParameter parameter) { return static_cast<std::size_t>(parameter); }
/// Key without unit: "ground", ..., "start_angle".
std::string_view name(FourBarParameter parameter);
constexpr bool is_link(FourBarParameter p) { return p <= FourBarParameter::rocker; }
/// True if it cannot be negative.
constexpr bool is_length(FourBarParameter p) { return is_link(p); }
constexpr bool is_angle(FourBarParameter p) { return p >= FourBarParameter::frame_angle; }

/// Rectangle that must hold both fixed pivots, or one of them (metres).
struct PackagingBox {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

struct FourBarPath;

/// A four-bar is to trace points with its coupler point. Given crank angles are relative to the ground link.
struct PathProblem : PathTask {
  using Mechanism = FourBarPath;
  /// Bounds (or fixed values) of the ten parameters; start_angle is used by equal_steps and increments only.
  /// See derive_bounds.
  std::array<Range, four_bar_parameter_count> bounds{};

  bool search_open = true, search_crossed = true;  ///< branches to search

  double min_transmission_angle = 0;      ///< rad; 0 = no limit
  std::optional<PackagingBox> packaging;  ///< box of both fixed pivots
  /// Box of the rocker pivot B0; sides may be infinite or fall together.
  std::optional<PackagingBox> rocker_pivot;
};

/// Throws ContractError unless the task is valid, the bounds are ordered and finite, lengths may be positive,
/// the transmission limit lies in [0, pi/2), the packaging box is ordered and finite, and the box of the
/// rocker pivot ordered.
void require_valid(const PathProblem& problem);

/// Bounds that follow from the path when the study gives none: see derive_ranges.
std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x,
                                                          const std::vector<double>& y);

/// A design with what it achieves.
using PathDesign = TracedPath<FourBar>;

/// The four-bar as a path mechanism.
struct FourBarPath {
  using Problem = PathProblem;
  using Design = PathDesign;
  using Linkage = FourBar;
  using Branch = planar::Branch;
  using Parameter = FourBarParameter;
  static constexpr MechanismWords words{
      "four-bar", {"coupler and rocker miss by ", ""}, "at a toggle", "that do not assemble"};
  static constexpr std::size_t kept_sense = 10;
  static FourBar& form(FourBar& linkage) { return linkage; }
  static FourBar linkage(Branch branch, std::span<const double> x);
  static std::array<double, four_bar_parameter_count> values(const PathProblem& problem,
                                                             const PathDesign& design);
  static bool matters(FourBarParameter, std::span<const double>) { return true; }
  static TracedPoint trace(const FourBar& linkage, double crank_angle);
  static CrankTurn turn(const FourBar& linkage);
  static std::optional<CrankInterval> reach(const FourBar& linkage, double crank_angle);
  static bool searches(const PathProblem& problem, Branch branch) {
    return branch == Branch::open ? problem.search_open : problem.search_crossed;
  }
  static void add_limits(const PathProblem& problem, PathDesign& design);
};

/// Measures a linkage against the problem: error, constraints by name (crank_rotates_fully, no_assembly,
/// transmission_angle, order, packaging, rocker_pivot, bounds), active bounds.
PathDesign measure(const PathProblem& problem, const FourBar& linkage, double sense,
                   std::vector<double> angles);

/// True if two linkages are the same within tolerance::same_design of their size; angles follow from the
/// lengths and are not compared.
bool same_linkage(const FourBar& a, const FourBar& b);

/// Best first, by the feasibility rules; among equals, as timed cognates are, the open branch first.
void rank(std::vector<PathDesign>& designs);

/// The ten-unknown problem (nine when the angles are given; 9 + points when timing is free, then every crank
/// angle is an unknown) on one branch and sense, for population methods; cost = sum of squared distances
/// (m2), evaluated by SIMD kernels. Boskovic 2018, Eqs. (4.2)-(4.4).
optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense);

}  // namespace linkwright::planar
