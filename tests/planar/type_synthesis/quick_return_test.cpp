// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/quick_return.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/planar/function/dead_centres.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// A slider-crank with a crank of 1, on a line along x, in sizes of the target.
FittedMachine slider_crank_of(double rod, double offset) {
  FittedMachine out;
  out.shape.program = programs_of(MachineFamily::slider_crank, MachineOutput::slide).front();
  out.shape.x.assign(static_cast<std::size_t>(out.shape.program->parameters), 0.0);
  out.shape.x[0] = rod, out.shape.x[1] = offset;
  out.shape.x[static_cast<std::size_t>(out.shape.program->scale())] = 1;
  return out;
}

// The crank angles of the dead centres, by crank and rod in line.
TEST(QuickReturns, AreThoseOfTheDeadCentres) {
  for (const double offset : {0.0, 0.3, -0.8}) {
    const double rod = 2.5, far = rod + 1, near = rod - 1;
    const double imbalance = std::asin(offset / near) - std::asin(offset / far);
    const double stroke = std::sqrt(far * far - offset * offset) - std::sqrt(near * near - offset * offset);
    for (const bool clockwise : {false, true})
      for (const double sign : {1.0, -1.0}) {
        const QuickReturn wanted{.time_ratio = 1.2, .range = sign * 0.1, .clockwise = clockwise};
        const MotionTarget target = quick_return_target(wanted);
        const MachineStrokes strokes = strokes_of(wanted, target, slider_crank_of(rod, offset));
        EXPECT_EQ(strokes.extremes, 2);
        EXPECT_NEAR(strokes.range / target.stroke.size, sign * stroke, 1e-6);
        const double ratio = time_ratio_of(std::abs(imbalance));
        EXPECT_NEAR(std::max(strokes.time_ratio, 1 / strokes.time_ratio), ratio, 1e-5);
        // The slow stroke changes its direction with the sense of the crank.
        const bool as_is = (imbalance > 0) == (strokes.time_ratio > 1);
        if (offset != 0) {
          const MachineStrokes other =
              strokes_of({.time_ratio = 1.2, .range = -sign * 0.1, .clockwise = !clockwise}, target,
                         slider_crank_of(rod, offset));
          EXPECT_EQ((imbalance > 0) == (other.time_ratio > 1), as_is);
        }
      }
  }
}

TEST(QuickReturns, AreRowsOfTheResidual) {
  const QuickReturn wanted{.time_ratio = 1.3, .range = 0.06};
  const MotionTarget target = quick_return_target(wanted);
  MachineFitter fitter(target, {.min_pair_angle = 20 * pi / 180});
  // From a slider-crank near by, a polish brings both dead centres to their places.
  FittedMachine machine = slider_crank_of(2.5, -0.6);
  double least = infinity;
  FittedMachine best;
  for (int k = 0; k < 36; ++k) {
    for (const double sign : {1.0, -1.0}) {
      FittedMachine trial = slider_crank_of(2.5, sign * 0.6);
      for (std::size_t i = 0; i < target.count; ++i) trial.angle[i] = 2 * pi * k / 36 + target.turn[i];
      fitter.polish(trial, infinity);
      trial.error = fitter.measure(trial).error;
      if (trial.error < least) least = trial.error, best = trial;
    }
  }
  EXPECT_LT(least, 1e-8);
  const MachineStrokes strokes = strokes_of(wanted, target, best);
  EXPECT_NEAR(strokes.time_ratio, 1.3, 1e-3);
  EXPECT_NEAR(strokes.range, 0.06, 1e-6);
}

TEST(QuickReturns, NeedARatioAndARange) {
  EXPECT_THROW((void)quick_return_target({.time_ratio = 0.9}), ContractError);
  EXPECT_THROW((void)quick_return_target({.range = 0}), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
