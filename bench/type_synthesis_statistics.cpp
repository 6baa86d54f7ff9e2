// SPDX-License-Identifier: BSD-3-Clause

// How often a search finds the machine that a curve comes from, or one as good:
//
//   type_synthesis_statistics [MACHINES [CURVES [FAMILY...]]]
//
// draws so many machines (40) of each family, with pair angles of at least 23 degrees and no link of 9 sizes
// of the curve or more, searches its family along the curve with so many curves (600 000) or, written as 2s,
// for so many seconds on two threads, and prints a table in Markdown: searches that end with an error below
// 0.05 % of the size. Machine k is drawn with the seed 5 and searched with the seed k. The atlas of a family
// is drawn before its first search. 600 000 curves take some tenths of a second on two threads.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/type_synthesis/atlas.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/polish.h"
#include "linkwright/planar/type_synthesis/search.h"

namespace {

using namespace linkwright;
using namespace linkwright::planar;

constexpr double recovered_below = 5e-4, least_pair_angle = 23 * pi / 180, longest_link = 9;
constexpr std::size_t curve_points = 720;

Stroke curve_of(const MachineShape& shape) {
  std::vector<double> angle, x(curve_points), y(curve_points);
  for (std::size_t k = 0; k < curve_points; ++k)
    angle.push_back(2 * pi * static_cast<double>(k) / curve_points);
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angle.data(),
                 .count = curve_points,
                 .px = x.data(),
                 .py = y.data()});
  Stroke out{.points = {}, .closed = true};
  for (std::size_t k = 0; k < curve_points; ++k) out.points.emplace_back(x[k], y[k]);
  return out;
}

/// True if the machine keeps the limits with something to spare, in sizes of its own curve.
bool keeps_limits(const MachineShape& shape, const SampledStroke& stroke) {
  FittedMachine machine{.shape = shape};
  double* place = machine.shape.x.data() + shape.program->place();
  place[0] = -stroke.centre.real() / stroke.size, place[1] = -stroke.centre.imag() / stroke.size;
  place[2] = 1 / stroke.size, place[3] = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k)
    machine.angle[k] = 2 * pi * static_cast<double>(k) / stroke_samples;
  MachineFitter fitter(stroke, {});
  const MachineMeasures m = fitter.measure(machine);
  return m.min_pair_angle >= least_pair_angle && m.max_length < longest_link && m.min_length > 0.05;
}

/// A machine of one of the programs of a family, and its curve.
Stroke drawn_curve(MachineFamily family, std::uint32_t number) {
  const auto programs = programs_of(family);
  for (std::uint32_t k = 0;; ++k) {
    RandomStream random(
        {.seed = 5, .run = static_cast<std::uint32_t>(family), .generation = number, .individual = k});
    MachineShape shape{.program = programs[random.below(static_cast<std::uint32_t>(programs.size()))]};
    if (!draw_shape(shape, 0, random)) continue;
    Stroke out = curve_of(shape);
    if (keeps_limits(shape, sampled_stroke(out))) return out;
  }
}

/// Where a search ends.
struct SearchEnd {
  std::int64_t curves = 0;  ///< 0 = by its time
  double seconds = 0;
};

SearchEnd end_of(std::string_view word) {
  SearchEnd out;
  const double number = std::max(0.0, std::strtod(std::string(word).c_str(), nullptr));
  if (word.ends_with('s'))
    out.seconds = std::max(number, 0.01);
  else
    out.curves = std::max<std::int64_t>(1000, static_cast<std::int64_t>(number));
  return out;
}

std::string row(MachineFamily family, std::uint32_t count, const SearchEnd& end) {
  {
    RunContext context;
    family_atlas(family, context);
  }
  std::uint32_t recovered = 0;
  std::vector<double> errors;
  std::int64_t curves = 0;
  std::string missed;
  for (std::uint32_t number = 0; number < count; ++number) {
    RunContext context;
    context.set_threads(2);
    const SampledStroke target = sampled_stroke(drawn_curve(family, number));
    if (end.seconds > 0) context.set_time_limit(std::chrono::duration<double>(end.seconds));
    const TypeSearchAnswer answer = search_types(
        target,
        {.families = {family}, .max_links = links_of(family), .max_curves = end.curves, .seed = number},
        context);
    curves += answer.curves;
    errors.push_back(answer.families[0].error);
    if (errors.back() < recovered_below)
      ++recovered;
    else
      missed += fmt::format("{}{}", missed.empty() ? "" : ", ", number);
  }
  std::sort(errors.begin(), errors.end());
  return fmt::format("| {} | {} of {} | {:.1e} | {:.1e} | {} | {} |\n", name_of(family), recovered, count,
                     errors[errors.size() / 2], errors.back(), curves / count, missed);
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, long long otherwise) { return argc > i ? std::atoll(argv[i]) : otherwise; };
  const auto count = static_cast<std::uint32_t>(std::max(1LL, number(1, 40)));
  const SearchEnd end = end_of(argc > 2 ? argv[2] : "600000");
  fmt::print("{} machines of each family, {} a search\n\n", count,
             end.seconds > 0 ? fmt::format("{} s", end.seconds) : fmt::format("{} curves", end.curves));
  fmt::print(
      "| family | recovered | median error | largest error | curves | not recovered "
      "|\n|---|---|---|---|---|---|\n");
  for (const auto& family : names(MachineFamily{})) {
    if (programs_of(family.value).empty()) continue;
    const bool asked = argc <= 3 || std::find_if(argv + 3, argv + argc, [&](const char* name) {
                                      return name == family.name;
                                    }) != argv + argc;
    if (asked) fmt::print("{}", row(family.value, count, end));
    std::fflush(stdout);
  }
  return 0;
}
