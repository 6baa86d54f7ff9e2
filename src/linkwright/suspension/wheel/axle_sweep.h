// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/suspension/wheel/axle.h"
#include "linkwright/suspension/wheel/steering.h"

/// @file
/// Both wheels of an axle over travel, roll and rack.
namespace linkwright::suspension {

/// An axle made ready for solving.
struct AxlePlan {
  CornerPlan left,  ///< the left wheel
      right;        ///< the right wheel
};

/// Makes a symmetric axle ready from either of its wheels.
///
/// @param suspension the suspension of one wheel; the other one is its mirror image
/// @returns the plan
/// @throws ContractError as `prepare_suspension` does
AxlePlan prepare_axle(const Suspension& suspension);

/// Makes an axle of two wheels ready.
///
/// @param left the suspension of the left wheel
/// @param right the suspension of the right wheel
/// @returns the plan
/// @throws ContractError as `prepare_suspension` does, and if the wheels are not a left and a right one
AxlePlan prepare_axle(const Suspension& left, const Suspension& right);

/// The prescribed input of an axle.
struct AxleInput {
  Driver driver = Driver::contact_z;  ///< coordinate of the travel of both wheels
  double left = 0,                    ///< travel of the left wheel by the driver, m
      right = 0;                      ///< travel of the right wheel, m
  double rack = 0;                    ///< rack displacement that both share, m, to the left
};

/// The position of an axle.
struct AxlePosition {
  Status status = Status::done;  ///< status of the first wheel that is not done
  std::string reason;            ///< empty, or the wheel and its reason
  CornerPosition left,           ///< of the left wheel
      right;                     ///< of the right wheel
};

/// The position of an axle at the reference input.
///
/// @param plan the plan of the axle
/// @returns the position, with its status
AxlePosition reference_position(const AxlePlan& plan);

/// The position of an axle at an input.
///
/// @param plan the plan of the axle
/// @param input wanted input
/// @param start position from which it is followed; it must be done
/// @returns the position, with its status
/// @throws ContractError as `solve_position` does
AxlePosition solve_axle(const AxlePlan& plan, const AxleInput& input, const AxlePosition& start);

/// The position of an axle whose body leans over a plane road that both contact points touch. The contacts
/// differ in height by their track times tan(roll), with the track as it is then.
///
/// @param plan the plan of the axle
/// @param roll rad, > 0 towards the left wheel, which rises against the body: a turn about -x
/// @param heave change of the mean height of the contacts (m)
/// @param rack rack displacement (m, to the left)
/// @param start position from which it is followed; it must be done
/// @returns the position, with its status
/// @throws ContractError as `solve_position` does, and unless the roll is within 1 rad
AxlePosition solve_roll(const AxlePlan& plan, double roll, double heave, double rack,
                        const AxlePosition& start);

/// The parameters of an axle at a position. Angles and rates of a wheel are in `left` and `right`, in the
/// frame of the body; these here take both wheels. Lateral: y of the vehicle, to the left.
struct AxleParameters {
  /// singular: a wheel is at a limit of travel, only angles, track and road are known, the rest is NaN.
  Status status = Status::done;
  WheelParameters left,     ///< of the left wheel
      right;                ///< of the right wheel
  double track = 0;         ///< m, between the contact points along y
  double track_change = 0;  ///< m, against the reference
  /// Angle of the line through both contacts (rad): > 0 with the left one higher in the body, which leans to
  /// the left.
  double road_angle = 0;
  double steer_left = 0,        ///< rad about +z, static toe included
      steer_right = 0;          ///< rad about +z, static toe included
  double steer = 0;             ///< rad, mean of both: as roll steer, > 0 steers to the left
  double road_camber_left = 0,  ///< rad, against the road
      road_camber_right = 0;    ///< rad, against the road
  /// Roll centre (y, z) in the frame of the body (m); nothing where both wheels' lines are parallel.
  std::optional<std::array<double, 2>> roll_centre;
  /// Height of the roll centre above the road (m).
  double roll_centre_height = WheelParameters::missing,
         roll_centre_offset = WheelParameters::missing;  ///< m, to the left of the middle along the road
  /// Mean steer angle by a further roll (rad/rad, as in `solve_roll` with the heave held).
  double roll_steer = WheelParameters::missing;
  double roll_toe_left = WheelParameters::missing,  ///< toe of the left wheel by roll, rad/rad
      roll_toe_right = WheelParameters::missing;    ///< toe of the right wheel by roll, rad/rad
  /// Camber of the left wheel against the road by roll (rad/rad); 1: it leans with the body.
  double roll_camber_left = WheelParameters::missing,
         roll_camber_right = WheelParameters::missing;  ///< of the right wheel; -1: it leans with the body
  /// Steering of the left wheel by the rack with the springs held, or the contact heights of a suspension
  /// without; nothing if not steered.
  std::optional<SteeringParameters> steering_left,
      steering_right;  ///< steering of the right wheel, likewise
};

/// The parameters of an axle.
///
/// @param plan the plan of the axle
/// @param position position of the axle
/// @returns the parameters, with their status
AxleParameters axle_parameters(const AxlePlan& plan, const AxlePosition& position);

/// Ackermann of both wheels at once.
struct AxleAckermann {
  double inner = 0,        ///< change of the steer angle of the inner wheel, rad, > 0
      outer = 0;           ///< change of that of the outer wheel, rad, > 0
  double ideal_inner = 0;  ///< rad
  double error = 0;        ///< rad, inner less ideal
  double percent = 0;      ///< percentage, as in `ackermann`
};

/// Ackermann of an axle from two of its positions.
///
/// @param straight the axle straight ahead, at rack 0, from which the changes of steer angle count
/// @param turned the axle at another rack displacement
/// @param wheelbase m, > 0
/// @param track distance that the angles refer to (m), as in `ackermann`
/// @returns the angles and the percentage; nothing where the wheels do not steer to the same side
/// @throws ContractError as `ackermann` does
std::optional<AxleAckermann> axle_ackermann(const AxleParameters& straight, const AxleParameters& turned,
                                            double wheelbase, double track);

/// The input of a sweep.
enum class AxleMotion {
  parallel,  ///< both wheels rise equally; values are travels (m, by the driver)
  opposite,  ///< the left wheel rises, the right one falls; values are travels of the left (m, by the driver)
  roll,      ///< the body leans over a plane road; values are rolls (rad)
  rack,      ///< the rack moves, travel held; values are rack displacements (m)
  single     ///< the left wheel alone rises; values are its travels (m, by the driver)
};
constexpr std::array<EnumName<AxleMotion>, 5> names(AxleMotion) {
  return {{{AxleMotion::parallel, "parallel", "both wheels rise equally"},
           {AxleMotion::opposite, "opposite", "the left wheel rises, the right one falls equally"},
           {AxleMotion::roll, "roll", "the body leans over a plane road"},
           {AxleMotion::rack, "rack", "the rack moves, travel held"},
           {AxleMotion::single, "single", "the left wheel alone rises"}}};
}

/// One row of a sweep.
struct AxleRow {
  double value = 0;           ///< value of the input (m or rad)
  AxlePosition position;      ///< position of the axle
  AxleParameters parameters;  ///< parameters, if the position is done
};

/// Positions along a motion, each followed from the last one that was found, the first from the reference.
/// The remaining inputs are held: with `parallel` and `opposite` the rack, with `roll` the rack and the mean
/// of the travels as heave, with `rack` the travels by their driver, with `single` the right wheel and the
/// rack.
///
/// @param plan the plan of the axle
/// @param motion input that moves
/// @param values its values (m or rad)
/// @param held inputs that are held
/// @param context cancellation and deadline; null: none
/// @returns one row a value; fewer when the context asks to stop
/// @throws ContractError if the reference position is not done, and as `solve_axle` and `solve_roll` do
std::vector<AxleRow> sweep_axle(const AxlePlan& plan, AxleMotion motion, std::span<const double> values,
                                const AxleInput& held = {}, const RunContext* context = nullptr);

/// Positions of every heave with every roll and every rack displacement.
struct AxleGrid {
  std::vector<double> heave,  ///< heave of each row (m), as in `solve_roll`
      roll,                   ///< roll of each row (rad), which changes first
      rack;                   ///< rack displacement of each row (m), which changes last
  std::vector<AxleRow> rows;  ///< with the roll as their value
};

/// Solves a grid of positions. Each is followed from its neighbour on the side of zero, so that it does not
/// depend on the spacing.
///
/// @param plan the plan of the axle
/// @param heaves changes of the mean height of the contacts (m), ascending, at least one
/// @param rolls angles as in `solve_roll` (rad), ascending, at least one
/// @param racks rack displacements (m, to the left), ascending, at least one
/// @param context cancellation and deadline; null: none
/// @returns the grid; rows that were solved when the context asks to stop
/// @throws ContractError if the reference position is not done or a list is empty, and as `solve_roll` does
AxleGrid solve_axle_grid(const AxlePlan& plan, std::span<const double> heaves, std::span<const double> rolls,
                         std::span<const double> racks, const RunContext* context = nullptr);

}  // namespace linkwright::suspension
