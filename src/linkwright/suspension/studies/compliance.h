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
#include "linkwright/suspension/compliance/coefficients.h"
#include "linkwright/suspension/compliance/compliance.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/parameters.h"

// The table `[compliance]`: loads and elastic joints in an analysis of a wheel suspension.
namespace linkwright::suspension {

enum class LinkEnd { body, carrier };
constexpr std::array<EnumName<LinkEnd>, 2> names(LinkEnd) {
  return {{{LinkEnd::body, "body"}, {LinkEnd::carrier, "carrier"}}};
}

/// The force of a bushing over its displacement.
struct BushingCurveForm {
  std::vector<double> displacement, force;
};
template <class Visitor>
void fields(Visitor&& visit, BushingCurveForm& c) {
  visit(field::length("displacement", "ascending; from 0: it is the same both ways").required(),
        c.displacement);
  visit(field::force("force", "at these displacements, ascending, 0 without displacement").required(),
        c.force);
}

/// The moment of a bushing over its rotation.
struct BushingMomentCurveForm {
  std::vector<double> rotation, moment;
};
template <class Visitor>
void fields(Visitor&& visit, BushingMomentCurveForm& c) {
  visit(field::angle("rotation", "ascending; from 0: it is the same both ways").required(), c.rotation);
  visit(field::torque("moment", "at these rotations, ascending, 0 without rotation").required(), c.moment);
}

/// `[[compliance.joint]]`: a bushing, a ball joint (only `stiffness`), or both joints of a rod in series
/// (`end` left out).
struct JointForm {
  std::string link;
  std::optional<LinkEnd> end;
  std::optional<double> stiffness;  ///< N/m
  std::optional<double> axial, radial;
  double torsional = 0, conical = 0;
  std::optional<double> second_radial, second_conical;
  std::optional<BushingCurveForm> axial_curve, radial_curve;
  std::optional<BushingMomentCurveForm> torsional_curve, conical_curve;
  std::optional<std::array<double, 3>> axis, second_axis;
};
template <class Visitor>
void fields(Visitor&& visit, JointForm& j) {
  visit(field::entry("link", "name of the link").required(), j.link);
  visit(field::entry("end", "which of its joints; left out: a rod and both its joints in series"), j.end);
  const auto stiffness = [](std::string_view key, std::string_view summary, Dimension dimension) {
    return field::of(dimension, key, summary).between(0, 1e15);
  };
  visit(
      stiffness("stiffness", "the same in all directions, free to turn: a ball joint", Dimension::stiffness),
      j.stiffness);
  visit(stiffness("axial", "of a bushing, along its axis", Dimension::stiffness), j.axial);
  visit(stiffness("radial", "of a bushing, across its axis", Dimension::stiffness), j.radial);
  visit(stiffness("torsional", "of a bushing, about its axis", Dimension::stiffness_angular), j.torsional);
  visit(stiffness("conical", "of a bushing, about axes across", Dimension::stiffness_angular), j.conical);
  visit(stiffness("second_radial", "of a bushing, across both its axes; default: the radial one",
                  Dimension::stiffness),
        j.second_radial);
  visit(
      stiffness("second_conical", "of a bushing, about the direction across both its axes; default: conical",
                Dimension::stiffness_angular),
      j.second_conical);
  visit(field::entry("axial_curve", "its force along its axis, instead of the axial stiffness"),
        j.axial_curve);
  visit(field::entry("radial_curve", "its force in each of two directions across, instead of the stiffness"),
        j.radial_curve);
  visit(field::entry("torsional_curve", "its moment about its axis, instead of the torsional stiffness"),
        j.torsional_curve);
  visit(field::entry("conical_curve",
                     "its moment about each of two directions across, instead of the stiffness"),
        j.conical_curve);
  visit(field::entry("axis",
                     "of a bushing, of any length; default: the hinge of the link, or the line of a rod")
            .between(-1e6, 1e6),
        j.axis);
  visit(
      field::entry("second_axis",
                   "of a bushing, of any length: the direction across its axis in which the radial stiffness "
                   "acts; default: any")
          .between(-1e6, 1e6),
      j.second_axis);
}

enum class LoadPlace { contact, wheel_centre };
constexpr std::array<EnumName<LoadPlace>, 2> names(LoadPlace) {
  return {{{LoadPlace::contact, "contact"}, {LoadPlace::wheel_centre, "wheel_centre"}}};
}
/// `[[compliance.load]]`: beside the load cases that are always reported.
struct LoadForm {
  std::string name;
  LoadPlace at = LoadPlace::contact;
  std::array<double, 3> force{}, moment{};
  std::optional<int> steps;
};
template <class Visitor>
void fields(Visitor&& visit, LoadForm& l) {
  visit(field::entry("name", "of the load case").required(), l.name);
  visit(field::entry("at", "where the force acts on the carrier"), l.at);
  visit(field::force("force", "in the vehicle's frame: forward, left, up"), l.force);
  visit(field::torque("moment", "about its axes"), l.moment);
  visit(field::entry("steps", "table over shares of the load, from none to all of it in so many steps")
            .between(1, 1000),
        l.steps);
}

/// `[[compliance.axle.mount]]`: a bushing between subframe and body.
struct MountForm {
  std::array<double, 3> point{};
  std::array<double, 3> axis{0, 0, 1};
  double axial = 0, radial = 0;
  bool both_sides = true;
};
template <class Visitor>
void fields(Visitor&& visit, MountForm& m) {
  visit(field::length("point", "its place in the vehicle's frame").between(-1e3, 1e3).required(), m.point);
  visit(field::entry("axis", "its direction, of any length").between(-1e6, 1e6), m.axis);
  visit(field::stiffness("axial", "along its axis").between(0, 1e15).required(), m.axial);
  visit(field::stiffness("radial", "across its axis").between(0, 1e15).required(), m.radial);
  visit(field::entry("both_sides", "there is another one, its mirror image"), m.both_sides);
}

/// `[compliance.axle]`: both wheels, joined by their rack.
struct ComplianceAxleForm {
  std::optional<double> rack_stiffness;
  bool anti_roll_bar = false;
  std::vector<std::string> on_subframe;
  std::vector<MountForm> mounts;
};
template <class Visitor>
void fields(Visitor&& visit, ComplianceAxleForm& a) {
  visit(field::stiffness("rack_stiffness", "of the rack against the body; default: held").between(1, 1e15),
        a.rack_stiffness);
  visit(field::entry("anti_roll_bar", "the bar of the mechanism joins both wheels"), a.anti_roll_bar);
  visit(field::entry("on_subframe",
                     "names of links whose joints at the body are on the subframe; default with mounts: all. "
                     "The rack goes with its link"),
        a.on_subframe);
  visit(field::entry("mount", "bushings of the subframe"), a.mounts);
}

struct ComplianceForm {
  std::optional<Support> support;
  std::optional<double> preload;
  std::vector<JointForm> joints;
  std::vector<LoadForm> loads;
  std::optional<ComplianceAxleForm> axle;
};
template <class Visitor>
void fields(Visitor&& visit, ComplianceForm& c) {
  visit(field::entry("support",
                     "what carries the wheel; default: the spring if its stiffness is known, else the height "
                     "of the contact"),
        c.support);
  visit(field::force("preload",
                     "load of the wheel at rest, upward at the contact, whose turning with the links counts; "
                     "needs a spring")
            .not_negative(),
        c.preload);
  visit(field::entry("joint", "elastic joints; all others are rigid"), c.joints);
  visit(field::entry("load", "loads in addition to the standard cases"), c.loads);
  visit(field::entry("axle", "both wheels with their rack, at the reference"), c.axle);
}

/// Checks what was read against the suspension; problems go to the reader.
void check_compliance(study::ObjectReader& document, ComplianceForm& compliance,
                      const CornerDescription& description);

/// Positions of a sweep, [rack * travels + travel].
struct SweptCorner {
  std::span<const double> travels, racks;  ///< m
  std::span<const CornerPosition> positions;
  std::span<const WheelParameters> wheels;
};

/// The tables `compliance` (coefficients), `compliance_matrix`, `joint_forces` (by load case) and `loads` at
/// the reference position, `over_load-n` of loads with steps, `compliance_over_travel` of the positions that
/// the sweep has, and of both wheels `axle_compliance` and `axle_compliance_matrix`.
void add_compliance(study::Result& result, const CornerDescription& description,
                    const std::optional<CornerDescription>& other_wheel, const ComplianceForm& compliance,
                    const SweptCorner& swept, const RunContext& context);

}  // namespace linkwright::suspension
