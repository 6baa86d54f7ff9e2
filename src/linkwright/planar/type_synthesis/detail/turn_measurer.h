// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// Measures of machines over the whole turn of the crank, or over the samples of a target that does not turn
/// it, on a grid of its own.
class TurnMeasurer {
 public:
  /// The target lives as long.
  explicit TurnMeasurer(const MotionTarget& target);

  /// Least pair angle, size and peak acceleration of a machine whose crank rotation is known.
  void measure(const FittedMachine& machine, MachineMeasures& out);
  /// True if the curve stays near the stroke between the points, too.
  bool stays_near(const FittedMachine& machine, double largest_deviation);

  std::int64_t curves() const { return curves_; }

 private:
  static constexpr std::size_t measured_angles = 720;

  double least_quality(const FittedMachine& machine) const;
  bool is_near_stroke(std::complex<double> point, std::size_t sample, double allowed) const;
  double box_of_pins(const PointProgram& p, std::complex<double> scale) const;
  double peak_acceleration(const FittedMachine& machine, double span) const;
  double peak_acceleration_of_part(const FittedMachine& machine) const;

  const MotionTarget& target_;
  std::vector<std::size_t>
      side_of_sample_;  ///< of the drawn stroke, on which a sample lies; and the last one
  std::int64_t curves_ = 0;
  alignas(64) std::array<double, measured_angles> angle_, quality_, worst_, x_, y_, tx_, ty_;
  std::vector<double> points_ = std::vector<double>(2 * max_steps * measured_angles);
};

}  // namespace linkwright::planar
