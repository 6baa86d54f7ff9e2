// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/linkage/linkage.h"
#include "linkwright/planar/linkage/plan.h"

// The effect of clearances of pins and errors of lengths on path, function and forces of any planar linkage.
namespace linkwright::clearance {

/// A pin that can lie anywhere within its clearance. The offset, from the joint's point of the first body to
/// that of the second, is held in the frame of the first body.
struct PinTolerance {
  int joint = 0;         ///< revolute joint of the linkage
  double clearance = 0;  ///< m, >= 0, radial
};
/// A length of a body: its second point may lie nearer to the first one or farther away.
struct LengthTolerance {
  int body = 0;
  int from = 0, to = 0;  ///< points of the body
  double tolerance = 0;  ///< m, >= 0: the length deviates by at most this
};
struct LinkageTolerances {
  std::vector<PinTolerance> pins;
  std::vector<LengthTolerance> lengths;
};

/// The values whose deviations are wanted. The values of a sample come in this order: x and y of every point
/// (m), the coordinate of every joint (rad or m, near its nominal value), x and y of the force of every joint
/// (N), and the drives (N m or N).
struct ToleranceOutputs {
  std::vector<planar::BodyPoint> points;
  std::vector<int> coordinates;  ///< joints, revolute or prismatic
  std::vector<int> forces;       ///< joints; the linkage must have its masses
  bool drives = false;           ///< likewise
};
std::size_t value_count(const planar::Linkage& linkage, const ToleranceOutputs& outputs);
/// Number of quantities: values that deviate as one thing, in the same order: a point by a distance (m), a
/// coordinate (rad or m), a force by the size of a vector (N), a drive (N m or N).
std::size_t quantity_count(const planar::Linkage& linkage, const ToleranceOutputs& outputs);

/// First derivatives at one sample.
struct SensitivitySample {
  /// Status of the nominal motion, or infeasible where a neighbour does not assemble.
  Status status = Status::done;
  std::vector<double> values;  ///< nominal
  /// Derivative of value i by parameter j at derivatives[i * parameters + j]: two a pin, by the offset along
  /// the global x and y axes, then one a length.
  std::vector<double> derivatives;
  /// Largest change of each value to first order: sum of clearance times gradient and tolerance times
  /// derivative.
  std::vector<double> worst;
  /// Standard deviation of each value to first order, pins touching their bushes in directions that are even
  /// over the circle, lengths even within their tolerance, all independent.
  std::vector<double> deviation;
  /// Largest error of each quantity to first order, all tolerances together in the worst direction: exact
  /// for the linear theory.
  std::vector<double> worst_error;
  /// Contribution of each tolerance (pins, then lengths) to the worst error, of quantity q by tolerance k at
  /// contributions[q * tolerances + k]: along the direction of the worst error, so that they sum up to it.
  std::vector<double> contributions;
  /// Mean square of the error of each quantity by each tolerance alone, as random as for `deviation`; in the
  /// order of `contributions`. The root of their sum over tolerances is that of all together.
  std::vector<double> mean_squares;
};
/// By central differences of whole solutions; the step is 6e-6 of the size of the linkage, the error about
/// 1e-10 of a value's size, more near dead points. `samples` holds the motion of all inputs, sample after
/// sample; forces take their rates and accelerations. Throws ContractError for tolerances, outputs and
/// samples that do not fit, or a linkage that cannot be planned. `times` of the samples, for loads that
/// depend on time; empty = 0 at all of them. When `context` asks to stop: the samples so far, a few hundred
/// at least if so many are asked for.
std::vector<SensitivitySample> clearance_sensitivity(const planar::Linkage& linkage,
                                                     const LinkageTolerances& tolerances,
                                                     const ToleranceOutputs& outputs,
                                                     std::span<const planar::InputMotion> samples,
                                                     std::span<const double> times = {},
                                                     const RunContext* context = nullptr);

/// The values of random linkages at one sample.
struct MonteCarloSample {
  int assembled = 0;  ///< draws that have a position there; the rest is about these
  std::vector<double> mean, deviation, least, most;  ///< statistics of each value
  std::vector<double> worst_error;                   ///< largest one of each quantity
};
/// Draws linkages: pins touching their bushes in even directions, lengths even within their tolerance; every
/// draw keeps its numbers over all samples and is solved exactly. In pieces, on the threads of the context
/// and with its checkpoint; the same bits for a seed however they are shared.
struct MonteCarloResult {
  Status status = Status::done;  ///< done, deadline or cancelled
  int draws = 0;                 ///< made
  std::vector<MonteCarloSample> samples;
  /// Missed samples of every draw: those that have a nominal motion at which it does not assemble.
  std::vector<int> missed;
  /// Largest error of quantity q over all samples, of draw d at largest[d * quantities + q].
  std::vector<double> largest;
};
MonteCarloResult clearance_monte_carlo(const planar::Linkage& linkage, const LinkageTolerances& tolerances,
                                       const ToleranceOutputs& outputs,
                                       std::span<const planar::InputMotion> samples, int draws,
                                       std::uint64_t seed, RunContext& context,
                                       std::span<const double> times = {});

}  // namespace linkwright::clearance
