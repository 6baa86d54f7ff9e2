// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/function_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"

namespace linkwright::planar {
namespace {

constexpr std::uint64_t drawn_from = 20261128;
constexpr std::size_t starts_a_piece = 2000;
constexpr int begins_a_turn = 8;  // angles at which a function may begin that takes the whole turn

std::size_t pieces_of(int links) { return links >= 8 ? 30 : links == 6 ? 20 : 10; }

double error_at(const MotionTarget& target, MachineFitter& fitter, double from, FittedMachine& machine) {
  const double error = begin_function(target, fitter, from, machine);
  return std::isfinite(error) ? error : infinity;
}

FunctionStart drawn_start(const MotionTarget& target, const PointProgram& program, MachineFitter& fitter,
                          RandomStream& random) {
  FunctionStart out;
  out.shape.program = &program;
  out.from = random.uniform(0, 2 * pi);
  const double range = target.turn[target.count - 1];
  const std::optional<CrankPart> part =
      target.turns ? std::nullopt : std::optional(CrankPart{out.from, range});
  if (!draw_shape(out.shape, 0, random, part)) return out;
  FittedMachine machine{.shape = out.shape};
  const double first = out.from;
  for (int i = 0; i < (target.turns ? begins_a_turn : 1); ++i) {
    const double from = first + 2 * pi * i / begins_a_turn;
    if (const double error = error_at(target, fitter, from, machine); error < out.error)
      out.error = error, out.from = from;
  }
  return out;
}

/// The scale and place along its line that bring a slider nearest to its travel; the line is the x axis.
void place_slider(const MotionTarget& target, FittedMachine& machine) {
  const PointProgram& p = *machine.shape.program;
  std::vector<double>& x = machine.shape.x;
  double *place = x.data() + p.place(), *scale = x.data() + p.scale();
  place[0] = place[1] = scale[1] = 0, scale[0] = 1;
  alignas(64) std::array<double, stroke_samples> px, py;
  compute_curve({.program = &p,
                 .x = x.data(),
                 .signs = machine.shape.signs,
                 .angle = machine.angle.data(),
                 .count = target.count,
                 .px = px.data(),
                 .py = py.data()});
  const auto n = static_cast<std::ptrdiff_t>(target.count);
  const double count = static_cast<double>(target.count);
  const double mean = std::accumulate(px.begin(), px.begin() + n, 0.0) / count,
               wanted = std::accumulate(target.x.begin(), target.x.begin() + n, 0.0) / count;
  double squares = 0, products = 0;
  for (std::size_t k = 0; k < target.count; ++k) {
    squares += (px[k] - mean) * (px[k] - mean);
    products += (px[k] - mean) * (target.x[k] - wanted);
  }
  scale[0] = products / squares;
  place[0] = wanted - scale[0] * mean, place[1] = -scale[0] * py[0];
}

}  // namespace

double begin_function(const MotionTarget& target, MachineFitter& fitter, double from,
                      FittedMachine& machine) {
  for (std::size_t k = 0; k < target.count; ++k) machine.angle[k] = from + target.turn[k];
  machine.sense = target.turn[target.count - 1] < 0 ? -1 : 1;
  if (target.output == MachineOutput::slide) place_slider(target, machine);
  return fitter.turn_body(machine);
}

std::vector<FunctionStart> function_starts(const MotionTarget& target, const MachineLimits& limits,
                                           MachineFamily family, std::size_t count,
                                           const RunContext& context) {
  const std::span<const PointProgram* const> programs = programs_of(family, target.output);
  const std::size_t pieces = pieces_of(programs.front()->links);
  const auto keep_best = [count](std::vector<FunctionStart>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const FunctionStart& a, const FunctionStart& b) { return a.error < b.error; });
    if (list.size() > count) list.resize(count);
  };
  std::vector<std::vector<FunctionStart>> found(pieces);
  optimise::parallel_for(pieces, context.threads(), [&](std::size_t piece) {
    MachineFitter fitter(target, limits);
    for (std::size_t k = 0; k < starts_a_piece; ++k) {
      if (k % 64 == 0 && context.interrupted()) return;
      RandomStream random({.seed = drawn_from,
                           .run = static_cast<std::uint32_t>(family),
                           .generation = static_cast<std::uint32_t>(piece),
                           .individual = static_cast<std::uint32_t>(k)});
      FunctionStart start =
          drawn_start(target, *programs[(piece * starts_a_piece + k) % programs.size()], fitter, random);
      if (start.error < infinity) found[piece].push_back(std::move(start));
    }
    keep_best(found[piece]);
  });
  std::vector<FunctionStart> out;
  for (auto& piece : found) std::move(piece.begin(), piece.end(), std::back_inserter(out));
  keep_best(out);
  return out;
}

std::optional<FittedMachine> grown_by_parallelogram(const FittedMachine& from, MachineFamily family,
                                                    RandomStream& random) {
  const PointProgram& old = *from.shape.program;
  if (old.output != MachineOutput::angle || old.pairs.empty()) return std::nullopt;
  std::vector<PairOfBars> pairs = old.pairs;
  pairs.push_back({0, old.traced_bar});
  const PointProgram* program = angle_program_of_pairs(pairs);
  if (!program || program->family != family) return std::nullopt;
  // The pins of the old output link at the samples, from its pivot.
  std::vector<double> points(2 * old.steps.size() * stroke_samples);
  compute_curve({.program = &old,
                 .x = from.shape.x.data(),
                 .signs = from.shape.signs,
                 .angle = from.angle.data(),
                 .count = stroke_samples,
                 .points = points.data()});
  const auto pins = old.traced_pins();
  const auto at = [&](std::size_t pin, std::size_t k) {
    return std::complex<double>(points[2 * pin * stroke_samples + k],
                                points[(2 * pin + 1) * stroke_samples + k]);
  };
  const std::complex<double> pivot = at(pins[0], 0);
  std::complex<double> middle{};
  for (std::size_t k = 0; k < stroke_samples; ++k) middle += at(pins[1], k) - pivot;
  const double length = std::abs(at(pins[1], 0) - pivot);
  if (!(std::abs(middle) > 0) || !(length > 0)) return std::nullopt;
  const std::complex<double> arm = std::polar(std::exp(0.4 * random.normal()), random.uniform(-pi, pi));
  const double side = random.uniform() < 0.5 ? -1 : 1;
  const std::complex<double> shift =
      std::polar(length * std::exp(0.4 * random.normal()), std::arg(middle * arm) + side * pi / 2);
  FittedMachine out = from;
  out.shape.program = program;
  out.shape.x.resize(static_cast<std::size_t>(program->parameters));
  std::copy(from.shape.x.end() - 4, from.shape.x.end(), out.shape.x.end() - 4);
  const std::size_t first = old.steps.size();  // ground pivot, point of the old output link, pair
  double* ground = out.shape.x.data() + program->steps[first].parameter;
  double* plate = out.shape.x.data() + program->steps[first + 1].parameter;
  double* bars = out.shape.x.data() + program->steps[first + 2].parameter;
  const std::complex<double> new_pivot = pivot + shift;
  ground[0] = new_pivot.real(), ground[1] = new_pivot.imag();
  plate[0] = arm.real(), plate[1] = arm.imag();
  bars[0] = std::abs(arm) * length, bars[1] = std::abs(shift);
  // The new pin is to the left of the line from the new pivot to the point of the old link, or to its right.
  const unsigned bit = 1u << static_cast<unsigned>(program->steps[first + 2].sign);
  out.shape.signs = side > 0 ? out.shape.signs & ~bit : out.shape.signs | bit;
  return out;
}

}  // namespace linkwright::planar
