// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/math/dual.h"
#include "linkwright/math/mixed_dual.h"
#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/wheel/parameters.h"

/// Exact derivatives of the wheel parameters with respect to the numbers of the design and to the inputs, by
/// the implicit function theorem: one Newton step in dual numbers at the position, one dual solve for the
/// motions.
namespace linkwright::suspension {

/// Numbers taken together in one pass.
inline constexpr int derivative_width = 4;

/// A suspension and the numbers that derivatives are asked for. Make it with `prepare_derivatives`.
struct DerivativePlan {
  CornerPlan plan;
  std::vector<DesignNumber> numbers;
  std::vector<BasicCornerPlan<math::Dual<derivative_width>>> passes;
  BasicCornerPlan<math::Dual<derivative_width>> inputs;
};
/// Throws ContractError as `prepare_suspension` does, and for numbers that the suspension does not have.
DerivativePlan prepare_derivatives(const Suspension& suspension, std::vector<DesignNumber> numbers);

struct WheelDerivatives {
  /// singular: at a limit of travel nothing has a derivative, and `by` has NaN.
  Status status = Status::done;
  WheelParameters parameters;
  /// [number]: every member is the derivative of the parameter of that name, the driver's value and the rack
  /// held; NaN where the parameter is.
  std::vector<WheelParameters> by;
  /// [number]: how the carrier (and the arm) moves with it, as rates of a motion.
  std::vector<Twist> shift;
};
/// At a position of `plan.plan`.
WheelDerivatives wheel_derivatives(const DerivativePlan& plan, const CornerPosition& position,
                                   Extent extent = Extent::all);

/// Derivatives of every parameter along the motions, second derivatives of the position where the parameter
/// is a rate: of `motion_ratio` by travel follows the wheel rate.
struct InputDerivatives {
  Status status = Status::done;  ///< status, as in WheelDerivatives
  WheelParameters parameters;
  WheelParameters by_travel;  ///< per metre of wheel-centre height, the rack held
  WheelParameters by_rack;    ///< per metre of rack, the height of the wheel centre held
};
InputDerivatives input_derivatives(const DerivativePlan& plan, const CornerPosition& position);

/// A length (m) or an angle (rad) along the travel of the wheel, the rack held.
struct TravelRates {
  double value = WheelParameters::missing;      ///< length or angle
  double ratio = WheelParameters::missing;      ///< by travel: i = dl/dz, longer positive; m/m or rad/m
  double by_travel = WheelParameters::missing;  ///< di/dz, 1/m or rad/m2
};

/// What the parts beside the carrier do along the travel.
struct CornerMotions {
  Status status = Status::done;       ///< singular: at a limit of travel; no number is known
  std::vector<TravelRates> rockers,   ///< angle of each rocker
      elements;                       ///< length or angle of each element
  std::optional<TravelRates> spring;  ///< length of the spring
  /// Coordinates (m) of the moving end of each element that reaches across the vehicle, in their order.
  std::vector<std::array<TravelRates, 3>> ends_across;
  /// Coordinates (m) of the end of each rocker's rod on the part that drives it.
  std::vector<std::array<TravelRates, 3>> rod_ends;
};

/// The motions of rockers, spring and elements at a position: l, dl/dz and d2l/dz2 by implicit
/// differentiation in dual numbers, J x = b and J x' = -J' x for the motion x along the travel.
///
/// @param plan the plan, made without or with design numbers
/// @param position a position of `plan.plan`
/// @param travel coordinate z that the rates refer to; not the spring
/// @returns the motions; singular where the wheel has no motion along its travel
CornerMotions corner_motions(const DerivativePlan& plan, const CornerPosition& position,
                             Driver travel = Driver::wheel_centre_z);

/// Lengths and angles along the travel of the wheel, or derivatives of them by a number of the design.
struct MotionRates {
  std::vector<TravelRates> rockers,  ///< angle of each rocker
      elements;                      ///< length or angle of each element
  TravelRates spring;                ///< length of the spring; NaN without one
  double spring_drawn = 0;           ///< length of the spring as drawn, m
};

/// A suspension and the numbers that derivatives of its motions are asked for. Make it with
/// `prepare_motions`.
struct MotionPlan {
  CornerPlan plan;                                                         ///< the suspension in numbers
  std::size_t numbers = 0;                                                 ///< how many numbers of the design
  std::vector<BasicCornerPlan<math::MixedDual<derivative_width>>> passes;  ///< some of the numbers each
};

/// Makes a suspension ready for derivatives of its motions.
///
/// @param suspension the suspension
/// @param numbers numbers of the design; may be none
/// @returns the plan
/// @throws ContractError as `prepare_derivatives` does
MotionPlan prepare_motions(const Suspension& suspension, std::span<const DesignNumber> numbers);

/// The motions at a position and their derivatives.
struct MotionDerivatives {
  Status status = Status::done;  ///< singular where the wheel has no motion along its travel
  MotionRates motions;           ///< what `corner_motions` has
  std::vector<MotionRates>
      by;  ///< [number]: derivatives, the value of the position's driver and the rack held
};

/// Motions along the travel with their derivatives by numbers of the design: the mixed third derivatives of
/// the position by travel, travel and number among them, exact by implicit differentiation.
///
/// @param plan the plan
/// @param position a position of `plan.plan`
/// @param travel coordinate that the rates refer to; not the spring
/// @returns motions and derivatives
MotionDerivatives motion_derivatives(const MotionPlan& plan, const CornerPosition& position,
                                     Driver travel = Driver::wheel_centre_z);

}  // namespace linkwright::suspension
