// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// Kinds of numbers that a wheel suspension is designed by.
enum class DesignKind {
  body,
  carrier,
  length,
  coupler_point,
  coupler_fraction,
  coupler_begin,
  spring_body,
  spring_moving,
  rocker_axis,
  rocker_rod,
  rocker_length,
  element_first,
  element_second,
  wheel_centre,
  wheel_toe,
  wheel_camber,
};
constexpr std::array<EnumName<DesignKind>, 16> names(DesignKind) {
  return {{{DesignKind::body, "body", "coordinate of a body point of a link"},
           {DesignKind::carrier, "carrier", "coordinate of a carrier point of a link"},
           {DesignKind::length, "length", "prescribed length of a link"},
           {DesignKind::coupler_point, "coupler_point", "coordinate of a coupler's point"},
           {DesignKind::coupler_fraction, "coupler_fraction", "where a coupler holds its first link"},
           {DesignKind::coupler_begin, "coupler_begin", "coordinate of a coupler's beginning off the line"},
           {DesignKind::spring_body, "spring_body", "coordinate of the spring's end at the body"},
           {DesignKind::spring_moving, "spring_moving", "coordinate of the spring's other end"},
           {DesignKind::rocker_axis, "rocker_axis", "coordinate of a point of a rocker's axis"},
           {DesignKind::rocker_rod, "rocker_rod", "coordinate of an end of a rocker's rod"},
           {DesignKind::rocker_length, "rocker_length", "prescribed length of a rocker's rod"},
           {DesignKind::element_first, "element_first", "coordinate of the end of an element at the body"},
           {DesignKind::element_second, "element_second", "coordinate of the other end of an element"},
           {DesignKind::wheel_centre, "wheel_centre", "coordinate of the wheel centre"},
           {DesignKind::wheel_toe, "wheel_toe", "toe at the reference"},
           {DesignKind::wheel_camber, "wheel_camber", "camber at the reference"}}};
}

/// One number of a wheel suspension (m; rad for angles; a share for the fraction of a coupler).
struct DesignNumber {
  DesignKind kind = DesignKind::body;
  int index = 0;  ///< index of the link, coupler, rocker or element
  /// Index among the link's body or carrier points, or those of a rocker's axis; of a rod 0 is its end on the
  /// part that drives the rocker, 1 that on the rocker. Of a length of an RS or SR link 0 or 1.
  int point = 0;
  int axis = 0;  ///< 0, 1, 2 = x, y, z

  friend bool operator==(const DesignNumber&, const DesignNumber&) = default;
};

/// The place of a number in a suspension. Throws ContractError for one that the suspension does not have; a
/// length has to be prescribed.
template <class T>
T& design_value(BasicSuspension<T>& suspension, const DesignNumber& number);
double design_value(const Suspension& suspension, const DesignNumber& number);

/// The name in files and reports: "link 3 (US).body_y", "spring.moving_x"; the number of the point is named
/// where there are two: "lower arm.body_2_z".
std::string label(const Suspension& suspension, const DesignNumber& number);

/// The suspension as it is made: every link and every rocker's rod keeps its lengths when points move, which
/// are then numbers of the design. Throws ContractError if a coupler is on a US link, whose place depends on
/// the length.
Suspension as_built(const Suspension& suspension);

/// All coordinates of the points of links, prescribed lengths, couplers, rockers and the spring, in the
/// order of the suspension.
std::vector<DesignNumber> hard_points(const Suspension& suspension);

}  // namespace linkwright::suspension
