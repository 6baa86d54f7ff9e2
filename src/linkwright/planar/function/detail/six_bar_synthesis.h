// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/planar/function/detail/range_errors.h"
#include "linkwright/planar/function/six_bar.h"

namespace linkwright::planar {

// Places of the range where errors are minimised.
inline constexpr std::size_t six_bar_samples = 81;
// Fits that the least greatest error is sought from, designs that are kept.
inline constexpr std::size_t six_bar_minimax_starts = 6, max_six_bars = 5;
inline constexpr int minimax_passes = 3;
// Places of the range at which the pair angles are conditions of the least greatest error, and by how much
// they may be less between these places (rad).
inline constexpr std::size_t pair_places = 41;
inline constexpr double between_pairs = 2e-3;
// Designs whose numbers agree to this share are one.
inline constexpr double same_six_bar = 2e-2;

/// Errors of a six-bar over the range, at `samples` shares; its output_at gives `output` and `sine`.
template <class Generator>
SixBarDesign<Generator> assess_six_bar(const FunctionProblem& problem, const Generator& generator,
                                       int samples) {
  const RangeErrors errors = range_errors(
      [&](double share) -> std::optional<PlaceError> {
        const auto at = output_at(generator, problem.input_range * share);
        if (!at) return std::nullopt;
        return PlaceError{math::wrap_angle(at->output - problem.output(share)), at->sine};
      },
      samples);
  return {generator, errors.assembles, errors.greatest_error, errors.rms_error, errors.pair_angle};
}

/// The search for six-bars of any structure that generate a function: least squares from the starts of the
/// model, for the least greatest error powers of the errors, then sequential quadratic programmes. A model
/// has
/// - `Generator` and `numbers`: what it is, and how many numbers it has;
/// - `numbers_of(generator)` and `with(generator, x)`: to and from these;
/// - `bounds(max_link, lower, upper)`: of the numbers;
/// - `starts(problem, four_bars, pair_angle)`: generators to begin from; `four_bars` are the best of the
///   same problem;
/// - `output(generator, input, slopes)`: rad, with its slopes unless null; nothing where it does not
/// assemble;
/// - `pair_cosines(generator, input, cosines, slopes)`: of the two angles that transmit force, likewise;
/// - `usable(generator)`: whether it can be built.
template <class Model>
class SixBarFinder {
  using Generator = typename Model::Generator;
  using Design = SixBarDesign<Generator>;
  using Numbers = std::array<double, Model::numbers>;
  static constexpr std::size_t numbers = Model::numbers;

 public:
  SixBarFinder(const FunctionProblem& problem, double pair_angle, RunContext& context)
      : p_(problem), pair_angle_(pair_angle), context_(context) {
    for (std::size_t k = 0; k < six_bar_samples; ++k) wanted_.push_back(p_.output(share(k)));
    Model::bounds(p_.max_link, lower_, upper_);
  }

  SixBarAnswer<Generator> find() {
    FunctionAnswer four_bars = find_generators(p_, context_);
    out_.status = four_bars.status;
    std::erase_if(four_bars.designs, [](const FunctionDesign& d) { return !d.assembles; });
    if (!four_bars.designs.empty()) out_.four_bar = four_bars.designs[0];
    if (!stopped(0)) {
      const std::vector<Generator> starts = Model::starts(p_, four_bars.designs, pair_angle_);
      for (std::size_t k = 0;
           k < starts.size() && !stopped(static_cast<double>(k) / static_cast<double>(starts.size())); ++k)
        fit(starts[k]);
    }
    rank(FunctionFit::least_squares, six_bar_minimax_starts);
    if (p_.fit == FunctionFit::minimax) minimax();
    rank(p_.fit, max_six_bars);
    if (out_.status == Status::done && out_.designs.empty()) out_.status = Status::infeasible;
    return std::move(out_);
  }

 private:
  static double share(std::size_t k) { return static_cast<double>(k) / (six_bar_samples - 1); }

  // Errors over the range and their slopes, by columns; false where it does not assemble.
  bool errors(const Generator& g, std::span<double> r, std::span<double> jacobian) const {
    Numbers slopes{};
    for (std::size_t k = 0; k < six_bar_samples; ++k) {
      const std::optional<double> out =
          Model::output(g, p_.input_range * share(k), jacobian.empty() ? nullptr : slopes.data());
      if (!out) return false;
      r[k] = math::wrap_angle(*out - wanted_[k]);
      for (std::size_t j = 0; j < numbers && !jacobian.empty(); ++j)
        jacobian[j * six_bar_samples + k] = slopes[j];
    }
    return true;
  }

  void fit(const Generator& start) { fit_power(start, 1, 1); }

  // Least sum of squares of (error / unit)^power, power odd: the higher, the more the greatest error counts.
  void fit_power(const Generator& start, int power, double unit) {
    Numbers x = Model::numbers_of(start);
    const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
      if (!errors(Model::with(start, at), r, jacobian)) return false;
      for (std::size_t k = 0; k < six_bar_samples && power > 1; ++k) {
        const double even = std::pow(r[k] / unit, power - 1);
        for (std::size_t j = 0; j < numbers && !jacobian.empty(); ++j)
          jacobian[j * six_bar_samples + k] *= power * even / unit;
        r[k] *= even / unit;
      }
      return true;
    };
    math::LeastSquaresOptions options;
    options.max_iterations = 300;
    options.lambda_max = 1e12;
    options.decrease_tolerance = 0;
    options.relative_decrease_tolerance = 1e-8;
    const math::LeastSquaresReport report =
        math::minimise_least_squares(residuals, six_bar_samples, x, lower_, upper_, options, workspace_);
    ++out_.starts;
    if (report.end == math::LeastSquaresEnd::start) return;
    add(Model::with(start, x));
  }

  void add(const Generator& g) {
    const Design design = assess(p_, g);
    if (design.assembles && Model::usable(g)) out_.designs.push_back(design);
  }

  void minimax() {
    // Powers of the errors lead towards the greatest one, though not always with the pair angle that is
    // wanted: both ends are starts. The design of one power begins the next.
    std::vector<Design> starts = out_.designs;
    const std::size_t fitted = starts.size();
    for (std::size_t s = 0; s < fitted; ++s) {
      Design led = starts[s];
      for (const int power : {3, 5, 9}) {
        if (stopped(0) || !(led.greatest_error > 0)) return;
        const std::size_t before = out_.designs.size();
        fit_power(led.generator, power, led.greatest_error);
        if (out_.designs.size() > before && out_.designs.back().greatest_error < led.greatest_error)
          led = out_.designs.back();
      }
      if (led.greatest_error < starts[s].greatest_error) starts.push_back(led);
    }
    for (std::size_t s = 0; s < starts.size(); ++s) {
      if (stopped(static_cast<double>(s) / static_cast<double>(starts.size()))) return;
      const Generator start = starts[s].generator;
      const double unit = starts[s].greatest_error;
      if (!(unit > 0)) continue;
      // Both signs of the error over the range; where it does not assemble, far more than any.
      const auto objectives = [&](std::span<const double> x, std::span<double> values,
                                  std::span<double> gradients) {
        std::array<double, six_bar_samples> r;
        std::array<double, numbers * six_bar_samples> jacobian;
        const bool there = errors(Model::with(start, x), r, jacobian);
        for (std::size_t k = 0; k < six_bar_samples; ++k)
          for (const bool turned : {false, true}) {
            const std::size_t row = 2 * k + turned;
            const double sign = turned ? -1 : 1;
            values[row] = there ? sign * r[k] / unit : 1e3;
            for (std::size_t j = 0; j < numbers && !gradients.empty(); ++j)
              gradients[row * numbers + j] = there ? sign * jacobian[j * six_bar_samples + k] / unit : 0;
          }
      };
      const double max_cosine = std::cos(pair_angle_ + between_pairs);
      const auto conditions = [&](std::span<const double> x, std::span<double> values,
                                  std::span<double> gradients) {
        const Generator g = Model::with(start, x);
        std::array<double, 2> pairs{};
        std::array<double, 2 * numbers> slopes{};
        for (std::size_t k = 0; k < pair_places; ++k) {
          const double input = p_.input_range * static_cast<double>(k) / (pair_places - 1);
          Model::pair_cosines(g, input, pairs, gradients.empty() ? nullptr : slopes.data());
          for (std::size_t row = 4 * k; row < 4 * k + 4; ++row) {
            const std::size_t pair = row % 4 / 2;
            const double sign = row % 2 == 0 ? 1 : -1;
            values[row] = sign * pairs[pair] - max_cosine;
            for (std::size_t j = 0; j < numbers && !gradients.empty(); ++j)
              gradients[numbers * row + j] = sign * slopes[numbers * pair + j];
          }
        }
      };
      Numbers x = Model::numbers_of(start);
      for (std::size_t j = 0; j < numbers; ++j) x[j] = std::clamp(x[j], lower_[j], upper_[j]);
      // A search that begins again forgets the curvature that led it astray.
      for (int pass = 0; pass < minimax_passes; ++pass)
        optimise::minimise_largest(2 * six_bar_samples, objectives, {}, 4 * pair_places, conditions, x,
                                   lower_, upper_, {}, context_);
      ++out_.starts;
      add(Model::with(start, x));
    }
  }

  // Best first, each once.
  void rank(FunctionFit fit, std::size_t most) {
    std::stable_sort(out_.designs.begin(), out_.designs.end(), [&](const Design& a, const Design& b) {
      const bool steep_a = a.pair_angle >= pair_angle_, steep_b = b.pair_angle >= pair_angle_;
      if (steep_a != steep_b) return steep_a;
      if (fit == FunctionFit::least_squares) return a.rms_error < b.rms_error;
      return a.greatest_error < b.greatest_error;
    });
    std::vector<Design> kept;
    for (const Design& d : out_.designs) {
      const Numbers x = Model::numbers_of(d.generator);
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const Design& k) {
        const Numbers y = Model::numbers_of(k.generator);
        double apart = 0, size = 0;
        for (std::size_t j = 0; j < numbers; ++j) apart += std::abs(x[j] - y[j]), size += std::abs(x[j]);
        return apart < same_six_bar * size;
      });
      if (!known && kept.size() < most) kept.push_back(d);
    }
    out_.designs = std::move(kept);
  }

  bool stopped(double fraction) {
    if (out_.status == Status::done) out_.status = context_.interruption();
    if (out_.status != Status::done) return true;
    context_.report({"six-bars", fraction, nan});
    return false;
  }

  const FunctionProblem& p_;
  double pair_angle_;
  RunContext& context_;
  std::vector<double> wanted_;
  Numbers lower_, upper_;
  math::LeastSquaresWorkspace workspace_;
  SixBarAnswer<Generator> out_;
};

}  // namespace linkwright::planar
