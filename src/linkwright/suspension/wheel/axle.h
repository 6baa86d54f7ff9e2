// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/suspension/wheel/parameters.h"

/// @file
/// Two wheels of an axle, and the axle in its vehicle.
namespace linkwright::suspension {

/// The roll centre of an axle when both wheels have different positions and travel: where the lines meet that
/// pass through the contact points across their velocities, seen along x.
///
/// @param left parameters of the left wheel
/// @param right parameters of the right wheel
/// @returns (y, z) in the vehicle's frame (m); nothing if the lines are parallel
std::optional<std::array<double, 2>> roll_centre(const WheelParameters& left, const WheelParameters& right);

/// The effect of a small roll of the body towards this wheel (rad per rad): both contact points stay on the
/// road, so this one rises against the body by half the track times the roll, the other one falls.
struct RollGains {
  double toe = 0;  ///< roll steer: change of toe
  /// Change of the camber against the road; 1 = the wheel leans with the body, 0 = it stays upright.
  double camber = 0;
};

/// The effect of a small roll of the body on a wheel.
///
/// @param wheel parameters of the wheel
/// @returns changes of toe and camber by roll (rad/rad)
RollGains roll_gains(const WheelParameters& wheel);

/// The place of an axle in the vehicle.
enum class AxlePlace {
  front,  ///< the front axle
  rear    ///< the rear axle
};
constexpr std::array<EnumName<AxlePlace>, 2> names(AxlePlace) {
  return {{{AxlePlace::front, "front"}, {AxlePlace::rear, "rear"}}};
}

/// The numbers of the vehicle on which the support of braking and driving depends.
struct VehicleLayout {
  double wheelbase = 0;            ///< m, > 0
  double centre_height = 0;        ///< m, mass centre above the ground, > 0
  double front_brake_share = 0.5;  ///< share of the braking force, 0 to 1
  double axle_drive_share = 1;     ///< share of the driving force at this axle, 0 to 1
};

/// Share of the load transfer that the links take instead of the springs, in percent; 100 = the body does not
/// pitch there (from virtual work). Front: anti-dive, and anti-lift under drive. Rear: anti-lift, and
/// anti-squat.
struct AntiFeatures {
  double outboard_brake = 0;  ///< brake torque taken by the carrier
  double inboard_brake = 0;   ///< brake torque taken by the body
  double inboard_drive = 0;   ///< driving torque taken by the body
  /// The first as drawn: by the line from the contact point to the side centre of the arm planes. NaN without
  /// arm planes.
  double outboard_brake_by_arms = nan;
};

/// The support of braking and driving by the links of a wheel.
///
/// @param wheel parameters of the wheel
/// @param place place of its axle
/// @param layout layout of the vehicle
/// @returns shares of the load transfer in percent
/// @throws ContractError unless wheelbase and height are positive and shares lie in 0 to 1
AntiFeatures anti_features(const WheelParameters& wheel, AxlePlace place, const VehicleLayout& layout);

/// The error of the steer angles of both wheels against a common centre of turning on the line of the rear
/// axle.
struct Ackermann {
  /// Angle (rad) by which the inner wheel should turn when the outer one turns by `outer`.
  double ideal_inner = 0;
  double percent = 0;  ///< 100 = ideal, 0 = parallel, negative = the outer wheel turns more
};

/// The error of the steer angles against a common centre of turning. The angles of one wheel alone are its
/// changes of toe at opposite rack displacements.
///
/// @param inner change of the steer angle of the inner wheel from straight ahead (rad, > 0)
/// @param outer change of the steer angle of the outer wheel (rad, > 0)
/// @param wheelbase m, > 0
/// @param track distance that the angles refer to (m, > 0): of the steering axes at the ground, or of the
///   wheels
/// @returns the ideal angle and the percentage
/// @throws ContractError unless wheelbase, track and the outer angle are positive
Ackermann ackermann(double inner, double outer, double wheelbase, double track);

/// The circles of a turn of a vehicle whose front axle steers, about a centre on the line of the rear axle.
struct TurningCircle {
  double kerb_to_kerb = 0;  ///< diameter of the track of the outer front wheel (m)
  /// Diameter of the path of the outer front corner of the body (m). NaN if its overhang or width is unknown.
  double wall_to_wall = nan;
};

/// The turning circles by the steer angle of the outer wheel.
///
/// @param outer change of the steer angle of the outer wheel from straight ahead (rad, > 0)
/// @param wheelbase m, > 0
/// @param axes distance of the steering axes at the ground (m, > 0)
/// @param scrub from the steering axis of the outer wheel at the ground to its contact point, across the
///   wheel (m, > 0 if the contact is outboard)
/// @param overhang of the body ahead of the front axle (m), or NaN
/// @param width of the body (m), or NaN
/// @returns both diameters
/// @throws ContractError unless wheelbase, distance and angle are positive
TurningCircle turning_circle(double outer, double wheelbase, double axes, double scrub, double overhang = nan,
                             double width = nan);

/// The steering parameters of a wheel at a position, while `lock` is held: height of the wheel centre or of
/// the contact, or the spring. Exact, from the steering motion.
///
/// A lever arm is the moment about the steering axis by a unit force, as virtual work over the rate of toe;
/// its sign is that of the toe (for both wheels), and a force the other way turns the other way.
struct SteeringParameters {
  Driver lock = Driver::spring;  ///< coordinate that is held
  double toe_by_rack = 0;        ///< rad/m
  /// rad/m, steer angle about +z, of either wheel > 0 if a rack to the left steers left.
  double steer_by_rack = 0;
  double camber_by_toe = 0;  ///< rad/rad
  /// rad/rad, carrier about the wheel's axis: what caster the wheel's bearing keeps.
  double carrier_pitch_by_toe = 0;
  /// m: force forward at the contact, braked by the carrier (outboard brake): > 0 where braking toes out.
  double brake_arm = 0;
  /// m: force forward at the contact, the wheel free to turn on its carrier (drive shaft, inboard brake).
  double drive_arm = 0;
  double lateral_arm = 0;  ///< m: force outboard at the contact
  /// m: force upward at the contact; also the rise of the contact against the body by toe (m/rad). With the
  /// spring held that is jacking: where the contact rises, the body sinks.
  double load_arm = 0;
  double contact_rise_by_rack = 0;  ///< m/m, the same by rack
};

/// The steering parameters of a wheel.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @param lock coordinate that is held
/// @returns the parameters; nothing for a suspension that no rack moves, at a limit of travel, and where the
///   rack does not turn the wheel
/// @throws ContractError if the spring is to be held and there is none
std::optional<SteeringParameters> steering_parameters(const CornerPlan& plan, const CornerPosition& position,
                                                      Driver lock);

/// Test for steered wheels.
///
/// @param plan the plan of the suspension
/// @returns true if any link of the suspension is on the rack
bool is_steered(const CornerPlan& plan);

/// The ratio of a steering: turn of the steering wheel (with its pinion) by steer angle.
///
/// @param steer_by_rack steer angle by rack (rad/m, either sign)
/// @param rack_per_turn rack travel by a turn of the pinion (m, > 0), the C factor
/// @returns the ratio, > 0
/// @throws ContractError unless rack_per_turn is positive
double steering_ratio(double steer_by_rack, double rack_per_turn);

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
