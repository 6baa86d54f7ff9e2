// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/limits.h"

namespace linkwright::planar {

/// A line through the values of the inputs: inputs = base + value direction.
struct InputLine {
  std::vector<double> base, direction;
};
/// Along one input, the others fixed: the value is that of the input (rad or m).
InputLine along_input(std::span<const double> inputs, int input);
/// From one set of inputs (value 0) to another (value 1).
InputLine line_between(std::span<const double> from, std::span<const double> to);

/// The assembly mode that a place of a linkage belongs to: the places that can be reached from it along a
/// line of inputs without passing a dead point. For linkages with groups that have no closed form, whose
/// modes have no names.
///
/// The places form a curve over the line. It is followed by its length (predictor along the tangent,
/// corrector by Newton's method at right angles to it), so that nothing special happens at a dead point:
/// there the value turns back, and the mode ends. A step is taken when the corrector hardly moves what was
/// predicted, the tangent turns little, a cubic through both ends meets the equations in the middle as well,
/// the slope of the value there shows that it does not turn back and forth again in between, and the
/// determinant of the equations bordered by the tangent keeps its sign, as it does along a curve but
/// not from one curve to another beside it. Where it changes sign however short the step, curves cross: a
/// change point. (Allgower and Georg, Introduction to Numerical Continuation Methods, SIAM 2003, sections 2,
/// 6 and 8.)
///
/// Only the groups without closed form and those they depend on take part; others are placed by
/// solve_position.
class ModeCurve {
 public:
  /// Follows the curve in both directions from `parts`, a place that meets the joints at `start`, to `low`
  /// and `high` at most, which hold `start`; all values along the line. Where `turn` > 0 (the change of value
  /// after which the inputs are the same again) it also ends where the linkage comes back to its place.
  /// Change points count as ends but for `smooth`.
  ModeCurve(const LinkagePlan& plan, InputLine line, double start, std::span<const PartState<double>> parts,
            double low, double high, double turn = 0, AtChangePoint policy = AtChangePoint::smooth);
  ~ModeCurve();
  ModeCurve(ModeCurve&&) noexcept;
  ModeCurve& operator=(ModeCurve&&) noexcept;

  /// Ends of the mode: `bound` where nothing ends but what was asked for.
  const RangeEnd& low() const;
  const RangeEnd& high() const;
  /// > 0: the linkage comes back to its place after this change of the value, a whole number of turns.
  double period() const;
  /// Values of the change points that were passed, rising.
  std::span<const double> change_points() const;
  /// True if the steps became too short somewhere, so that the mode may continue beyond its end.
  bool lost() const;
  /// Number of places that were computed.
  std::size_t nodes() const;

  /// Puts the place at a value into the motion, and the signs of the assembly modes that it shows; whole
  /// turns do not matter where `turn` was given. done; no_assembly or, at a change point, limit_reached
  /// beyond the ends, where the motion gets the place of the nearer end.
  Status place(double value, LinkageMotion& motion);
  /// m: the gaps of the joints at a value beyond the ends: the largest after bringing their squares to
  /// a minimum from the nearer end.
  double gap(double value);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// The nearest place that meets the joints, for places that meet them about: changes parts and the value
/// along the line as little as it can. False when there is none near.
bool nearest_place(const LinkagePlan& plan, const InputLine& line, double& value,
                   std::span<PartState<double>> parts);

}  // namespace linkwright::planar
