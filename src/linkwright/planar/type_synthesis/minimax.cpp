// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/minimax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t kept_angles = 48;
constexpr int passes = 3;
constexpr double kept_margin =
    0.02 * pi / 180;  // more of the pair angle than is promised, between the angles

/// The errors of one machine by its free numbers: parameters, the crank angle where it begins, and the angle
/// of the body on its bar.
class FunctionErrors {
 public:
  FunctionErrors(const MotionTarget& target, const MachineLimits& limits, const FittedMachine& machine,
                 double margin)
      : target_(target),
        machine_(machine),
        program_(*machine.shape.program),
        given_(limits.ground_pivots),
        dimensions_(limits),
        x_(machine.shape.x) {
    const double sine = std::sin(std::min(limits.min_pair_angle + margin, pi / 2));
    min_quality_ = sine * sine;
    dimensions_.set_program(program_);
    // An angle changes neither with the scale, which the limits of lengths heed, nor with the place, which
    // pivots on the ground may be limited by; the travel along a line does not change across it.
    const auto place = static_cast<std::size_t>(program_.place());
    const bool anywhere = !target.placed() && (limits.ground_box || !given_.empty());
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (i < place || i == place + 2 || (i == place && target.placed()) || anywhere) free_.push_back(i);
  }

  std::size_t numbers() const { return free_.size() + (target_.oriented ? 2 : 1); }
  std::size_t errors() const { return target_.count; }
  std::size_t limits() const { return kept_angles + dimensions_.count(); }

  std::vector<double> start() const {
    std::vector<double> out;
    for (const std::size_t i : free_) out.push_back(x_[i]);
    out.push_back(machine_.angle[0]);
    if (target_.oriented) out.push_back(machine_.body_angle);
    return out;
  }

  /// Errors, and their derivatives row by row where they are wanted.
  void evaluate(std::span<const double> at, std::span<double> values, std::span<double> gradients) {
    const bool with_gradients = !gradients.empty();
    take(at);
    const std::size_t n = target_.count, parameters = x_.size();
    CurveTask task{.program = &program_,
                   .x = x_.data(),
                   .signs = machine_.shape.signs,
                   .angle = angle_.data(),
                   .count = n,
                   .px = px_.data(),
                   .py = py_.data(),
                   .tx = tx_.data(),
                   .ty = ty_.data()};
    if (target_.oriented) task.bx = bx_.data(), task.by = by_.data(), task.rate = rate_.data();
    nx_.fill(target_.placed() ? 1 : 0), ny_.fill(0), na_.fill(1);
    if (with_gradients) {
      rows_.resize(parameters * n);
      task.nx = nx_.data(), task.ny = ny_.data(), task.na = target_.oriented ? na_.data() : nullptr;
      task.rows = rows_.data(), task.stride = n;
    }
    compute_curve(task);
    const double body = target_.oriented ? at.back() : 0;
    for (std::size_t k = 0; k < n; ++k)
      values[k] =
          target_.oriented
              ? std::arg(std::complex<double>(bx_[k], by_[k]) * std::polar(1.0, body - target_.angle[k]))
              : px_[k] - target_.x[k];
    free_means(values, 1);
    if (!with_gradients) return;
    find_moves();
    const std::size_t columns = numbers();
    for (std::size_t k = 0; k < n; ++k) {
      double* row = gradients.data() + k * columns;
      by_free_numbers([&](std::size_t i) { return rows_[i * n + k]; }, row);
      row[free_.size()] = target_.oriented ? rate_[k] : tx_[k];
      if (target_.oriented) row[columns - 1] = 1;
    }
    free_means(gradients, columns);
  }

  /// What is missing of the pair angles, as squared sines, of the lengths and of the box of the pivots.
  void missing(std::span<const double> at, std::span<double> values, std::span<double> gradients) {
    take(at);
    const double from = target_.turns ? 0 : angle_[0], range = target_.turns
                                                                   ? 2 * pi * (kept_angles - 1) / kept_angles
                                                                   : angle_[target_.count - 1] - from;
    std::array<double, kept_angles> angle, quality, worst, later, ahead, behind, of;
    for (std::size_t k = 0; k < kept_angles; ++k)
      angle[k] = from + range * static_cast<double>(k) / (kept_angles - 1);
    qualities(angle, quality, worst);
    // The angles move with the first one where the crank does not turn.
    const bool moving = !target_.turns && !gradients.empty();
    constexpr double step = 1e-5;
    for (const bool forward : {true, false}) {
      if (!moving) break;
      for (std::size_t k = 0; k < kept_angles; ++k) later[k] = angle[k] + (forward ? step : -step);
      qualities(later, forward ? ahead : behind, of);
    }
    if (!gradients.empty()) find_moves();
    std::vector<double> gradient(x_.size());
    const std::size_t columns = numbers();
    for (std::size_t k = 0; k < kept_angles; ++k) {
      values[k] = min_quality_ - quality[k];
      if (gradients.empty()) continue;
      quality_gradient(program_, x_, machine_.shape.signs, angle[k], static_cast<int>(worst[k]), gradient);
      double* row = gradients.data() + k * columns;
      std::fill_n(row, columns, 0.0);
      by_free_numbers([&](std::size_t i) { return -gradient[i]; }, row);
      if (moving) row[free_.size()] = -(ahead[k] - behind[k]) / (2 * step);
    }
    std::vector<double> slopes(gradients.empty() ? 0 : dimensions_.count() * x_.size());
    dimensions_.missing(x_, values.subspan(kept_angles), slopes);
    for (std::size_t k = 0; k < dimensions_.count() && !gradients.empty(); ++k) {
      double* row = gradients.data() + (kept_angles + k) * columns;
      std::fill_n(row, columns, 0.0);
      by_free_numbers([&](std::size_t i) { return slopes[k * x_.size() + i]; }, row);
    }
  }

  FittedMachine machine_at(std::span<const double> at) {
    take(at);
    FittedMachine out = machine_;
    out.shape.x = x_, out.angle = angle_;
    if (target_.oriented) out.body_angle = at.back();
    return out;
  }

 private:
  using Kept = std::array<double, kept_angles>;
  void qualities(const Kept& angle, Kept& quality, Kept& worst) const {
    compute_curve({.program = &program_,
                   .x = x_.data(),
                   .signs = machine_.shape.signs,
                   .angle = angle.data(),
                   .count = kept_angles,
                   .quality = quality.data(),
                   .worst = worst.data()});
  }

  void take(std::span<const double> at) {
    for (std::size_t i = 0; i < free_.size(); ++i) x_[free_[i]] = at[i];
    unsettled_ = x_;
    settle(x_);
    for (std::size_t k = 0; k < angle_.size(); ++k)
      angle_[k] = at[free_.size()] + target_.turn[std::min(k, target_.count - 1)];
  }

  bool settles() const { return target_.placed() || !given_.empty(); }

  /// Whatever the free numbers are, given pivots are met, and a slider moves along the x axis.
  void settle(std::span<double> x) const {
    const auto across = static_cast<std::size_t>(program_.place()) + 1,
               scale = static_cast<std::size_t>(program_.scale());
    if (target_.placed()) x[scale + 1] = 0;
    dimensions_.meet_pivots(x);
    if (!target_.placed()) return;
    const auto height = static_cast<std::size_t>(program_.steps.back().parameter) + 1;
    if (given_.empty())
      x[across] = -x[scale] * x[height];
    else
      x[height] = -x[across] / x[scale];
  }

  /// How all parameters change with the free numbers once they are settled.
  void find_moves() {
    if (!settles()) return;
    const std::size_t n = x_.size();
    moves_.assign(free_.size() * n, 0);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const double step = 1e-6 * std::max(std::abs(unsettled_[free_[i]]), 1.0);
      for (const double side : {1.0, -1.0}) {
        std::vector<double> moved = unsettled_;
        moved[free_[i]] += side * step;
        settle(moved);
        for (std::size_t j = 0; j < n; ++j) moves_[i * n + j] += side * moved[j] / (2 * step);
      }
    }
  }

  /// The derivatives of a number by the free numbers, from those by all parameters.
  template <class Derivative>
  void by_free_numbers(const Derivative& of, double* out) const {
    const std::size_t n = x_.size();
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (!settles()) {
        out[i] = of(free_[i]);
        continue;
      }
      out[i] = 0;
      for (std::size_t j = 0; j < n; ++j) out[i] += moves_[i * n + j] * of(j);
    }
  }

  /// Where the output rests, its value is free.
  void free_means(std::span<double> values, std::size_t columns) const {
    for (const RestingSamples& rest : target_.rests)
      for (std::size_t c = 0; c < columns; ++c) {
        double mean = 0;
        for (std::size_t k = rest.first; k < rest.end; ++k) mean += values[k * columns + c];
        mean /= static_cast<double>(rest.end - rest.first);
        for (std::size_t k = rest.first; k < rest.end; ++k) values[k * columns + c] -= mean;
      }
  }

  const MotionTarget& target_;
  const FittedMachine& machine_;
  const PointProgram& program_;
  const std::vector<std::complex<double>>& given_;
  DimensionLimits dimensions_;
  std::vector<double> x_, rows_;
  std::vector<double> unsettled_, moves_;
  std::vector<std::size_t> free_;
  double min_quality_ = 0;
  using Samples = std::array<double, stroke_samples>;
  alignas(64) Samples angle_{}, px_{}, py_{}, tx_{}, ty_{}, bx_{}, by_{}, rate_{}, nx_{}, ny_{}, na_{};
};

/// The machine with the least greatest error next to another one, with a margin of its pair angles (rad);
/// none where it is not less.
std::optional<FittedMachine> lessened(const MotionTarget& target, const MachineLimits& limits,
                                      const FittedMachine& machine, double margin, RunContext& context) {
  FunctionErrors of(target, limits, machine, margin);
  std::vector<double> x = of.start(), errors(of.errors()), low(x), high(x);
  of.evaluate(x, errors, {});
  const auto greatest = [&] {
    double out = 0;
    for (const double e : errors) out = std::max(out, std::abs(e));
    return out;
  };
  const double before = greatest();
  if (!(before > 0) || !std::isfinite(before)) return std::nullopt;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double reach = 0.2 * std::max(std::abs(x[i]), 0.5);
    low[i] -= reach, high[i] += reach;
  }
  const std::size_t columns = x.size();
  std::vector<double> slopes(of.errors() * columns);
  // The errors with both signs.
  const auto both = [&](std::span<const double> at, std::span<double> values, std::span<double> gradients) {
    of.evaluate(at, errors, gradients.empty() ? std::span<double>{} : slopes);
    for (std::size_t k = 0; k < errors.size(); ++k)
      for (const std::size_t turned : {0u, 1u}) {
        const double by = (turned ? -1 : 1) / before;
        values[2 * k + turned] = std::isfinite(errors[k]) ? by * errors[k] : 1e3;
        for (std::size_t c = 0; c < columns && !gradients.empty(); ++c)
          gradients[(2 * k + turned) * columns + c] = by * slopes[k * columns + c];
      }
  };
  const auto kept = [&](std::span<const double> at, std::span<double> values, std::span<double> gradients) {
    of.missing(at, values, gradients);
  };
  // A search that begins again forgets the curvature that led it astray.
  for (int pass = 0; pass < passes && !context.interrupted(); ++pass)
    optimise::minimise_largest(2 * errors.size(), both, {}, of.limits(), kept, x, low, high, {}, context);
  of.evaluate(x, errors, {});
  if (!(greatest() < before)) return std::nullopt;
  FittedMachine out = of.machine_at(x);
  // The size of machines whose output is an angle is not the search's to change.
  MachineFitter(target, limits).move(out, std::vector<double>(out.shape.x.size() + 2));
  return out;
}

}  // namespace

void lessen_greatest_error(const MotionTarget& target, const MachineLimits& limits, FittedMachine& machine,
                           RunContext& context) {
  MachineFitter fitter(target, limits);
  double margin = kept_margin;
  for (int attempt = 0; attempt < 3; ++attempt) {
    std::optional<FittedMachine> found = lessened(target, limits, machine, margin, context);
    if (!found) return;
    FittedMachine measured = *found;
    const MachineMeasures now = fitter.measure(measured);
    if (now.defect == MachineDefect::none) {
      machine = std::move(*found);
      return;
    }
    if (now.defect != MachineDefect::pair_angle) return;
    // Between the angles that are looked at, a pair angle may fall further.
    margin += 1.2 * (limits.min_pair_angle - now.min_pair_angle);
  }
}

}  // namespace linkwright::planar
