// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/serial_arm/serial_arm.h"
#include "linkwright/planar/studies/environment.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/driven_law.h"
#include "linkwright/study/kind.h"

// The analysis of a serial arm over time: what its file holds (field lists), how it is read, run and
// reported.
namespace linkwright::planar {

/// `[[mechanism.link]]`, from the base outwards. Reading fills in what is left out.
struct ArmLinkEntry {
  std::string name;               ///< begins the names of the link's columns; default link1, link2, ...
  double length = 0;              ///< m
  double mass = 0;                ///< kg
  std::optional<double> inertia;  ///< kg m2, default m L^2 / 12
  std::optional<double> centre_distance;  ///< m, default L / 2
  double centre_angle = 0;                ///< rad
  std::vector<PointMass> attached;
};
template <class Visitor>
void fields(Visitor&& visit, ArmLinkEntry& l) {
  visit(field::entry("name", "letters, digits and _; begins the names of its columns"), l.name);
  visit(field::length("length", "own joint to next joint or tip").between(1e-9, 1e9).required(), l.length);
  visit(field::mass("mass", "mass of the link, without what is attached").not_negative().required(), l.mass);
  visit(field::inertia("inertia", "moment of inertia about its mass centre; default: uniform rod, m L^2 / 12")
            .not_negative(),
        l.inertia);
  visit(field::length("centre_distance",
                      "distance of its mass centre from its own joint; default: half its length")
            .not_negative(),
        l.centre_distance);
  visit(field::angle("centre_angle", "angle of its mass centre from the link line").between(-1e3, 1e3),
        l.centre_angle);
  visit(field::entry("attached", "masses fixed to it: payload, motor, counterweight"), l.attached);
}

/// `[mechanism]` of the analysis.
struct ArmMechanism {
  double base_x = 0, base_y = 0;  ///< joint O1 (m)
  std::vector<ArmLinkEntry> links;
};
template <class Visitor>
void fields(Visitor&& visit, ArmMechanism& m) {
  const auto place = [](std::string_view key, std::string_view summary) {
    return field::length(key, summary);
  };
  visit(place("base_x", "joint O1, x"), m.base_x);
  visit(place("base_y", "joint O1, y"), m.base_y);
  visit(field::entry("link", "the links from the base outwards").required(), m.links);
}

/// From where the angle of a law counts.
enum class ArmAngle { absolute, joint };
constexpr std::array<EnumName<ArmAngle>, 2> names(ArmAngle) {
  return {{{ArmAngle::absolute, "absolute", "link against the x axis"},
           {ArmAngle::joint, "joint", "link against the link before, the first against the x axis"}}};
}
/// `[[drive]]`: how one link moves.
struct ArmDrive {
  std::string link;
  ArmAngle angle = ArmAngle::absolute;
  study::RotaryLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, ArmDrive& d) {
  visit(field::entry("link", "name of the link").required(), d.link);
  visit(field::entry("angle", "from where its angle counts"), d.angle);
  visit(field::entry("law", "how its angle moves in time").required(), d.law);
}

struct TimeSweep {
  study::TimeSamples time;
};
template <class Visitor>
void fields(Visitor&& visit, TimeSweep& s) {
  visit(field::entry("time", "times of the rows").required(), s.time);
}

/// The columns of the table.
struct ArmQuantities {
  bool position = true, rates = true, reactions = true, torques = true, power = true, energy = true;
};

/// An analysis as read; one drive for each link, in the order of the links.
struct SerialArmStudy {
  ArmMechanism mechanism;
  std::vector<ArmDrive> drives;
  Environment environment;
  TimeSweep sweep;
  ArmQuantities quantities;
};

/// "analysis" of "planar.serial_arm".
study::Kind serial_arm_kind();

/// Reads the tables of the study; problems go to the reader.
SerialArmStudy read_serial_arm_study(study::ObjectReader& document, const study::Common& common);

/// The arm that a study describes.
SerialArm serial_arm(const ArmMechanism& mechanism);

/// Absolute motion of all links at the first time of the sweep, then at the second.
std::vector<math::Motion> arm_motion(const SerialArmStudy& study);

/// The table of the study alone.
Table serial_arm_table(const SerialArmStudy& study);
/// ... without rows.
Table empty_serial_arm_table(const SerialArmStudy& study);

/// Motion, joint forces, torques, power and energy at each time. Cancelled or out of time: the rows so far.
study::Result run_serial_arm_study(const SerialArmStudy& study, RunContext& context);

}  // namespace linkwright::planar
