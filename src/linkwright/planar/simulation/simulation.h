// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/math/ode.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The motion of an input: prescribed by a law or, without one, free from a value and rate at the first time.
struct InputDrive {
  std::optional<math::MotionLaw> law;  ///< prescribed motion; nothing for a free input
  double value = 0,                    ///< of a free input at the first time, rad or m
      rate = 0;                        ///< of a free input, rad/s or m/s
};

/// Options of a simulation.
struct SimulationOptions {
  math::OdeMethod method = math::OdeMethod::explicit_runge_kutta_8;  ///< method of integration
  double relative_tolerance = 1e-9;                                  ///< of each step
  /// Absolute tolerance of a step: rad and rad/s; of displacements (m, m/s) times the size of the linkage.
  double absolute_tolerance = 1e-10;
  /// Absolute tolerances of the free inputs (rad, m), in their order, where they are more than the one above:
  /// what their rounding leaves. Empty: none.
  std::span<const double> value_resolution = {},
                          rate_resolution = {};           ///< the same for their rates (rad/s, m/s)
  long max_steps = 1'000'000;                             ///< steps after which it ends as not_converged
  AtChangePoint at_change_point = AtChangePoint::smooth;  ///< behaviour at change points
  bool stop_at_rest = false;  ///< it ends where friction first holds the linkage at rest
};

/// One row of a simulation; valid during the call that receives it.
struct SimulationInstant {
  double time = 0;  ///< s
  /// done; singular within rounding of a change point, where only inputs and energies are known.
  Status status = Status::done;
  std::span<const InputMotion> inputs;  ///< all inputs, in their order
  double kinetic = 0;                   ///< J
  double potential = 0;                 ///< J, of weight and springs
  /// Work (J) since the start: of prescribed drives and of loads that store no energy; less what a kink has
  /// cost.
  double work = 0;
  double drift = 0;  ///< J: kinetic + potential - work less its value at the start; zero but for errors
  const LinkageMotion* motion = nullptr;  ///< velocities and accelerations included
  /// Joint forces while joints stick by friction, which do not follow from the motion; else null.
  const LinkageForces* held = nullptr;
  double friction_loss = 0;  ///< J: what friction has taken since the start
  /// States of the joints, one a joint: 1 and -1 slide with and against their coordinate, 0 sticks; NaN:
  /// without friction. Empty where no joint has friction.
  std::span<const double> friction_senses = {};
};
/// All joint forces of an instant: `held` where joints stick, else those of solve_forces.
///
/// @param linkage the linkage, with masses and loads
/// @param plan its plan
/// @param instant an instant with a motion
/// @param forces receives the forces; use one again and again
/// @throws ContractError if a body has no mass
void solve_forces(const Linkage& linkage, const LinkagePlan& plan, const SimulationInstant& instant,
                  LinkageForces& forces);

/// A function that receives the rows; false ends the simulation.
using SimulationOutput = std::function<bool(const SimulationInstant&)>;

/// Quantities whose changes of sign are found within the steps, however far apart the rows are (see
/// math::OdeHooks). Of energies the instants have the work alone.
struct SimulationWatch {
  std::size_t count = 0;  ///< number of quantities
  /// Computes the quantities of an instant.
  std::function<void(const SimulationInstant&, std::span<double> values)> values = {};
  /// Called after every step, and where quantities change signs: `crossed` are their indices. false ends the
  /// simulation.
  std::function<bool(const SimulationInstant&, std::span<const std::size_t> crossed)> note = {};
};

/// A change point that the linkage went through.
struct ChangePassage {
  double time = 0;          ///< s
  double value = 0;         ///< value of the input (rad or m)
  std::vector<int> groups;  ///< groups whose modes meet there
  double energy_lost = 0;   ///< J: in the kink of `keep_sign`
};

/// A change of the state of a joint with friction.
enum class FrictionChange {
  sticks,        ///< its speed has come to zero, and friction at rest holds it
  slips,         ///< it begins to slide
  reverses,      ///< its speed changes its sign
  changes_flank  ///< the normal force of a slide changes its sign
};
constexpr std::array<EnumName<FrictionChange>, 4> names(FrictionChange) {
  return {{{FrictionChange::sticks, "sticks", "its speed has come to zero, and friction holds it"},
           {FrictionChange::slips, "slips", "it begins to slide"},
           {FrictionChange::reverses, "reverses", "its speed changes its sign"},
           {FrictionChange::changes_flank, "changes flank", "its normal force changes its sign"}}};
}
/// An event of a joint with friction.
struct FrictionEvent {
  double time = 0;                                 ///< s
  int joint = 0;                                   ///< index of the joint
  FrictionChange change = FrictionChange::sticks;  ///< what happens
  double value = 0;                                ///< coordinate of the joint (rad or m)
  double sense = 0;                                ///< state from here on: 1, -1 slides, 0 sticks
};

/// A change of the state of a stop.
enum class StopChange {
  hits,   ///< its joint meets it and is thrown back
  rests,  ///< its joint stays on it
  leaves  ///< its joint comes off it
};
constexpr std::array<EnumName<StopChange>, 3> names(StopChange) {
  return {{{StopChange::hits, "is hit", "its joint meets it and is thrown back"},
           {StopChange::rests, "closes", "its joint stays on it"},
           {StopChange::leaves, "opens", "its joint comes off it"}}};
}
/// An event of a stop.
struct StopEvent {
  double time = 0;                        ///< s; of `rests` after impacts without number, when they end
  std::size_t stop = 0;                   ///< index of the stop
  StopChange change = StopChange::rests;  ///< what happens
  double before = 0;                      ///< rate of the gap before (rad/s or m/s)
  double after = 0;                       ///< rate of the gap after (rad/s or m/s)
  double energy_lost = 0;                 ///< J, in an impact
};

/// Times during which friction holds a linkage at rest although a load over time or a drive may free it.
struct FrictionRests {
  long count = 0;         ///< number of rests
  double first_from = 0,  ///< start of the first, s
      first_to = 0;       ///< its end, s
  double total = 0;       ///< s, of all of them
};

/// The outcome of a simulation.
struct SimulationReport {
  /// done: the last time, or the output said stop; limit_reached: a limit of the motion, or a change point
  /// with `stop`; no_assembly, singular: the start has
  /// no motion; at_rest: friction has brought the linkage to rest, or never lets it start, and nothing can
  /// free it later; self_locking: friction jams it while it moves (see settle_friction); not_converged;
  /// cancelled, deadline. Rows so far are kept.
  Status status = Status::done;
  Sentence message;          ///< says in plain words why it is not `done`; else empty
  double time = 0;           ///< reached, s
  int group = -1;            ///< index of the group in the plan where a limit or start failed
  double largest_drift = 0;  ///< J, over the rows
  double peak_energy = 0;    ///< J: largest kinetic energy, change of potential energy or work of a row
  std::vector<ChangePassage> passages;         ///< the first 1000
  long passage_count = 0;                      ///< number of all passages
  FrictionRests rests;                         ///< rests by friction
  std::vector<FrictionEvent> friction_events;  ///< the first 10000
  long friction_event_count = 0;               ///< number of all of them
  std::vector<StopEvent> stop_events;          ///< of the stops, the first 10000
  long stop_event_count = 0;                   ///< number of all of them
  long steps = 0,                              ///< of the integration
      evaluations = 0;                         ///< of the equations of motion
};

/// Motion of a linkage under forces: integrates the equations of LinkageDynamics over `times` and calls
/// `output` at each of them.
///
/// The motion ends where a group comes to its limit (dead point): there the free input turns back while the
/// linkage continues in the other assembly mode, so that another coordinate is needed
/// (simulate_all_coordinates). With one input in closed form, change points are passed as `at_change_point`
/// says: `smooth` changes the signs of the modes that meet, as a moving linkage does by itself; `keep_sign`
/// turns onto the other branch, by an inelastic impact that keeps the momentum along it, or stops where that
/// branch does not meet this one; `stop` ends. Within 0.08 rad (or sizes) of a change point, where the closed
/// forms lose digits, the acceleration is interpolated between positions on both sides, to about 1e-11. With
/// more inputs, and in general groups, change points count as limits.
///
/// Joints with friction slide or stick (see FrictionStates). A joint whose speed comes to zero sticks when
/// its friction at rest can bear the effort that keeps it there; it slides on, back or at a later time
/// otherwise. Where several joints hold the same motion, the largest share of what one of them can bear is
/// the least possible. Changes of states are found within the steps and reported. A run ends `at_rest` when
/// friction holds the whole linkage and neither drives nor loads over time can free it.
///
/// Rigid stops throw their joints back with their restitution (Newton's law for several impacts at once;
/// friction takes no part in them), or hold them as long as they have to push. Impacts that follow each other
/// ever faster come to their end within a ten-millionth of the time of the simulation, and are passed. A
/// joint that a drive presses on its stop ends the run as limit_reached.
///
/// @param linkage the linkage, with masses and loads
/// @param plan its plan
/// @param drives the motion of each input, at least one of them free
/// @param times times of the rows (s), rising, two at least; the first is the start
/// @param options method, tolerances and behaviour at change points
/// @param output receives the rows
/// @param context progress, deadline and cancellation; null: none
/// @returns the outcome
/// @throws ContractError if there is no free input, drives or times do not fit, a law is no motion, or a body
///   has no mass
SimulationReport simulate(const Linkage& linkage, const LinkagePlan& plan, std::span<const InputDrive> drives,
                          std::span<const double> times, const SimulationOptions& options,
                          const SimulationOutput& output, const RunContext* context = nullptr);

/// Times at which accelerations may step or kink: where laws do (math::breaks), and corners of load tables
/// over time.
///
/// @param linkage the linkage with its loads
/// @param drives the motion of each input
/// @param from start of the interval (s)
/// @param to end of the interval (s)
/// @returns the times strictly between `from` and `to`, rising (s)
std::vector<double> breaks_of(const Linkage& linkage, std::span<const InputDrive> drives, double from,
                              double to);

/// Calls math::integrate from break to break, so that no step lies across one: on either side `f` is asked
/// with times of that side.
///
/// @param f the differential equations
/// @param y state at `from`; receives the state at the end
/// @param from start of the interval
/// @param to end of the interval
/// @param breaks times strictly between, rising
/// @param options options of the integration
/// @param hooks output, events and context of the integration
/// @returns the report of all intervals together
math::OdeReport integrate_by_pieces(math::OdeFunction f, std::span<double> y, double from, double to,
                                    std::span<const double> breaks, math::OdeOptions options,
                                    math::OdeHooks hooks);

/// The same as `simulate`, with quantities whose changes of sign are found.
///
/// @param linkage the linkage, with masses and loads
/// @param plan its plan
/// @param drives the motion of each input, at least one of them free
/// @param times times of the rows (s), rising, two at least; the first is the start
/// @param options method, tolerances and behaviour at change points
/// @param output receives the rows
/// @param watch the quantities
/// @param context progress, deadline and cancellation; null: none
/// @returns the outcome
/// @throws ContractError as `simulate` does
SimulationReport simulate_watched(const Linkage& linkage, const LinkagePlan& plan,
                                  std::span<const InputDrive> drives, std::span<const double> times,
                                  const SimulationOptions& options, const SimulationOutput& output,
                                  const SimulationWatch& watch, const RunContext* context = nullptr);

}  // namespace linkwright::planar
