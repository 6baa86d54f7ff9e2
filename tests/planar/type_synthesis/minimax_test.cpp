// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/minimax.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

struct PublishedFunction {
  const char* name;
  std::function<double(double)> y;
  double from, to;
  double four_bar,
      six_bar;  ///< greatest error of the best known with pair angles of 30 degrees (deg); 0 = not tried
};

// Four-bars and six-bars of 90 degrees of input and output: the best known with pair angles of 30 degrees
// over the range.
TEST(LeastGreatestErrors, ReachTheBestKnownOfFourBarsAndOfSixBars) {
  const std::vector<PublishedFunction> all{
      {"x^1.5", [](double x) { return std::pow(x, 1.5); }, 1, 4, 0.0048603, 0},
      {"log10 to 2", [](double x) { return std::log10(x); }, 1, 2, 0.029280, 0},
      {"sin", [](double x) { return std::sin(math::radians(x)); }, 0, 90, 0.19057, 1.08e-3},
      {"exp", [](double x) { return std::exp(x); }, 0, 1, 0.025947, 0}};
  for (const PublishedFunction& f : all) {
    const double y0 = f.y(f.from), y1 = f.y(f.to);
    const MotionTarget target = function_target({.range = pi / 2, .at = [&](double share) {
                                                   const double y = f.y(f.from + (f.to - f.from) * share);
                                                   return pi / 2 * (y - y0) / (y1 - y0);
                                                 }});
    const MachineLimits limits{.min_pair_angle = math::radians(30), .max_length = 20};
    RunContext context;
    const auto best_of = [&](std::vector<MachineFamily> families, std::int64_t curves) {
      const TypeSearchAnswer answer = search_types(
          target, {.families = std::move(families), .limits = limits, .max_curves = curves}, context);
      MachineFitter fitter(target, limits);
      double best = infinity;
      for (FoundMachine found : answer.machines) {
        const double before = math::degrees(found.measures.largest_rotation);
        lessen_greatest_error(target, limits, found.machine, context);
        const MachineMeasures now = fitter.measure(found.machine);
        EXPECT_LE(math::degrees(now.largest_rotation), before * (1 + 1e-9));
        if (now.min_pair_angle >= limits.min_pair_angle)
          best = std::min(best, math::degrees(now.largest_rotation));
      }
      return best;
    };
    // 96 samples against 81: neither has the extremes themselves.
    EXPECT_LT(best_of({MachineFamily::four_bar}, 60'000), f.four_bar * 1.005) << f.name;
    if (f.six_bar > 0) {
      EXPECT_LT(best_of({MachineFamily::watt_2, MachineFamily::stephenson_3}, 150'000), f.six_bar) << f.name;
    }
  }
}

struct LimitedFunction {
  const char* name;
  MachineOutput output;
  MachineFamily family;
  MachineLimits limits;
};

/// The greatest error of a machine at the samples.
double greatest_error_of(const MotionTarget& target, const MachineMeasures& m) {
  return target.placed() ? m.largest_deviation : m.largest_rotation;
}

// Limits that the least sum of squares has come to: the least greatest error keeps them, and is less.
TEST(LeastGreatestErrors, KeepAllLimits) {
  const double pair = math::radians(30);
  const std::vector<LimitedFunction> all{
      {"lengths of an angle",
       MachineOutput::angle,
       MachineFamily::four_bar,
       {.min_pair_angle = pair, .min_length = 0.5, .max_length = 1.4}},
      {"box of an angle",
       MachineOutput::angle,
       MachineFamily::four_bar,
       {.min_pair_angle = pair, .ground_box = PlaneBox{-0.2, 0.2, -0.1, 0.3}}},
      {"pivots of an angle",
       MachineOutput::angle,
       MachineFamily::four_bar,
       {.min_pair_angle = pair, .max_length = 1.5, .ground_pivots = {{0.5, 0.2}, {1.3, 0.4}}}},
      {"lengths of a slider",
       MachineOutput::slide,
       MachineFamily::slider_crank,
       {.min_pair_angle = pair, .min_length = 0.9, .max_length = 3}},
      {"box of a slider",
       MachineOutput::slide,
       MachineFamily::slider_crank,
       {.min_pair_angle = pair, .ground_box = PlaneBox{-1, 1, 0.4, 1.5}}},
      {"pivot of a slider",
       MachineOutput::slide,
       MachineFamily::stephenson_3,
       {.min_pair_angle = pair, .max_length = 5, .ground_pivots = {{-1.0, 0.7}}}}};
  for (const LimitedFunction& f : all) {
    const bool slides = f.output == MachineOutput::slide;
    const MotionTarget target =
        function_target({.output = f.output, .range = pi / 2, .at = [&](double share) {
                           return (slides ? 0.1 : 1.2) * share * share;
                         }});
    RunContext context;
    const TypeSearchAnswer answer =
        search_types(target, {.families = {f.family}, .limits = f.limits, .max_curves = 15'000}, context);
    ASSERT_FALSE(answer.machines.empty()) << f.name;
    MachineFitter fitter(target, f.limits);
    int lessened = 0;
    for (FoundMachine found : answer.machines) {
      const double before = greatest_error_of(target, found.measures);
      lessen_greatest_error(target, f.limits, found.machine, context);
      const MachineMeasures now = fitter.measure(found.machine);
      EXPECT_EQ(now.defect, MachineDefect::none) << f.name << ", " << found.machine.shape.program->name;
      if (!(greatest_error_of(target, now) < 0.95 * before)) continue;
      ++lessened;
      if (slides) {
        const PointProgram& p = *found.machine.shape.program;
        const std::vector<double>& x = found.machine.shape.x;
        const auto place = static_cast<std::size_t>(p.place()),
                   height = static_cast<std::size_t>(p.steps.back().parameter) + 1;
        EXPECT_NEAR(x[place + 1] + x[place + 2] * x[height], 0, 1e-9) << f.name;
      }
    }
    EXPECT_GT(lessened, 0) << f.name;
  }
}

}  // namespace
}  // namespace linkwright::planar
