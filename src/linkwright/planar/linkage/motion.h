// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/state.h"

namespace linkwright::planar {

struct GeneralGroupMemory;
struct GeneralGroupDelete {
  void operator()(GeneralGroupMemory* memory) const;
};
using GeneralGroupPointer = std::unique_ptr<GeneralGroupMemory, GeneralGroupDelete>;

/// Motion of a linkage at one instant, and the memory to compute it: make one a thread with its plan and use
/// it again and again; nothing is allocated after the first use. General groups start their search from the
/// positions that are in it.
class LinkageMotion {
 public:
  explicit LinkageMotion(const LinkagePlan& plan);

  /// done; no_assembly or singular (dead point) at `failed_group`, from which on nothing is known; of a
  /// general group also not_converged.
  Status status = Status::done;
  int failed_group = -1;
  /// m: by how much the bodies of the failed group are too short or too long to close; 0 when assembled.
  double gap = 0;
  /// Largest distance (m) between the points that joints hold together, over the groups placed: what
  /// rounding, or Newton's method, left.
  double closure_residual = 0;
  /// One a part; NaN where not known, but parts of general groups stay where they were, for the next search.
  std::vector<PartState<double>> parts;
  std::vector<GroupState<double>> groups;  ///< one a group
  /// Sign of the assembly mode in use, one a group: those of the plan unless changed.
  std::vector<double> modes;
  std::vector<GeneralGroupPointer> general;  ///< states of groups with a matrix, else null
  std::vector<double> twists;  ///< rad, one a torsion spring, see PlanTwist; NaN before the first position
};

/// A point of a body in the global frame: where it is and how it moves.
struct PointMotion {
  Vec<double> position, velocity, acceleration;
};
/// `at` in the frame of the body.
PointMotion point_motion(const LinkagePlan& plan, const LinkageMotion& motion, int body,
                         std::complex<double> at);
/// The frame of a body: origin and direction of its x axis, speeds and accelerations.
PartState<double> body_state(const LinkagePlan& plan, const LinkageMotion& motion, int body);

/// Places all parts for the given inputs (values only). Closed forms where the plan has them; a general group
/// is searched by Newton's method from the positions in `motion`, or from its start poses at first.
/// Throws ContractError when the number of inputs is not the plan's or one is not finite.
void solve_position(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// The twists of the torsion springs at the places of the parts; solve_position does it as well.
void count_turns(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Velocities for the given rates of the inputs, after solve_position.
void solve_velocity(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Accelerations for the given accelerations of the inputs, after solve_velocity.
void solve_acceleration(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Position, velocity and acceleration in one call.
void solve_motion(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Follows the linkage from its present inputs to others, so that general groups stay on
/// their assembly mode (ModeCurve; change points end the path). False (and the status in `motion`,
/// which stays at the last good place: `reached` of the path, 0 to 1) when there is no path. Plans in closed
/// form need no path and are placed directly.
struct FollowReport {
  bool arrived = true;
  double reached = 1;
};
FollowReport follow(const LinkagePlan& plan, std::span<const double> from, std::span<const double> to,
                    LinkageMotion& motion);

/// Marks a group, and those behind it, as not placed: positions are NaN, but those of groups without closed
/// form stay for the next search.
void mark_failed(const LinkagePlan& plan, LinkageMotion& motion, std::size_t group, Status status);

}  // namespace linkwright::planar
