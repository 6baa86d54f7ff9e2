// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>

#include "linkwright/planar/function/six_bar.h"
#include "linkwright/planar/linkage/linkage.h"

// Six-bar function generators: a four-bar whose coupler drives the output through a link (Stephenson III).
namespace linkwright::planar {

/// Lengths in those of the ground link, which goes from the crank axis at 0 to the rocker pivot at 1. The
/// crank pin is at a e^(i input), the pin of the output at pivot + b e^(i output): the arguments of a and b
/// are the start angles.
struct StephensonGenerator {
  std::complex<double> a;
  double coupler = 0, rocker = 0;
  /// Point of the coupler, from the crank pin, along the coupler and to its left.
  std::complex<double> point;
  std::complex<double> pivot;  ///< pivot of the output
  double link = 0;             ///< from the coupler point to the output
  std::complex<double> b;
  double branch = 1;  ///< +1 = rocker pin to the left of the line from the crank pin to the rocker pivot
  /// +1 = pin of the output to the left of the line from the coupler point to the output's pivot.
  double side = 1;
};
inline constexpr std::size_t stephenson_numbers = 11;

/// Output (rad, in (-pi, pi]) at an input, and the lesser of the sines of the angles between coupler and
/// rocker, link and output. Nothing where it does not assemble.
struct StephensonOutput {
  double output = 0, sine = 0;
};
std::optional<StephensonOutput> output_at(const StephensonGenerator& generator, double input);

/// Output at an input with its derivatives by a, coupler, rocker, point, pivot, link and b, complex numbers
/// by their real and imaginary parts. Nothing where it does not assemble.
struct StephensonSlopes {
  double output = 0;
  std::array<double, stephenson_numbers> slopes{};
};
std::optional<StephensonSlopes> slopes_at(const StephensonGenerator& generator, double input);

/// The linkage with bodies crank, coupler, rocker, link and output, driven at O; pivots O, B0 and F0, B0
/// `ground` (m) along the x axis. The angle of the output is that of its pin.
Linkage linkage_of(const StephensonGenerator& generator, double ground);

using StephensonDesign = SixBarDesign<StephensonGenerator>;
StephensonDesign assess(const FunctionProblem& problem, const StephensonGenerator& generator,
                        int samples = 1001);

using StephensonAnswer = SixBarAnswer<StephensonGenerator>;
/// Finds Stephenson generators as find_watt_generators does, from the best four-bars with a parallelogram
/// behind the rocker and from the best of many random six-bars. No link is shorter than a twentieth of the
/// ground link.
///
/// Throws ContractError for a slider, or precision points.
StephensonAnswer find_stephenson_generators(const FunctionProblem& problem, double pair_angle,
                                            RunContext& context);

}  // namespace linkwright::planar
