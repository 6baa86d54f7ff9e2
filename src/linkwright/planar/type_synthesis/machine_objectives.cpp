// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/machine_objectives.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"

namespace linkwright::planar {
namespace {

constexpr double normal_quantile_90 = 1.2815515655446004;

using DimensionEffect = std::vector<std::pair<std::size_t, double>>;

}  // namespace

// Plates are given in lengths of their bar, everything else in cranks.
std::vector<DimensionEffect> dimension_effects(const MachineShape& shape) {
  const PointProgram& p = *shape.program;
  const std::vector<double>& x = shape.x;
  const auto own = static_cast<std::size_t>(p.place()), s = static_cast<std::size_t>(p.scale());
  const double crank = std::hypot(x[s], x[s + 1]);
  std::vector<int> bar(own, -1);
  for (const LengthTerm& term : lengths_of(p))
    if (term.plate >= 0 && term.factor >= 0)
      bar[static_cast<std::size_t>(term.plate)] = bar[static_cast<std::size_t>(term.plate) + 1] = term.factor;
  std::vector<DimensionEffect> out(own + 1);
  out[0] = {{s, x[s] / crank}, {s + 1, x[s + 1] / crank}};
  for (std::size_t i = 0; i < own; ++i) {
    if (bar[i] < 0) {
      out[0].emplace_back(i, -x[i] / crank);
      out[i + 1].emplace_back(i, 1 / crank);
    } else {
      const auto b = static_cast<std::size_t>(bar[i]);
      out[i + 1].emplace_back(i, 1 / (crank * std::abs(x[b])));
      out[b + 1].emplace_back(i, -x[i] / (crank * x[b]));
    }
  }
  return out;
}

double QuantityTerms::largest() const {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

double tolerance_90(const MachineShape& shape, const ErrorModel& model, double tolerance) {
  const std::vector<DimensionEffect> effects = dimension_effects(shape);
  const auto count = static_cast<Eigen::Index>(effects.size());
  const std::size_t n = model.unknowns;
  const double sigma = tolerance / 3;
  // Gradient and matrix by the dimensions, in standard deviations.
  Eigen::VectorXd b = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd a(count, count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const DimensionEffect& row = effects[static_cast<std::size_t>(r)];
    for (const auto& [i, by] : row) b(r) += sigma * by * model.gradient[i];
    for (Eigen::Index c = 0; c <= r; ++c) {
      double sum = 0;
      for (const auto& [i, by] : row)
        for (const auto& [j, by_other] : effects[static_cast<std::size_t>(c)])
          sum += by * by_other * model.matrix[i * n + j];
      a(r, c) = a(c, r) = sigma * sigma * sum;
    }
  }
  const Eigen::MatrixXd square = a * a;
  const Eigen::VectorXd ab = a * b;
  const double mean = model.squares + a.trace(), variance = 2 * a.squaredNorm() + 4 * b.squaredNorm(),
               third = 8 * square.cwiseProduct(a).sum() + 24 * b.dot(ab);
  if (!(variance > 0)) return std::sqrt(std::max(mean, 0.0));
  const double skewness = third / std::pow(variance, 1.5);
  double deviation = normal_quantile_90;
  if (skewness > 1e-6)  // Wilson and Hilferty
    deviation =
        2 / skewness * (std::pow(1 + skewness * normal_quantile_90 / 6 - skewness * skewness / 36, 3) - 1);
  return std::sqrt(std::max(mean + std::sqrt(variance) * deviation, 0.0));
}

MachineObjectives::MachineObjectives(const MotionTarget& target, std::vector<MachineQuantity> quantities,
                                     const MachineLoads& loads, double tolerance)
    : target_(target),
      quantities_(std::move(quantities)),
      loads_(loads),
      tolerance_(tolerance),
      tx_(traced_angles),
      ty_(traced_angles),
      points_(2 * max_steps * traced_angles) {
  if (target.output == MachineOutput::angle)
    for (std::vector<double>* row : {&bx_, &by_, &rate_}) row->resize(traced_angles);
  for (std::size_t k = 0; k < traced_angles; ++k)
    angle_.push_back(2 * pi * static_cast<double>(k) / traced_angles);
  for (std::size_t k = 0; k < force_angles; ++k)
    force_angle_.push_back(2 * pi * static_cast<double>(k) / force_angles);
}

bool MachineObjectives::evaluate(const FittedMachine& machine, MachineFitter& fitter,
                                 std::vector<QuantityTerms>& out) {
  out.assign(quantities_.size(), {});
  if (!target_.turns) choose_angles(machine);
  bool traced = false, loaded = false;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const MachineQuantity quantity = quantities_[q];
    if (needs_loads(quantity) && !loaded) {
      FoundLinkage linkage = found_linkage(machine, target_.stroke);
      add_loads(linkage, loads_);
      if (!target_.turns)
        for (double& angle : force_angle_) angle += linkage.crank_angle;
      if (!sample_forces(linkage, loads_.crank_speed, force_angle_, forces_)) return false;
      loaded = true;
    }
    if ((quantity == MachineQuantity::size || quantity == MachineQuantity::peak_acceleration) && !traced)
      trace(machine), traced = true;
    switch (quantity) {
      case MachineQuantity::peak_joint_force:
        out[q] = {.values = forces_.joint_force, .series = forces_.count, .ends = !target_.turns};
        break;
      case MachineQuantity::drive_torque:
        out[q] = {.values = forces_.drive_torque, .series = forces_.count, .ends = !target_.turns};
        break;
      case MachineQuantity::size:
        size_terms(machine, out[q]);
        break;
      case MachineQuantity::peak_acceleration:
        target_.is_function() ? output_acceleration_terms(out[q]) : acceleration_terms(machine, out[q]);
        break;
      case MachineQuantity::tolerance_90:
        tolerance_terms(machine, fitter, out[q]);
        break;
    }
    if (!std::all_of(out[q].values.begin(), out[q].values.end(), [](double v) { return std::isfinite(v); }))
      return false;
  }
  return true;
}

void MachineObjectives::tolerance_terms(const FittedMachine& machine, MachineFitter& fitter,
                                        QuantityTerms& out) const {
  const double unit = target_.error_unit();
  const ErrorModel model = fitter.error_model(machine, false);
  const double error = tolerance_90(machine.shape, model, tolerance_ / target_.stroke.size);
  out = {{unit * error}, 1, unit * unit * (error * error - model.squares)};
}

/// The used part of the turn.
void MachineObjectives::choose_angles(const FittedMachine& machine) {
  target_.cover_used_part(machine.angle, angle_);
  target_.cover_used_part(machine.angle, force_angle_);
}

void MachineObjectives::trace(const FittedMachine& machine) {
  CurveTask task{.program = machine.shape.program,
                 .x = machine.shape.x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle_.data(),
                 .count = traced_angles,
                 .tx = tx_.data(),
                 .ty = ty_.data(),
                 .points = points_.data()};
  if (!rate_.empty()) task.bx = bx_.data(), task.by = by_.data(), task.rate = rate_.data();
  compute_curve(task);
}

/// Both sides of the box of all pins, the pivot of the crank at the origin of the machine's plane among them.
void MachineObjectives::size_terms(const FittedMachine& machine, QuantityTerms& out) const {
  const PointProgram& p = *machine.shape.program;
  const auto s = static_cast<std::size_t>(p.scale());
  const std::complex<double> scale(machine.shape.x[s], machine.shape.x[s + 1]);
  double left = 0, right = 0, bottom = 0, top = 0;
  for (std::size_t i = 0; i < p.steps.size(); ++i) {
    if (p.steps[i].operation == PointOperation::sleeve) continue;
    const double *px = points_.data() + 2 * i * traced_angles, *py = px + traced_angles;
    for (std::size_t k = 0; k < traced_angles; ++k) {
      const std::complex<double> at = scale * std::complex<double>(px[k], py[k]);
      left = std::min(left, at.real()), right = std::max(right, at.real());
      bottom = std::min(bottom, at.imag()), top = std::max(top, at.imag());
    }
  }
  const double size = target_.stroke.size;
  out = {{size * (right - left), size * (top - bottom)}, 1};
}

/// Differences of the tangent; an open stroke asks for nothing outside its own part of the turn.
void MachineObjectives::acceleration_terms(const FittedMachine& machine, QuantityTerms& out) const {
  const double first = machine.angle.front(), last = machine.angle[target_.count - 1];
  const double from = std::min(first, last), span = std::abs(last - first);
  out.values.assign(traced_angles, 0.0);
  out.series = traced_angles;
  if (!target_.turns) {
    out.ends = true;
    const double by = 0.5 / std::abs(angle_[1] - angle_[0]);
    for (std::size_t k = 1; k + 1 < traced_angles; ++k)
      if ((angle_[k] - first) * (angle_[k] - last) <= 0)
        out.values[k] = by * std::hypot(tx_[k + 1] - tx_[k - 1], ty_[k + 1] - ty_[k - 1]);
    return;
  }
  for (std::size_t k = 0; k < traced_angles; ++k) {
    const double ahead = angle_[k] - from;
    if (!target_.stroke.closed && ahead - 2 * pi * std::floor(ahead / (2 * pi)) > span) continue;
    const std::size_t a = (k + traced_angles - 1) % traced_angles, b = (k + 1) % traced_angles;
    out.values[k] = std::hypot(tx_[b] - tx_[a], ty_[b] - ty_[a]) * traced_angles / (4 * pi);
  }
}

/// Differences of the speed of the slider, or of the angular speed of the output link; none at the ends of a
/// range.
void MachineObjectives::output_acceleration_terms(QuantityTerms& out) const {
  const bool angle = target_.output == MachineOutput::angle;
  const double step = angle_[1] - angle_[0], by = 1 / std::abs(2 * step);
  out.values.assign(traced_angles, 0.0);
  out.series = traced_angles, out.ends = !target_.turns;
  for (std::size_t k = 0; k < traced_angles; ++k) {
    if (out.ends && (k == 0 || k + 1 == traced_angles)) continue;
    const std::size_t a = (k + traced_angles - 1) % traced_angles, b = (k + 1) % traced_angles;
    out.values[k] = by * (angle ? std::abs(rate_[b] - rate_[a])
                                : target_.stroke.size * std::hypot(tx_[b] - tx_[a], ty_[b] - ty_[a]));
  }
}

}  // namespace linkwright::planar
