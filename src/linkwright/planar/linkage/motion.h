// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/plan.h"

namespace linkwright::planar {

/// Motion of a part: its origin and the direction of its x axis, and how they move. Global frame, SI.
template <class T>
struct PartState {
  math::Vector2<T> origin,        ///< m, global
      direction;                  ///< direction of the x axis, unit vector
  math::Vector2<T> velocity;      ///< velocity of the origin, m/s
  T speed;                        ///< rad/s, counter-clockwise positive
  math::Vector2<T> acceleration;  ///< acceleration of the origin, m/s2
  T angular_acceleration;         ///< rad/s2
};

/// The state of a group's closure.
template <class T>
struct GroupState {
  /// Radicand of a dyad with two modes, in m2 (RRP, RPR) or m4 (RRR): negative = it cannot be assembled, zero
  /// = the modes meet.
  T radicand;
  /// Determinant of the 2 x 2 equations over the product of the columns' lengths: the sine of the
  /// transmission angle of an RRR dyad. Zero = dead point.
  T sine;
  math::Vector2<T> reference;  ///< reference point R of the closure, global, m
  math::Vector2<T> column_x,   ///< displacement of R by a unit of the one joint
      column_y;                ///< displacement of R by a unit of the other
  T inverse;                   ///< 1 / cross(column_x, column_y)
  T rate_x,                    ///< rate of the joint of column_x
      rate_y,                  ///< rate of the joint of column_y
      rate_zero;               ///< rate of the third joint
};

/// Force and its moment about a point that is named beside it.
template <class T>
struct Wrench {
  math::Vector2<T> force;  ///< N, global
  T moment;                ///< N m
};

/// The memory of a group that is solved by a matrix.
struct GeneralGroupMemory;

/// Deletes the memory of a group.
struct GeneralGroupDelete {
  /// Deletes the memory.
  ///
  /// @param memory the memory, or null
  void operator()(GeneralGroupMemory* memory) const;
};
/// The owner of the memory of a group.
using GeneralGroupPointer = std::unique_ptr<GeneralGroupMemory, GeneralGroupDelete>;

/// Motion of a linkage at one instant, and the memory to compute it: make one a thread with its plan and use
/// it again and again; nothing is allocated after the first use. General groups start their search from the
/// positions that are in it.
class LinkageMotion {
 public:
  /// Memory for a plan, in the assembly modes of the plan and before the first position.
  ///
  /// @param plan the plan; it need not outlive the motion
  explicit LinkageMotion(const LinkagePlan& plan);

  /// done; no_assembly or singular (dead point) at `failed_group`, from which on nothing is known;
  /// not_converged as well for a general group.
  Status status = Status::done;
  int failed_group = -1;  ///< index of the group in the plan; -1 if none failed
  /// Length (m) by which the bodies of the failed group are too short or too long to close; 0 when assembled.
  double gap = 0;
  /// Largest distance (m) between the points that joints hold together, over the groups placed: what
  /// rounding, or Newton's method, left.
  double closure_residual = 0;
  /// State of each part; NaN where not known, but parts of general groups stay where they were, for the next
  /// search.
  std::vector<PartState<double>> parts;
  std::vector<GroupState<double>> groups;  ///< one a group
  /// Sign of the assembly mode in use, one a group: those of the plan unless changed.
  std::vector<double> modes;
  std::vector<GeneralGroupPointer> general;  ///< states of groups with a matrix, else null
  std::vector<double> twists;  ///< rad, one a torsion spring, see PlanTwist; NaN before the first position
  /// Angles with their turns (rad) of the parts that loops turn and gears follow, see DrivenAngle::shares;
  /// one a part, NaN before the first position and of other parts.
  std::vector<double> loop_angles;
};

/// A point of a body in the global frame: where it is and how it moves.
struct PointMotion {
  math::Vec2 position,  ///< global, m
      velocity,         ///< m/s
      acceleration;     ///< m/s2
};

/// The motion of a point of a body.
///
/// @param plan the plan of the linkage
/// @param motion the motion
/// @param body index of the body
/// @param at the point in the frame of the body (m)
/// @returns its motion in the global frame
PointMotion point_motion(const LinkagePlan& plan, const LinkageMotion& motion, int body,
                         std::complex<double> at);

/// The frame of a body: origin and direction of its x axis, speeds and accelerations.
///
/// @param plan the plan of the linkage
/// @param motion the motion
/// @param body index of the body
/// @returns origin, direction and rates of its frame, global
PartState<double> body_state(const LinkagePlan& plan, const LinkageMotion& motion, int body);

/// Places all parts for the given inputs (values only). Closed forms where the plan has them; a general group
/// is searched by Newton's method from the positions in `motion`, or from its start poses at first.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; only the values are used
/// @param motion receives the positions and the status
/// @throws ContractError when the number of inputs is not the plan's or one is not finite
void solve_position(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// The twists of the torsion springs at the present position of the parts; solve_position calls it.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; only the values are used
/// @param motion has the positions and receives the twists
void count_turns(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Velocities for the given rates of the inputs, after solve_position.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; values and rates are used
/// @param motion has the positions and receives the velocities
void solve_velocity(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Accelerations for the given accelerations of the inputs, after solve_velocity.
///
/// @param plan the plan of the linkage
/// @param inputs one an input
/// @param motion has the velocities and receives the accelerations
void solve_acceleration(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Position, velocity and acceleration in one call.
///
/// @param plan the plan of the linkage
/// @param inputs one an input
/// @param motion receives the motion and the status
/// @throws ContractError as solve_position does
void solve_motion(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// The outcome of following a linkage from its present inputs to others.
struct FollowReport {
  bool arrived = true;  ///< the linkage is at the last inputs
  double reached = 1;   ///< share of the path that was covered, 0 to 1
};

/// Follows the linkage from its present inputs to others, so that general groups stay on their assembly mode
/// (ModeCurve; change points end the path). Plans in closed form need no path and are placed directly.
///
/// @param plan the plan of the linkage
/// @param from present values of all inputs (rad or m)
/// @param to wanted values of all inputs
/// @param motion stays at the last good position, with the status
/// @returns true if it arrived, else the share of the path that was covered
/// @throws ContractError if the numbers of inputs do not fit
FollowReport follow(const LinkagePlan& plan, std::span<const double> from, std::span<const double> to,
                    LinkageMotion& motion);

/// Marks a group, and those behind it, as not placed: positions are NaN, but those of groups without closed
/// form stay for the next search.
///
/// @param plan the plan of the linkage
/// @param motion receives the status
/// @param group index of the group that failed
/// @param status the reason
void mark_failed(const LinkagePlan& plan, LinkageMotion& motion, std::size_t group, Status status);

}  // namespace linkwright::planar
