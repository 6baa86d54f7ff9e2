// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/direct/motion_quantity.h"
#include "linkwright/suspension/wheel/derivatives.h"
#include "linkwright/suspension/wheel/quantities.h"

/// Targets of a wheel suspension, and the deviations from them.
namespace linkwright::suspension {

/// Tolerance of a target value: `least` up to a size of `from`, `slope` more per unit above (Poznanovic 2016,
/// equation 75 with the sign of negative targets corrected: |value| - from).
struct ToleranceRule {
  double least = 1;
  double slope = 0;
  double from = 0;
};
double tolerance_of(const ToleranceRule& rule, double value);

/// Target as a quartic in two inputs (equation 79): coefficients of x1^4, x1^3 x2, x1^2 x2^2, x1 x2^3, x2^4,
/// x1^3, x1^2 x2, x1 x2^2, x2^3, x1^2, x1 x2, x2^2, x1, x2 and 1.
double quartic(std::span<const double, 15> coefficients, double x1, double x2);

/// The quantity that is compared with the target.
enum class TargetMeasure { value, change, relative_change };
constexpr std::array<EnumName<TargetMeasure>, 3> names(TargetMeasure) {
  return {{{TargetMeasure::value, "value", "the quantity itself"},
           {TargetMeasure::change, "change", "its difference from that at the reference input"},
           {TargetMeasure::relative_change, "relative_change",
            "the same, divided by that at the reference input"}}};
}

struct TargetPoint {
  CornerInput input;
  double value = 0;
  double tolerance = 1;  ///< > 0
  double weight = 1;     ///< >= 0, on the deviation in tolerances
};

/// Values that a quantity is to take at some inputs, which are positions of one driver.
struct TargetCurve {
  WheelQuantity quantity = WheelQuantity::toe;
  std::optional<MotionQuantity> motion = {};  ///< number of a spring, damper or bar instead of the quantity
  TargetMeasure measure = TargetMeasure::value;
  CornerInput reference;  ///< input of the position that changes are measured from, of the same design
  std::vector<TargetPoint> points;
};

/// Curves that count as one: its objective is the largest deviation, in tolerances (equations 76, 77). It is
/// met when that is at most 1.
struct TargetObjective {
  std::string name;
  std::vector<TargetCurve> curves;
};

/// Numbers that a design is free in, and their range.
struct DesignVariable {
  DesignNumber number;
  double lower = 0, upper = 0;  ///< m (rad, 1), lower < upper
};

/// All positions that the objectives need, each once, and from which one each is solved.
struct TargetPositions {
  Driver driver = Driver::wheel_centre_z;
  std::vector<CornerInput> inputs;  ///< nearest to the reference first
  std::vector<int> from;            ///< an earlier position that is nearest; -1 = the reference
  Extent extent = Extent::at_rest;
  struct Row {
    std::size_t objective = 0, curve = 0, point = 0;
    int position = 0, reference = -1;  ///< -1: the value itself
  };
  std::vector<Row> rows;  ///< one a target, in the order of the objectives
};
/// Throws ContractError for objectives without targets, and for tolerances, weights or values out of range.
TargetPositions target_positions(std::span<const TargetObjective> objectives, Driver driver);

/// The results of a design at the positions.
struct TargetAnswer {
  bool assembled = false;        ///< at every position
  double reached = 0;            ///< share of the positions that there are, with part of the step to the next
  std::vector<double> achieved;  ///< [row]: the measure of each target
  std::vector<double> deviations;  ///< [row]: weight times (achieved - value) / tolerance
  std::vector<double> by;          ///< [row][number] row-major: derivatives of the deviations
  std::vector<CornerPosition> positions;
  std::vector<std::vector<Twist>> shifts;  ///< [position][number]: see WheelDerivatives
};
/// Without numbers there are no derivatives. Positions are followed from one to the next; a design that
/// misses one has no deviations.
TargetAnswer answer(const Suspension& suspension, std::span<const TargetObjective> objectives,
                    const TargetPositions& at, std::span<const DesignNumber> numbers);

/// The largest deviation of each objective.
std::vector<double> objective_values(std::span<const TargetObjective> objectives, const TargetPositions& at,
                                     std::span<const double> deviations);

}  // namespace linkwright::suspension
