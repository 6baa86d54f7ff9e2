// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/ode.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/ode_events.h"
#include "linkwright/math/ode_stepper.h"

namespace linkwright::math {

struct OdeWorkspace::Parts {
  OdeStepper stepper;
  OdeEventFinder finder;
  std::vector<double> state;       // at outputs and events
  std::vector<std::size_t> fired;  // events of the last restart
};

OdeWorkspace::OdeWorkspace() : parts_(std::make_unique<Parts>()) {}
OdeWorkspace::~OdeWorkspace() = default;
OdeWorkspace::OdeWorkspace(OdeWorkspace&&) noexcept = default;
OdeWorkspace& OdeWorkspace::operator=(OdeWorkspace&&) noexcept = default;

namespace {

void check(std::span<const double> y, double from, double to, const OdeOptions& o, const OdeHooks& hooks) {
  LINKWRIGHT_REQUIRE(!y.empty(), "no components");
  LINKWRIGHT_REQUIRE(std::isfinite(from) && std::isfinite(to), "interval from {} to {}", from, to);
  for (std::size_t j = 0; j < y.size(); ++j)
    LINKWRIGHT_REQUIRE(std::isfinite(y[j]), "y[{}] = {} at the start", j, y[j]);
  LINKWRIGHT_REQUIRE(o.relative_tolerance >= 0 && o.absolute_tolerance >= 0, "tolerances {} and {}",
                     o.relative_tolerance, o.absolute_tolerance);
  LINKWRIGHT_REQUIRE(o.absolute_tolerances.empty() || o.absolute_tolerances.size() == y.size(),
                     "{} absolute tolerances for {} components", o.absolute_tolerances.size(), y.size());
  for (const double tolerance : o.absolute_tolerances)
    LINKWRIGHT_REQUIRE(tolerance >= 0, "absolute tolerance {}", tolerance);
  LINKWRIGHT_REQUIRE(o.initial_step >= 0 && o.max_step > 0, "initial step {}, longest step {}",
                     o.initial_step, o.max_step);
  LINKWRIGHT_REQUIRE(o.max_steps >= 0, "{} steps", o.max_steps);
  LINKWRIGHT_REQUIRE(o.event_tolerance >= 0, "event tolerance {}", o.event_tolerance);
  const bool bdf = o.method == OdeMethod::bdf;
  const bool banded = o.lower_bandwidth >= 0 || o.upper_bandwidth >= 0;
  LINKWRIGHT_REQUIRE(!banded || (bdf && o.lower_bandwidth >= 0 && o.upper_bandwidth >= 0 && !hooks.jacobian),
                     "bandwidths {} and {}: both, for bdf, without a Jacobian function", o.lower_bandwidth,
                     o.upper_bandwidth);
  const int n = static_cast<int>(y.size());
  LINKWRIGHT_REQUIRE(o.lower_bandwidth < n && o.upper_bandwidth < n, "bandwidths {} and {} of {} equations",
                     o.lower_bandwidth, o.upper_bandwidth, n);
  LINKWRIGHT_REQUIRE(bdf || !hooks.jacobian, "{} uses no Jacobian", name_of(o.method));
  LINKWRIGHT_REQUIRE(o.method != OdeMethod::adams || !hooks.project, "adams cannot project");
  LINKWRIGHT_REQUIRE(hooks.events.empty() == !hooks.event_values, "{} events {} their function",
                     hooks.events.size(), hooks.event_values ? "with" : "without");
  LINKWRIGHT_REQUIRE(hooks.output_times.empty() == !hooks.output, "{} output times {} their function",
                     hooks.output_times.size(), hooks.output ? "with" : "without");
  const double direction = to < from ? -1 : 1;
  double last = from;
  for (const double t : hooks.output_times) {
    LINKWRIGHT_REQUIRE(direction * (t - last) >= 0 && direction * (to - t) >= 0,
                       "output time {} after {}, between {} and {}", t, last, from, to);
    last = t;
  }
}

}  // namespace

OdeReport integrate(OdeFunction f, std::span<double> y, double from, double to, const OdeOptions& o,
                    const OdeHooks& hooks, OdeWorkspace& w) {
  check(y, from, to, o, hooks);
  if (!w.parts_) w.parts_ = std::make_unique<OdeWorkspace::Parts>();  // moved from
  auto& stepper = w.parts_->stepper;
  auto& finder = w.parts_->finder;
  auto& state = w.parts_->state;
  auto& fired = w.parts_->fired;
  const std::size_t n = y.size();
  const double direction = to < from ? -1 : 1, range = std::abs(to - from);
  const double resolution = 4 * tolerance::epsilon * std::max(std::abs(from), std::abs(to));
  stepper.prepare(f, n, from, to, o, hooks);
  finder.prepare(hooks, n, std::max(o.event_tolerance, resolution));
  state.resize(n);
  fired.clear();
  fired.reserve(hooks.events.size());

  OdeReport report;
  const auto end = [&](Status status, OdeEnd why, double t, std::span<const double> last,
                       std::string message = {}) {
    if (stepper.thrown) std::rethrow_exception(std::exchange(stepper.thrown, nullptr));
    if (last.data() != y.data()) std::copy(last.begin(), last.end(), y.begin());
    report.status = status;
    report.end = why;
    report.t = t;
    report.evaluations = stepper.evaluations;
    report.message = std::move(message);
    return report;
  };
  // Outputs up to and including t, from the last step. False: the integration ends here.
  std::size_t next_output = 0;
  double told = 0;
  bool unprojected = false;
  const auto deliver = [&](double t) {
    for (; next_output < hooks.output_times.size(); ++next_output) {
      const double at = hooks.output_times[next_output];
      if (direction * (at - t) > 0) break;
      stepper.state(at, state);
      told = at;
      unprojected = hooks.project && at != stepper.t0 && at != stepper.t1 && !hooks.project(at, state);
      if (unprojected) return false;
      if (!hooks.output(at, state)) {
        ++next_output;
        return false;
      }
    }
    return true;
  };

  const auto stuck = [&](bool refused) {
    if (refused)
      return end(Status::limit_reached, OdeEnd::evaluation, stepper.t1, stepper.y1,
                 fmt::format("the right-hand side cannot be evaluated beyond t = {}", stepper.t1));
    return end(Status::not_converged, OdeEnd::step_size, stepper.t1, stepper.y1,
               fmt::format("no step is short enough at t = {}", stepper.t1));
  };
  const auto end_at_output = [&] {
    if (!unprojected) return end(Status::done, OdeEnd::hook, told, state);
    return end(Status::limit_reached, OdeEnd::evaluation, stepper.t0, stepper.y0,
               fmt::format("the projection failed at t = {}", told));
  };

  if (!stepper.start(from, y, o.initial_step))
    return end(Status::infeasible, OdeEnd::evaluation, from, y,
               fmt::format("the right-hand side cannot be evaluated at the start, t = {}", from));
  finder.begin(from, stepper.y1, stepper.rate0, direction, {});
  if (!deliver(from)) return end_at_output();

  double reported = 0;
  while (direction * (to - stepper.t1) > resolution || (range <= resolution && stepper.t1 != to)) {
    if (hooks.context) {
      if (const Status why = hooks.context->interruption(); why != Status::done)
        return end(why, OdeEnd::interrupted, stepper.t1, stepper.y1,
                   fmt::format("{} at t = {}", why == Status::cancelled ? "cancelled" : "time limit reached",
                               stepper.t1));
      const double fraction = std::abs(stepper.t1 - from) / range;
      if (fraction >= reported + 0.01) {
        hooks.context->report({.stage = "integration", .fraction = fraction});
        reported = fraction;
      }
    }
    if (report.steps >= o.max_steps)
      return end(Status::not_converged, OdeEnd::steps, stepper.t1, stepper.y1,
                 fmt::format("{} steps used up at t = {}", report.steps, stepper.t1));

    const OdeStepper::Outcome outcome = stepper.step();
    if (stepper.thrown || outcome == OdeStepper::Outcome::impossible)
      return end(Status::not_converged, OdeEnd::tolerance, stepper.t1, stepper.y1, stepper.message());
    if (outcome == OdeStepper::Outcome::shorter) {
      ++report.failures;
      const double shorter = 0.25 * std::min(stepper.reach, std::abs(to - stepper.t1));
      const bool refused = stepper.refused;
      if (shorter > std::max(resolution, 1e-12 * range) && stepper.start(stepper.t1, stepper.y1, shorter))
        continue;
      return stuck(refused);
    }
    ++report.steps;
    report.last_step = stepper.t1 - stepper.t0;
    if (stepper.t1 == stepper.t0) return stuck(stepper.refused);

    bool restarted = false;
    double at = stepper.t0;
    while (finder.find(stepper, at, at)) {
      if (finder.which().empty()) continue;  // crossed the other way
      if (!deliver(at)) return end_at_output();
      ++report.events;
      stepper.state(at, state);
      if (hooks.project && !hooks.project(at, state))
        return end(Status::limit_reached, OdeEnd::evaluation, stepper.t0, stepper.y0,
                   fmt::format("the projection failed at t = {}", at));
      const auto which = finder.which();
      const bool on = !hooks.step || hooks.step(at, state);
      const OdeAction action = hooks.event ? hooks.event(at, which, state) : OdeAction::go_on;
      if (!on) return end(Status::done, OdeEnd::hook, at, state);
      const bool terminal =
          std::any_of(which.begin(), which.end(), [&](std::size_t i) { return hooks.events[i].terminal; });
      if (terminal || action == OdeAction::stop) {
        report.event = which.front();
        return end(Status::done, OdeEnd::event, at, state);
      }
      if (action == OdeAction::go_on) continue;
      fired.assign(which.begin(), which.end());
      if (direction * (to - at) <= resolution) return end(Status::done, OdeEnd::time, at, state);
      if (!stepper.start(at, state, 0))
        return end(Status::limit_reached, OdeEnd::evaluation, at, state,
                   fmt::format("the right-hand side cannot be evaluated after the event at t = {}", at));
      finder.begin(at, stepper.y1, stepper.rate0, direction, fired);
      restarted = true;
      break;
    }
    if (restarted) continue;
    if (!deliver(stepper.t1)) return end_at_output();
    if (hooks.step && !hooks.step(stepper.t1, stepper.y1))
      return end(Status::done, OdeEnd::hook, stepper.t1, stepper.y1);
  }
  if (!deliver(to)) return end_at_output();
  return end(Status::done, OdeEnd::time, to, stepper.y1);
}

}  // namespace linkwright::math
