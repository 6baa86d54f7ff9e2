#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/targets.h"

namespace linkwright::planar {

/// How the crank angle is tied to the target points.
enum class Timing {
  free,         ///< each point is met at any crank angle, in the order of the points
  equal_steps,  ///< crank angle of point i = start angle + i step
  increments,   ///< crank angle of a point = that of the one before + its increment, from the start angle
  given,        ///< crank angle of each point is given
};
constexpr std::array<EnumName<Timing>, 4> names(Timing) {
  return {{{Timing::free, "free", "each point is met at any crank angle, in order"},
           {Timing::equal_steps, "equal_steps", "crank angle of point i = start angle + i step"},
           {Timing::increments, "increments",
            "crank angle of a point = that of the one before + its increment, from the start angle"},
           {Timing::given, "given", "the crank angle of each point is given"}}};
}
/// Whether the crank angles are known but for the start angle, which is then a design variable.
constexpr bool starts_anywhere(Timing t) { return t == Timing::equal_steps || t == Timing::increments; }

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

/// Rectangle that must hold both fixed pivots, or one of them (metres).
struct PackagingBox {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

/// A four-bar is to trace points with its coupler point.
struct PathProblem : PathTargets {
  Timing timing = Timing::free;
  double least_step = 1e-4;  ///< crank rotation that free timing keeps between two points (rad, > 0)
  double step = 0;           ///< rad, equal_steps
  /// rad, one a point; given: relative to the ground link, increments: from the first point, 0 there
  std::vector<double> angles;

  /// Bounds (or fixed values) of the ten parameters; start_angle is used by equal_steps and increments only.
  /// See derive_bounds.
  std::array<Range, four_bar_parameter_count> bounds{};

  bool search_open = true, search_crossed = true;  ///< branches to search
  bool search_positive = true,
       search_negative = false;  ///< senses of crank rotation: +1 = the signs of step and angles as given

  bool crank_rotates_fully = true;
  double min_transmission_angle = 0;      ///< rad; 0 = no limit
  std::optional<PackagingBox> packaging;  ///< of both fixed pivots
  std::optional<PackagingBox>
      rocker_pivot;  ///< of the rocker pivot B0; sides may be infinite or fall together
};

/// Keys of the parameters without unit, in their order: "ground", ..., "start_angle".
std::string_view name(FourBarParameter parameter);

/// Throws ContractError unless the targets are valid (and there are as many angles when they are given), the
/// bounds are ordered and finite, lengths may be positive, the transmission limit lies in [0, pi/2), the
/// packaging box is ordered and finite, and the box of the rocker pivot ordered.
void require_valid(const PathProblem& problem);

/// Bounds that follow from the path when the study gives none: links from 1/1000 to 50 times the size of the
/// path (its bounding-box diagonal), pivots and coupler point up to 50 times as far from its middle, angles
/// over a full turn.
std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x,
                                                          const std::vector<double>& y);

/// Crank angle (rad) of point k before the start angle is added and for sense +1: 0 when timing is free.
double point_angle(const PathProblem& problem, std::size_t k);

/// A design with what it achieves.
struct PathDesign {
  FourBar linkage;
  double sense = 1;  ///< +1 or -1: sense of crank rotation along the order of the points
  std::vector<double>
      angles;        ///< crank angle at each target point (rad), unwrapped in the order of the points
  double error = 0;  ///< sum of squared distances (m2), Boskovic 2018 Eq. (4.4), from gates where targets are
                     ///< gates, and beyond the tolerances; infinite when the coupler point does not exist at
                     ///< a target
  std::vector<optimise::Violation> violations;  ///< of the constraints of the problem; empty = feasible
  std::vector<std::string> active_bounds;       ///< names of parameters at a bound
};

/// Measures a linkage against the problem: error, constraints by name (crank_rotates_fully, no_assembly,
/// transmission_angle, order, packaging, rocker_pivot, bounds), active bounds.
PathDesign measure(const PathProblem& problem, const FourBar& linkage, double sense,
                   std::vector<double> angles);

/// Sum of its violations; 0 = feasible.
double total_violation(const PathDesign& design);

/// Whether two linkages are the same within tolerance::same_design of their size; angles follow from the
/// lengths and are not compared.
bool same_linkage(const FourBar& a, const FourBar& b);

/// Best first, by the feasibility rules; among equals, as timed cognates are, the open branch first.
void rank(std::vector<PathDesign>& designs);

PathErrors path_errors(const PathProblem& problem, const PathDesign& design);

/// The ten-unknown problem (nine when the angles are given; 9 + points when timing is free, then every crank
/// angle is an unknown) on one branch and sense, for population methods; cost = sum of squared distances
/// (m2), evaluated by SIMD kernels. Boskovic 2018, Eqs. (4.2)-(4.4).
optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense);
/// Turns a candidate of that problem into a design.
PathDesign path_design(const PathProblem& problem, Branch branch, double sense, std::span<const double> x);

}  // namespace linkwright::planar
