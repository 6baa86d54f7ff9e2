// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/flexible/chain_equations.h"
#include "linkwright/flexible/links.h"
#include "linkwright/flexible/modes.h"

namespace linkwright::flexible {

namespace {

constexpr int max_refinements = 12, max_halvings = 6;

// The drive: exactly one of both laws.
struct Drive {
  const AngleLaw* motion = nullptr;
  const TorqueLaw* torque = nullptr;
};

// Parameters of the generalised-alpha method.
struct Method {
  explicit Method(double radius)
      : alpha_m((2 * radius - 1) / (radius + 1)),
        alpha_f(radius / (radius + 1)),
        gamma(0.5 - alpha_m + alpha_f),
        beta((gamma + 0.5) * (gamma + 0.5) / 4),
        share((1 - alpha_f) / (1 - alpha_m)) {}
  double alpha_m, alpha_f, gamma, beta;
  double share;  // share of the new acceleration in the new auxiliary one

  TangentScale scale(double h) const { return {1 / (share * beta * h * h), gamma / (beta * h)}; }
};

class Run {
 public:
  Run(const Chain& chain, const Drive& drive, const SimulationOptions& options, const Start& start,
      int halvings)
      : chain_(chain),
        drive_(drive),
        options_(options),
        method_(options.spectral_radius),
        pieces_(1 << halvings),
        equations_(chain),
        now_(state_at_rest(chain)),
        next_(now_),
        auxiliary_(now_.q.size() + 1),
        change_(now_.q.size()) {
    if (!start.q.empty()) now_.q = start.q;
    if (!start.v.empty()) now_.v = start.v;
    now_.angle = start.angle;
    now_.rate = start.rate;
    const std::vector<std::size_t> joints = hinges(chain);
    for (const HingeDrive& d : options.hinges) {
      motors_.push_back(joints.at(d.hinge));
      if (d.motion) equations_.lock_turn(motors_.back());
    }
  }

  Simulation go() {
    std::vector<double> stops(options_.breaks.begin(), options_.breaks.end());
    std::sort(stops.begin(), stops.end());
    const double dt = options_.output_interval;
    const long intervals = std::lround(std::ceil(options_.end / dt * (1 - 4 * tolerance::epsilon)));
    take_hub(std::nextafter(0.0, 1.0));
    settle(std::nextafter(0.0, 1.0));
    sample(0);
    std::size_t stop = 0;
    while (stop < stops.size() && stops[stop] <= 0) ++stop;
    double t = 0;
    for (long i = 1; i <= intervals && going(); ++i) {
      const double until = i == intervals ? options_.end : double(i) * dt;
      while (stop < stops.size() && stops[stop] < until && going()) {
        advance(t, stops[stop], true);
        t = stops[stop++];
      }
      const bool jump = stop < stops.size() && stops[stop] == until;
      stop += jump;
      if (going()) advance(t, until, jump);
      t = until;
      if (going()) sample(t);
    }
    if (halved_ > 0)
      out_.warnings.push_back(
          fmt::format("{} steps did not converge and were halved: take a shorter step", halved_));
    out_.last = now_;
    return std::move(out_);
  }

 private:
  bool going() const { return out_.status == Status::done; }

  // Turns of the hinges, or torques in them, at a time.
  void take_hinges(double t, ChainState& state) {
    for (std::size_t k = 0; k < motors_.size(); ++k) {
      const HingeDrive& d = options_.hinges[k];
      const std::size_t i = coordinates_per_cell * motors_[k] + turn;
      if (d.torque) {
        equations_.set_motor(motors_[k], (*d.torque)(t));
      } else {
        const HubMotion m = (*d.motion)(t);
        state.q[i] = m.angle;
        state.v[i] = m.rate;
        state.a[i] = m.acceleration;
      }
    }
  }
  double motor_power() const {
    double out = 0;
    for (const std::size_t s : motors_)
      out += equations_.motor_torque(s) * now_.v[coordinates_per_cell * s + turn];
    return out;
  }

  void take_hub(double t) {
    take_hinges(t, now_);
    if (!drive_.motion) return;
    const HubMotion m = (*drive_.motion)(t);
    now_.angle = m.angle;
    now_.rate = m.rate;
    now_.acceleration = m.acceleration;
  }

  // The rest of the hub's balance of torque (N m).
  double hub_residual(double t) const {
    return drive_.torque ? equations_.forces().torque - (*drive_.torque)(t) : 0;
  }

  // Accelerations that belong to the place, the rates and the drive after a jump. Vibrations that a step
  // cannot follow, and turns without mass, are held by their springs, as the method does it.
  void settle(double t) {
    const double h = std::min(options_.step, options_.output_interval) / double(pieces_);
    const TangentScale scale{.acceleration = method_.scale(h).acceleration};
    equations_.evaluate(now_);
    equations_.factor(scale, drive_.torque != nullptr);
    ++out_.factorisations;
    const double hub = equations_.solve(equations_.residual(), hub_residual(t), change_);
    for (std::size_t i = 0; i < change_.size(); ++i) {
      now_.a[i] += scale.acceleration * change_[i];
      auxiliary_[i] += scale.acceleration * change_[i];
    }
    if (drive_.torque) {
      now_.acceleration += scale.acceleration * hub;
      auxiliary_.back() += scale.acceleration * hub;
    }
    factored_ = false;
    equations_.evaluate(now_);
    power_ = torque(t) * now_.rate + motor_power();
    loss_ = lossy() ? equations_.energy(now_).loss : 0;
  }

  bool lossy() const {
    bool joints = false;
    for (const Cell& cell : chain_.cells) joints = joints || cell.damping > 0;
    return joints || chain_.mass_damping > 0 || chain_.stiffness_damping > 0 || chain_.hub_damping > 0;
  }
  double torque(double t) const { return drive_.torque ? (*drive_.torque)(t) : equations_.forces().torque; }

  // From one time to another in equal steps; after a jump of the drive the accelerations are found again.
  void advance(double from, double to, bool jump) {
    const long count = std::max(1L, std::lround(std::ceil((to - from) / options_.step - 1e-9))) * pieces_;
    const double h = (to - from) / double(count);
    if (!(std::abs(h - step_) <= 1e-9 * h)) factored_ = false;
    step_ = h;
    out_.step = std::max(out_.step, h);
    for (long i = 1; i <= count && going(); ++i) {
      const bool last = i == count;
      const double t = last ? to : from + double(i) * h;
      step(h, last && jump ? std::nextafter(t, 0.0) : t);
      if (options_.context && out_.steps % 128 == 0) look(t);
    }
    if (jump && going()) {
      const double after = std::nextafter(to, infinity);
      take_hub(after);
      settle(after);
    }
  }

  void look(double t) {
    const Status why = options_.context->interruption();
    if (why != Status::done) {
      out_.status = why;
      out_.message = fmt::format("stopped at {:.6g} s", t);
    }
    options_.context->report({.stage = "simulation", .fraction = t / options_.end});
  }

  // A step that does not converge is made in two halves, down to a 64th.
  void step(double h, double t, int halvings = 0) {
    if (attempt(h, t)) return;
    factored_ = false;
    if (halvings == max_halvings) {
      out_.status = Status::not_converged;
      out_.message = fmt::format("the step of {:.4g} s to {:.6g} s does not converge", h, t);
      return;
    }
    ++halved_;
    step(h / 2, t - h / 2, halvings + 1);
    if (going()) step(h / 2, t, halvings + 1);
    factored_ = false;
  }

  bool attempt(double h, double t) {
    const TangentScale scale = method_.scale(h);
    // The old acceleration as a guess of the new one; everything else of the new state follows from it.
    const auto predict = [&](double q, double v, double a, double aux, double& q1, double& v1, double& rest) {
      rest = (method_.alpha_f * a - method_.alpha_m * aux) / (1 - method_.alpha_m);
      const double aux1 = rest + method_.share * a;
      q1 = q + h * v + h * h * ((0.5 - method_.beta) * aux + method_.beta * aux1);
      v1 = v + h * ((1 - method_.gamma) * aux + method_.gamma * aux1);
    };
    rest_.resize(auxiliary_.size());
    for (std::size_t i = 0; i < change_.size(); ++i)
      predict(now_.q[i], now_.v[i], now_.a[i], auxiliary_[i], next_.q[i], next_.v[i], rest_[i]);
    next_.a = now_.a;
    take_hinges(t, next_);
    if (drive_.motion) {
      const HubMotion m = (*drive_.motion)(t);
      next_.angle = m.angle;
      next_.rate = m.rate;
      next_.acceleration = m.acceleration;
    } else {
      predict(now_.angle, now_.rate, now_.acceleration, auxiliary_.back(), next_.angle, next_.rate,
              rest_.back());
      next_.acceleration = now_.acceleration;
    }

    double before = infinity;
    bool met = false;
    for (int i = 0;; ++i) {
      equations_.evaluate(next_);
      const double hub = hub_residual(t);
      const double left = std::max(equations_.relative_residual(), std::abs(hub) / equations_.moment_scale());
      met = left <= options_.newton_tolerance;
      if (met || !std::isfinite(left) || i == options_.max_iterations) break;
      if (!factored_ || left > 0.1 * before) {
        factored_ = equations_.factor(scale, drive_.torque != nullptr);
        ++out_.factorisations;
        if (!factored_) break;
      }
      before = left;
      const double turned_by = equations_.solve(equations_.residual(), hub, change_);
      ++out_.iterations;
      double most = std::abs(turned_by);
      for (std::size_t k = 0; k < change_.size(); ++k) {
        const double dq = change_[k];
        next_.q[k] += dq;
        next_.v[k] += scale.rate * dq;
        next_.a[k] += scale.acceleration * dq;
        most = std::max(most, std::abs(dq) / (k % coordinates_per_cell == turn ? 1 : chain_length_));
      }
      next_.angle += turned_by;
      next_.rate += scale.rate * turned_by;
      next_.acceleration += scale.acceleration * turned_by;
      if (most < tolerance::epsilon / 4) {  // nothing left to change
        equations_.evaluate(next_);
        met = true;
        break;
      }
    }
    if (!met) return false;
    ++out_.steps;
    for (std::size_t i = 0; i < change_.size(); ++i) auxiliary_[i] = rest_[i] + method_.share * next_.a[i];
    auxiliary_.back() = rest_.back() + method_.share * next_.acceleration;
    std::swap(now_, next_);

    const double power = torque(t) * now_.rate + motor_power();
    work_ += h / 2 * (power_ + power);
    power_ = power;
    if (lossy()) {
      const double loss = equations_.energy(now_).loss;
      dissipated_ += h / 2 * (loss_ + loss);
      loss_ = loss;
    }
    const double kink = largest_kink(chain_, now_.q);
    out_.largest_kink = std::max(out_.largest_kink, kink);
    out_.fastest = std::max(out_.fastest, std::abs(now_.rate));
    if (kink > fold_limit) {
      out_.status = Status::limit_reached;
      out_.message = fmt::format("two bars at {:.1f} deg at {:.6g} s: the chain folded", kink * 180 / pi, t);
    }
    return true;
  }

  void sample(double t) {
    const ChainForces& f = equations_.evaluate(now_);
    const ChainEnergy e = equations_.energy(now_);
    const math::Vec2 tip = equations_.tip();
    double bending = nan;
    if (chain_.kinematics != Kinematics::source_linearised) {
      bending = 0;
      for (const SectionForce& cut : equations_.sections()) bending = std::max(bending, std::abs(cut.moment));
    }
    out_.samples.push_back({.time = t,
                            .angle = now_.angle,
                            .rate = now_.rate,
                            .acceleration = now_.acceleration,
                            .torque = torque(t),
                            .tip_xi = tip.x - chain_.hub_radius - chain_length_,
                            .tip_eta = tip.y,
                            .tip_angle = equations_.tip_angle(),
                            .reaction_xi = f.reaction.x,
                            .reaction_eta = f.reaction.y,
                            .moment = f.moment,
                            .bending_moment = bending,
                            .kinetic = e.kinetic,
                            .potential = e.potential,
                            .work = work_,
                            .dissipated = dissipated_,
                            .angular_momentum = e.angular_momentum});
    if (options_.keep_states) out_.states.push_back(now_);
    if (!motors_.empty()) {
      std::vector<double>& torques = out_.hinge_torques.emplace_back();
      for (const std::size_t s : motors_) torques.push_back(equations_.motor_torque(s));
    }
  }

  const Chain& chain_;
  const Drive& drive_;
  const SimulationOptions& options_;
  const Method method_;
  const long pieces_;
  ChainEquations equations_;
  ChainState now_, next_;
  std::vector<double> auxiliary_, rest_, change_;  // the hub's last
  std::vector<std::size_t> motors_;                // cells of the driven hinges
  const double chain_length_ = chain_.length();
  bool factored_ = false;
  long halved_ = 0;
  double step_ = 0, power_ = 0, work_ = 0, loss_ = 0, dissipated_ = 0;
  Simulation out_;
};

constexpr double Sample::*quantities[] = {
    &Sample::angle,        &Sample::rate,    &Sample::acceleration,   &Sample::torque,
    &Sample::tip_xi,       &Sample::tip_eta, &Sample::tip_angle,      &Sample::reaction_xi,
    &Sample::reaction_eta, &Sample::moment,  &Sample::bending_moment, &Sample::kinetic,
    &Sample::potential,    &Sample::work,    &Sample::dissipated,     &Sample::angular_momentum};

// The limit of two runs, in the finer one; how far it moved the tip.
double extrapolate(const Simulation& coarse, Simulation& fine) {
  double moved = 0;
  const std::size_t common = std::min(coarse.samples.size(), fine.samples.size());
  for (std::size_t i = 0; i < common; ++i) {
    const Sample& rough = coarse.samples[i];
    Sample& s = fine.samples[i];
    moved = std::max(moved, std::hypot(s.tip_xi - rough.tip_xi, s.tip_eta - rough.tip_eta) / 3);
    for (const auto quantity : quantities) s.*quantity += (s.*quantity - rough.*quantity) / 3;
  }
  const auto limit = [](double& value, double rough) { value += (value - rough) / 3; };
  const auto limits = [&](std::vector<double>& values, const std::vector<double>& roughs) {
    for (std::size_t k = 0; k < values.size(); ++k) limit(values[k], roughs[k]);
  };
  for (std::size_t i = 0; i < std::min(coarse.states.size(), fine.states.size()); ++i) {
    const ChainState& rough = coarse.states[i];
    ChainState& s = fine.states[i];
    limit(s.angle, rough.angle);
    limit(s.rate, rough.rate);
    limit(s.acceleration, rough.acceleration);
    limits(s.q, rough.q);
    limits(s.v, rough.v);
    limits(s.a, rough.a);
  }
  for (std::size_t i = 0; i < std::min(coarse.hinge_torques.size(), fine.hinge_torques.size()); ++i)
    limits(fine.hinge_torques[i], coarse.hinge_torques[i]);
  return moved;
}

// Warns of motions for which the chain is too coarse.
void doubt(const Chain& chain, Simulation& out) {
  Chain rigid = chain;  // along the link, which has no part in it
  rigid.extensible = false;
  if (out.fastest > 0)
    if (const auto critical = critical_speed(rigid, out.fastest)) {
      out.unstable = true;
      out.warnings.insert(
          out.warnings.begin(),
          fmt::format("the hub turned at {:.6g} rad/s, but the straight chain of {} cells with {} kinematics "
                      "is unstable "
                      "beyond {:.6g} rad/s: take more divisions{}",
                      out.fastest, chain.cells.size(), name_of(chain.kinematics), *critical,
                      chain.kinematics == Kinematics::chord_consistent ? "" : " or chord_consistent"));
    }
  if (out.largest_kink > kink_limit)
    out.warnings.push_back(
        fmt::format("two bars stood at {:.3g} rad to each other, more than {}: take more divisions",
                    out.largest_kink, kink_limit));
}

Simulation simulate(const Chain& chain, const Drive& drive, const SimulationOptions& o, const Start& start) {
  LINKWRIGHT_REQUIRE(o.end > 0 && o.output_interval > 0 && o.step > 0 && std::isfinite(o.end / o.step),
                     "end {} s, output interval {} s, step {} s: all must be positive", o.end,
                     o.output_interval, o.step);
  LINKWRIGHT_REQUIRE(o.spectral_radius >= 0 && o.spectral_radius < 1, "spectral radius {}",
                     o.spectral_radius);
  LINKWRIGHT_REQUIRE(o.newton_tolerance > 0 && o.max_iterations > 0, "tolerance {}, {} iterations",
                     o.newton_tolerance, o.max_iterations);
  const std::size_t n = coordinates_per_cell * chain.cells.size();
  LINKWRIGHT_REQUIRE((start.q.empty() || start.q.size() == n) && (start.v.empty() || start.v.size() == n),
                     "a start of {} coordinates and {} rates for {}", start.q.size(), start.v.size(), n);
  const std::size_t joints = hinges(chain).size();
  for (const HingeDrive& d : o.hinges)
    LINKWRIGHT_REQUIRE(d.hinge < joints && d.motion.has_value() != d.torque.has_value(),
                       "a drive of hinge {} of {} with {} laws", d.hinge, joints,
                       int(d.motion.has_value()) + int(d.torque.has_value()));
  for (const double b : o.breaks) LINKWRIGHT_REQUIRE(std::isfinite(b), "a break at {} s", b);

  Simulation out = Run(chain, drive, o, start, 0).go();
  if (o.extrapolate) {
    for (int halvings = 1;; ++halvings) {
      Simulation coarse = std::move(out);
      out = Run(chain, drive, o, start, halvings).go();
      out.steps += coarse.steps;
      out.iterations += coarse.iterations;
      out.factorisations += coarse.factorisations;
      const bool stopped = out.status == Status::cancelled || out.status == Status::deadline;
      const bool both = coarse.status == Status::done && out.status == Status::done;
      if (stopped && coarse.samples.size() > out.samples.size()) {
        // The run with the longer step went further than the interrupted one with the shorter step.
        coarse.status = out.status;
        coarse.message = fmt::format(
            "the run with half the step was {}; the results are those of the whole step", out.message);
        coarse.error = nan;
        coarse.steps = out.steps;
        coarse.iterations = out.iterations;
        coarse.factorisations = out.factorisations;
        out = std::move(coarse);
        break;
      }
      Simulation limit = out;
      if (coarse.status == Status::done) {
        limit.error = extrapolate(coarse, limit);
      } else {
        limit.error = nan;
        limit.warnings.push_back(
            "the run with twice the step failed, so there is no estimate of the error: " + coarse.message);
      }
      const bool good = both && (o.tolerance <= 0 || limit.error <= o.tolerance);
      const bool last = stopped || o.tolerance <= 0 || halvings == max_refinements;
      if (good || last) {
        out = std::move(limit);
        if (!good && out.status == Status::done && o.tolerance > 0) {
          out.status = Status::not_converged;
          out.message =
              fmt::format("the tip is known to {:.3g} m only, not to {:.3g} m", out.error, o.tolerance);
        }
        break;
      }
    }
  }
  doubt(chain, out);
  return out;
}

}  // namespace

Simulation simulate_motion(const Chain& chain, AngleLaw law, const SimulationOptions& options,
                           const Start& start) {
  return simulate(chain, {.motion = &law}, options, start);
}

Simulation simulate_torque(const Chain& chain, TorqueLaw law, const SimulationOptions& options,
                           const Start& start) {
  return simulate(chain, {.torque = &law}, options, start);
}

}  // namespace linkwright::flexible
