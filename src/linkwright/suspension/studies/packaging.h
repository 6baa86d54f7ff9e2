// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/studies/compliance.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/packaging.h"

// The table `[packaging]`: angles of ball joints and of a half-shaft, and clearances, at every position.
namespace linkwright::suspension {

struct HalfShaftForm {
  std::array<double, 3> inner{}, outer{}, inner_axis{0, 1, 0};
  std::optional<double> greatest_inner_angle, greatest_outer_angle, greatest_plunge;
};
template <class Visitor>
void fields(Visitor&& visit, HalfShaftForm& h) {
  const auto point = [](std::string_view key, std::string_view summary) {
    return field::length(key, summary).between(-1e3, 1e3).required();
  };
  visit(point("inner", "centre of its joint on the body"), h.inner);
  visit(point("outer", "centre of its joint on the carrier"), h.outer);
  visit(field::entry("inner_axis", "direction of the gearbox's shaft, of any length").between(-1e6, 1e6),
        h.inner_axis);
  visit(field::angle("greatest_inner_angle", "that the joint on the body allows").between(0, 1.6),
        h.greatest_inner_angle);
  visit(field::angle("greatest_outer_angle", "that the joint on the carrier allows").between(0, 1.6),
        h.greatest_outer_angle);
  visit(field::length("greatest_plunge", "that it allows, either way").between(0, 1e3), h.greatest_plunge);
}

struct BallJointForm {
  std::string link;
  LinkEnd end = LinkEnd::carrier;
  std::array<double, 3> stud{};
  std::optional<double> greatest_angle;
};
template <class Visitor>
void fields(Visitor&& visit, BallJointForm& b) {
  visit(field::entry("link", "name of the link").required(), b.link);
  visit(field::entry("end", "which of its joints"), b.end);
  visit(field::entry("stud", "direction of the stud at the reference, of any length")
            .between(-1e6, 1e6)
            .required(),
        b.stud);
  visit(field::angle("greatest_angle", "that the joint allows, from the reference").between(0, 3.2),
        b.greatest_angle);
}

struct ClearanceForm {
  std::string first, second;
  double first_radius = 0, second_radius = 0;
  double least = 0;
};
template <class Visitor>
void fields(Visitor&& visit, ClearanceForm& c) {
  visit(field::entry("first", "name of a link, \"spring\" or \"half_shaft\"; beside a box also \"tyre\"")
            .required(),
        c.first);
  visit(field::entry("second", "likewise, or \"tyre\", or the name of a box").required(), c.second);
  visit(field::length("first_radius", "of the first part about its line").not_negative(), c.first_radius);
  visit(field::length("second_radius", "of the second part about its line").not_negative(), c.second_radius);
  visit(field::length("least", "clearance that there must be").not_negative(), c.least);
}

/// `[[packaging.box]]`.
struct BoxForm {
  std::string name;
  std::array<double, 3> lower{}, upper{};
};
template <class Visitor>
void fields(Visitor&& visit, BoxForm& b) {
  visit(field::entry("name", "by which clearances name it").required(), b.name);
  const auto corner = [](std::string_view key, std::string_view summary) {
    return field::length(key, summary).between(-1e3, 1e3).required();
  };
  visit(corner("lower", "corner with the least coordinates, in the frame of the vehicle"), b.lower);
  visit(corner("upper", "opposite corner"), b.upper);
}

/// `[packaging]`.
struct PackagingForm {
  std::optional<double> tyre_width;
  std::optional<HalfShaftForm> half_shaft;
  std::vector<BallJointForm> ball_joints;
  std::vector<BoxForm> boxes;
  std::vector<ClearanceForm> clearances;
};
template <class Visitor>
void fields(Visitor&& visit, PackagingForm& p) {
  visit(field::length("tyre_width", "of the tyre, whose cross-section is taken as a circle").positive(),
        p.tyre_width);
  visit(field::entry("half_shaft", "drive shaft between the body and the carrier"), p.half_shaft);
  visit(field::entry("ball_joint", "ball joints of links"), p.ball_joints);
  visit(field::entry("box", "obstacles fixed to the body, with faces along the axes of the vehicle"),
        p.boxes);
  visit(field::entry("clearance", "distances between parts"), p.clearances);
}

/// The half-shaft and the boxes that were read.
HalfShaft shaft_of(const HalfShaftForm& form);
Box box_of(const BoxForm& form);
/// Checks what was read against the suspension; problems go to the reader.
void check_packaging(study::ObjectReader& document, const PackagingForm& packaging,
                     const Suspension& suspension);
/// Columns of the first table, whose rows are `positions` at these travels and racks (m), with facts and a
/// warning for each limit that is passed.
void add_packaging(study::Result& result, const Suspension& suspension, const CornerPlan& plan,
                   const PackagingForm& packaging, std::span<const CornerPosition> positions);
/// Number of columns that `add_packaging` makes.
double packaging_columns(const PackagingForm& packaging);

}  // namespace linkwright::suspension
