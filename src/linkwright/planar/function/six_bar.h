#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/function/synthesis.h"

// What six-bar function generators of all structures have in common.
namespace linkwright::planar {

template <class Generator>
struct SixBarDesign {
  Generator generator;
  bool assembles = true;                     ///< over the whole range
  double greatest_error = 0, rms_error = 0;  ///< rad, over the range where it assembles
  double pair_angle = 0;  ///< rad, least angle between coupler and rocker, and link and output
};

template <class Generator>
struct SixBarAnswer {
  Status status = Status::done;
  std::optional<FunctionDesign> four_bar;  ///< the best four-bar of the same problem
  std::vector<SixBarDesign<Generator>>
      designs;  ///< best first, each once; those that pass a pair angle first
  int starts = 0;
};

/// Errors of a generator over the range, at `samples` shares; its output_at gives `output` and `sine`.
template <class Generator>
SixBarDesign<Generator> assess_six_bar(const FunctionProblem& problem, const Generator& generator,
                                       int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "{} samples", samples);
  SixBarDesign<Generator> out;
  out.generator = generator;
  double least = 1, sum = 0;
  int there = 0;
  for (int k = 0; k < samples; ++k) {
    const double share = static_cast<double>(k) / (samples - 1);
    const auto at = output_at(generator, problem.input_range * share);
    if (!at) {
      out.assembles = false;
      continue;
    }
    const double error = math::wrap_angle(at->output - problem.output(share));
    out.greatest_error = std::max(out.greatest_error, std::abs(error));
    sum += error * error;
    ++there;
    least = std::min(least, at->sine);
  }
  out.rms_error = there > 0 ? std::sqrt(sum / there) : infinity;
  out.pair_angle = out.assembles ? std::asin(std::min(1.0, least)) : 0;
  return out;
}

}  // namespace linkwright::planar
