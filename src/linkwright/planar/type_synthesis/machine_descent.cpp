// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/machine_descent.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/planar/type_synthesis/curve.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t limit_samples = 96;        // crank angles at which pair angles are looked at
constexpr std::size_t max_peaks = 24;            // terms of an objective that a step heeds
constexpr double lowest_peak = 0.6;              // of the largest: lower ones are left out
constexpr double pair_margin = 0.05 * pi / 180;  // as the polish keeps it
constexpr double heeded = 0.5;                   // limits that are further off are left out
constexpr double heeded_errors = 0.3;            // of the greatest allowed: smaller ones are left out
constexpr double first_radius = 0.05, max_radius = 0.5, min_radius = 2e-4;  // of a step, in parameters
constexpr int max_steps_down = 40, max_small_steps = 3;
constexpr double small_gain = 1e-3;

/// What a parameter may well change by.
double scale_of(double x) { return std::abs(x) + 0.1; }

std::vector<MachineQuantity> quantities_of(const RefineOptions& options) {
  std::vector<MachineQuantity> out;
  for (const MachineObjective& objective : options.objectives) out.push_back(objective.quantity);
  return out;
}

/// Numbers of the local maxima of rows over the turn that come near the largest of all, at most `max_peaks`.
std::vector<std::size_t> peaks_of(const QuantityTerms& terms) {
  const std::vector<double>& v = terms.values;
  const double least = lowest_peak * terms.largest();
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t first = i / terms.series * terms.series, k = i - first;
    const bool begins = terms.ends && k == 0, ends = terms.ends && k + 1 == terms.series;
    const double before = begins ? -infinity : v[first + (k + terms.series - 1) % terms.series],
                 after = ends ? -infinity : v[first + (k + 1) % terms.series];
    if (v[i] >= least && v[i] >= before && (v[i] > after || terms.series == 1)) out.push_back(i);
  }
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return v[a] > v[b]; });
  if (out.size() > max_peaks) out.resize(max_peaks);
  return out;
}

}  // namespace

MachineDescent::MachineDescent(const MotionTarget& target, const RefineOptions& options)
    : target_(target),
      options_(options),
      fitter_(target, options.limits),
      objectives_(target, quantities_of(options), options.loads, options.length_tolerance),
      dimensions_(options.limits) {}

std::vector<double> MachineDescent::largest(const std::vector<QuantityTerms>& terms) {
  std::vector<double> out;
  for (const QuantityTerms& t : terms) out.push_back(t.largest());
  return out;
}

std::vector<double> MachineDescent::values_of(const FittedMachine& machine) {
  return objectives_.evaluate(machine, fitter_, terms_) ? largest(terms_) : std::vector<double>();
}

/// True for an unknown of a function's machine that changes nothing but where it stands: its place and turn,
/// and the scale that an angle does not depend on.
bool MachineDescent::is_held(std::size_t unknown, const FittedMachine& machine) const {
  const auto place = static_cast<std::size_t>(machine.shape.program->place());
  if (!target_.is_function() || unknown < place || unknown >= place + 4) return false;
  return !target_.placed() || unknown == place + 1 || unknown == place + 3;
}

/// Squared sines of the pair angles above their limit, logarithms of lengths, distances of pivots from the
/// sides of their box.
void MachineDescent::evaluate_limits(const FittedMachine& machine, std::vector<double>& out) {
  const PointProgram& p = *machine.shape.program;
  const std::vector<double>& x = machine.shape.x;
  const MachineLimits& limits = options_.limits;
  alignas(64) std::array<double, limit_samples> angle, quality, worst;
  for (std::size_t k = 0; k < limit_samples; ++k) angle[k] = 2 * pi * static_cast<double>(k) / limit_samples;
  if (!target_.turns) target_.cover_used_part(machine.angle, angle);
  compute_curve({.program = &p,
                 .x = x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle.data(),
                 .count = limit_samples,
                 .quality = quality.data(),
                 .worst = worst.data()});
  const double sine = std::sin(std::min(limits.min_pair_angle + pair_margin, pi / 2));
  dimensions_.set_program(p);
  std::vector<double> missing(dimensions_.count());
  dimensions_.missing(x, missing, {});
  out.clear();
  for (const double q : quality) out.push_back(q - sine * sine);
  for (const double value : missing) out.push_back(-value);
}

void MachineDescent::choose_rows(const DescentAim& aim) {
  rows_.clear();
  for (std::size_t o = 0; o < terms_.size(); ++o) {
    if (aim.weight[o] == 0 && aim.at_most[o] == infinity) continue;
    if (terms_[o].beside_error) {
      rows_.push_back({.group = o, .with_error = true, .value = *terms_[o].beside_error});
      continue;
    }
    for (const std::size_t i : peaks_of(terms_[o]))
      rows_.push_back({.group = o, .index = i, .value = terms_[o].values[i]});
  }
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    if (limits_[i] > heeded) continue;
    if (i < limit_samples) {
      // Without a turn both ends have one neighbour.
      const bool first = !target_.turns && i == 0, last = !target_.turns && i + 1 == limit_samples;
      const double before = limits_[first ? i : (i + limit_samples - 1) % limit_samples],
                   after = limits_[last ? i : (i + 1) % limit_samples];
      if (limits_[i] > before || limits_[i] > after) continue;
    }
    rows_.push_back({.group = terms_.size(), .index = i, .value = limits_[i]});
  }
}

/// Gradients of all rows by differences; false where the machine has no values.
bool MachineDescent::linearise(const DescentAim& aim, const FittedMachine& machine) {
  if (!objectives_.evaluate(machine, fitter_, terms_)) return false;
  evaluate_limits(machine, limits_);
  choose_rows(aim);
  const std::size_t own = machine.shape.x.size(),
                    extra = (target_.timed ? 1u : 0u) + (target_.oriented ? 1u : 0u);
  // What a function asks for depends on where the crank begins.
  const bool function = target_.is_function();
  const std::size_t n = function ? own + extra : own;
  for (Row& row : rows_) row.gradient.assign(n, 0.0);
  FittedMachine moved = machine;
  std::vector<double> change(own + extra);
  for (std::size_t i = 0; i < n; ++i) {
    if (is_held(i, machine)) continue;
    const double by = 1e-6 * (i < own ? scale_of(machine.shape.x[i]) : 1);
    if (function) {
      moved = machine;
      change.assign(n, 0.0), change[i] = by;
      fitter_.move(moved, change);
    } else {
      moved.shape.x[i] = machine.shape.x[i] + by;
    }
    if (!objectives_.evaluate(moved, fitter_, moved_terms_)) return false;
    evaluate_limits(moved, moved_limits_);
    for (Row& row : rows_) {
      const double now = row.group == terms_.size() ? moved_limits_[row.index]
                         : row.with_error           ? *moved_terms_[row.group].beside_error
                                                    : moved_terms_[row.group].values[row.index];
      row.gradient[i] = (now - row.value) / by;
    }
    if (!function) moved.shape.x[i] = machine.shape.x[i];
  }
  return true;
}

/// The error by changes of all unknowns, as shares of what each may well change by.
MachineDescent::ScaledError MachineDescent::scaled_error(const FittedMachine& machine) {
  const ErrorModel model = fitter_.error_model(machine, true);
  const std::size_t n = model.unknowns, own = machine.shape.x.size();
  ScaledError out;
  out.squares = model.squares;
  out.by.assign(n, 0.1);
  for (std::size_t i = 0; i < own; ++i) out.by[i] = is_held(i, machine) ? 0 : scale_of(machine.shape.x[i]);
  const auto size = static_cast<Eigen::Index>(n);
  out.matrix.resize(size, size), out.gradient.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.gradient(i) = out.by[k] * model.gradient[k];
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto l = static_cast<std::size_t>(j);
      out.matrix(i, j) = out.by[k] * out.by[l] * model.matrix[k * n + l];
    }
  }
  return out;
}

/// Parts of a cone whose sum of squares is the squared error, but for a constant, which is returned.
double MachineDescent::error_parts(const ScaledError& error, double radius,
                                   std::vector<optimise::Affine>& parts) {
  Eigen::MatrixXd a = radius * radius * error.matrix;
  a.diagonal().array() += 1e-12 * a.trace();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(a);
  const Eigen::MatrixXd l = cholesky.matrixL();
  const Eigen::VectorXd centre = cholesky.matrixL().solve(radius * error.gradient);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    optimise::Affine& part = parts.emplace_back();
    part.constant = centre(i);
    for (Eigen::Index j = i; j < a.rows(); ++j)
      part.variables.push_back(static_cast<std::size_t>(j)), part.factors.push_back(l(j, i));
  }
  return error.squares - centre.squaredNorm();
}

/// value + gradient.d of a row, times a factor.
optimise::Affine MachineDescent::linear_part(const Row& row, double factor, const ScaledError& error,
                                             double radius) {
  optimise::Affine out{.constant = factor * row.value};
  for (std::size_t i = 0; i < row.gradient.size(); ++i)
    out.variables.push_back(i), out.factors.push_back(factor * radius * error.by[i] * row.gradient[i]);
  return out;
}

/// q <= t for q^2 = squared error + a linear part, by its tangent (q^2 + q0^2) / (2 q0) above it.
optimise::Cone MachineDescent::error_cone(const Row& row, const DescentAim& aim, const ScaledError& error,
                                          double radius, std::optional<std::size_t> ratio) {
  const double reference = aim.reference[row.group], unit = target_.error_unit() / reference;
  const double now = terms_[row.group].values[0] / reference;
  std::vector<optimise::Affine> parts;
  const double rest = error_parts(error, radius, parts);
  for (optimise::Affine& part : parts) {
    part.constant *= unit;
    for (double& factor : part.factors) factor *= unit;
  }
  optimise::Affine first = linear_part(row, -1 / (reference * reference), error, radius);
  first.constant -= now * now + unit * unit * rest;
  if (ratio)
    first.variables.push_back(*ratio), first.factors.push_back(2 * now);
  else
    first.constant += 2 * now * std::max(aim.at_most[row.group], now);
  return optimise::rotated_cone(parts, first, {.constant = 1});
}

/// Unknowns of the model: changes of the machine in shares of the radius, then a ratio for each objective.
optimise::ConeProgramme MachineDescent::programme(const DescentAim& aim, const ScaledError& error,
                                                  double radius) {
  const std::size_t n = error.by.size();
  optimise::ConeProgramme out;
  out.cost.assign(n, 0.0);
  std::vector<std::optional<std::size_t>> ratio(terms_.size());
  for (std::size_t o = 0; o < terms_.size(); ++o)
    if (aim.weight[o] > 0) ratio[o] = out.cost.size(), out.cost.push_back(aim.weight[o]);
  for (const Row& row : rows_) {
    if (row.group == terms_.size()) {
      optimise::Affine inside = linear_part(row, 1, error, radius);
      inside.constant = std::max(inside.constant, 0.0);
      out.cones.push_back({.bound = std::move(inside)});
      continue;
    }
    const bool bounded = aim.at_most[row.group] < infinity;
    if (row.with_error) {
      if (ratio[row.group]) out.cones.push_back(error_cone(row, aim, error, radius, ratio[row.group]));
      if (bounded) out.cones.push_back(error_cone(row, aim, error, radius, {}));
      continue;
    }
    optimise::Affine below = linear_part(row, -1 / aim.reference[row.group], error, radius);
    if (bounded) {
      optimise::Affine room = below;
      room.constant += std::max(aim.at_most[row.group], -below.constant);
      out.cones.push_back({.bound = std::move(room)});
    }
    if (!ratio[row.group]) continue;
    below.variables.push_back(*ratio[row.group]), below.factors.push_back(1);
    out.cones.push_back({.bound = std::move(below)});
  }
  optimise::Cone step{.bound = {.constant = 1}};
  for (std::size_t i = 0; i < n; ++i) step.parts.push_back({.variables = {i}, .factors = {1.0}});
  out.cones.push_back(std::move(step));
  optimise::Cone path;
  const double rest = error_parts(error, radius, path.parts);
  const double room = std::sqrt(std::max(aim.max_error * aim.max_error - rest, 1e-24));
  path.bound.constant = 1;
  for (optimise::Affine& part : path.parts) {
    part.constant /= room;
    for (double& factor : part.factors) factor /= room;
  }
  out.cones.push_back(std::move(path));
  if (aim.max_greatest < infinity) add_greatest(aim, error, radius, out.cones);
  return out;
}

/// The errors of a function that come near the greatest that is allowed, each with its sign.
void MachineDescent::add_greatest(const DescentAim& aim, const ScaledError& error, double radius,
                                  std::vector<optimise::Cone>& cones) const {
  const std::size_t count = errors_.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (std::abs(errors_[k]) < heeded_errors * aim.max_greatest) continue;
    const double by = (errors_[k] > 0 ? 1 : -1) / aim.max_greatest;
    optimise::Affine room{.constant = std::max(1 - by * errors_[k], 0.0)};
    for (std::size_t i = 0; i < error.by.size(); ++i)
      room.variables.push_back(i),
          room.factors.push_back(-by * radius * error.by[i] * derivatives_[i * count + k]);
    cones.push_back({.bound = std::move(room)});
  }
}

/// The best step of the model within a radius; false where there is none.
bool MachineDescent::propose(const DescentAim& aim, const ScaledError& error, double radius,
                             RunContext& context) {
  const optimise::ConeReport report = optimise::solve(
      programme(aim, error, radius), {.gap = 1e-5, .residual = 1e-6, .max_iterations = 50}, context);
  const std::size_t n = error.by.size();
  if (report.x.size() < n || report.end == optimise::ConeEnd::unbounded ||
      report.end == optimise::ConeEnd::interrupted)
    return false;
  change_.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) change_[i] = report.x[i] * radius * error.by[i];
  predicted_ = report.cost;
  return std::all_of(change_.begin(), change_.end(), [](double v) { return std::isfinite(v); });
}

/// The least change, in shares, that brings the error of a machine back to what is allowed.
bool MachineDescent::return_to_path(const DescentAim& aim, FittedMachine& machine) {
  const ScaledError error = scaled_error(machine);
  const double wanted = aim.max_error * aim.max_error * (1 - 1e-4);
  const auto step_at = [&](double damping) -> Eigen::VectorXd {
    Eigen::MatrixXd a = error.matrix;
    a.diagonal().array() += damping;
    return -a.llt().solve(error.gradient);
  };
  const auto squares_at = [&](const Eigen::VectorXd& d) {
    return error.squares + 2 * error.gradient.dot(d) + d.dot(error.matrix * d);
  };
  double low = 1e-12 * error.matrix.trace(), high = error.matrix.trace();
  if (!(squares_at(step_at(low)) < wanted)) return false;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (squares_at(step_at(middle)) < wanted ? low : high) = middle;
  }
  const Eigen::VectorXd step = step_at(low);
  std::vector<double> change(error.by.size());
  for (std::size_t i = 0; i < change.size(); ++i)
    change[i] = error.by[i] * step(static_cast<Eigen::Index>(i));
  fitter_.move(machine, change);
  return true;
}

/// The least change, in shares, that brings the greatest error of a function back to what is allowed.
bool MachineDescent::lessen_greatest(const DescentAim& aim, FittedMachine& machine, RunContext& context) {
  const ScaledError error = scaled_error(machine);
  std::vector<double> errors, derivatives;
  fitter_.output_errors(machine, errors, derivatives);
  const std::size_t n = error.by.size(), count = errors.size();
  optimise::ConeProgramme least;
  least.cost.assign(n + 1, 0.0), least.cost[n] = 1;
  optimise::Cone size{.bound = {.variables = {n}, .factors = {1.0}}};
  for (std::size_t i = 0; i < n; ++i) size.parts.push_back({.variables = {i}, .factors = {1.0}});
  least.cones.push_back(std::move(size));
  for (std::size_t k = 0; k < count; ++k) {
    if (std::abs(errors[k]) < heeded_errors * aim.max_greatest) continue;
    const double by = (errors[k] > 0 ? 1 : -1) / aim.max_greatest;
    optimise::Affine room{.constant = 1 - 1e-4 - by * errors[k]};
    for (std::size_t i = 0; i < n; ++i)
      room.variables.push_back(i), room.factors.push_back(-by * error.by[i] * derivatives[i * count + k]);
    least.cones.push_back({.bound = std::move(room)});
  }
  const optimise::ConeReport report =
      optimise::solve(least, {.gap = 1e-3, .residual = 1e-6, .max_iterations = 50}, context);
  if (report.x.size() < n || report.end == optimise::ConeEnd::unbounded ||
      report.end == optimise::ConeEnd::interrupted)
    return false;
  std::vector<double> change(n);
  for (std::size_t i = 0; i < n; ++i) change[i] = report.x[i] * error.by[i];
  if (!std::all_of(change.begin(), change.end(), [](double v) { return std::isfinite(v); })) return false;
  fitter_.move(machine, change);
  return true;
}

/// The machine after a share of the change; false where it breaks the path or a limit.
bool MachineDescent::moved(const DescentAim& aim, double part, FoundMachine& found, RunContext& context) {
  std::vector<double> change = change_;
  for (double& c : change) c *= part;
  fitter_.move(found.machine, change);
  found.measures = fitter_.measure(found.machine);
  for (int pass = 0; pass < 2 && !(found.measures.error <= aim.max_error); ++pass) {
    if (!(found.measures.error < 2 * aim.max_error) || !return_to_path(aim, found.machine)) return false;
    found.measures = fitter_.measure(found.machine);
  }
  const auto greatest = [&] { return greatest_error(target_, found.measures); };
  for (int pass = 0; pass < 2 && !(greatest() <= aim.max_greatest); ++pass) {
    if (!(greatest() < 2 * aim.max_greatest) || !lessen_greatest(aim, found.machine, context)) return false;
    found.measures = fitter_.measure(found.machine);
  }
  return keeps_errors(aim, found) && (!aim.within_tolerance || found.measures.beyond_tolerance == 0);
}

bool MachineDescent::keeps_errors(const DescentAim& aim, const FoundMachine& found) const {
  return found.measures.error <= aim.max_error && found.measures.defect == MachineDefect::none &&
         greatest_error(target_, found.measures) <= aim.max_greatest &&
         (!options_.whole_error || options_.whole_error(found.machine) <= aim.max_whole);
}

double MachineDescent::cost(const DescentAim& aim, std::span<const double> values) const {
  double sum = 0;
  for (std::size_t o = 0; o < values.size(); ++o) sum += aim.weight[o] * values[o] / aim.reference[o];
  return sum;
}

bool MachineDescent::within_bounds(const DescentAim& aim, std::span<const double> values,
                                   std::span<const double> before) const {
  for (std::size_t o = 0; o < values.size(); ++o)
    if (values[o] > std::max(aim.at_most[o] * aim.reference[o], before[o])) return false;
  return true;
}

/// A step within a radius, which is adapted; false where none is better.
bool MachineDescent::improve(const DescentAim& aim, double& radius, FoundMachine& found,
                             std::vector<double>& values, RunContext& context) {
  const double before = cost(aim, values);
  const ScaledError error = scaled_error(found.machine);
  if (aim.max_greatest < infinity) fitter_.output_errors(found.machine, errors_, derivatives_);
  for (; radius > min_radius; radius *= 0.25) {
    if (context.interrupted()) return false;
    if (!propose(aim, error, radius, context)) continue;
    for (double part = 1; part > 0.2; part *= 0.5) {
      FoundMachine trial = found;
      if (!moved(aim, part, trial, context)) continue;
      std::vector<double> now = values_of(trial.machine);
      if (now.empty() || !(cost(aim, now) < before) || !within_bounds(aim, now, values)) continue;
      const bool as_predicted = before - cost(aim, now) > 0.5 * (before - predicted_);
      radius = part < 1 ? part * radius : as_predicted ? std::min(2 * radius, max_radius) : radius;
      found = std::move(trial), values = std::move(now);
      return true;
    }
  }
  return false;
}

bool MachineDescent::descend(const DescentAim& aim, FoundMachine& found, std::vector<double>& values,
                             RunContext& context) {
  values = values_of(found.machine);
  if (values.empty()) return false;
  double radius = first_radius;
  int small_steps = 0;
  for (int step = 0; step < max_steps_down && small_steps < max_small_steps; ++step) {
    const double before = cost(aim, values);
    if (context.interrupted() || !linearise(aim, found.machine) ||
        !improve(aim, radius, found, values, context))
      break;
    ++steps_;
    small_steps = before - cost(aim, values) < small_gain * before ? small_steps + 1 : 0;
  }
  return true;
}

}  // namespace linkwright::planar
