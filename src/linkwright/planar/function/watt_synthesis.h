// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "linkwright/planar/function/six_bar.h"
#include "linkwright/planar/linkage/linkage.h"

// Six-bar function generators: two four-bars in a row, the rocker of the first being the crank of the second
// (Watt II).
namespace linkwright::planar {

/// Each in lengths of its own ground link; the input of the second is the output of the first.
struct WattGenerator {
  FunctionGenerator first, second;
};

/// Output (rad) at an input, with its derivatives by the numbers of both four-bars in the order of
/// GeneratorOutput, and the lesser of the sines of both. Nothing where one of them does not assemble.
struct WattOutput {
  double output = 0;
  std::array<double, 10> slopes{};
  double sine = 0;
};
std::optional<WattOutput> output_at(const WattGenerator& generator, double input);

/// The linkage with bodies crank, coupler, rocker, link and output, driven at O; pivots O, B0 and H0 lie on
/// the x axis, `ground` (m) apart. The angle of the rocker, and of the output, is that of its first pin.
Linkage linkage_of(const WattGenerator& generator, double ground);

using WattDesign = SixBarDesign<WattGenerator>;
WattDesign assess(const FunctionProblem& problem, const WattGenerator& generator, int samples = 1001);

using WattAnswer = SixBarAnswer<WattGenerator>;
/// By least squares, or the least greatest error: from the best four-bars with a parallelogram before or
/// behind them, which changes nothing at first, and from random pairs. Designs with at least `pair_angle`
/// (rad) come first; for the least greatest error it is a condition.
///
/// Throws ContractError for a slider, or precision points.
WattAnswer find_watt_generators(const FunctionProblem& problem, double pair_angle, RunContext& context);

}  // namespace linkwright::planar
