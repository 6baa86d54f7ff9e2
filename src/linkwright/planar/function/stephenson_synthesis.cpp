// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/stephenson_synthesis.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/math/dual.h"
#include "linkwright/planar/function/detail/six_bar_synthesis.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using StephensonNumbers = std::array<double, stephenson_numbers>;
using StephensonDual = math::Dual<static_cast<int>(stephenson_numbers)>;

// Shortest link, in grounds.
constexpr double shortest_stephenson_link = 0.05;
// Random six-bars that are looked at, the places of the range where they are, and how many begin a search.
constexpr int random_stephensons = 20000;
constexpr int screening_places = 13;
constexpr std::size_t screened_stephensons = 60;
// Four-bars to begin from, and directions of the parallelogram behind them.
constexpr std::size_t stephenson_four_bars = 3;
constexpr int rocker_parallelograms = 3;

template <class T>
struct StephensonPlace {
  bool closed = false;
  T angle{}, first_cosine{}, second_cosine{};  // the first is known where the second loop is open
};

// The six-bar at an input, for doubles and dual numbers.
template <class T>
StephensonPlace<T> place_stephenson(const std::array<T, stephenson_numbers>& x, double branch, double side,
                                    double input) {
  using std::atan2, std::sqrt;
  StephensonPlace<T> out;
  const auto& [a_re, a_im, coupler, rocker, u, v, px, py, link, b_re, b_im] = x;
  const double c = std::cos(input), s = std::sin(input);
  const T ax = a_re * c - a_im * s, ay = a_re * s + a_im * c;
  const T dx = 1.0 - ax, dy = -ay, square = dx * dx + dy * dy;
  out.first_cosine = (coupler * coupler + rocker * rocker - square) / (2.0 * coupler * rocker);
  const T along = (square + coupler * coupler - rocker * rocker) / (2.0 * square);
  const T across = coupler * coupler / square - along * along;
  if (!(across > 0.0)) return out;
  const T root = branch * sqrt(across);
  const T ex = (along * dx - root * dy) / coupler, ey = (along * dy + root * dx) / coupler;
  const T gx = ax + u * ex - v * ey - px,
          gy = ay + u * ey + v * ex - py;  // from the pivot to the coupler point
  const T reach = gx * gx + gy * gy, arm2 = b_re * b_re + b_im * b_im;
  out.second_cosine = (link * link + arm2 - reach) / (2.0 * link * sqrt(arm2));
  const T along_c = (reach + arm2 - link * link) / (2.0 * reach);
  const T across_c = arm2 / reach - along_c * along_c;
  if (!(across_c > 0.0)) return out;
  // Left of the line from the coupler point to the pivot is right of the line back.
  const T root_c = -side * sqrt(across_c);
  const T fx = along_c * gx - root_c * gy, fy = along_c * gy + root_c * gx;
  out.angle = atan2(fy * b_re - fx * b_im, fx * b_re + fy * b_im);
  out.closed = true;
  return out;
}

std::array<StephensonDual, stephenson_numbers> dual_numbers(const StephensonNumbers& x) {
  std::array<StephensonDual, stephenson_numbers> out;
  for (std::size_t j = 0; j < stephenson_numbers; ++j)
    out[j] = StephensonDual::variable(x[j], static_cast<int>(j));
  return out;
}

struct StephensonModel {
  using Generator = StephensonGenerator;
  static constexpr std::size_t numbers = stephenson_numbers;

  static StephensonNumbers numbers_of(const StephensonGenerator& g) {
    return {g.a.real(),     g.a.imag(),     g.coupler, g.rocker,   g.point.real(), g.point.imag(),
            g.pivot.real(), g.pivot.imag(), g.link,    g.b.real(), g.b.imag()};
  }
  static StephensonGenerator with(StephensonGenerator g, std::span<const double> x) {
    g.a = {x[0], x[1]}, g.coupler = x[2], g.rocker = x[3], g.point = {x[4], x[5]};
    g.pivot = {x[6], x[7]}, g.link = x[8], g.b = {x[9], x[10]};
    return g;
  }

  static void bounds(double max_link, std::span<double> lower, std::span<double> upper) {
    // Points within a square of this half width are no farther than the longest link.
    for (std::size_t j = 0; j < numbers; ++j) upper[j] = max_link / std::sqrt(2.0), lower[j] = -upper[j];
    for (const std::size_t j : {2, 3, 8}) lower[j] = shortest_stephenson_link, upper[j] = max_link;
  }

  static std::vector<StephensonGenerator> starts(const FunctionProblem& p,
                                                 std::span<const FunctionDesign> four_bars,
                                                 double pair_angle) {
    std::vector<StephensonGenerator> out;
    for (std::size_t k = 0; k < std::min(stephenson_four_bars, four_bars.size()); ++k)
      from_four_bar(p, four_bars[k].generator, out);
    from_random(p, pair_angle, out);
    return out;
  }

  static std::optional<double> output(const StephensonGenerator& g, double input, double* slopes) {
    if (!slopes) {
      const auto place = place_stephenson(numbers_of(g), g.branch, g.side, input);
      return place.closed ? std::optional(place.angle) : std::nullopt;
    }
    const std::optional<StephensonSlopes> out = slopes_at(g, input);
    if (!out) return std::nullopt;
    std::copy(out->slopes.begin(), out->slopes.end(), slopes);
    return out->output;
  }

  static void pair_cosines(const StephensonGenerator& g, double input, std::array<double, 2>& cosines,
                           double* slopes) {
    if (!slopes) {
      const auto place = place_stephenson(numbers_of(g), g.branch, g.side, input);
      cosines = {place.first_cosine, place.second_cosine};
      return;
    }
    const auto place = place_stephenson(dual_numbers(numbers_of(g)), g.branch, g.side, input);
    cosines = {place.first_cosine.value, place.second_cosine.value};
    for (std::size_t j = 0; j < numbers; ++j) {
      slopes[j] = place.first_cosine.by[j];
      slopes[numbers + j] = place.second_cosine.by[j];
    }
  }

  static bool usable(const StephensonGenerator& g) {
    return std::min(std::abs(g.a), std::abs(g.b)) >= shortest_stephenson_link;
  }

 private:
  // A coupler point at the rocker's pin, and an output that forms a parallelogram with the rocker, move as it
  // does.
  static void from_four_bar(const FunctionProblem& p, const FunctionGenerator& four_bar,
                            std::vector<StephensonGenerator>& out) {
    const double turn = p.output(1);
    if (!(std::abs(turn) < pi)) return;
    const double room = pi - std::abs(turn), start = std::arg(four_bar.b);
    for (const double side : {1.0, -1.0})
      for (int j = 0; j < rocker_parallelograms; ++j) {
        // The ground of the parallelogram stays on one side of the rocker while it turns.
        const double from = std::max(0.0, -turn) + room * (j + 0.5) / rocker_parallelograms;
        const std::complex<double> shift = std::polar(1.0, start - from + (side > 0 ? 0 : pi));
        out.push_back({four_bar.a, four_bar.c, std::abs(four_bar.b), four_bar.c, 1.0 + shift, 1, four_bar.b,
                       four_bar.branch, side});
      }
  }

  // The best of many, each turned so that the mean error is none.
  static void from_random(const FunctionProblem& p, double pair_angle,
                          std::vector<StephensonGenerator>& out) {
    std::vector<std::pair<double, StephensonGenerator>> screened;
    const double least = std::sin(0.8 * pair_angle), far = std::min(p.max_link, 4.5);
    std::array<double, screening_places> wanted;
    for (int k = 0; k < screening_places; ++k)
      wanted[static_cast<std::size_t>(k)] = p.output(static_cast<double>(k) / (screening_places - 1));
    for (int k = 0; k < random_stephensons; ++k) {
      RandomStream random({.seed = 1, .run = 2, .individual = static_cast<std::uint32_t>(k)});
      const auto length = [&] { return std::min(far, std::exp(random.uniform(-1.2, 1.2))); };
      const auto any = [&](double most) {
        return std::polar(most * random.uniform(), random.uniform(-pi, pi));
      };
      StephensonGenerator g{std::polar(length(), random.uniform(-pi, pi)),
                            length(),
                            length(),
                            any(3),
                            std::complex<double>(random.uniform(-1.5, 2), random.uniform(-1.5, 1.5)),
                            length(),
                            length(),
                            k % 2 == 0 ? 1.0 : -1.0,
                            k % 4 < 2 ? 1.0 : -1.0};
      double sum = 0, squares = 0, last = 0;
      bool there = true;
      for (int i = 0; i < screening_places && there; ++i) {
        const auto at = output_at(g, p.input_range * i / (screening_places - 1));
        there = at && at->sine > least;
        if (!there) break;
        double off = at->output - wanted[static_cast<std::size_t>(i)];
        if (i > 0) off += 2 * pi * std::round((last - off) / (2 * pi));
        last = off;
        sum += off;
        squares += off * off;
      }
      if (!there) continue;
      const double mean = sum / screening_places;
      g.b *= std::polar(1.0, mean);
      screened.emplace_back(squares / screening_places - mean * mean, g);
    }
    std::stable_sort(screened.begin(), screened.end(),
                     [](const auto& one, const auto& other) { return one.first < other.first; });
    for (std::size_t k = 0; k < std::min(screened_stephensons, screened.size()); ++k)
      out.push_back(screened[k].second);
  }
};

}  // namespace

std::optional<StephensonOutput> output_at(const StephensonGenerator& g, double input) {
  const auto place = place_stephenson(StephensonModel::numbers_of(g), g.branch, g.side, input);
  if (!place.closed) return std::nullopt;
  const double worst = std::max(std::abs(place.first_cosine), std::abs(place.second_cosine));
  return StephensonOutput{place.angle, std::sqrt(std::max(0.0, (1 - worst) * (1 + worst)))};
}

std::optional<StephensonSlopes> slopes_at(const StephensonGenerator& g, double input) {
  const auto place = place_stephenson(dual_numbers(StephensonModel::numbers_of(g)), g.branch, g.side, input);
  if (!place.closed) return std::nullopt;
  return StephensonSlopes{place.angle.value, place.angle.by};
}

Linkage linkage_of(const StephensonGenerator& g, double ground) {
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {ground, 0}}, {"F0", ground * g.pivot}});
  add_bar(l, "crank", "O", "A", ground * std::abs(g.a));
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {ground * g.coupler, 0}}, {"C", ground * g.point}});
  add_bar(l, "rocker", "B0", "B", ground * g.rocker);
  add_bar(l, "link", "C", "F", ground * g.link);
  add_bar(l, "output", "F0", "F", ground * std::abs(g.b));
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_pin(l, "C", "coupler.C", "link.C");
  add_pin(l, "F", "link.F", "output.F");
  add_pin(l, "F0", "ground.F0", "output.F0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", g.branch > 0 ? AssemblyMode::plus : AssemblyMode::minus);
  set_mode(l, "link", "output", g.side > 0 ? AssemblyMode::plus : AssemblyMode::minus);
  return l;
}

StephensonDesign assess(const FunctionProblem& problem, const StephensonGenerator& generator, int samples) {
  return assess_six_bar(problem, generator, samples);
}

StephensonAnswer find_stephenson_generators(const FunctionProblem& problem, double pair_angle,
                                            RunContext& context) {
  LINKWRIGHT_REQUIRE(!problem.slider, "the output is a rocker");
  LINKWRIGHT_REQUIRE(problem.fit != FunctionFit::points, "six-bars are fitted");
  return SixBarFinder<StephensonModel>(problem, pair_angle, context).find();
}

}  // namespace linkwright::planar
