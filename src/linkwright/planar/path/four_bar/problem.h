// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {

/// The design variables, in the order of the variables of the ten-unknown problem.
enum class FourBarParameter : std::size_t {
  ground,       ///< L1, m
  crank,        ///< L2, m
  coupler,      ///< L3, m
  rocker,       ///< L4, m
  coupler_u,    ///< l1, m
  coupler_v,    ///< l2, m
  pivot_x,      ///< x0, m
  pivot_y,      ///< y0, m
  frame_angle,  ///< theta0, rad
  start_angle   ///< theta2^1, crank angle at the first point, rad
};
/// Number of entries of FourBarParameter.
inline constexpr std::size_t four_bar_parameter_count = 10;

/// The place of a parameter among the variables.
///
/// @param parameter the parameter
/// @returns its index, from 0
constexpr std::size_t index(FourBarParameter parameter) { return static_cast<std::size_t>(parameter); }

/// The key of a parameter without its unit: "ground", ..., "start_angle".
///
/// @param parameter the parameter
/// @returns the key
std::string_view name(FourBarParameter parameter);

/// Test for lengths of links.
///
/// @param p the parameter
/// @returns true if it is the length of a link
constexpr bool is_link(FourBarParameter p) { return p <= FourBarParameter::rocker; }

/// Test for lengths that cannot be negative.
///
/// @param p the parameter
/// @returns true if it cannot be negative
constexpr bool is_length(FourBarParameter p) { return is_link(p); }

/// Test for angles.
///
/// @param p the parameter
/// @returns true if it is an angle
constexpr bool is_angle(FourBarParameter p) { return p >= FourBarParameter::frame_angle; }

/// Rectangle that must hold both fixed pivots, or one of them (metres).
struct PackagingBox {
  double x_min = 0,  ///< left side
      x_max = 0,     ///< right side
      y_min = 0,     ///< lower side
      y_max = 0;     ///< upper side
};

struct FourBarPath;

/// A four-bar is to trace points with its coupler point. Given crank angles are relative to the ground link.
struct PathProblem : PathTask {
  /// The mechanism of the problem.
  using Mechanism = FourBarPath;
  /// Bounds (or fixed values) of the ten parameters; start_angle is used by equal_steps and increments only.
  /// See derive_bounds.
  std::array<Range, four_bar_parameter_count> bounds{};

  bool search_open = true,    ///< searches the open branch
      search_crossed = true;  ///< searches the crossed branch

  double min_transmission_angle = 0;      ///< rad; 0 = no limit
  std::optional<PackagingBox> packaging;  ///< box of both fixed pivots
  /// Box of the rocker pivot B0; sides may be infinite or fall together.
  std::optional<PackagingBox> rocker_pivot;
};

/// Checks a problem.
///
/// @param problem the problem
/// @throws ContractError unless the task is valid, the bounds are ordered and finite, lengths may be
///   positive, the transmission limit lies in [0, pi/2), the packaging box is ordered and finite, and the box
///   of the rocker pivot ordered
void require_valid(const PathProblem& problem);

/// Bounds that follow from the path when the study gives none: see derive_ranges.
///
/// @param x x of the target points (m)
/// @param y y of the target points (m)
/// @returns the bounds in the order of FourBarParameter
std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x,
                                                          const std::vector<double>& y);

/// A design with what it achieves.
using PathDesign = TracedPath<FourBar>;

/// The four-bar as a path mechanism.
struct FourBarPath {
  /// The problem.
  using Problem = PathProblem;
  /// A design with what it achieves.
  using Design = PathDesign;
  /// The mechanism itself.
  using Linkage = FourBar;
  /// Its branches.
  using Branch = planar::Branch;
  /// Its parameters.
  using Parameter = FourBarParameter;
  /// Parts of sentences for messages.
  static constexpr MechanismWords words{
      "four-bar", {"coupler and rocker miss by ", ""}, "at a toggle", "that do not assemble"};
  /// Index of the sense in a checkpoint.
  static constexpr std::size_t kept_sense = 10;
  /// The part of a linkage that has its numbers.
  ///
  /// @param linkage the four-bar
  /// @returns the same four-bar
  static FourBar& form(FourBar& linkage) { return linkage; }
  /// The four-bar of a branch with given parameters; links of length zero become the shortest ones.
  ///
  /// @param branch the branch
  /// @param x the parameters in the order of FourBarParameter
  /// @returns the four-bar
  static FourBar linkage(Branch branch, std::span<const double> x);
  /// The parameters of a design; the start angle is 0 where it is no variable.
  ///
  /// @param problem the problem
  /// @param design the design
  /// @returns the parameters in the order of FourBarParameter
  static std::array<double, four_bar_parameter_count> values(const PathProblem& problem,
                                                             const PathDesign& design);
  /// Each parameter of a four-bar has a meaning. @returns true
  static bool matters(FourBarParameter, std::span<const double>) { return true; }
  /// The coupler point at a crank angle.
  ///
  /// @param linkage the four-bar
  /// @param crank_angle crank angle, from the ground link (rad)
  /// @returns the point (m, global) with its status
  static TracedPoint trace(const FourBar& linkage, double crank_angle);
  /// The margin of the crank to a full turn.
  ///
  /// @param linkage the four-bar
  /// @returns the margin (m)
  static CrankTurn turn(const FourBar& linkage);
  /// The crank angles around one that are reached without taking the four-bar apart.
  ///
  /// @param linkage the four-bar
  /// @param crank_angle crank angle, from the ground link (rad)
  /// @returns the interval, a full turn from `crank_angle` when the crank rotates fully; nothing where it
  ///   does not assemble
  static std::optional<CrankInterval> reach(const FourBar& linkage, double crank_angle);
  /// Test for branches that are searched.
  ///
  /// @param problem the problem
  /// @param branch the branch
  /// @returns true if the branch is searched
  static bool searches(const PathProblem& problem, Branch branch) {
    return branch == Branch::open ? problem.search_open : problem.search_crossed;
  }
  /// Adds violations of the transmission angle, the order of the points, the packaging box and the box of the
  /// rocker pivot.
  ///
  /// @param problem the problem
  /// @param design the design, whose error is known
  static void add_limits(const PathProblem& problem, PathDesign& design);
};

/// Measures a linkage against the problem: error, constraints by name (crank_rotates_fully, no_assembly,
/// transmission_angle, order, packaging, rocker_pivot, bounds), active bounds.
///
/// @param problem the problem
/// @param linkage the four-bar
/// @param sense sense of crank rotation along the order of the points, +1 or -1
/// @param angles crank angle at each target point from the ground link (rad), unwrapped
/// @returns the design with its error and violations
/// @throws ContractError unless the problem is valid and there is one angle for each point
PathDesign measure(const PathProblem& problem, const FourBar& linkage, double sense,
                   std::vector<double> angles);

/// Compares two four-bars.
///
/// @param a a four-bar
/// @param b another
/// @returns true if they are the same within tolerance::same_design of their size; angles follow from the
///   lengths and are not compared
bool same_linkage(const FourBar& a, const FourBar& b);

/// Sorts designs, best first, by the feasibility rules; among equals, as timed cognates are, the open branch
/// first.
///
/// @param designs the designs
void rank(std::vector<PathDesign>& designs);

/// The outcome of one seed of the synthesis of four-bars.
using PathSynthesis = PathAnswer<FourBarPath>;

/// Synthesis of a four-bar for a path by the recommended method. Prescribed and relative timing: the linear
/// unknowns (scale, rotation, position, tracing point) are eliminated (variable projection), full crank
/// rotation holds by construction, and Levenberg-Marquardt with the exact Jacobian runs from many starts.
/// Free timing: see search_free_timing. Where a bound or limit is active, an augmented Lagrangian finishes.
/// When the best design has drawbacks (usability.h), the best one without them is looked for and returned
/// with it.
///
/// @param problem the problem
/// @param options seed, number of starts and of designs
/// @param context progress, deadline, cancellation and threads of the run
/// @returns the designs and the course of the search
/// @throws ContractError as require_valid does, and unless starts >= 0 and max_solutions >= 1
PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options,
                              RunContext& context);

/// A design as a publication prints it, for the path it was made for.
struct PublishedPathDesign {
  std::string label;           ///< source, "Boskovic 2018"
  FourBar linkage;             ///< the four-bar as printed, or corrected
  double start_angle = 0;      ///< rad
  double published_error = 0;  ///< sum of squared distances (m2) as printed
  std::string verdict;         ///< "reproduced", "corrected" or "not reproduced"
  std::string note;            ///< reason for the verdict
};

/// The closed path of 18 points with 20 degree crank steps: Boskovic 2018, Eqs. (4.28)-(4.30), bounds
/// included. The source prints lengths without unit; they are read as metres.
///
/// @returns the problem
PathProblem eighteen_points();

/// The six designs of Boskovic 2018, Table 4.1, branch open, sense +1, and a seventh entry: the design of
/// Cabrera 2007 with its shifted columns corrected. Verdicts from re-evaluation.
///
/// @returns the designs with the errors as printed
std::vector<PublishedPathDesign> eighteen_point_designs();

}  // namespace linkwright::planar
