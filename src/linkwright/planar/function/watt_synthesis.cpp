// SPDX-License-Identifier: BSD-3-Clause
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
#include "linkwright/planar/function/detail/six_bar_synthesis.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

constexpr int random_watts = 120;
// Four-bars to begin from.
constexpr std::size_t four_bar_starts = 3;
// Directions of the cranks of parallelograms on either side of their ground link.
constexpr int parallelogram_directions = 3;

struct WattModel {
  using Generator = WattGenerator;
  static constexpr std::size_t numbers = 10;

  static std::array<double, numbers> numbers_of(const WattGenerator& g) {
    return {g.first.a.real(),  g.first.a.imag(),  g.first.b.real(),  g.first.b.imag(),  g.first.c,
            g.second.a.real(), g.second.a.imag(), g.second.b.real(), g.second.b.imag(), g.second.c};
  }
  static WattGenerator with(WattGenerator g, std::span<const double> x) {
    g.first.a = {x[0], x[1]}, g.first.b = {x[2], x[3]}, g.first.c = x[4];
    g.second.a = {x[5], x[6]}, g.second.b = {x[7], x[8]}, g.second.c = x[9];
    return g;
  }

  static void bounds(double max_link, std::span<double> lower, std::span<double> upper) {
    // Pins within a square of this half width are no farther than the longest link.
    for (std::size_t j = 0; j < numbers; ++j) upper[j] = max_link / std::sqrt(2.0), lower[j] = -upper[j];
    for (const std::size_t j : {4, 9}) lower[j] = 1e-6 * max_link, upper[j] = max_link;
  }

  static std::vector<WattGenerator> starts(const FunctionProblem& p,
                                           std::span<const FunctionDesign> four_bars, double) {
    std::vector<WattGenerator> out;
    for (std::size_t k = 0; k < std::min(four_bar_starts, four_bars.size()); ++k)
      from_four_bar(p, four_bars[k].generator, out);
    for (int k = 0; k < random_watts; ++k) from_random(p, static_cast<std::uint32_t>(k), out);
    return out;
  }

  static std::optional<double> output(const WattGenerator& g, double input, double* slopes) {
    const std::optional<WattOutput> out = output_at(g, input);
    if (!out) return std::nullopt;
    if (slopes) std::copy(out->slopes.begin(), out->slopes.end(), slopes);
    return out->output;
  }

  static void pair_cosines(const WattGenerator& g, double input, std::array<double, 2>& cosines,
                           double* slopes) {
    const std::optional<GeneratorOutput> middle = output_at(g.first, input);
    const PairCosine first = pair_cosine(g.first, input),
                     second = pair_cosine(g.second, middle ? middle->output : 0);
    cosines = {first.value, second.value};
    for (std::size_t j = 0; j < 5 && slopes; ++j) {
      slopes[j] = first.slopes[j];
      slopes[5 + j] = 0;
      slopes[10 + j] = middle ? second.by_input * middle->slopes[j] : 0;
      slopes[15 + j] = second.slopes[j];
    }
  }

  static bool usable(const WattGenerator&) { return true; }

 private:
  // The crank of a parallelogram stays on one side of its ground link while it turns.
  static void from_four_bar(const FunctionProblem& p, const FunctionGenerator& four_bar,
                            std::vector<WattGenerator>& out) {
    for (const bool before : {true, false}) {
      const double turn = before ? p.input_range : p.output(1);
      if (!(std::abs(turn) < pi)) continue;
      for (const double side : {0.0, pi})
        for (int j = 0; j < parallelogram_directions; ++j)
          for (const double length : {0.5, 1.0}) {
            const double room = pi - std::abs(turn);
            const double from = side + std::max(0.0, -turn) + room * (j + 0.5) / parallelogram_directions;
            const Complex pin = std::polar(length, from);
            const FunctionGenerator parallelogram{false, pin, pin, 1, side > 0 ? -1.0 : 1.0};
            out.push_back(before ? WattGenerator{parallelogram, four_bar}
                                 : WattGenerator{four_bar, parallelogram});
          }
    }
  }

  static void from_random(const FunctionProblem& p, std::uint32_t individual,
                          std::vector<WattGenerator>& out) {
    RandomStream random({.seed = 1, .run = 1, .individual = individual});
    const auto length = [&] { return std::exp(random.uniform(-1.2, 1.2)); };
    const auto any = [&](double branch) {
      return FunctionGenerator{false, std::polar(length(), random.uniform(-pi, pi)),
                               std::polar(length(), random.uniform(-pi, pi)), length(), branch};
    };
    WattGenerator g{any(individual % 2 == 0 ? 1 : -1), any(individual % 4 < 2 ? 1 : -1)};
    // Turned so that the middle of the range fits.
    const std::optional<WattOutput> middle = output_at(g, 0.5 * p.input_range);
    if (!middle) return;
    g.second.b *= std::polar(1.0, middle->output - p.output(0.5));
    out.push_back(g);
  }
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
  return assess_six_bar(problem, generator, samples);
}

WattAnswer find_watt_generators(const FunctionProblem& problem, double pair_angle, RunContext& context) {
  LINKWRIGHT_REQUIRE(!problem.slider, "the output is a rocker");
  LINKWRIGHT_REQUIRE(problem.fit != FunctionFit::points, "six-bars are fitted");
  return SixBarFinder<WattModel>(problem, pair_angle, context).find();
}

}  // namespace linkwright::planar
