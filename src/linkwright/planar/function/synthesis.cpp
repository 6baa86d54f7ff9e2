// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/planar/function/detail/range_errors.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Places of the range where errors are minimised.
constexpr std::size_t fitted_samples = 81;
constexpr int random_generators = 60;
// Designs of a least squares fit that the least greatest error is sought from.
constexpr std::size_t minimax_starts = 4;
// Numbers for a least pair angle: more starts, the places of the range where it is a condition, by how much
// it may be less between these (rad), and random generators that have it, of which the best begin a search.
constexpr std::size_t steep_starts = 24, pair_conditions = 41, steep_generators = 24;
constexpr double between_conditions = 2e-3;
constexpr int screened_generators = 20000, generator_places = 13;
// Local optima with errors beyond this times that of the best are not worth listing.
constexpr double worth_listing = 10;
// Generators whose numbers agree to this share are one.
constexpr double same_generator = 1e-5;

double share_of(std::size_t k, std::size_t count) {
  return static_cast<double>(k) / static_cast<double>(count - 1);
}

std::array<double, 5> numbers_of(const FunctionGenerator& g) {
  return {g.a.real(), g.a.imag(), g.b.real(), g.b.imag(), g.c};
}
FunctionGenerator with_numbers(FunctionGenerator g, std::span<const double> x) {
  g.a = {x[0], x[1]};
  g.b = {x[2], x[3]};
  g.c = std::abs(x[4]);
  return g;
}

// Errors over the range and their slopes (column-major); false where it does not assemble.
bool errors(const FunctionProblem& p, const FunctionGenerator& g, std::span<const double> wanted,
            std::span<double> r, std::span<double> jacobian) {
  const std::size_t n = wanted.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::optional<GeneratorOutput> out = output_at(g, p.input_range * share_of(k, n));
    if (!out) return false;
    r[k] = p.slider ? out->output - wanted[k] : math::wrap_angle(out->output - wanted[k]);
    if (jacobian.empty()) continue;
    for (std::size_t j = 0; j < 5; ++j) jacobian[j * n + k] = out->slopes[j];
  }
  return true;
}

bool better_generator(const FunctionDesign& a, const FunctionDesign& b, FunctionFit fit, double pair_angle) {
  const auto whole = [](const FunctionDesign& d) { return d.assembles && d.other_branch == 0; };
  if (whole(a) != whole(b)) return whole(a);
  if ((a.pair_angle >= pair_angle) != (b.pair_angle >= pair_angle)) return a.pair_angle >= pair_angle;
  if (fit == FunctionFit::least_squares) return a.rms_error < b.rms_error;
  return a.greatest_error < b.greatest_error;
}

class GeneratorFinder {
 public:
  GeneratorFinder(const FunctionProblem& problem, RunContext& context) : p_(problem), context_(context) {
    for (std::size_t k = 0; k < fitted_samples; ++k)
      wanted_.push_back(p_.output(share_of(k, fitted_samples)));
  }

  FunctionAnswer find() {
    if (p_.fit == FunctionFit::points) {
      for (const FunctionGenerator& g : exact_generators(pairs(p_.at), p_.slider, p_.given))
        out_.designs.push_back(assess(p_, g));
    } else {
      least_squares();
      if (p_.fit == FunctionFit::minimax && out_.status == Status::done) minimax();
    }
    rank(p_.fit);
    if (p_.fit != FunctionFit::points && !out_.designs.empty()) {
      const double most = worth_listing * out_.designs[0].greatest_error;
      std::erase_if(out_.designs, [&](const FunctionDesign& d) { return d.greatest_error > most; });
    }
    return std::move(out_);
  }

 private:
  std::vector<FunctionPair> pairs(const std::vector<double>& shares) const {
    std::vector<FunctionPair> out;
    for (const double share : shares) out.push_back({p_.input_range * share, p_.output(share)});
    return out;
  }

  void least_squares() {
    // Exact solutions at Chebyshev's points, and at points moved by half a gap either way.
    const std::vector<double> base = chebyshev_shares(5);
    for (const double shift : {0.0, 0.5, -0.5}) {
      std::vector<double> shares = base;
      for (std::size_t k = 0; k < 5 && shift != 0; ++k) {
        const double next = shift > 0 ? (k + 1 < 5 ? base[k + 1] : 1) : (k > 0 ? base[k - 1] : 0);
        shares[k] += std::abs(shift) * (next - base[k]);
      }
      for (const FunctionGenerator& g : exact_generators(pairs(shares), p_.slider))
        for (const double branch : {1.0, -1.0}) {
          FunctionGenerator start = g;
          start.branch = branch;
          fit(start);
        }
    }
    const double scale = p_.slider ? std::abs(p_.output(1)) : 1;
    for (int k = 0; k < random_generators; ++k) {
      if (stopped(static_cast<double>(k) / random_generators)) return;
      RandomStream random({.seed = 1, .individual = static_cast<std::uint32_t>(k)});
      const auto length = [&] { return scale * std::exp(random.uniform(-1.5, 1.5)); };
      FunctionGenerator g{p_.slider, std::polar(length(), random.uniform(-pi, pi)), 0, length(),
                          k % 2 == 0 ? 1.0 : -1.0};
      g.b = p_.slider ? Complex(scale * random.normal(), 0.5 * scale * random.normal()) : Complex(length());
      // Turned so that the middle of the range fits.
      const std::optional<GeneratorOutput> middle = output_at(g, 0.5 * p_.input_range);
      if (!middle) continue;
      const double off = middle->output - p_.output(0.5);
      g.b = p_.slider ? g.b + off : g.b * std::polar(1.0, off);
      fit(g);
    }
  }

  void fit(const FunctionGenerator& start) {
    std::array<double, 5> x = numbers_of(start), lower, upper;
    lower.fill(-p_.max_link);
    upper.fill(p_.max_link);
    lower[4] = 1e-6 * p_.max_link;
    const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
      return errors(p_, with_numbers(start, at), wanted_, r, jacobian);
    };
    math::LeastSquaresOptions options;
    options.max_iterations = 300;
    options.lambda_max = 1e12;
    options.decrease_tolerance = 0;
    options.relative_decrease_tolerance = 1e-10;
    const math::LeastSquaresReport report =
        math::minimise_least_squares(residuals, fitted_samples, x, lower, upper, options, workspace_);
    ++out_.starts;
    if (report.end == math::LeastSquaresEnd::start) return;
    out_.designs.push_back(assess(p_, with_numbers(start, x)));
  }

  void minimax() {
    rank(FunctionFit::least_squares);
    const bool steep = p_.min_pair_angle > 0;
    std::vector<FunctionDesign> starts = out_.designs;
    starts.resize(std::min(steep ? steep_starts : minimax_starts, starts.size()));
    if (steep) add_steep(starts);
    for (std::size_t s = 0; s < starts.size(); ++s) {
      if (stopped(static_cast<double>(s) / static_cast<double>(starts.size()))) return;
      const FunctionGenerator start = starts[s].generator;
      const double unit = starts[s].greatest_error;
      if (!starts[s].assembles || !(unit > 0)) continue;
      // Both signs of the error over the range; where it does not assemble, far more than any.
      const auto objectives = [&](std::span<const double> x, std::span<double> values,
                                  std::span<double> gradients) {
        std::array<double, fitted_samples> r;
        std::array<double, 5 * fitted_samples> jacobian;
        const bool there = errors(p_, with_numbers(start, x), wanted_, r, jacobian);
        for (std::size_t k = 0; k < fitted_samples; ++k)
          for (const bool turned : {false, true}) {
            const std::size_t row = 2 * k + turned;
            const double sign = turned ? -1 : 1;
            values[row] = there ? sign * r[k] / unit : 1e3;
            if (gradients.empty()) continue;
            for (std::size_t j = 0; j < 5; ++j)
              gradients[row * 5 + j] = there ? sign * jacobian[j * fitted_samples + k] / unit : 0;
          }
      };
      std::array<double, 5> x = numbers_of(start), lower, upper;
      lower.fill(-p_.max_link);
      upper.fill(p_.max_link);
      lower[4] = 1e-6 * p_.max_link;
      for (std::size_t j = 0; j < 5; ++j) x[j] = std::clamp(x[j], lower[j], upper[j]);
      const double max_cosine = std::cos(p_.min_pair_angle + between_conditions);
      const auto conditions = [&](std::span<const double> at, std::span<double> values,
                                  std::span<double> gradients) {
        const FunctionGenerator g = with_numbers(start, at);
        for (std::size_t k = 0; k < pair_conditions; ++k) {
          const PairCosine pair = pair_cosine(g, p_.input_range * share_of(k, pair_conditions));
          for (std::size_t row = 2 * k; row < 2 * k + 2; ++row) {
            const double sign = row % 2 == 0 ? 1 : -1;
            values[row] = sign * pair.value - max_cosine;
            for (std::size_t j = 0; j < 5 && !gradients.empty(); ++j)
              gradients[5 * row + j] = sign * pair.slopes[j];
          }
        }
      };
      if (steep)
        optimise::minimise_largest(2 * fitted_samples, objectives, {}, 2 * pair_conditions, conditions, x,
                                   lower, upper, {}, context_);
      else
        optimise::minimise_largest(2 * fitted_samples, objectives, {}, x, lower, upper, {}, context_);
      ++out_.starts;
      const FunctionDesign design = assess(p_, with_numbers(start, x));
      if (design.assembles) out_.designs.push_back(design);
    }
  }

  // The best of many random generators with the least pair angle, each turned, or moved, so that the mean
  // error is none.
  void add_steep(std::vector<FunctionDesign>& starts) const {
    std::vector<std::pair<double, FunctionGenerator>> screened;
    const double scale = p_.slider ? std::abs(p_.output(1)) : 1, least = std::sin(p_.min_pair_angle);
    for (int k = 0; k < screened_generators; ++k) {
      RandomStream random({.seed = 1, .run = 1, .individual = static_cast<std::uint32_t>(k)});
      const auto length = [&] { return scale * std::exp(random.uniform(-2, 2)); };
      FunctionGenerator g{p_.slider, std::polar(length(), random.uniform(-pi, pi)), 0, length(),
                          k % 2 == 0 ? 1.0 : -1.0};
      g.b = p_.slider ? Complex(0, scale * random.normal()) : Complex(length());
      double sum = 0, squares = 0, last = 0;
      bool there = true;
      for (std::size_t i = 0; i < generator_places && there; ++i) {
        const double share = share_of(i, generator_places);
        const auto at = output_at(g, p_.input_range * share);
        there = at && at->sine > least;
        if (!there) break;
        double off = at->output - p_.output(share);
        if (i > 0 && !p_.slider) off += 2 * pi * std::round((last - off) / (2 * pi));
        last = off;
        sum += off;
        squares += off * off;
      }
      if (!there) continue;
      const double mean = sum / generator_places;
      g.b = p_.slider ? g.b + mean : g.b * std::polar(1.0, mean);
      screened.emplace_back(squares / generator_places - mean * mean, g);
    }
    std::stable_sort(screened.begin(), screened.end(),
                     [](const auto& one, const auto& other) { return one.first < other.first; });
    for (std::size_t k = 0; k < std::min(steep_generators, screened.size()); ++k)
      starts.push_back(assess(p_, screened[k].second));
  }

  // Best first, each once.
  void rank(FunctionFit fit) {
    std::stable_sort(out_.designs.begin(), out_.designs.end(),
                     [&](const FunctionDesign& a, const FunctionDesign& b) {
                       return better_generator(a, b, fit, p_.min_pair_angle);
                     });
    std::vector<FunctionDesign> kept;
    for (const FunctionDesign& d : out_.designs) {
      const auto x = numbers_of(d.generator);
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const FunctionDesign& k) {
        const auto y = numbers_of(k.generator);
        double apart = 0, size = 0;
        for (std::size_t j = 0; j < 5; ++j) apart += std::abs(x[j] - y[j]), size += std::abs(x[j]);
        return apart < same_generator * size;
      });
      if (!known) kept.push_back(d);
    }
    out_.designs = std::move(kept);
  }

  bool stopped(double fraction) {
    out_.status = context_.interruption();
    if (out_.status != Status::done) return true;
    context_.report({"generators", fraction, nan});
    return false;
  }

  const FunctionProblem& p_;
  RunContext& context_;
  std::vector<double> wanted_;
  math::LeastSquaresWorkspace workspace_;
  FunctionAnswer out_;
};

}  // namespace

std::vector<double> chebyshev_shares(int count) {
  LINKWRIGHT_REQUIRE(count >= 1, "{} points", count);
  std::vector<double> out;
  for (int k = 1; k <= count; ++k) out.push_back(0.5 * (1 - std::cos((2 * k - 1) * pi / (2 * count))));
  return out;
}

std::optional<double> structural_error(const FunctionProblem& problem, const FunctionGenerator& generator,
                                       double share) {
  const std::optional<GeneratorPlace> out = place_at(generator, problem.input_range * share);
  if (!out) return std::nullopt;
  const double error = out->output - problem.output(share);
  return problem.slider ? error : math::wrap_angle(error);
}

RangeErrors range_errors(const std::function<std::optional<PlaceError>(double share)>& at, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "{} samples", samples);
  RangeErrors out;
  double least = 1, sum = 0;
  int there = 0;
  for (int k = 0; k < samples; ++k) {
    const std::optional<PlaceError> place = at(static_cast<double>(k) / (samples - 1));
    if (!place) {
      out.assembles = false;
      continue;
    }
    out.greatest_error = std::max(out.greatest_error, std::abs(place->error));
    sum += place->error * place->error;
    ++there;
    least = std::min(least, place->sine);
  }
  out.rms_error = there > 0 ? std::sqrt(sum / there) : infinity;
  out.pair_angle = out.assembles ? std::asin(std::min(1.0, least)) : 0;
  return out;
}

FunctionDesign assess(const FunctionProblem& problem, const FunctionGenerator& generator, int samples) {
  const RangeErrors errors = range_errors(
      [&](double share) -> std::optional<PlaceError> {
        const std::optional<GeneratorPlace> at = place_at(generator, problem.input_range * share);
        if (!at) return std::nullopt;
        return PlaceError{*structural_error(problem, generator, share), at->sine};
      },
      samples);
  FunctionDesign out;
  out.generator = generator;
  out.assembles = errors.assembles;
  out.greatest_error = errors.greatest_error;
  out.rms_error = errors.rms_error;
  out.pair_angle = errors.pair_angle;
  // An exact point that is missed was met on the other branch, unless both meet there.
  const double rounding = 1e-6 * (problem.slider ? std::abs(problem.output(1)) : 1);
  if (problem.fit == FunctionFit::points)
    for (const double share : problem.at) {
      const std::optional<GeneratorPlace> place = place_at(generator, problem.input_range * share);
      if (!place || place->on_both_branches) continue;
      if (std::abs(*structural_error(problem, generator, share)) > rounding) ++out.other_branch;
    }
  return out;
}

FunctionAnswer find_generators(const FunctionProblem& problem, RunContext& context) {
  return GeneratorFinder(problem, context).find();
}

}  // namespace linkwright::planar
