#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/serial_arm/serial_arm.h"
#include "linkwright/planar/studies/environment.h"
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
  visit(Field{.key = "name", .summary = "letters, digits and _; begins the names of its columns"}, l.name);
  visit(Field{.key = "length",
              .summary = "own joint to next joint or tip",
              .dimension = Dimension::length,
              .minimum = 1e-9,
              .maximum = 1e9,
              .required = true},
        l.length);
  visit(Field{.key = "mass",
              .summary = "mass of the link, without what is attached",
              .dimension = Dimension::mass,
              .minimum = 0,
              .maximum = 1e9,
              .required = true},
        l.mass);
  visit(Field{.key = "inertia",
              .summary = "moment of inertia about its mass centre; default: uniform rod, m L^2 / 12",
              .dimension = Dimension::inertia,
              .minimum = 0,
              .maximum = 1e18},
        l.inertia);
  visit(Field{.key = "centre_distance",
              .summary = "distance of its mass centre from its own joint; default: half its length",
              .dimension = Dimension::length,
              .minimum = 0,
              .maximum = 1e9},
        l.centre_distance);
  visit(Field{.key = "centre_angle",
              .summary = "angle of its mass centre from the link line",
              .dimension = Dimension::angle,
              .minimum = -1e3,
              .maximum = 1e3},
        l.centre_angle);
  visit(Field{.key = "attached", .summary = "masses fixed to it: payload, motor, counterweight"}, l.attached);
}

/// `[mechanism]` of the analysis.
struct ArmMechanism {
  double base_x = 0, base_y = 0;  ///< joint O1 (m)
  std::vector<ArmLinkEntry> links;
};
template <class Visitor>
void fields(Visitor&& visit, ArmMechanism& m) {
  const auto place = [](std::string_view key, std::string_view summary) {
    return Field{
        .key = key, .summary = summary, .dimension = Dimension::length, .minimum = -1e9, .maximum = 1e9};
  };
  visit(place("base_x", "joint O1, x"), m.base_x);
  visit(place("base_y", "joint O1, y"), m.base_y);
  visit(Field{.key = "link", .summary = "the links from the base outwards", .required = true}, m.links);
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
  visit(Field{.key = "link", .summary = "name of the link", .required = true}, d.link);
  visit(Field{.key = "angle", .summary = "from where its angle counts"}, d.angle);
  visit(Field{.key = "law", .summary = "how its angle moves in time", .required = true}, d.law);
}

struct TimeSweep {
  study::TimeSamples time;
};
template <class Visitor>
void fields(Visitor&& visit, TimeSweep& s) {
  visit(Field{.key = "time", .summary = "times of the rows", .required = true}, s.time);
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
