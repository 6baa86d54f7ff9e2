// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/step_pace.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/simulation/simulation.h"

// Continuous contact in any pins of any planar linkage: the model of four_bar_clearance.h, for all others. It
// is the linkage of planar/ with a massless bar instead of each pin that has clearance.
namespace linkwright::clearance {

/// A pin that has clearance, and how it starts.
struct JointClearance {
  int joint = 0;         ///< revolute joint of the linkage, without drive and friction
  double clearance = 0;  ///< m, > 0: radius of the bush less radius of the pin
  /// Direction from the joint's point of its first body to that of its second (absolute, rad) and its rate.
  double angle = 0;
  double rate = 0;     ///< rad/s
  double damping = 0;  ///< N m s, >= 0: viscous torque against the absolute rate
};

/// The bar that replaces a pin.
struct ClearanceBar {
  int body = 0;   ///< body of the new linkage; its x axis points from the first body's point to the second's
  int input = 0;  ///< input that turns it: angle of the bar from its carrier
  int carrier = 0;    ///< the body of the joint that the input counts from
  int far_joint = 0;  ///< joint of the new linkage: the pin at the other end
  double clearance = 0;
};

/// A linkage with bars instead of pins.
struct ClearedLinkage {
  /// done; no_assembly and the like when the ideal linkage has no position at the start; infeasible when the
  /// linkage cannot be planned.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  /// Bodies and joints of the original keep their numbers, but for the points of cleared joints; the inputs
  /// of the original come first. Every body has a start pose.
  planar::Linkage linkage;
  planar::LinkagePlan plan;
  std::vector<ClearanceBar> bars;  ///< one a clearance
};

/// Puts the bars in. `inputs` are the values of the drives at which the linkage of `plan` shows, in the modes
/// of its plan, how it is assembled. Each bar is carried by that body of its joint which is placed first, so
/// that a pin between groups of the plan keeps closed forms; between two bodies of one group a general group
/// results. Throws ContractError for joints that are no free pins or are named twice, and clearances that are
/// not positive or not less than half the size of the linkage.
ClearedLinkage with_clearance(const planar::Linkage& linkage, std::span<const JointClearance> clearances,
                              std::span<const double> inputs);

/// State of one clearance in a row.
struct ClearanceState {
  double angle = 0, rate = 0, acceleration = 0;  ///< absolute, of the bar; the angle is not wrapped
  /// N, in the bar. Positive: pin and bush are pressed together; else the model has left its range.
  double tension = 0;
};
struct JointClearanceRow {
  planar::SimulationInstant instant;       ///< instant of the cleared linkage
  std::span<const ClearanceState> joints;  ///< one a clearance
};
/// false ends the simulation.
using JointClearanceOutput = std::function<bool(const JointClearanceRow&)>;

/// The end of contact. Found within the steps of the integration: rows have no influence.
struct ContactValidity {
  double first_separation = nan;  ///< s: first tension <= 0; NaN: never
  double separated = 0;           ///< share of the time with tension <= 0
  int sign_changes = 0;           ///< sign changes of the tension
  double min_tension = infinity;  ///< N, over steps and rows
};

struct JointClearanceRun {
  Status status = Status::done;  ///< status of the start or the simulation
  std::string message;
  planar::SimulationReport simulation;
  std::vector<ContactValidity> joints;  ///< one a clearance
  /// End states at simulation.time: those of the clearances, and values and rates of the inputs of the
  /// original.
  std::vector<ClearanceState> end;
  std::vector<planar::InputMotion> inputs;
  double kinetic = 0, potential = 0, work = 0;  ///< J there, as in planar::SimulationInstant
  int parted = -1;  ///< clearance at whose loss of contact it ended, with AtSeparation::stop
};

/// The action when the tension of a clearance is no longer positive. With `ignore` it is not looked for, and
/// validity is that of the rows alone, which saves half of the time.
enum class AtSeparation { go_on, stop, ignore };

/// The action when it is clear early that the allowed steps will not be enough.
enum class AtHopeless { go_on, stop };

/// Motion under forces with clearance: `drives` are those of the inputs of the original linkage, laws or
/// free. Times, options and the rest as in planar::simulate, whose contract errors it throws, too. Tolerances
/// that are finer than the rounding of a short bar's angle (100 units in the last place of the size of the
/// linkage, by the clearance) are widened to that. With AtSeparation::stop it ends, with status done, at the
/// first instant at which a tension is not positive, and there is no row beyond. With AtHopeless::stop
/// it ends early, not_converged, when StepPace sees that options.max_steps will not do.
JointClearanceRun simulate_joint_clearance(
    const planar::Linkage& linkage, std::span<const JointClearance> clearances,
    std::span<const planar::InputDrive> drives, std::span<const double> times,
    const planar::SimulationOptions& options, const JointClearanceOutput& output = {},
    const RunContext* context = nullptr, AtSeparation at_separation = AtSeparation::go_on,
    AtHopeless at_hopeless = AtHopeless::go_on);

}  // namespace linkwright::clearance
