// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/math/function_ref.h"

namespace linkwright::math {

/// y' = f(t, y): fills `rate`, of y's length. Returns false when f cannot be evaluated here: the step is
/// shortened. Values that are not finite count as false.
using OdeFunction = FunctionRef<bool(double t, std::span<const double> y, std::span<double> rate)>;

/// Methods of integration.
enum class OdeMethod {
  explicit_runge_kutta_5,  ///< Dormand and Prince's pair of orders 5 and 4
  explicit_runge_kutta_8,  ///< Verner's pair of orders 8 and 7
  adams,                   ///< Adams-Moulton of orders 1 to 12
  bdf                      ///< backward differentiation of orders 1 to 5, for stiff equations
};
constexpr std::array<EnumName<OdeMethod>, 4> names(OdeMethod) {
  return {
      {{OdeMethod::explicit_runge_kutta_5, "explicit_runge_kutta_5",
        "Dormand and Prince's pair of orders 5 and 4; smooth motion, tolerances down to 1e-7, many events"},
       {OdeMethod::explicit_runge_kutta_8, "explicit_runge_kutta_8",
        "Verner's pair of orders 8 and 7; smooth motion, tight tolerances"},
       {OdeMethod::adams, "adams", "Adams-Moulton of orders 1 to 12; smooth motion, costly right-hand sides"},
       {OdeMethod::bdf, "bdf", "backward differentiation of orders 1 to 5; stiff equations"}}};
}

/// Method, tolerances and limits of an integration.
struct OdeOptions {
  OdeMethod method = OdeMethod::explicit_runge_kutta_8;  ///< method of integration
  /// The error of a step is held below relative_tolerance |y_j| + absolute_tolerance, in the mean square over
  /// the components. The error at the end is the sum of those of the steps as the equations carry them on.
  double relative_tolerance = 1e-8;
  double absolute_tolerance = 1e-10;                 ///< in the unit of y, of all components
  std::span<const double> absolute_tolerances = {};  ///< one a component, instead of the one above
  double initial_step = 0;                           ///< length; 0 = chosen from f
  double max_step = infinity;                        ///< longest step, in the unit of t
  long max_steps = 100'000;                          ///< accepted steps after which the integration ends
  /// Times of events are known to this (in units of t), or to four roundings of t where that is more.
  double event_tolerance = 1e-12;
  /// Jacobian of bdf by difference quotients within this band; negative = all of it.
  int lower_bandwidth = -1;
  int upper_bandwidth = -1;  ///< diagonals above the main one; negative = all
};

/// The direction of a zero crossing, seen in the direction of integration.
enum class OdeCrossing {
  rising,   ///< from negative to positive
  falling,  ///< from positive to negative
  either    ///< both
};
/// A zero crossing to be found.
struct OdeEvent {
  OdeCrossing crossing = OdeCrossing::either;  ///< direction that counts
  bool terminal = false;                       ///< the integration ends here
};

/// The next action after an event.
enum class OdeAction {
  go_on,    ///< y was not touched
  restart,  ///< y was changed, or f is another one from here on
  stop,
};

/// All optional. They may throw; the exception leaves `integrate`.
struct OdeHooks {
  /// Times at which `output` is called, in the order of integration, from `from` to `to` inclusive. Steps do
  /// not depend on them. y there is as accurate as at the ends of steps (see `integrate`).
  std::span<const double> output_times = {};
  std::function<bool(double t, std::span<const double> y)> output = {};  ///< false ends the integration

  /// After every step, and at an event, before it is acted on. false ends the integration.
  std::function<bool(double t, std::span<const double> y)> step = {};

  /// Moves y back onto the manifold it belongs to, after every accepted step, before it is used for anything.
  /// false when it cannot: the step is shortened. Not with adams.
  std::function<bool(double t, std::span<double> y)> project = {};

  /// Events to be found; their functions are `event_values`.
  std::span<const OdeEvent> events = {};
  /// Values of all events' functions; continuous between events.
  std::function<void(double t, std::span<const double> y, std::span<double> values)> event_values = {};
  /// At an event: `which` are the indices of those that happen together, in rising order. May change y.
  std::function<OdeAction(double t, std::span<const std::size_t> which, std::span<double> y)> event = {};

  /// df_i/dy_j at jacobian[j * n + i], for bdf.
  std::function<bool(double t, std::span<const double> y, std::span<double> jacobian)> jacobian = {};

  const RunContext* context = nullptr;  ///< looked at after every step; receives the stage "integration"
};

/// The reason why an integration ended.
enum class OdeEnd {
  time,        ///< the end of the interval was reached
  event,       ///< a terminal event, or `event` said stop
  hook,        ///< `output` or `step` said so
  evaluation,  ///< f or the projection cannot be evaluated
  steps,       ///< max_steps were used up
  step_size,   ///< the step became too short
  tolerance,   ///< the tolerance cannot be met
  interrupted  ///< the run was cancelled or is out of time
};
constexpr std::array<EnumName<OdeEnd>, 8> names(OdeEnd) {
  return {{{OdeEnd::time, "time"},
           {OdeEnd::event, "event"},
           {OdeEnd::hook, "hook"},
           {OdeEnd::evaluation, "evaluation"},
           {OdeEnd::steps, "steps"},
           {OdeEnd::step_size, "step_size"},
           {OdeEnd::tolerance, "tolerance"},
           {OdeEnd::interrupted, "interrupted"}}};
}

/// How an integration ended, and what it took.
struct OdeReport {
  /// done: `to`, a terminal event, or a hook said stop; infeasible: f cannot be evaluated at the start (y is
  /// left as it was); limit_reached: f (or the projection) cannot be evaluated beyond t; not_converged: steps
  /// used up, or the tolerance cannot be met; cancelled, deadline. t and y are the last good ones.
  Status status = Status::done;
  OdeEnd end = OdeEnd::time;            ///< reason of the end
  double t = 0;                         ///< time of y
  std::size_t event = std::size_t(-1);  ///< first of the events that ended it
  long steps = 0;                       ///< accepted steps
  long evaluations = 0;                 ///< calls of f, all of them
  long failures = 0;     ///< times that SUNDIALS gave a step up and was started again with a shorter one
  long events = 0;       ///< occasions, however many events happened together
  double last_step = 0;  ///< signed length of the last step
  std::string message;   ///< says why it is not `done`, for people; else empty
};

/// Memory of an integration; use one again and again (per thread) and nothing is allocated after the first
/// call of a size, method and direction, but for three small blocks that CVODE makes at every start of bdf.
class OdeWorkspace {
 public:
  /// Memory that grows with its first use.
  OdeWorkspace();
  /// Frees the memory.
  ~OdeWorkspace();
  /// Takes the memory of another one.
  OdeWorkspace(OdeWorkspace&&) noexcept;
  /// Takes the memory of another one. @returns this
  OdeWorkspace& operator=(OdeWorkspace&&) noexcept;

 private:
  /// @cond
  friend OdeReport integrate(OdeFunction, std::span<double>, double, double, const OdeOptions&,
                             const OdeHooks&, OdeWorkspace&);
  /// @endcond
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Integrates y' = f(t, y) from y(from) = y to y(to), in place; `to` may lie before `from`. Steps are those
/// of SUNDIALS (Hindmarsh et al. 2005): ARKODE's explicit Runge-Kutta pairs, CVODE's Adams and BDF.
///
/// Between the ends of a step, y is CVODE's own polynomial, or Hermite's polynomial through the ends and
/// through 1 (explicit_runge_kutta_5) or 3 (explicit_runge_kutta_8) parts of the step that are computed by
/// the same formula: degree 5 or 9, as accurate as the step, for 7 or 39 calls of f in each step in which it
/// is needed.
///
/// Events: signs are compared at 8 places within every step, and near-misses (a least |g| below a tenth of
/// its range) are searched for two crossings, so events are found however far apart the output times are.
/// What happens twice within an eighth of a step without coming near zero at the places compared can be
/// missed: `max_step` guards against it. An event is reported at the far side of its crossing. For the next
/// 100 tolerances its function counts as on the side towards which it then moves, and so does a function that
/// is zero at the start, which is no crossing: nothing is reported twice, and flights shorter than that are
/// not seen.
///
/// @param f right-hand side of the equations
/// @param y state at `from`, and at the end that at the time of the report; not empty
/// @param from time at which the integration starts
/// @param to time at which it ends, later or earlier
/// @param options method, tolerances and limits
/// @param hooks outputs, events and projection
/// @param workspace memory, one for each thread
/// @returns how it ended; `t` is the time of y
/// @throws ContractError for an empty y, values that are not finite, options out of range, output times out
/// of order or outside the interval, hooks that miss their partner, and combinations that a method lacks
OdeReport integrate(OdeFunction f, std::span<double> y, double from, double to, const OdeOptions& options,
                    const OdeHooks& hooks, OdeWorkspace& workspace);

/// Integrates without hooks.
/// @param f right-hand side of the equations
/// @param y state at `from`, and at the end that at the time of the report; not empty
/// @param from time at which the integration starts
/// @param to time at which it ends, later or earlier
/// @param options method, tolerances and limits
/// @param workspace memory, one for each thread
/// @returns how it ended; `t` is the time of y
/// @throws ContractError as `integrate` with hooks does
inline OdeReport integrate(OdeFunction f, std::span<double> y, double from, double to,
                           const OdeOptions& options, OdeWorkspace& workspace) {
  return integrate(f, y, from, to, options, {}, workspace);
}

}  // namespace linkwright::math
