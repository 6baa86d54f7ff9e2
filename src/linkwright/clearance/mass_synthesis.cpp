// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/mass_synthesis.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"

namespace linkwright::clearance {
namespace {

using Complex = std::complex<double>;

void limits(const ClearanceMassProblem& p, std::vector<double>& lower, std::vector<double>& upper) {
  for (const Range& r : p.bounds) lower.push_back(r.lower), upper.push_back(r.upper);
}
double sample_angle(const ClearanceMassProblem& p, std::size_t k) {
  return p.crank.angle + std::copysign(full_turn, p.crank.speed) * static_cast<double>(k) / p.samples;
}

// Forces of the ideal pin over a turn against the wanted directions: components across, over the mean of
// those along. Masses that press the pin the wrong way are no answer.
bool force_residuals(const ClearanceMassProblem& p, std::span<const double> x, std::span<double> r) {
  ClearanceFourBar model = with_masses(p.model, x);
  model.clearance = 0;
  double along = 0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    const double angle = sample_angle(p, k);
    const ClearanceInstant now = clearance_instant(model, angle, p.crank.speed, 0, {});
    if (now.status != Status::done) return false;
    const Complex seen = now.pin_force * std::polar(1.0, -(angle + p.phase));
    along -= seen.real();
    r[k] = seen.imag();
  }
  along /= static_cast<double>(r.size());
  if (!(along > 0)) return false;
  for (double& value : r) value /= along;
  return true;
}

// An orbit that is followed from trial to trial.
class OrbitFollower {
 public:
  OrbitFollower(const UniformCrank& crank, const ClearanceTolerances& tolerances, const RunContext* context)
      : crank_(crank), tolerances_(tolerances), context_(context) {}
  bool begin(const ClearanceFourBar& model) {
    const double direction = force_direction(model, crank_.angle, crank_.speed, 0);
    if (!std::isfinite(direction)) return false;
    const double phase = std::remainder(direction - crank_.angle, full_turn);
    return find(model, phase, 0) || find(model, 0, 0);
  }
  bool follow(const ClearanceFourBar& model) {
    const ClearanceOrbit found = follow_orbit(model, crank_, orbit_, tolerances_, context_);
    if (found.status != Status::done) return false;
    orbit_ = found;
    return true;
  }
  const ClearanceOrbit& orbit() const { return orbit_; }

 private:
  bool find(const ClearanceFourBar& model, double phase, double slope) {
    const ClearanceOrbit found = find_orbit(model, crank_, phase, slope, tolerances_, context_);
    if (found.status != Status::done) return false;
    orbit_ = found;
    return true;
  }
  UniformCrank crank_;
  ClearanceTolerances tolerances_;
  const RunContext* context_;
  ClearanceOrbit orbit_;
};

// Rows of one turn of a motion.
template <class Row>
ClearanceRun over_a_turn(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                         std::span<const double> crank_angles, const ClearanceTolerances& tolerances,
                         const RunContext* context, Row&& row) {
  // Rows in the order of time, each angle within the turn that begins with the orbit.
  const double sense = std::copysign(1.0, crank.speed);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < crank_angles.size(); ++k) {
    double way = std::fmod(sense * (crank_angles[k] - crank.angle), full_turn);
    if (way < 0) way += full_turn;
    order.push_back({way / std::abs(crank.speed), k});
  }
  std::sort(order.begin(), order.end());
  std::vector<double> times{0};
  for (const auto& [time, k] : order) times.push_back(time);
  times.push_back(full_turn / std::abs(crank.speed));  // the whole turn, for the tension
  std::size_t next = 0;
  return simulate_clearance(
      model, math::ConstantSpeed{crank.angle, crank.speed}, start, times, tolerances,
      [&](const ClearanceRow& now) {
        if (next > 0 && next <= order.size()) row(order[next - 1].second, now);
        ++next;
        return true;
      },
      context);
}

std::vector<double> even_angles(const UniformCrank& crank, int samples) {
  std::vector<double> out;
  for (int k = 0; k < samples; ++k)
    out.push_back(crank.angle + std::copysign(full_turn, crank.speed) * k / samples);
  return out;
}

math::LeastSquaresOptions local_options() {
  return {.max_iterations = 60,
          .decrease_tolerance = 0,
          .relative_decrease_tolerance = 1e-9,
          .step_tolerance = 1e-10};
}
// Scales of difference quotients, as shares of the ranges; longer ones where an integration leaves its own
// errors in what is differenced.
constexpr double smooth = 0.1, integrated = 1;
std::vector<double> widths(std::span<const double> lower, std::span<const double> upper, double share) {
  std::vector<double> out;
  for (std::size_t k = 0; k < lower.size(); ++k) out.push_back(std::max(share * (upper[k] - lower[k]), 1e-9));
  return out;
}

// Least squares whose variables are shares of their ranges, all damped alike. Mass centres of the rocker
// hardly matter to the clearance link; a damping by the diagonal would let them run until the orbit is lost.
template <class Misfit>
math::LeastSquaresReport minimise_shares(Misfit&& misfit, std::size_t m, std::span<double> x,
                                         std::span<const double> lower, std::span<const double> upper,
                                         double difference, math::LeastSquaresOptions options) {
  const std::size_t n = x.size();
  std::vector<double> there(n), shares(n), zeros(n, 0.0), ones(n, 1.0), scale(n, difference);
  const auto place = [&](std::span<const double> share) {
    for (std::size_t k = 0; k < n; ++k) there[k] = lower[k] + (upper[k] - lower[k]) * share[k];
  };
  for (std::size_t k = 0; k < n; ++k)
    shares[k] = upper[k] > lower[k] ? (x[k] - lower[k]) / (upper[k] - lower[k]) : 0;
  const auto at_shares = [&](std::span<const double> share, std::span<double> r, std::span<double>) {
    place(share);
    return misfit(there, r);
  };
  const auto residuals = [&](std::span<const double> share, std::span<double> r, std::span<double> jacobian) {
    return at_shares(share, r, {}) &&
           (jacobian.empty() ||
            math::bounded_jacobian(at_shares, m, share, zeros, ones, jacobian, scale) == Status::done);
  };
  options.damping = math::Damping::identity;
  options.lambda0 = 1;
  options.jacobian_at_trials = false;
  math::LeastSquaresWorkspace workspace;
  const math::LeastSquaresReport report =
      math::minimise_least_squares(residuals, m, shares, zeros, ones, options, workspace);
  if (report.status != Status::infeasible) {
    place(shares);
    std::copy(there.begin(), there.end(), x.begin());
  }
  return report;
}

}  // namespace

void require_valid(const ClearanceMassProblem& p) {
  require_valid(p.model);
  LINKWRIGHT_REQUIRE(p.model.clearance > 0, "clearance {} m must be positive", p.model.clearance);
  LINKWRIGHT_REQUIRE(p.samples >= 8, "needs 8 samples of a turn at least, got {}", p.samples);
  LINKWRIGHT_REQUIRE(p.crank.speed != 0 && std::isfinite(p.crank.speed) && std::isfinite(p.phase),
                     "crank at {} rad/s, phase {} rad", p.crank.speed, p.phase);
  for (std::size_t k = 0; k < p.bounds.size(); ++k) {
    const bool positive = k == 0 || k == 3 || k == 4 || k == 7;
    LINKWRIGHT_REQUIRE(p.bounds[k].lower <= p.bounds[k].upper && (!positive || p.bounds[k].lower > 0),
                       "variable {} of the masses lies between {} and {}", k, p.bounds[k].lower,
                       p.bounds[k].upper);
  }
}

ClearanceFourBar with_masses(const ClearanceFourBar& model, std::span<const double> x) {
  LINKWRIGHT_REQUIRE(x.size() == clearance_mass_count, "needs {} numbers, got {}", clearance_mass_count,
                     x.size());
  ClearanceFourBar out = model;
  out.coupler = {x[0], x[3], {x[1], x[2]}};
  out.rocker = {x[4], x[7], {x[5], x[6]}};
  return out;
}

double transient_phase_error(const ClearanceMassProblem& p, std::span<const double> x,
                             const RunContext* context) {
  return phase_error(with_masses(p.model, x), p.crank, {p.crank.angle + p.phase, p.crank.speed}, p.phase,
                     p.samples, p.tolerances, context);
}

optimise::Problem clearance_mass_problem(const ClearanceMassProblem& p) {
  require_valid(p);
  static constexpr const char* names[] = {
      "coupler_mass_kg", "coupler_u_m", "coupler_v_m", "coupler_inertia_kg_m2",
      "rocker_mass_kg",  "rocker_u_m",  "rocker_v_m",  "rocker_inertia_kg_m2"};
  optimise::Problem out;
  for (std::size_t k = 0; k < clearance_mass_count; ++k)
    out.variables.push_back({names[k], p.bounds[k].lower, p.bounds[k].upper});
  out.evaluate = [p](const optimise::PopulationView& c, std::span<double> cost, std::span<double> violation) {
    std::array<double, clearance_mass_count> x;
    for (std::size_t i = 0; i < c.size; ++i) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = c(k, i);
      cost[i] = transient_phase_error(p, x);
      violation[i] = std::isfinite(cost[i]) ? 0 : 1;
    }
  };
  out.explain = [p](std::span<const double> x) {
    std::vector<Violation> found;
    if (!std::isfinite(transient_phase_error(p, x))) found.push_back({"rotates_fully", 1});
    return found;
  };
  return out;
}

std::vector<double> force_phase_errors(const ClearanceMassProblem& p, std::span<const double> x) {
  const ClearanceFourBar model = with_masses(p.model, x);
  std::vector<double> out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(p.samples); ++k) {
    const double angle = sample_angle(p, k);
    out.push_back(
        std::remainder(force_direction(model, angle, p.crank.speed, 0) - angle - p.phase, full_turn));
  }
  return out;
}

ClearanceMassDesign clearance_mass_design(const ClearanceMassProblem& p, std::vector<double> x,
                                          const RunContext* context) {
  require_valid(p);
  ClearanceMassDesign out;
  const ClearanceFourBar model = with_masses(p.model, x);
  out.transient_error = transient_phase_error(p, x, context);
  out.x = std::move(x);
  OrbitFollower follower(p.crank, p.tolerances, context);
  if (!follower.begin(model)) {
    out.status = Status::not_converged;
    out.orbit_error = infinity;
    return out;
  }
  out.orbit = follower.orbit();
  double sum = 0;
  const std::vector<double> angles = even_angles(p.crank, p.samples);
  const ClearanceRun run =
      over_a_turn(model, p.crank, out.orbit.start(p.crank), angles, p.tolerances, context,
                  [&](std::size_t, const ClearanceRow& row) {
                    const double off = std::remainder(row.link.angle - row.crank.value - p.phase, full_turn);
                    sum += off * off;
                  });
  out.min_tension = run.min_tension;
  out.orbit_error = run.status == Status::done ? std::sqrt(sum) / p.samples : infinity;
  return out;
}

ClearanceMassDesign synthesise_clearance_masses(const ClearanceMassProblem& p, int starts,
                                                const optimise::Seed& seed, RunContext& context) {
  require_valid(p);
  std::vector<double> lower, upper;
  limits(p, lower, upper);
  const std::vector<double> scale = widths(lower, upper, smooth);
  const auto m = static_cast<std::size_t>(p.samples);

  const auto by_force = [&](std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
    if (!force_residuals(p, x, r)) return false;
    if (jacobian.empty()) return true;
    const auto inner = [&](std::span<const double> at, std::span<double> out, std::span<double>) {
      return force_residuals(p, at, out);
    };
    return math::bounded_jacobian(inner, m, x, lower, upper, jacobian, scale) == Status::done;
  };
  const optimise::MultistartReport seeds = optimise::multistart_least_squares(
      by_force, m, lower.size(), lower, upper,
      [&](std::size_t, RandomStream& random, std::span<double> x) {
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = random.uniform(lower[k], upper[k]);
        return true;
      },
      {.starts = starts, .local = local_options()}, seed, context);
  if (seeds.reached_best == 0)
    return {.status = seeds.status == Status::done ? Status::infeasible : seeds.status};
  std::vector<double> x = seeds.ends[seeds.best].x;
  std::int64_t evaluations = seeds.evaluations;

  OrbitFollower follower(p.crank, p.tolerances, &context);
  Status interrupted = context.interruption();
  if (interrupted == Status::done && follower.begin(with_masses(p.model, x))) {
    const std::vector<double> angles = even_angles(p.crank, p.samples);
    const auto on_periodic_orbit = [&](std::span<const double> at, std::span<double> r) {
      ++evaluations;
      if (context.interrupted()) return false;
      const ClearanceFourBar model = with_masses(p.model, at);
      if (!follower.follow(model)) return false;
      return over_a_turn(model, p.crank, follower.orbit().start(p.crank), angles, p.tolerances, &context,
                         [&](std::size_t k, const ClearanceRow& row) {
                           r[k] = std::remainder(row.link.angle - row.crank.value - p.phase, full_turn);
                         })
                 .status == Status::done;
    };
    math::LeastSquaresOptions options = local_options();
    options.max_iterations = 40;
    options.relative_decrease_tolerance = 1e-4;
    minimise_shares(on_periodic_orbit, m, x, lower, upper, integrated, options);
    interrupted = context.interruption();
  }
  // An interrupted search reports its best as far as that takes no time of its own.
  RunContext last;
  last.set_time_limit(std::chrono::milliseconds(200));
  ClearanceMassDesign out = clearance_mass_design(p, x, interrupted == Status::done ? &context : &last);
  out.evaluations = evaluations;
  if (const Status why = context.interruption(); why != Status::done) out.status = why;
  return out;
}

namespace {

// The search for lengths and masses together: first with the path at zero clearance, then with the path on
// the periodic orbit of the clearance link.
class LinkageAndMasses {
 public:
  LinkageAndMasses(const ClearancePathProblem& path, const ClearanceMassProblem& mass,
                   std::span<const double> path_x, std::span<const double> mass_x, RunContext& context)
      : path_(path),
        mass_(mass),
        context_(context),
        follower_(mass.crank, mass.tolerances, &context),
        x_(path_x.begin(), path_x.end()),
        r_(rows()) {
    for (const Range& r : path.bounds) lower_.push_back(r.lower), upper_.push_back(r.upper);
    limits(mass, lower_, upper_);
    x_.insert(x_.end(), mass_x.begin(), mass_x.end());
    given_ = x_;
    even_enough_ = std::min(0.25, 0.5 * uniformity(model_of(x_)));
  }
  ClearanceDesign run();

 private:
  std::size_t rows() const { return 2 * path_.x.size(); }
  ClearanceFourBar model_of(std::span<const double> at) const {
    ClearanceFourBar model = with_masses(mass_.model, at.subspan(clearance_length_count));
    model.linkage = clearance_path_design(path_, at.first(clearance_length_count)).model.linkage;
    return model;
  }
  void misses(std::size_t k, const Complex& point, std::span<double> r) const {
    r[2 * k] = point.real() - path_.x[k];
    r[2 * k + 1] = point.imag() - path_.y[k];
  }
  double rms(std::span<const double> r) const {
    double sum = 0;
    for (const double value : r) sum += value * value;
    return std::sqrt(sum / static_cast<double>(path_.x.size()));
  }
  double uniformity(const ClearanceFourBar& model) const;
  bool at_zero_clearance(std::span<const double> at, std::span<double> r);
  bool on_periodic_orbit(std::span<const double> at, std::span<double> r);
  template <class Misfit>
  bool minimise(Misfit&& misfit, double share, double decrease, int iterations);
  double on_orbit_from(std::vector<double> start, bool search);
  ClearanceDesign stopped(Status why);

  const ClearancePathProblem& path_;
  const ClearanceMassProblem& mass_;
  RunContext& context_;
  OrbitFollower follower_;
  std::vector<double> lower_, upper_, x_, given_, r_;
  double even_enough_ = 0;  // least uniformity of the force of the ideal pin
  ClearanceDesign out_;
  // The best that any trial has shown: what an interrupted search gives back.
  struct Seen {
    double rms = infinity;
    std::vector<double> x;
    ClearanceOrbit orbit;
    double min_tension = -infinity;
  } seen_;
};

// Least force of the ideal pin over a turn, over the mean one: where it is nearly zero pin and bush part,
// and its direction says nothing of the clearance link.
double LinkageAndMasses::uniformity(const ClearanceFourBar& model) const {
  ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  double least = infinity, mean = 0;
  for (const double angle : even_angles(mass_.crank, mass_.samples)) {
    const ClearanceInstant now = clearance_instant(ideal, angle, mass_.crank.speed, 0, {});
    if (now.status != Status::done) return 0.0;
    least = std::min(least, now.tension);
    mean += now.tension / mass_.samples;
  }
  return mean > 0 ? least / mean : 0.0;
}

// Misses with the clearance link along the force of the ideal joint: no integration.
bool LinkageAndMasses::at_zero_clearance(std::span<const double> at, std::span<double> r) {
  ++out_.evaluations;
  const ClearanceFourBar model = model_of(at);
  if (uniformity(model) < even_enough_) return false;
  for (std::size_t k = 0; k < path_.x.size(); ++k) {
    const double direction = force_direction(model, path_.crank_angles[k], mass_.crank.speed, 0);
    const ClearancePosition p = clearance_position(model, path_.crank_angles[k], direction);
    if (!std::isfinite(direction) || p.status != Status::done) return false;
    misses(k, p.point, r);
  }
  return true;
}

bool LinkageAndMasses::on_periodic_orbit(std::span<const double> at, std::span<double> r) {
  ++out_.evaluations;
  if (context_.interrupted()) return false;
  const ClearanceFourBar model = model_of(at);
  if (!turns_fully(model) || !follower_.follow(model)) return false;
  const ClearanceRun run = over_a_turn(
      model, mass_.crank, follower_.orbit().start(mass_.crank), path_.crank_angles, mass_.tolerances,
      &context_, [&](std::size_t k, const ClearanceRow& row) { misses(k, row.instant->position.point, r); });
  if (run.status != Status::done || !(run.min_tension > 0)) return false;
  if (const double now = rms(r); now < seen_.rms)
    seen_ = {now, {at.begin(), at.end()}, follower_.orbit(), run.min_tension};
  return true;
}

template <class Misfit>
bool LinkageAndMasses::minimise(Misfit&& misfit, double share, double decrease, int iterations) {
  const std::vector<double> scale = widths(lower_, upper_, share);
  const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
    if (!misfit(at, r)) return false;
    if (jacobian.empty()) return true;
    const auto inner = [&](std::span<const double> there, std::span<double> rows, std::span<double>) {
      return misfit(there, rows);
    };
    return math::bounded_jacobian(inner, rows(), at, lower_, upper_, jacobian, scale) == Status::done;
  };
  math::LeastSquaresOptions options = local_options();
  options.max_iterations = iterations;
  options.jacobian_at_trials = false;
  options.relative_decrease_tolerance = decrease;
  options.cost_tolerance = 1e-20;
  math::LeastSquaresWorkspace workspace;
  std::vector<double> end = x_;
  const math::LeastSquaresReport report =
      math::minimise_least_squares(residuals, rows(), end, lower_, upper_, options, workspace);
  if (report.status == Status::infeasible) return false;
  x_ = end;
  return true;
}

// From x, in place: the distance of the path on the orbit; infinite where there is no orbit in contact.
double LinkageAndMasses::on_orbit_from(std::vector<double> start, bool search) {
  x_ = std::move(start);
  if (!follower_.begin(model_of(x_)) || !on_periodic_orbit(x_, r_)) return infinity;
  if (search) minimise([this](auto at, auto r) { return on_periodic_orbit(at, r); }, integrated, 1e-2, 30);
  return follower_.begin(model_of(x_)) && on_periodic_orbit(x_, r_) ? rms(r_) : infinity;
}

ClearanceDesign LinkageAndMasses::stopped(Status why) {
  out_.status = why;
  out_.x = seen_.x.empty() ? given_ : seen_.x;
  out_.model = model_of(out_.x);
  out_.limit_rms = at_zero_clearance(out_.x, r_) ? rms(r_) : infinity;
  out_.path_rms = seen_.rms;
  out_.orbit = seen_.orbit;
  out_.min_tension = seen_.min_tension;
  return out_;
}

ClearanceDesign LinkageAndMasses::run() {
  minimise([&](std::span<const double> at,
               std::span<double> off) { return !context_.interrupted() && at_zero_clearance(at, off); },
           smooth, 1e-6, 200);
  // A design that is good for zero clearance may have no orbit that keeps contact at this clearance.
  double found = on_orbit_from(x_, true);
  std::vector<double> best = x_;
  if (!(found <= on_orbit_from(given_, false))) {
    if (const double other = on_orbit_from(given_, true); other < found) {
      found = other;
      best = x_;
    }
  }
  if (const Status why = context_.interruption(); why != Status::done) return stopped(why);
  x_ = best;
  const bool there = std::isfinite(found) && follower_.begin(model_of(x_));
  out_.x = x_;
  out_.model = model_of(x_);
  out_.limit_rms = at_zero_clearance(x_, r_) ? rms(r_) : infinity;
  out_.path_rms = infinity;
  out_.min_tension = -infinity;
  if (!there || !follower_.follow(out_.model)) {
    out_.status = Status::not_converged;
    const Status why = context_.interruption();
    return why == Status::done ? out_ : stopped(why);
  }
  out_.orbit = find_orbit(out_.model, mass_.crank, follower_.orbit().phase, follower_.orbit().slope,
                          mass_.tolerances, &context_);
  const ClearanceRun run = over_a_turn(
      out_.model, mass_.crank, out_.orbit.start(mass_.crank), path_.crank_angles, mass_.tolerances, &context_,
      [&](std::size_t k, const ClearanceRow& row) { misses(k, row.instant->position.point, r_); });
  if (const Status why = context_.interruption(); why != Status::done) return stopped(why);
  if (run.status == Status::done) out_.path_rms = rms(r_);
  out_.min_tension = run.min_tension;
  return out_;
}

}  // namespace

ClearanceDesign design_clearance_linkage(const ClearancePathProblem& path, const ClearanceMassProblem& mass,
                                         std::span<const double> path_x, std::span<const double> mass_x,
                                         RunContext& context) {
  require_valid(path);
  require_valid(mass);
  LINKWRIGHT_REQUIRE(!path.free_timing, "both stages at once need prescribed crank angles, got {} free ones",
                     path.x.size());
  LINKWRIGHT_REQUIRE(path_x.size() == clearance_length_count && mass_x.size() == clearance_mass_count,
                     "{} lengths and {} masses", path_x.size(), mass_x.size());
  return LinkageAndMasses(path, mass, path_x, mass_x, context).run();
}

}  // namespace linkwright::clearance
