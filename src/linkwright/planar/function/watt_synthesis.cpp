#include "linkwright/planar/function/watt_synthesis.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using WattNumbers = std::array<double, 10>;

// Places of the range where errors are minimised.
constexpr std::size_t watt_samples = 81;
constexpr int random_watts = 120;
// Four-bars to begin from, fits that the least greatest error is sought from, designs that are kept.
constexpr std::size_t four_bar_starts = 3, watt_minimax_starts = 6, most_watts = 5;
constexpr int minimax_passes = 3;
// Places of the range at which the pair angles are conditions of the least greatest error, and by how much
// they may be less between these places (rad).
constexpr std::size_t pair_places = 41;
constexpr double between_pairs = 2e-3;
// Designs whose numbers agree to this share are one.
constexpr double same_watt = 2e-2;
// Directions of the cranks of parallelograms on either side of their ground link.
constexpr int parallelogram_directions = 3;

WattNumbers numbers_of(const WattGenerator& g) {
  return {g.first.a.real(),  g.first.a.imag(),  g.first.b.real(),  g.first.b.imag(),  g.first.c,
          g.second.a.real(), g.second.a.imag(), g.second.b.real(), g.second.b.imag(), g.second.c};
}
WattGenerator watt_with(WattGenerator g, std::span<const double> x) {
  g.first.a = {x[0], x[1]}, g.first.b = {x[2], x[3]}, g.first.c = x[4];
  g.second.a = {x[5], x[6]}, g.second.b = {x[7], x[8]}, g.second.c = x[9];
  return g;
}

// Cosine of the angle between coupler and rocker, with its derivatives by the numbers of the four-bar and by
// the input.
struct PairCosine {
  double value = 0, by_input = 0;
  std::array<double, 5> slopes{};
};
PairCosine pair_cosine(const FunctionGenerator& g, double input) {
  const Complex turn = std::polar(1.0, input), pin = g.a * turn, i(0, 1);
  const double rocker = std::abs(g.b), below = 2 * g.c * rocker;
  const Complex pull = 2.0 * std::conj(1.0 - pin);  // how the square of the distance falls with the pin
  PairCosine out;
  out.value = (g.c * g.c + rocker * rocker - std::norm(1.0 - pin)) / below;
  const Complex by_b = (2.0 - out.value * 2 * g.c / rocker) * g.b / below;
  out.slopes = {std::real(pull * turn) / below, std::real(pull * i * turn) / below, by_b.real(), by_b.imag(),
                (2 * g.c - out.value * 2 * rocker) / below};
  out.by_input = std::real(pull * i * pin) / below;
  return out;
}

class WattFinder {
 public:
  WattFinder(const FunctionProblem& problem, double pair_angle, RunContext& context)
      : p_(problem), pair_angle_(pair_angle), context_(context) {
    for (std::size_t k = 0; k < watt_samples; ++k) wanted_.push_back(p_.output(share(k)));
    // Pins within a square of this half width are no farther than the longest link.
    lower_.fill(-p_.most_link / std::sqrt(2.0)), upper_.fill(p_.most_link / std::sqrt(2.0));
    lower_[4] = lower_[9] = 1e-6 * p_.most_link, upper_[4] = upper_[9] = p_.most_link;
  }

  WattAnswer find() {
    FunctionAnswer four_bars = find_generators(p_, context_);
    out_.status = four_bars.status;
    std::erase_if(four_bars.designs, [](const FunctionDesign& d) { return !d.assembles; });
    if (!four_bars.designs.empty()) out_.four_bar = four_bars.designs[0];
    for (std::size_t k = 0; k < std::min(four_bar_starts, four_bars.designs.size()) && !stopped(0); ++k)
      from_four_bar(four_bars.designs[k].generator);
    for (int k = 0; k < random_watts && !stopped(static_cast<double>(k) / random_watts); ++k)
      from_random(static_cast<std::uint32_t>(k));
    rank(FunctionFit::least_squares, watt_minimax_starts);
    if (p_.fit == FunctionFit::minimax) minimax();
    rank(p_.fit, most_watts);
    if (out_.status == Status::done && out_.designs.empty()) out_.status = Status::infeasible;
    return std::move(out_);
  }

 private:
  static double share(std::size_t k) { return static_cast<double>(k) / (watt_samples - 1); }

  // The crank of a parallelogram stays on one side of its ground link while it turns.
  void from_four_bar(const FunctionGenerator& four_bar) {
    for (const bool before : {true, false}) {
      const double turn = before ? p_.input_range : p_.output(1);
      if (!(std::abs(turn) < pi)) continue;
      for (const double side : {0.0, pi})
        for (int j = 0; j < parallelogram_directions; ++j)
          for (const double length : {0.5, 1.0}) {
            const double room = pi - std::abs(turn);
            const double from = side + std::max(0.0, -turn) + room * (j + 0.5) / parallelogram_directions;
            const Complex pin = std::polar(length, from);
            const FunctionGenerator parallelogram{false, pin, pin, 1, side > 0 ? -1.0 : 1.0};
            fit(before ? WattGenerator{parallelogram, four_bar} : WattGenerator{four_bar, parallelogram});
          }
    }
  }

  void from_random(std::uint32_t individual) {
    RandomStream random({.seed = 1, .run = 1, .individual = individual});
    const auto length = [&] { return std::exp(random.uniform(-1.2, 1.2)); };
    const auto any = [&](double branch) {
      return FunctionGenerator{false, std::polar(length(), random.uniform(-pi, pi)),
                               std::polar(length(), random.uniform(-pi, pi)), length(), branch};
    };
    WattGenerator g{any(individual % 2 == 0 ? 1 : -1), any(individual % 4 < 2 ? 1 : -1)};
    // Turned so that the middle of the range fits.
    const std::optional<WattOutput> middle = output_at(g, 0.5 * p_.input_range);
    if (!middle) return;
    g.second.b *= std::polar(1.0, middle->output - p_.output(0.5));
    fit(g);
  }

  // Errors over the range and their slopes, by columns; false where it does not assemble.
  bool errors(const WattGenerator& g, std::span<double> r, std::span<double> jacobian) const {
    for (std::size_t k = 0; k < watt_samples; ++k) {
      const std::optional<WattOutput> out = output_at(g, p_.input_range * share(k));
      if (!out) return false;
      r[k] = math::wrap_angle(out->output - wanted_[k]);
      for (std::size_t j = 0; j < 10 && !jacobian.empty(); ++j)
        jacobian[j * watt_samples + k] = out->slopes[j];
    }
    return true;
  }

  void fit(const WattGenerator& start) { fit_power(start, 1, 1); }

  // Least sum of squares of (error / unit)^power, power odd: the higher, the more the greatest error counts.
  void fit_power(const WattGenerator& start, int power, double unit) {
    WattNumbers x = numbers_of(start);
    const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
      if (!errors(watt_with(start, at), r, jacobian)) return false;
      for (std::size_t k = 0; k < watt_samples && power > 1; ++k) {
        const double even = std::pow(r[k] / unit, power - 1);
        for (std::size_t j = 0; j < 10 && !jacobian.empty(); ++j)
          jacobian[j * watt_samples + k] *= power * even / unit;
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
        math::minimise_least_squares(residuals, watt_samples, x, lower_, upper_, options, workspace_);
    ++out_.starts;
    if (report.end == math::LeastSquaresEnd::start) return;
    add(watt_with(start, x));
  }

  void add(const WattGenerator& g) {
    const WattDesign design = assess(p_, g);
    if (design.assembles) out_.designs.push_back(design);
  }

  void minimax() {
    // Powers of the errors lead towards the greatest one, though not always with the pair angle that is
    // wanted: both ends are starts. The design of one power begins the next.
    std::vector<WattDesign> starts = out_.designs;
    const std::size_t fitted = starts.size();
    for (std::size_t s = 0; s < fitted; ++s) {
      WattDesign led = starts[s];
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
      const WattGenerator start = starts[s].generator;
      const double unit = starts[s].greatest_error;
      if (!(unit > 0)) continue;
      // Both signs of the error over the range; where it does not assemble, far more than any.
      const auto objectives = [&](std::span<const double> x, std::span<double> values,
                                  std::span<double> gradients) {
        std::array<double, watt_samples> r;
        std::array<double, 10 * watt_samples> jacobian;
        const bool there = errors(watt_with(start, x), r, jacobian);
        for (std::size_t k = 0; k < watt_samples; ++k)
          for (const bool turned : {false, true}) {
            const std::size_t row = 2 * k + turned;
            const double sign = turned ? -1 : 1;
            values[row] = there ? sign * r[k] / unit : 1e3;
            for (std::size_t j = 0; j < 10 && !gradients.empty(); ++j)
              gradients[row * 10 + j] = there ? sign * jacobian[j * watt_samples + k] / unit : 0;
          }
      };
      const double most_cosine = std::cos(pair_angle_ + between_pairs);
      const auto conditions = [&](std::span<const double> x, std::span<double> values,
                                  std::span<double> gradients) {
        const WattGenerator g = watt_with(start, x);
        for (std::size_t k = 0; k < pair_places; ++k) {
          const double input = p_.input_range * static_cast<double>(k) / (pair_places - 1);
          const std::optional<GeneratorOutput> middle = output_at(g.first, input);
          const PairCosine first = pair_cosine(g.first, input),
                           second = pair_cosine(g.second, middle ? middle->output : 0);
          for (std::size_t row = 4 * k; row < 4 * k + 4; ++row) {
            const PairCosine& pair = row % 4 < 2 ? first : second;
            const double sign = row % 2 == 0 ? 1 : -1;
            values[row] = sign * pair.value - most_cosine;
            if (gradients.empty()) continue;
            for (std::size_t j = 0; j < 5; ++j) {
              gradients[10 * row + j] = row % 4 < 2 ? sign * pair.slopes[j]
                                        : middle    ? sign * pair.by_input * middle->slopes[j]
                                                    : 0;
              gradients[10 * row + 5 + j] = row % 4 < 2 ? 0 : sign * pair.slopes[j];
            }
          }
        }
      };
      WattNumbers x = numbers_of(start);
      for (std::size_t j = 0; j < 10; ++j) x[j] = std::clamp(x[j], lower_[j], upper_[j]);
      // A search that begins again forgets the curvature that led it astray.
      for (int pass = 0; pass < minimax_passes; ++pass)
        optimise::minimise_largest(2 * watt_samples, objectives, {}, 4 * pair_places, conditions, x, lower_,
                                   upper_, {}, context_);
      ++out_.starts;
      add(watt_with(start, x));
    }
  }

  // Best first, each once.
  void rank(FunctionFit fit, std::size_t most) {
    std::stable_sort(out_.designs.begin(), out_.designs.end(), [&](const WattDesign& a, const WattDesign& b) {
      const bool steep_a = a.pair_angle >= pair_angle_, steep_b = b.pair_angle >= pair_angle_;
      if (steep_a != steep_b) return steep_a;
      if (fit == FunctionFit::least_squares) return a.rms_error < b.rms_error;
      return a.greatest_error < b.greatest_error;
    });
    std::vector<WattDesign> kept;
    for (const WattDesign& d : out_.designs) {
      const WattNumbers x = numbers_of(d.generator);
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const WattDesign& k) {
        const WattNumbers y = numbers_of(k.generator);
        double apart = 0, size = 0;
        for (std::size_t j = 0; j < 10; ++j) apart += std::abs(x[j] - y[j]), size += std::abs(x[j]);
        return apart < same_watt * size;
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
  WattNumbers lower_, upper_;
  math::LeastSquaresWorkspace workspace_;
  WattAnswer out_;
};

}  // namespace

std::optional<WattOutput> output_at(const WattGenerator& g, double input) {
  const std::optional<GeneratorOutput> middle = output_at(g.first, input);
  if (!middle) return std::nullopt;
  const std::optional<GeneratorOutput> end = output_at(g.second, middle->output);
  if (!end) return std::nullopt;
  WattOutput out;
  out.output = end->output;
  out.sine = std::min(middle->sine, end->sine);
  // An input that grows turns the crank pin: it moves by i a.
  const double by_middle = -end->slopes[0] * g.second.a.imag() + end->slopes[1] * g.second.a.real();
  for (std::size_t j = 0; j < 5; ++j) {
    out.slopes[j] = by_middle * middle->slopes[j];
    out.slopes[5 + j] = end->slopes[j];
  }
  return out;
}

Linkage linkage_of(const WattGenerator& g, double ground) {
  const double rocker = std::abs(g.first.b);
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {ground, 0}}, {"H0", {2 * ground, 0}}});
  add_bar(l, "crank", "O", "A", ground * std::abs(g.first.a));
  add_bar(l, "coupler", "A", "B", ground * g.first.c);
  add_body(l, "rocker",
           {{"B0", {0, 0}},
            {"B", {ground * rocker, 0}},
            {"D", ground * g.second.a * std::conj(g.first.b) / rocker}});
  add_bar(l, "link", "D", "H", ground * g.second.c);
  add_bar(l, "output", "H0", "H", ground * std::abs(g.second.b));
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_pin(l, "D", "rocker.D", "link.D");
  add_pin(l, "H", "link.H", "output.H");
  add_pin(l, "H0", "ground.H0", "output.H0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", g.first.branch > 0 ? AssemblyMode::plus : AssemblyMode::minus);
  set_mode(l, "link", "output", g.second.branch > 0 ? AssemblyMode::plus : AssemblyMode::minus);
  return l;
}

WattDesign assess(const FunctionProblem& problem, const WattGenerator& generator, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "{} samples", samples);
  WattDesign out;
  out.generator = generator;
  double least = 1, sum = 0;
  int there = 0;
  for (int k = 0; k < samples; ++k) {
    const double share = static_cast<double>(k) / (samples - 1);
    const std::optional<WattOutput> at = output_at(generator, problem.input_range * share);
    if (!at) {
      out.assembles = false;
      continue;
    }
    const double error = math::wrap_angle(at->output - problem.output(share));
    out.greatest_error = std::max(out.greatest_error, std::abs(error));
    sum += error * error;
    ++there;
    least = std::min(least, at->sine);
  }
  out.rms_error = there > 0 ? std::sqrt(sum / there) : infinity;
  out.pair_angle = out.assembles ? std::asin(std::min(1.0, least)) : 0;
  return out;
}

WattAnswer find_watt_generators(const FunctionProblem& problem, double pair_angle, RunContext& context) {
  LINKWRIGHT_REQUIRE(!problem.slider, "the output is a rocker");
  LINKWRIGHT_REQUIRE(problem.fit != FunctionFit::points, "six-bars are fitted");
  return WattFinder(problem, pair_angle, context).find();
}

}  // namespace linkwright::planar
