// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/minimax.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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

}  // namespace
}  // namespace linkwright::planar
