// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace linkwright::planar {

/// A four-bar or slider-crank whose output follows its input, both counted from where they start.
///
/// Four-bar: ground from 0 to 1 (lengths in grounds), crank pin a e^(i input), rocker pin 1 + b e^(i output),
/// coupler of length c: the arguments of a and b are the start angles. Slider-crank: crank pin a e^(i input)
/// about 0, slider pin output + b on a line along x (m): the imaginary part of b is the offset of the guide.
struct FunctionGenerator {
  bool slider = false;
  std::complex<double> a, b;
  double c = 0;
  /// Four-bar: +1 = rocker pin to the left of the line from the crank pin to the rocker pivot; slider-crank:
  /// +1 = slider ahead of the crank pin along x.
  double branch = 1;
};

/// Output at an input, with its derivatives by a (real and imaginary part), b (likewise) and c, and the sine
/// of the angle between coupler and rocker (rod and normal of the guide), >= 0. Nothing where it does not
/// assemble or the branches meet. The output of a four-bar is an angle in (-pi, pi].
struct GeneratorOutput {
  double output = 0;
  std::array<double, 5> slopes{};
  double sine = 0;
};
std::optional<GeneratorOutput> output_at(const FunctionGenerator& generator, double input);

/// The cosine of the pair angle may pass +-1 by so much, the rounding of the numbers of a generator that was
/// computed, and the generator still assembles; within as much of +-1 both branches meet, and a place there
/// belongs to both.
inline constexpr double branches_meet = 1e-9;

/// Output at an input and the sine of the pair angle, as output_at has them, and where the branches meet as
/// well: the sine is 0 there, and the output, which has no derivatives, is that of both branches.
struct GeneratorPlace {
  double output = 0, sine = 0;
  bool on_both_branches = false;
};
std::optional<GeneratorPlace> place_at(const FunctionGenerator& generator, double input);

/// Cosine of the angle between coupler and rocker (rod and normal of the guide), whether or not it assembles,
/// with its derivatives by the numbers in the order of GeneratorOutput, and by the input.
struct PairCosine {
  double value = 0, by_input = 0;
  std::array<double, 5> slopes{};
};
PairCosine pair_cosine(const FunctionGenerator& generator, double input);

/// An input (rad) and the output that belongs to it (rad, or m of a slider).
struct FunctionPair {
  double input = 0, output = 0;
};

/// The given start angles of a generator: directions of the crank at input 0 and of the rocker at output 0
/// (rad). A slider-crank may have the first, and the place of the slider at output 0 along the line (m) is
/// not one of them.
struct StartAngles {
  std::optional<double> input, output;
};

/// All generators through five pairs, less one for each start angle that is given: at most three of a
/// four-bar (Burmester pairs of the rocker seen from the crank, of which the ground itself is one), or of a
/// slider-crank. The branch is that of the first pair at which the two branches are apart.
///
/// Throws ContractError for another number of pairs, or a start angle of the output of a slider-crank.
std::vector<FunctionGenerator> exact_generators(std::span<const FunctionPair> pairs, bool slider,
                                                const StartAngles& given = {});

}  // namespace linkwright::planar
