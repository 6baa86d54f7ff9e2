// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/function/generator.h"

// Generators of a function y(x), x from x0 to x1: input = input_range (x - x0) / (x1 - x0), output =
// output_range (y - y(x0)) / (y(x1) - y(x0)).
namespace linkwright::planar {

/// The way in which the function is met.
enum class FunctionFit { points, least_squares, minimax };
constexpr std::array<EnumName<FunctionFit>, 3> names(FunctionFit) {
  return {
      {{FunctionFit::points, "points", "exactly at precision points: 5, less one for each start angle given"},
       {FunctionFit::least_squares, "least_squares", "least sum of squared errors over the range"},
       {FunctionFit::minimax, "minimax", "least greatest error over the range"}}};
}

struct FunctionProblem {
  bool slider = false;
  /// Output (rad or m) that is wanted at a share of the range, 0 to 1; 0 at 0.
  std::function<double(double)> output;
  double input_range = 0;  ///< rad, signed
  FunctionFit fit = FunctionFit::points;
  std::vector<double> at;  ///< shares at which it is met (points)
  StartAngles given;       ///< points only
  /// rad, kept over the range by designs that come first (minimax); 0 = no limit.
  double min_pair_angle = 0;
  double max_link = 20;  ///< greatest |a|, |b| and c, in grounds or m (least_squares, minimax)
};

/// Chebyshev's shares of a range: (1 - cos((2k - 1) pi / 2n)) / 2, k = 1 to n.
std::vector<double> chebyshev_shares(int count);

struct FunctionDesign {
  FunctionGenerator generator;
  bool assembles = true;      ///< over the whole range
  int other_branch = 0;       ///< precision points that it meets on the other branch only
  double greatest_error = 0;  ///< rad or m, over the range where it assembles
  double rms_error = 0;
  double pair_angle = 0;  ///< rad, least angle between coupler and output link
};
/// Structural error (rad or m) at a share of the range; nothing where it does not assemble.
std::optional<double> structural_error(const FunctionProblem& problem, const FunctionGenerator& generator,
                                       double share);

/// Errors of a generator over the range, at `samples` shares.
FunctionDesign assess(const FunctionProblem& problem, const FunctionGenerator& generator, int samples = 1001);

struct FunctionAnswer {
  Status status = Status::done;
  /// Best first: those that assemble and have no other branch, then those with the least pair angle that is
  /// wanted, then by error; of a search those within ten times the error of the best.
  std::vector<FunctionDesign> designs;
  int starts = 0;  ///< starts of the search
};
FunctionAnswer find_generators(const FunctionProblem& problem, RunContext& context);

}  // namespace linkwright::planar
