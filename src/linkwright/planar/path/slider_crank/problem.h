// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/slider_crank.h"
#include "linkwright/planar/path/mechanism.h"

// Path synthesis of the slider-crank with an inclined, offset guide: Boskovic 2018, section 4.3.
namespace linkwright::planar {

/// The design variables, in the order of Boskovic 2018, Eqs. (4.12) and (4.31): L2, L3, L4, beta, delta,
/// H (here counted the other way), x_A, y_A, theta2 of the first point.
enum class SliderParameter : std::size_t {
  crank,
  rod,
  point_distance,
  point_angle,
  guide_angle,
  offset,
  pivot_x,
  pivot_y,
  start_angle
};
inline constexpr std::size_t slider_parameter_count = 9;
constexpr std::size_t index(SliderParameter parameter) { return static_cast<std::size_t>(parameter); }
/// Key without unit: "crank", ..., "start_angle".
std::string_view name(SliderParameter parameter);
constexpr bool is_link(SliderParameter p) { return p <= SliderParameter::rod; }
/// True if it cannot be negative.
constexpr bool is_length(SliderParameter p) { return p <= SliderParameter::point_distance; }
constexpr bool is_angle(SliderParameter p) {
  return p == SliderParameter::point_angle || p == SliderParameter::guide_angle ||
         p == SliderParameter::start_angle;
}

struct SliderCrankPath;

/// A slider-crank is to trace points with a point of its rod. Crank angles are measured from the x axis;
/// given ones are increments from a start angle that is fixed at 0.
struct SliderPathProblem : PathTask {
  using Mechanism = SliderCrankPath;
  /// Bounds (or fixed values) of the parameters. Free timing does not use the start angle.
  std::array<Range, slider_parameter_count> bounds{};

  bool search_forward = true,
       search_backward = false;  ///< sides of the slider; backward of guide direction delta and offset h is
                                 ///< forward of delta + pi and -h

  /// rad, greatest angle between rod and guide; pi/2 = no limit. Over the full turn where the crank rotates
  /// fully, else over the arc from the first to the last crank angle.
  double max_pressure_angle = pi / 2;
  /// m, of the slider over a full turn; needs a crank that turns fully.
  Range stroke{0, infinity};
};

/// Throws ContractError unless the task is valid and its timing not `given`, the bounds are ordered, finite
/// and leave lengths positive, the pressure limit lies in (0, pi/2], and the stroke range is ordered, not
/// negative, and asked of a full turn only.
void require_valid(const SliderPathProblem& problem);

/// Bounds that follow from the path when the study gives none: see derive_ranges.
std::array<Range, slider_parameter_count> derive_slider_bounds(const std::vector<double>& x,
                                                               const std::vector<double>& y);

/// The position of a slider-crank. Boskovic 2018, Eqs. (4.7)-(4.11).
struct SliderCrankPose {
  Status status = Status::done;                   ///< done, singular (rod square to the guide) or no_assembly
  double gap = 0;                                 ///< m, by how much the rod is too short to reach the guide
  std::complex<double> crank_pin, slider, point;  ///< A, B, C; B and C are NaN without assembly
  double rod_angle = 0;                           ///< rad, of A->B from the x axis
  double displacement = 0;    ///< m, of the slider along the guide from the foot of the crank pivot, signed
  double pressure_angle = 0;  ///< rad, between rod and guide, [0, pi/2]
};
SliderCrankPose slider_crank_pose(const SliderCrankMechanism& mechanism, double crank_angle);

/// m, over a full turn; NaN when the crank does not rotate fully. Not the "stroke" that Boskovic 2018 prints
/// in Tables 4.2 and 4.3, which is the abscissa of the tracing point at the first crank angle.
double stroke(const SliderCrankForm& form);

/// Rod less crank less |offset| (m): the crank rotates fully if it is not negative.
double rotation_margin(const SliderCrankForm& form);

/// Greatest pressure angle over a full turn (rad); NaN when the crank does not rotate fully.
double greatest_pressure_angle(const SliderCrankForm& form);
/// Greatest |sine| of the pressure angle while the crank goes from `low` to `high` (rad, from the x axis);
/// more than 1 where the rod does not reach the guide on the way.
double greatest_pressure_sine(const SliderCrankForm& form, double low, double high);

/// A design with what it achieves.
struct SliderPathDesign : TracedPath<SliderCrankMechanism> {
  double stroke = 0;  ///< m, see stroke()
};

/// The slider-crank as a path mechanism.
struct SliderCrankPath {
  using Problem = SliderPathProblem;
  using Design = SliderPathDesign;
  using Linkage = SliderCrankMechanism;
  using Branch = SliderSide;
  using Parameter = SliderParameter;
  static constexpr MechanismWords words{"slider-crank",
                                        {"the rod is ", " too short to reach the guide"},
                                        "the rod is square to the guide",
                                        "at which the rod does not reach the guide"};
  static constexpr std::size_t kept_sense = 1;
  static SliderCrankForm& form(SliderCrankMechanism& mechanism) { return mechanism.parameters; }
  static SliderCrankMechanism linkage(SliderSide side, std::span<const double> x);
  static std::array<double, slider_parameter_count> values(const SliderPathProblem& problem,
                                                           const SliderPathDesign& design);
  static bool matters(SliderParameter parameter, std::span<const double> values) {
    return parameter != SliderParameter::point_angle || values[index(SliderParameter::point_distance)] != 0;
  }
  static TracedPoint trace(const SliderCrankMechanism& mechanism, double crank_angle);
  static CrankTurn turn(const SliderCrankMechanism& mechanism);
  static std::optional<CrankInterval> reach(const SliderCrankMechanism& mechanism, double crank_angle);
  static bool searches(const SliderPathProblem& problem, SliderSide side) {
    return side == SliderSide::forward ? problem.search_forward : problem.search_backward;
  }
  static void add_limits(const SliderPathProblem& problem, SliderPathDesign& design);
};

/// Measures a mechanism against the problem: error, stroke, constraints by name (crank_rotates_fully,
/// no_assembly, pressure_angle, stroke, order, bounds), active bounds.
SliderPathDesign measure(const SliderPathProblem& problem, const SliderCrankMechanism& mechanism,
                         double sense, std::vector<double> angles);

/// The same mechanism with the slider ahead of the crank pin: a guide that is turned by half a turn has the
/// opposite offset and the other mode.
SliderCrankMechanism forward_form(SliderCrankMechanism mechanism);

/// True if two mechanisms are the same within tolerance::same_design of their size, whichever way their
/// guides are given.
bool same_linkage(const SliderCrankMechanism& a, const SliderCrankMechanism& b);

/// Best first, by the feasibility rules.
void rank(std::vector<SliderPathDesign>& designs);

/// The other slider-crank that traces the same curve (Roberts; the third one has its pivot at infinity): its
/// crank follows the arm A->C of the original and its rod follows the original's crank, so it turns with the
/// rod angle of the original and its crank rocks where the original's turns fully. Its crank angle is the
/// original's rod angle plus that of the point on the rod. The mode is the one at `crank_angle`. Throws
/// ContractError when the tracing point is the crank pin, which leaves no cognate.
SliderCrankMechanism slider_crank_cognate(const SliderCrankMechanism& mechanism, double crank_angle);

/// Divisors of the two objectives where they are compared: squared size and size of the path.
struct SliderPathScales {
  double error = 1, stroke = 1;
};

/// The nine-unknown problem (eight and a crank angle a point when timing is free) on one side and sense, for
/// population methods; evaluated by SIMD kernels. One objective: sum of squared distances (m2), Boskovic
/// 2018, Eq. (4.14). Two: that and the stroke, Eqs. (4.17)-(4.19) with a stroke that is one, each over its
/// scale.
optimise::Problem path_population_problem(const SliderPathProblem& problem, SliderSide side, double sense);
optimise::Problem slider_path_front_problem(const SliderPathProblem& problem, SliderSide side, double sense,
                                            const SliderPathScales& scales);

constexpr double sign(SliderSide side) { return side == SliderSide::forward ? 1 : -1; }

}  // namespace linkwright::planar
