// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/speed_fluctuation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/ode.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/scan.h"

namespace linkwright::planar {
namespace {

void require(const Linkage& l, const LinkagePlan& plan, const SpeedFluctuationSetup& s) {
  LINKWRIGHT_REQUIRE(plan.inputs() == 1 && plan.closed_form() && periodic(plan, 0),
                     "a speed fluctuation needs one input that turns, in closed form, and {} inputs are here",
                     plan.inputs());
  LINKWRIGHT_REQUIRE(plan.has_masses, "a speed fluctuation needs the mass of every body: '{}' has none",
                     plan.massless[0]);
  LINKWRIGHT_REQUIRE(
      std::isfinite(s.start + s.mean_speed) && s.mean_speed != 0 && s.fluctuation > 0 && s.samples >= 16,
      "start {}, mean speed {}, fluctuation {}, {} samples", s.start, s.mean_speed, s.fluctuation, s.samples);
  const auto by_time = [](const auto& load) { return goes_by(load, LoadArgument::time); };
  LINKWRIGHT_REQUIRE(std::none_of(l.forces.begin(), l.forces.end(), by_time) &&
                         std::none_of(l.torques.begin(), l.torques.end(), by_time) &&
                         std::none_of(l.struts.begin(), l.struts.end(), by_time),
                     "{} loads, one of which goes by time: a cycle has none",
                     l.forces.size() + l.torques.size() + l.struts.size());
}

// Turns after which all loads that go by the input repeat; 0 when there are none up to so many.
int turns_of_cycle(const Linkage& l) {
  constexpr int max_turns = 64;
  constexpr double same = 1e-9;
  const auto repeats = [](const auto& load, int turns) {
    if (load.factor.against != LoadArgument::input) return true;
    const double period = period_of(load.factor, true), count = full_turn * turns / period;
    return period == 0 || std::abs(count - std::round(count)) <= same * count;
  };
  for (int turns = 1; turns <= max_turns; ++turns)
    if (std::all_of(l.forces.begin(), l.forces.end(), [&](const auto& f) { return repeats(f, turns); }) &&
        std::all_of(l.torques.begin(), l.torques.end(), [&](const auto& t) { return repeats(t, turns); }) &&
        std::all_of(l.struts.begin(), l.struts.end(), [&](const auto& s) { return repeats(s, turns); }))
      return turns;
  return 0;
}

// True if the input rotates fully; else says why not.
template <class Answer>
bool rotates_fully(const LinkagePlan& plan, const SpeedFluctuationSetup& s, Answer& out) {
  const LinkageMotion motion(plan);
  const BranchPath path =
      branch_path(plan, std::span(&s.start, 1), 0, motion.modes, s.start - 1, s.start + 1);
  if (path.status != Status::done) {
    out.status = path.status;
    out.message = say("it does not assemble at {}", degrees_of(s.start, 6).spelled());
  } else if (path.period == 0) {
    out.status = Status::limit_reached;
    out.message =
        say("the input does not rotate fully: it goes from {} to {}",
            degrees_of(path.low.value, 6).spelled().sharing_unit(), degrees_of(path.high.value, 6).spelled());
  } else if (!path.change_points.empty()) {
    out.status = Status::infeasible;
    out.message = say("the cycle passes through a change point at {}",
                      degrees_of(path.change_points.front().value, 6).spelled());
  }
  return out.status == Status::done;
}

// True if the loads repeat after whole turns; sets after how many.
template <class Answer>
bool has_cycle(const Linkage& l, Answer& out) {
  out.turns = turns_of_cycle(l);
  if (out.turns > 0) return true;
  out.status = Status::infeasible;
  out.message =
      "the loads do not repeat after whole turns of the input: their periods do not divide up to 64 turns";
  return false;
}

// Running integral over the cycle, by the cubic through four neighbours; periodic.
std::vector<double> integral(const std::vector<double>& f, double step) {
  const std::size_t n = f.size();
  std::vector<double> out(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i)
    out[i + 1] = out[i] + step / 24 * (13 * (f[i] + f[i + 1]) - f[(i + n - 1) % n] - f[(i + 2) % n]);
  return out;
}

// Speeds over the cycle with energies E + c and inertias J + extra, so that the turn takes its time: its mean
// over the angle of one over the speed is one over the mean speed.
std::vector<double> speeds(const SpeedFluctuation& cycle, double extra, double mean) {
  const std::size_t n = cycle.input.size();
  const double least = *std::min_element(cycle.energy.begin(), cycle.energy.end());
  std::vector<double> out(n);
  const auto slowness = [&](double c) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = std::sqrt(2 * (cycle.energy[i] - least + c) / (cycle.inertia[i] + extra));
      sum += 1 / out[i];
    }
    return sum / static_cast<double>(n);
  };
  // More energy, less time. The answer lies between nearly none and far more than the mean speed needs.
  const double most = *std::max_element(cycle.inertia.begin(), cycle.inertia.end()) + extra;
  const auto slow = [&](double c) { return slowness(c) > 1 / mean; };
  double high = most * mean * mean + cycle.energy_fluctuation;
  while (slow(high)) high *= 2;
  slowness(math::bisect(slow, 0, high, {}).outside);
  return out;
}
double spread(const std::vector<double>& speeds, double mean) {
  const auto [least, most] = std::minmax_element(speeds.begin(), speeds.end());
  return (*most - *least) / mean;
}

}  // namespace

SpeedFluctuation speed_fluctuation(const Linkage& linkage, const LinkagePlan& plan,
                                   const SpeedFluctuationSetup& setup, const RunContext* context) {
  constexpr int between_looks = 1024;
  require(linkage, plan, setup);
  SpeedFluctuation out;
  if (!rotates_fully(plan, setup, out) || !has_cycle(linkage, out)) return out;
  Linkage l = linkage;
  std::erase_if(l.torques, [](const BodyTorque& t) { return goes_by(t, LoadArgument::speed); });
  const double speed = setup.mean_speed, sense = speed > 0 ? 1 : -1, mean = std::abs(speed);
  const double step = full_turn / setup.samples;
  LinkageMotion motion(plan);
  LinkageForces forces;
  double sum = 0;
  const int samples = out.turns * setup.samples;
  for (int i = 0; i < samples; ++i) {
    if (context && i % between_looks == 0 && (out.status = context->interruption()) != Status::done) {
      out.message = "interrupted before the cycle was known";
      return out;
    }
    const InputMotion input{setup.start + sense * i * step, speed, 0};
    solve_motion(plan, std::span(&input, 1), motion);
    solve_forces(l, plan, motion, 0, input.value, forces);
    if (forces.status != Status::done) {
      out.status = forces.status;
      out.message = say("no answer at {}", degrees_of(input.value, 6).spelled());
      return out;
    }
    out.input.push_back(input.value);
    out.inertia.push_back(2 * kinetic_energy(plan, motion) / (speed * speed));
    out.torque.push_back((forces.weight_power + forces.load_power) / speed);
    sum += out.torque.back();
  }
  out.motor_torque = -sum / samples;
  std::vector<double> excess;
  for (const double q : out.torque) excess.push_back(sense * (q + out.motor_torque));
  out.energy = integral(excess, step);
  const auto [least, most] = std::minmax_element(out.energy.begin(), out.energy.end());
  out.energy_fluctuation = *most - *least;
  out.speed = speeds(out, 0, mean);
  out.fluctuation = spread(out.speed, mean);
  const auto excessive = [&](double flywheel) {
    throw_if_interrupted(context);
    out.with_flywheel = speeds(out, flywheel, mean);
    return spread(out.with_flywheel, mean) > setup.fluctuation;
  };
  try {
    if (excessive(0)) {
      double low = 0, high = out.energy_fluctuation / (setup.fluctuation * mean * mean) + out.inertia[0];
      while (excessive(high)) low = high, high *= 2;
      out.flywheel = math::bisect(excessive, low, high, {.relative = 1e-12, .halvings = 100}).outside;
      excessive(out.flywheel);
    }
  } catch (const Interrupted& why) {
    out.status = why.status();
    out.message = "interrupted before the flywheel was found";
    out.flywheel = nan;
    out.with_flywheel.assign(out.speed.size(), out.flywheel);
  }
  for (std::vector<double>* s : {&out.speed, &out.with_flywheel})
    for (double& v : *s) v *= sense;
  return out;
}

SteadyCycle steady_cycle(const Linkage& l, const LinkagePlan& plan, const SpeedFluctuationSetup& setup,
                         const RunContext* context) {
  require(l, plan, setup);
  SteadyCycle out;
  if (!rotates_fully(plan, setup, out) || !has_cycle(l, out)) return out;
  const double sense = setup.mean_speed > 0 ? 1 : -1;
  LinkageDynamics dynamics(l, plan, {true});
  math::OdeWorkspace workspace;
  std::vector<double> angles;
  for (int i = 0; i <= out.turns * setup.samples; ++i)
    angles.push_back(setup.start + sense * full_turn * i / setup.samples);
  // Squared speed, which goes through zero evenly where the machine stops, and time over the angle.
  const auto slope = [&](double angle, std::span<const double> y, std::span<double> rate) {
    if (!(y[0] > 0)) return false;
    InputMotion input{angle, sense * std::sqrt(y[0]), 0};
    if (dynamics.solve(0, std::span(&input, 1)) != Status::done) return false;
    rate[0] = 2 * input.acceleration;
    rate[1] = 1 / input.rate;
    return true;
  };
  const math::OdeOptions options{.relative_tolerance = 1e-11,
                                 .absolute_tolerance = 1e-12 * setup.mean_speed * setup.mean_speed};
  // The speed after a turn that begins with `speed`.
  const auto turn = [&](double speed) {
    std::array<double, 2> y{speed * speed, 0};
    out.input.clear();
    out.speed.clear();
    math::OdeHooks hooks{.output_times = angles, .context = context};
    hooks.output = [&](double angle, std::span<const double> now) {
      out.input.push_back(angle);
      out.speed.push_back(sense * std::sqrt(std::max(now[0], 0.0)));
      return true;
    };
    const math::OdeReport report =
        math::integrate(slope, y, angles.front(), angles.back(), options, hooks, workspace);
    ++out.cycles;
    out.period = y[1];
    out.status = report.status;
    const bool given_up = report.status == Status::limit_reached || report.status == Status::not_converged ||
                          report.status == Status::infeasible;
    if (given_up && y[0] < 1e-3 * setup.mean_speed * setup.mean_speed) {
      out.status = Status::limit_reached;
      out.message =
          say("it comes to rest at {}: the motor does not carry it over", degrees_of(report.t, 6).spelled());
    } else if (report.status != Status::done) {
      out.message = say("at {}: {}", degrees_of(report.t, 6).spelled(), report.message);
    }
    return sense * std::sqrt(std::max(y[0], 0.0));
  };
  double speed = setup.mean_speed, last = 0, last_gain = 0;
  for (int cycle = 0; cycle < 200; ++cycle) {
    const double gain = turn(speed) - speed;
    if (out.status != Status::done) return out;
    if (std::abs(gain) <= 1e-9 * std::abs(speed)) {
      out.mean_speed = sense * out.turns * full_turn / out.period;
      out.fluctuation = spread(out.speed, out.mean_speed) * sense;
      return out;
    }
    double next = speed + gain;
    // The secant, where it does not leap.
    if (cycle > 0 && gain != last_gain) {
      const double aim = speed - gain * (speed - last) / (gain - last_gain);
      if (aim / speed > 0.5 && aim / speed < 2) next = aim;
    }
    last = speed;
    last_gain = gain;
    speed = next;
  }
  out.status = Status::not_converged;
  out.message =
      "the speed does not become periodic: only a motor whose torque depends on its speed makes it so";
  return out;
}

}  // namespace linkwright::planar
