// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/ode.h"

namespace linkwright::clearance {
namespace {

std::string failure(const ClearanceInstant& now, double time, double crank) {
  const std::string place =
      fmt::format("at {:.6g} s, crank at {:.4f} deg", time, math::degrees(math::wrap_angle(crank)));
  if (now.status == Status::no_assembly)
    return fmt::format("no assembly {}: the links miss each other by {:.3g} mm", place,
                       now.position.gap * 1e3);
  if (std::abs(now.position.sine) < singular_sine)
    return fmt::format("coupler and rocker are in line {}", place);
  return fmt::format("the clearance link moves no mass {}, so its rotation does not follow from the forces",
                     place);
}

// True if the crank is about to reach an angle where no position of the pin in the bush lets the links meet:
// before it does, the link swings faster and faster without end.
bool caught(const ClearanceFourBar& model, double crank) {
  const planar::FourBar& l = model.linkage;
  const double distance = std::abs(std::polar(l.ground, l.frame_angle) - std::polar(l.crank, crank));
  const double left = 0.01 * model.clearance;
  return distance - model.clearance > l.coupler + l.rocker - left ||
         distance + model.clearance < std::abs(l.coupler - l.rocker) + left;
}
std::string caught_message(double time, double crank) {
  return fmt::format(
      "the crank stops at {:.6g} s, {:.4f} deg: beyond that angle the links meet for no position of the pin "
      "in its bush",
      time, math::degrees(math::wrap_angle(crank)));
}

class FourBarMotion {
 public:
  FourBarMotion(const ClearanceFourBar& model, const math::MotionLaw& law, const ClearanceOutput& output)
      : model_(model), law_(law), output_(output) {}

  ClearanceRun run(const LinkState& start, std::span<const double> times,
                   const ClearanceTolerances& tolerances, const RunContext* context) {
    LINKWRIGHT_REQUIRE(model_.clearance > 0, "clearance {} m: the ideal joint has no motion of its own",
                       model_.clearance);
    LINKWRIGHT_REQUIRE(times.size() >= 2 && times.front() < times.back(), "no interval of time: {} times",
                       times.size());
    LINKWRIGHT_REQUIRE(std::isfinite(start.angle) && std::isfinite(start.rate), "start at {} rad, {} rad/s",
                       start.angle, start.rate);
    std::array<double, 2> y{start.angle, start.rate};
    run_.link = start;
    run_.time = from_ = times.front();
    evaluate(from_, y);
    if (now_.status != Status::done) {
      run_.status = now_.status;
      run_.message = failure(now_, from_, crank_.value);
      return run_;
    }
    apart_ = !(now_.tension > 0);
    if (apart_) run_.first_separation = parted_at_ = from_;

    const double speed = std::max(1.0, std::abs(crank_.rate));
    const std::array<double, 2> absolute{tolerances.absolute, tolerances.absolute * speed};
    const std::array<math::OdeEvent, 1> events{};
    math::OdeHooks hooks{.output_times = times, .events = events, .context = context};
    hooks.output = [&](double t, std::span<const double> state) {
      note(t, state);
      return !output_ || output_({t, crank_, run_.link, &now_});
    };
    hooks.step = [&](double t, std::span<const double> state) {
      note(t, state);
      caught_ = caught(model_, crank_.value);
      return !caught_;
    };
    hooks.event_values = [&](double t, std::span<const double> state, std::span<double> values) {
      evaluate(t, state);
      values[0] = now_.status == Status::done ? now_.tension : 1;
    };
    hooks.event = [&](double t, std::span<const std::size_t>, std::span<double>) {
      ++run_.sign_changes;
      apart_ = !apart_;
      if (apart_) {
        if (std::isnan(run_.first_separation)) run_.first_separation = t;
        parted_at_ = t;
      } else {
        apart_time_ += t - parted_at_;
      }
      return math::OdeAction::go_on;
    };
    math::OdeWorkspace workspace;
    const math::OdeReport ode = math::integrate(
        [&](double t, std::span<const double> state, std::span<double> rate) {
          evaluate(t, state);
          if (now_.status != Status::done) {
            failed_ = now_;
            failed_crank_ = crank_.value;
            return false;
          }
          rate[0] = state[1];
          rate[1] = now_.link_acceleration;
          return true;
        },
        y, times.front(), times.back(),
        {.relative_tolerance = tolerances.relative,
         .absolute_tolerances = absolute,
         .max_steps = tolerances.max_steps},
        hooks, workspace);
    finish(ode, y);
    return run_;
  }

 private:
  void evaluate(double t, std::span<const double> state) {
    crank_ = law_(t);
    now_ = clearance_instant(model_, crank_.value, crank_.rate, crank_.acceleration, {state[0], state[1]});
  }
  void note(double t, std::span<const double> state) {
    evaluate(t, state);
    run_.link = {state[0], state[1]};
    run_.time = t;
    run_.fastest_link = std::max(run_.fastest_link, std::abs(state[1]));
    run_.min_tension = std::min(run_.min_tension, now_.tension);
    run_.max_tension = std::max(run_.max_tension, now_.tension);
  }
  void finish(const math::OdeReport& ode, std::span<const double> y) {
    run_.time = ode.t;
    run_.link = {y[0], y[1]};
    run_.steps = ode.steps;
    run_.evaluations = ode.evaluations;
    if (apart_) apart_time_ += ode.t - parted_at_;
    run_.separated = ode.t > from_ ? apart_time_ / (ode.t - from_) : 0;
    run_.status = ode.status;
    if (caught_) {
      run_.status = Status::limit_reached;
      run_.message = caught_message(ode.t, crank_.value);
    }
    if (ode.status == Status::done) return;
    if (ode.status == Status::limit_reached && failed_.status != Status::done) {
      run_.status = failed_.status;
      run_.message = failure(failed_, ode.t, failed_crank_);
    } else {
      run_.message = fmt::format("ended at {:.6g} s: {}", ode.t, ode.message);
    }
  }

  const ClearanceFourBar& model_;
  math::MotionCurve law_;
  const ClearanceOutput& output_;
  ClearanceRun run_;
  ClearanceInstant now_, failed_;
  math::Motion crank_;
  double failed_crank_ = 0, from_ = 0, parted_at_ = 0, apart_time_ = 0;
  bool apart_ = false, caught_ = false;
};

// The map of phase and slope over one turn of a crank that rotates uniformly.
class TurnMap {
 public:
  TurnMap(const ClearanceFourBar& model, const UniformCrank& crank, const ClearanceTolerances& tolerances,
          const RunContext* context)
      : model_(model), crank_(crank), tolerances_(tolerances), context_(context) {
    require_valid(model);
    LINKWRIGHT_REQUIRE(model.clearance > 0, "clearance {} m: the ideal joint has no motion of its own",
                       model.clearance);
    LINKWRIGHT_REQUIRE(std::isfinite(crank.angle) && std::isfinite(crank.speed) && crank.speed != 0,
                       "the crank must turn, at {} rad/s", crank.speed);
  }

  /// (phase, slope) after a turn; false, with status and message, when the linkage does not rotate fully.
  /// `rows` receive the phase at `samples` points of the turn, the first at its start.
  bool operator()(std::array<double, 2>& x, std::span<double> rows = {}) {
    const double way = crank_.speed > 0 ? full_turn : -full_turn;
    std::array<double, 2> y = x;
    std::vector<double> times;
    for (std::size_t k = 0; k < rows.size(); ++k)
      times.push_back(way * static_cast<double>(k) / static_cast<double>(rows.size()));
    std::size_t next = 0;
    math::OdeHooks hooks{.output_times = times, .context = context_};
    if (!rows.empty())
      hooks.output = [&](double, std::span<const double> state) {
        rows[next++] = state[0];
        return true;
      };
    ClearanceInstant failed;
    double failed_crank = 0;
    bool stuck = false;
    hooks.step = [&](double s, std::span<const double>) {
      stuck = caught(model_, crank_.angle + s);
      return !stuck;
    };
    const math::OdeReport ode = math::integrate(
        [&](double s, std::span<const double> state, std::span<double> rate) {
          const double angle = crank_.angle + s;
          const ClearanceInstant now = clearance_instant(model_, angle, crank_.speed, 0,
                                                         {angle + state[0], crank_.speed * (1 + state[1])});
          if (now.status != Status::done) {
            failed = now, failed_crank = angle;
            return false;
          }
          rate[0] = state[1];
          rate[1] = now.link_acceleration / (crank_.speed * crank_.speed);
          return true;
        },
        y, 0, way,
        {.relative_tolerance = tolerances_.relative,
         .absolute_tolerance = tolerances_.absolute,
         .max_steps = tolerances_.max_steps},
        hooks, workspace_);
    status = ode.status;
    if (stuck) {
      status = Status::limit_reached;
      message = caught_message(ode.t / crank_.speed, crank_.angle + ode.t);
      return false;
    }
    if (status == Status::done) {
      x = y;
      return true;
    }
    if (failed.status != Status::done) {
      status = failed.status;
      message = failure(failed, ode.t / crank_.speed, failed_crank);
    } else {
      message = ode.message;
    }
    return false;
  }

  Status status = Status::done;
  std::string message;

 private:
  const ClearanceFourBar& model_;
  UniformCrank crank_;
  ClearanceTolerances tolerances_;
  const RunContext* context_;
  math::OdeWorkspace workspace_;
};

ClearanceOrbit failed_orbit(ClearanceOrbit orbit, const TurnMap& map) {
  orbit.status = map.status;
  orbit.message = map.message;
  return orbit;
}

}  // namespace

ClearanceRun simulate_clearance(const ClearanceFourBar& model, const math::MotionLaw& crank,
                                const LinkState& start, std::span<const double> times,
                                const ClearanceTolerances& tolerances, const ClearanceOutput& output,
                                const RunContext* context) {
  require_valid(model);
  return FourBarMotion(model, crank, output).run(start, times, tolerances, context);
}

ClearanceOrbit find_orbit(const ClearanceFourBar& model, const UniformCrank& crank, double phase,
                          double slope, const ClearanceTolerances& tolerances, const RunContext* context) {
  constexpr int most = 50;
  constexpr double longest_step = 0.5, converged = 1e-10, difference = 1e-5;
  TurnMap map(model, crank, tolerances, context);
  ClearanceOrbit orbit{.phase = phase, .slope = slope};
  for (;; ++orbit.iterations) {
    std::array<double, 2> end{orbit.phase, orbit.slope};
    if (!map(end)) return failed_orbit(orbit, map);
    // Turns of the link against the crank do not count.
    const std::array<double, 2> gap{math::angle_difference(end[0], orbit.phase), end[1] - orbit.slope};
    orbit.residual = std::max(std::abs(gap[0]), std::abs(gap[1]));
    std::array<double, 4> by;  // derivative of the map, row by row
    for (std::size_t k = 0; k < 2; ++k) {
      std::array<double, 2> more{orbit.phase, orbit.slope}, less = more;
      more[k] += difference;
      less[k] -= difference;
      if (!map(more) || !map(less)) return failed_orbit(orbit, map);
      by[k] = (more[0] - less[0]) / (2 * difference);
      by[2 + k] = (more[1] - less[1]) / (2 * difference);
    }
    orbit.derivative = by;
    const double trace = by[0] + by[3], determinant = by[0] * by[3] - by[1] * by[2];
    const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
    orbit.multipliers = {trace / 2 + root, trace / 2 - root};
    if (orbit.residual <= converged) return orbit;
    const double d = (by[0] - 1) * (by[3] - 1) - by[1] * by[2];
    std::array<double, 2> step{-(gap[0] * (by[3] - 1) - gap[1] * by[1]) / d,
                               -((by[0] - 1) * gap[1] - by[2] * gap[0]) / d};
    const double length = std::hypot(step[0], step[1]);
    if (orbit.iterations == most || !std::isfinite(length)) {
      orbit.status = Status::not_converged;
      orbit.message =
          fmt::format("no periodic motion after {} steps of Newton's method: a turn changes it by {:.3g}",
                      orbit.iterations, orbit.residual);
      return orbit;
    }
    const double part = std::min(1.0, longest_step / length);
    orbit.phase += part * step[0];
    orbit.slope += part * step[1];
  }
}

ClearanceOrbit follow_orbit(const ClearanceFourBar& model, const UniformCrank& crank,
                            const ClearanceOrbit& known, const ClearanceTolerances& tolerances,
                            const RunContext* context) {
  constexpr int most = 8;
  TurnMap map(model, crank, tolerances, context);
  ClearanceOrbit orbit = known;
  const std::array<double, 4>& by = known.derivative;
  const double d = (by[0] - 1) * (by[3] - 1) - by[1] * by[2];
  for (orbit.iterations = 0; orbit.iterations < most; ++orbit.iterations) {
    std::array<double, 2> end{orbit.phase, orbit.slope};
    if (!map(end)) break;
    const std::array<double, 2> gap{math::angle_difference(end[0], orbit.phase), end[1] - orbit.slope};
    const double residual = std::max(std::abs(gap[0]), std::abs(gap[1]));
    if (residual <= 1e-10) {
      orbit.residual = residual;
      return orbit;
    }
    const std::array<double, 2> step{-(gap[0] * (by[3] - 1) - gap[1] * by[1]) / d,
                                     -((by[0] - 1) * gap[1] - by[2] * gap[0]) / d};
    if (!(std::hypot(step[0], step[1]) < 0.1)) break;
    orbit.phase += step[0];
    orbit.slope += step[1];
  }
  return find_orbit(model, crank, known.phase, known.slope, tolerances, context);
}

ClearanceOrbit settle(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                      int turns, double tolerance, const ClearanceTolerances& tolerances,
                      const RunContext* context) {
  LINKWRIGHT_REQUIRE(turns >= 1, "needs 1 turn at least, got {}", turns);
  TurnMap map(model, crank, tolerances, context);
  ClearanceOrbit orbit{.phase = start.angle - crank.angle, .slope = start.rate / crank.speed - 1};
  while (orbit.iterations < turns) {
    std::array<double, 2> end{orbit.phase, orbit.slope};
    if (!map(end)) return failed_orbit(orbit, map);
    ++orbit.iterations;
    orbit.residual =
        std::max(std::abs(math::angle_difference(end[0], orbit.phase)), std::abs(end[1] - orbit.slope));
    orbit.phase = end[0];
    orbit.slope = end[1];
    if (orbit.residual <= tolerance) return orbit;
  }
  orbit.status = Status::not_converged;
  orbit.message = fmt::format("not periodic within {} turns: the last one changed the motion by {:.3g}",
                              turns, orbit.residual);
  return orbit;
}

double phase_error(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                   double phase, int samples, const ClearanceTolerances& tolerances,
                   const RunContext* context) {
  LINKWRIGHT_REQUIRE(samples >= 1, "needs 1 sample at least, got {}", samples);
  TurnMap map(model, crank, tolerances, context);
  std::vector<double> rows(static_cast<std::size_t>(samples));
  std::array<double, 2> x{start.angle - crank.angle, start.rate / crank.speed - 1};
  if (!map(x, rows)) return infinity;
  double sum = 0;
  for (const double psi : rows) sum += (psi - phase) * (psi - phase);
  return std::sqrt(sum) / samples;
}

}  // namespace linkwright::clearance
