// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/parallel/pi_joint/stiffness.h"

/// Stiffness of bars from stiffness that was measured at the output of a Pi-joint.
namespace linkwright::parallel {

/// The meaning of a mean stiffness over a range of angles.
enum class StiffnessMean { of_stiffness, of_compliance, at_zero };
constexpr std::array<EnumName<StiffnessMean>, 3> names(StiffnessMean) {
  return {{{StiffnessMean::of_stiffness, "of_stiffness", "arithmetic mean over the angle"},
           {StiffnessMean::of_compliance, "of_compliance", "harmonic mean: what the mean compliance gives"},
           {StiffnessMean::at_zero, "at_zero", "the value at theta = 0"}}};
}

/// A range of theta, within (-pi/2, pi/2), from < to.
struct AngleRange {
  double from = 0, to = 0;
};

/// Mean stiffness (N m/rad) over a range, by Gauss-Legendre quadrature.
double mean_stiffness(const PiJoint& joint, const PiBars& bars, const AngleRange& range, StiffnessMean mean,
                      double share = 1);

/// k_d (N/m) of the diagonal with which the mean stiffness is `wanted` (N m/rad, > 0); the other bars are as
/// given, `bars.diagonal` is not looked at. Nothing where they alone make the joint softer.
std::optional<double> diagonal_for_mean(const PiJoint& joint, const PiBars& bars, const AngleRange& range,
                                        StiffnessMean mean, double wanted, double share = 1);

/// Stiffness (N m/rad) measured at an angle.
struct PiStiffnessSample {
  double angle = 0, stiffness = 0;
};

/// Bars whose stiffness is sought; the others are known.
struct PiBarsSought {
  bool diagonal = true, screw = false, arm = false, coupler = false;
};

struct PiStiffnessFit {
  /// done, or singular where the samples cannot distinguish the bars sought: then they are one choice of
  /// many.
  Status status = Status::done;
  PiBars bars;           ///< infinite: yields too little to be seen
  double error = 0;      ///< root of the mean square of the relative error of the compliance
  double condition = 0;  ///< by which relative errors of samples may grow in the bars; infinite when singular
};

/// Fits compliances, in which the model is linear, none below 0, to samples with relative errors of equal
/// weight. As many samples as bars sought are needed at least. Throws ContractError for fewer, for none
/// sought, and for samples at or beyond +-pi/2 or without a positive finite stiffness.
PiStiffnessFit fit_bars(const PiJoint& joint, std::span<const PiStiffnessSample> samples,
                        const PiBarsSought& sought, const PiBars& known = {}, double share = 1);

}  // namespace linkwright::parallel
