// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/compliance/coefficients.h"
#include "linkwright/suspension/compliance/compliance.h"
#include "linkwright/suspension/studies/corner.h"

// The table `[compliance]`: loads and elastic joints in an analysis of a wheel suspension.
namespace linkwright::suspension {

enum class LinkEnd { body, carrier };
constexpr std::array<EnumName<LinkEnd>, 2> names(LinkEnd) {
  return {{{LinkEnd::body, "body"}, {LinkEnd::carrier, "carrier"}}};
}

/// `[[compliance.joint]]`: a bushing, a ball joint (only `stiffness`), or both joints of a rod in series
/// (`end` left out).
struct JointForm {
  std::string link;
  std::optional<LinkEnd> end;
  std::optional<double> stiffness;  ///< N/m
  std::optional<double> axial, radial;
  double torsional = 0, conical = 0;
  std::optional<std::array<double, 3>> axis;
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
  visit(field::entry("axis",
                     "of a bushing, of any length; default: the hinge of the link, or the line of a rod")
            .between(-1e6, 1e6),
        j.axis);
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
};
template <class Visitor>
void fields(Visitor&& visit, LoadForm& l) {
  visit(field::entry("name", "of the load case").required(), l.name);
  visit(field::entry("at", "where the force acts on the carrier"), l.at);
  visit(field::force("force", "in the vehicle's frame: forward, left, up"), l.force);
  visit(field::torque("moment", "about its axes"), l.moment);
}

struct ComplianceForm {
  std::optional<Support> support;
  std::optional<double> preload;
  std::vector<JointForm> joints;
  std::vector<LoadForm> loads;
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
}

/// Checks what was read against the suspension; problems go to the reader.
void check_compliance(study::ObjectReader& document, ComplianceForm& compliance,
                      const CornerDescription& description);

/// The tables `compliance` (coefficients), `compliance_matrix`, `joint_forces` (by load case) and `loads`, at
/// the reference position.
void add_compliance(study::Result& result, const CornerDescription& description,
                    const ComplianceForm& compliance);

}  // namespace linkwright::suspension
