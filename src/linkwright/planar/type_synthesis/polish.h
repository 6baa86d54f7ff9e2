// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/motion_target.h"
#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {

/// A box with sides along the axes.
struct PlaneBox {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// What a machine must keep; lengths in sizes of the stroke, places from its mean.
struct MachineLimits {
  double min_pair_angle = 20 * pi / 180;  ///< rad, over the whole turn, or the used part of it
  double min_length = 0.05, max_length = 10;
  std::optional<PlaneBox> ground_box = {};               ///< all pivots on the ground are inside
  std::vector<std::complex<double>> ground_pivots = {};  ///< each is a pivot of the machine on the ground
  double pivot_tolerance = 1e-3;                         ///< of the given pivots
};

/// What keeps a machine from being an answer.
enum class MachineDefect {
  none,
  pair_angle,
  short_link,
  long_link,
  order,
  excursion,
  ground_box,
  ground_pivots,
  no_turn
};
constexpr std::array<EnumName<MachineDefect>, 9> names(MachineDefect) {
  return {{{MachineDefect::none, "none", "none"},
           {MachineDefect::pair_angle, "pair_angle", "the least pair angle is below its limit"},
           {MachineDefect::short_link, "short_link", "a length is below its limit"},
           {MachineDefect::long_link, "long_link", "a length is above its limit"},
           {MachineDefect::order, "order", "the points are met in another order, or in more than one turn"},
           {MachineDefect::excursion, "excursion", "between two points the curve leaves the stroke"},
           {MachineDefect::ground_box, "ground_box", "a pivot on the ground is outside the box"},
           {MachineDefect::ground_pivots, "ground_pivots", "no pivot is at one of the given ground pivots"},
           {MachineDefect::no_turn, "no_turn",
            "the crank does not turn fully, or its turn ends in another position"}}};
}

/// A machine that is compared with a stroke: parameters in sizes of the stroke from its mean.
struct FittedMachine {
  MachineShape shape;
  double sense = 1;                                        ///< of the crank along the stroke, +1 or -1
  alignas(64) std::array<double, stroke_samples> angle{};  ///< crank angle of each sample of the target (rad)
  double body_angle = 0;    ///< of the body from the line of the pins of the traced bar (rad)
  double error = infinity;  ///< root mean square distance, in sizes
};

/// What is told of a machine; lengths in sizes of the stroke.
struct MachineMeasures {
  double error = infinity;  ///< root mean square of what is fitted: distances beyond the tolerance, rotations
  double distance = 0;      ///< root mean square distance of the points of the stroke
  double largest_deviation = 0;
  /// Largest distance beyond a tolerance, of the samples that have one; 0 where all keep it, to rounding.
  double beyond_tolerance = 0;
  double rotation = 0, largest_rotation = 0;  ///< errors of the angle of the body (rad)
  /// Over the whole turn, or over the used part where the crank need not turn (rad); 0 where the machine does
  /// not assemble.
  double min_pair_angle = 0;
  double min_length = 0, max_length = 0;
  double size = 0;               ///< larger side of the box of all pins over the same rotation
  double span = 0;               ///< crank angle between the first and the last point (rad)
  double peak_acceleration = 0;  ///< of the traced point at unit crank speed
  MachineDefect defect = MachineDefect::none;
};

/// The squared error near a machine, squares + 2 gradient.d + d.matrix d, for changes d of all its unknowns:
/// parameters, the start of the crank where the target is timed, the angle of the body where it is oriented.
/// Residuals change linearly in it, and crank angles that are free stay the closest ones.
struct ErrorModel {
  std::size_t unknowns = 0;
  double squares = 0;                    ///< squared error of the machine itself, in squared sizes
  std::vector<double> gradient, matrix;  ///< half of its gradient; symmetric matrix, row after row
};

/// Fits machines to one target, one after the other: a result depends on the machine that it begins with
/// alone. Make one a thread; nothing is allocated afterwards.
class MachineFitter {
 public:
  MachineFitter(const MotionTarget& target, const MachineLimits& limits);
  ~MachineFitter();
  MachineFitter(MachineFitter&&) noexcept;

  /// Turns the body on its bar so that it is at its angles as nearly as can be. Returns the error.
  double turn_body(FittedMachine& machine);

  /// Levenberg-Marquardt on shape and place, the crank angles following, in three stages with growing weight
  /// of the limits and more of them while the limits are nearly kept. Given up (false) when the error after
  /// one of the first two is far above `best`, infinity = never.
  bool polish(FittedMachine& machine, double best);

  /// Measures on a grid of its own, and the crank angles to rounding.
  MachineMeasures measure(FittedMachine& machine);

  /// The error of a measured machine near its unknowns; with `hold_pivots` stiff rows keep given ground
  /// pivots at their places.
  ErrorModel error_model(const FittedMachine& machine, bool hold_pivots);

  /// Errors of the output of a function at all samples, in sizes or rad, and their derivatives by the
  /// unknowns of `error_model`: those of all samples by the first unknown, then by the second, ...
  void output_errors(const FittedMachine& machine, std::vector<double>& errors,
                     std::vector<double>& derivatives);

  /// Changes all unknowns of a machine, as those of `error_model`; given ground pivots are met again, and a
  /// machine whose scale is free has its own scale again. The crank angles are those before, but for the
  /// start of the crank: `measure` follows.
  void move(FittedMachine& machine, std::span<const double> change);

  /// Number of curves that were computed, each of 96 points.
  std::int64_t curves() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace linkwright::planar
