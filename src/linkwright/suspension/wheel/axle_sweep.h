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

/// Both wheels of an axle over travel, roll and rack.
namespace linkwright::suspension {

struct AxlePlan {
  CornerPlan left, right;
};
/// A symmetric axle from either wheel, and one of two wheels. Throw ContractError as `prepare_suspension`
/// does, and if the wheels are not a left and a right one.
AxlePlan prepare_axle(const Suspension& suspension);
AxlePlan prepare_axle(const Suspension& left, const Suspension& right);

/// Travel of each wheel by the driver (m), and the rack they share (m, to the left).
struct AxleInput {
  Driver driver = Driver::contact_z;
  double left = 0, right = 0;
  double rack = 0;
};

struct AxlePosition {
  Status status = Status::done;  ///< status of the first wheel that is not done
  std::string reason;            ///< empty, or the wheel and its reason
  CornerPosition left, right;
};
AxlePosition reference_position(const AxlePlan& plan);
AxlePosition solve_axle(const AxlePlan& plan, const AxleInput& input, const AxlePosition& start);

/// The body leans by `roll` (rad, > 0 towards the left wheel, which rises against the body: a turn about -x)
/// over a plane road that both contact points touch, their mean height changed by `heave` (m): the
/// contacts differ in height by their track times tan(roll), with the track as it is then.
AxlePosition solve_roll(const AxlePlan& plan, double roll, double heave, double rack,
                        const AxlePosition& start);

/// The parameters of an axle at a position. Angles and rates of a wheel are in `left` and `right`, in the
/// frame of the body; these here take both wheels. Lateral: y of the vehicle, to the left.
struct AxleParameters {
  /// singular: a wheel is at a limit of travel, only angles, track and road are known, the rest is NaN.
  Status status = Status::done;
  WheelParameters left, right;
  double track = 0;         ///< m, between the contact points along y
  double track_change = 0;  ///< m, against the reference
  double road_angle = 0;    ///< rad, of the line through both contacts: > 0 with the left one higher in the
                            ///< body, which leans to the left
  double steer_left = 0, steer_right = 0;  ///< rad about +z, static toe included
  double steer = 0;                        ///< rad, mean of both: as roll steer, > 0 steers to the left
  double road_camber_left = 0, road_camber_right = 0;  ///< rad, against the road
  /// Roll centre (y, z) in the frame of the body (m), nothing where both wheels' lines are parallel; how high
  /// above the road, and how far to the left of the middle between the contacts along it.
  std::optional<std::array<double, 2>> roll_centre;
  double roll_centre_height = WheelParameters::missing, roll_centre_offset = WheelParameters::missing;
  /// By a further roll (rad/rad, as in `solve_roll` with the heave held): of the mean steer angle, of the toe
  /// of each wheel, and of its camber against the road (1 on the left, -1 on the right: leans with the body).
  double roll_steer = WheelParameters::missing;
  double roll_toe_left = WheelParameters::missing, roll_toe_right = WheelParameters::missing;
  double roll_camber_left = WheelParameters::missing, roll_camber_right = WheelParameters::missing;
  /// By the rack with the springs held, or the contact heights of a suspension without; nothing if not
  /// steered.
  std::optional<SteeringParameters> steering_left, steering_right;
};
AxleParameters axle_parameters(const AxlePlan& plan, const AxlePosition& position);

/// Ackermann of both wheels at once, their changes of steer angle counted from `straight`, an axle at rack 0.
struct AxleAckermann {
  double inner = 0, outer = 0;  ///< rad, > 0
  double ideal_inner = 0;       ///< rad
  double error = 0;             ///< rad, inner less ideal
  double percent = 0;           ///< percentage, as in `ackermann`
};
/// Nothing where the wheels do not steer to the same side. `track` (m) as in `ackermann`.
std::optional<AxleAckermann> axle_ackermann(const AxleParameters& straight, const AxleParameters& turned,
                                            double wheelbase, double track);

/// The input of a sweep. Values: travel of both wheels (m, by the driver), roll (rad), rack (m).
enum class AxleMotion { parallel, roll, rack };
constexpr std::array<EnumName<AxleMotion>, 3> names(AxleMotion) {
  return {{{AxleMotion::parallel, "parallel", "both wheels rise equally"},
           {AxleMotion::roll, "roll", "the body leans over a plane road"},
           {AxleMotion::rack, "rack", "the rack moves, travel held"}}};
}

struct AxleRow {
  double value = 0;
  AxlePosition position;
  AxleParameters parameters;  ///< parameters, if the position is done
};
/// Positions along a motion, each followed from the last one that was found, the first from the reference.
/// What does not move is held as in `held`: with `parallel` its rack, with `roll` its rack and the mean of
/// its travels as heave, with `rack` its travels (by its driver). Fewer rows than values when `context` asks
/// to stop.
std::vector<AxleRow> sweep_axle(const AxlePlan& plan, AxleMotion motion, std::span<const double> values,
                                const AxleInput& held = {}, const RunContext* context = nullptr);

}  // namespace linkwright::suspension
