// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "support/published.h"

// Wheel suspensions as tests/published/suspension.json writes them (figures of Poznanovic 2016 and computed
// references).
namespace linkwright::suspension {

inline const Value& published(std::string_view id) { return test::published_case("suspension.json", id); }

inline Vec3 point(const Value& array) {
  const auto at = test::numbers(array);
  return {at.at(0), at.at(1), at.at(2)};
}

inline Suspension corner_from(const Value& mechanism) {
  Suspension out;
  out.wheel = {point(test::at(mechanism, "wheel_centre_m")), test::number_at(mechanism, "toe_rad"),
               test::number_at(mechanism, "camber_rad"), test::number_at(mechanism, "tyre_diameter_m")};
  for (const Value& from : test::at(mechanism, "links").as_array()) {
    const std::string& type = test::at(from, "type").as_string();
    if (type == "coupler") {
      const auto between = test::numbers(test::at(from, "between_links"));
      out.couplers.push_back({"", static_cast<int>(between[0]), test::number_at(from, "fraction_on_first"),
                              static_cast<int>(between[1]), point(test::at(from, "point_on_second_m"))});
      continue;
    }
    CornerLink link;
    for (const auto& entry : names(LinkType{}))
      if (entry.name == type) link.type = entry.value;
    for (const Value& at : test::at(from, "body_m").as_array()) link.body.push_back(point(at));
    // A joint without a link stands there with the same points twice.
    if (carrier_points(link.type) > 0)
      for (const Value& at : test::at(from, "carrier_m").as_array()) link.carrier.push_back(point(at));
    out.links.push_back(link);
  }
  if (const Value* steering = mechanism.find("steering")) {
    out.links.at(test::at(*steering, "link_index").as_integer()).moved_by_rack = true;
    out.rack_direction = point(test::at(*steering, "direction"));
  }
  if (const Value* spring = mechanism.find("spring")) {
    const std::string& to = test::at(*spring, "attached_to").as_string();
    out.spring = {point(test::at(*spring, "body_m")), point(test::at(*spring, "point_m")),
                  to == "carrier" ? -1 : std::stoi(to.substr(5))};
  }
  return out;
}

/// The suspension with its rods on the centre link of a steering linkage in place of the rack. The arms, 150
/// mm long, point forward; `unequal` shortens and turns the idler arm, and leans both shafts.
inline Suspension with_steering_linkage(Suspension suspension, bool unequal) {
  for (const CornerLink& link : suspension.links) {
    if (!link.moved_by_rack) continue;
    const Vec3 at = link.body[0], joint{at.x, std::abs(at.y) + 0.02, at.z}, idler = math::mirrored(joint);
    suspension.steering_linkage = {
        .axis = unequal ? Vec3{0.2, 0.1, 2} : Vec3{0, 0, 1},
        .pitman_pivot = joint + Vec3{-0.15, 0, 0},
        .pitman_joint = joint,
        .idler_pivot = idler + (unequal ? Vec3{-0.12, 0.03, 0} : Vec3{-0.15, 0, 0}),
        .idler_joint = idler};
  }
  return suspension;
}

/// The position at a travel, continued from the reference.
inline CornerPosition solve(const CornerPlan& plan, double travel, double rack = 0,
                            Driver driver = Driver::wheel_centre_z) {
  return solve_position(plan, driver, {travel, rack}, reference_position(plan));
}

inline double distance(const Vec3& a, const Vec3& b) { return norm(a - b); }

}  // namespace linkwright::suspension
