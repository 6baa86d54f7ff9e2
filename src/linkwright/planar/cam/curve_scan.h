// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/math/function_ref.h"
#include "linkwright/planar/cam/programme.h"

/// @file
/// Extremes and signs of quantities that follow from the motion programme of a cam. A quantity is a function
/// of the motion and of the angle of the cam; it is smooth within each part of the programme and may step
/// between parts, where both of its values count.
namespace linkwright::planar {

/// A quantity over a programme: the motion of the follower and the angle of the cam (rad) in, a number out.
using CamQuantity = math::FunctionRef<double(const math::Motion&, double)>;

/// A value and the angle of the cam at which it occurs.
struct CamExtreme {
  double value = 0;  ///< the value
  double angle = 0;  ///< angle of the cam (rad), in the range of the programme
};

/// The place that is reported where several have the same value but for rounding.
enum class EqualPlaces {
  first,  ///< the first of them
  last    ///< the last of them
};

/// The least value of a quantity. Samples bracket it, and the place is refined to a zero of the derivative.
/// @param curve the programme
/// @param quantity the quantity; values that are not finite are passed over
/// @param equal the place that is reported of several with the same value
/// @returns the least value and its place; infinity where there is none
CamExtreme least_over(const ProgrammeCurve& curve, CamQuantity quantity,
                      EqualPlaces equal = EqualPlaces::first);

/// The greatest value of a quantity, refined as `least_over` does.
/// @param curve the programme
/// @param quantity the quantity; values that are not finite are passed over
/// @returns the greatest value and its place; -infinity where there is none
CamExtreme greatest_over(const ProgrammeCurve& curve, CamQuantity quantity);

/// A range of angles of the cam.
struct CamRange {
  double from = 0,  ///< rad
      to = 0;       ///< rad; beyond the angle of the programme if the range passes its end
};

/// The ranges in which a quantity is negative. Their edges are zeros of the quantity, or steps; ranges that
/// are narrower than the distance of samples are found by the refined extremes.
/// @param curve the programme
/// @param quantity the quantity; a value that is not finite counts as positive
/// @returns the ranges in the order of their beginnings; one that passes the end of a turning cam is one
/// range
std::vector<CamRange> negative_ranges(const ProgrammeCurve& curve, CamQuantity quantity);

}  // namespace linkwright::planar
