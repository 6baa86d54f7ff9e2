// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/dependent/beam_parameters.h"
#include "linkwright/suspension/dependent/beam_steering.h"
#include "linkwright/suspension/studies/axle.h"
#include "linkwright/suspension/studies/values.h"

// The analysis of a beam axle over heave and roll: what its file holds, how it is read, run and reported.
namespace linkwright::suspension {

using PointArray = std::array<double, 3>;

constexpr Field axle_point(std::string_view key, std::string_view summary) {
  return field::length(key, summary).between(-1e3, 1e3);
}
constexpr Field axle_direction(std::string_view key, std::string_view summary) {
  return field::entry(key, summary).between(-1e6, 1e6);
}

struct AxleWheelForm {
  PointArray centre{};
  double toe = 0, camber = 0, tyre_diameter = 0.6;
};
template <class Visitor>
void fields(Visitor&& visit, AxleWheelForm& w) {
  visit(axle_point("centre", "wheel centre at the reference").required(), w.centre);
  const auto angle = [](std::string_view key, std::string_view summary) {
    return field::angle(key, summary).between(-1, 1);
  };
  visit(angle("toe", "at the reference, > 0: front of the wheel towards the vehicle"), w.toe);
  visit(angle("camber", "at the reference, > 0: top of the wheel away from the vehicle"), w.camber);
  visit(field::length("tyre_diameter", "of the tyre as it stands").between(0.01, 100).required(),
        w.tyre_diameter);
}

struct AxleRodForm {
  std::string name;
  PointArray body{}, beam{};
  std::optional<double> length;
  bool both_sides = false;
};
constexpr std::string_view both_sides_summary =
    "the points are those of the left side, the right one mirrors them";
template <class Visitor>
void fields(Visitor&& visit, AxleRodForm& r) {
  visit(field::entry("name", "of the rod, for messages and tables").required(), r.name);
  visit(axle_point("body", "its joint on the body").required(), r.body);
  visit(axle_point("beam", "its joint on the axle beam").required(), r.beam);
  visit(field::length("length", "instead of the distance of its joints").between(1e-6, 1e3), r.length);
  visit(field::entry("both_sides", both_sides_summary), r.both_sides);
}

struct AxleArmForm {
  std::string name;
  std::vector<PointArray> hinge;
  PointArray ball{};
  bool hinge_on_beam = false;
};
template <class Visitor>
void fields(Visitor&& visit, AxleArmForm& a) {
  visit(field::entry("name", "of the arm, for messages and tables").required(), a.name);
  visit(axle_point("hinge", "two points on the axis of its hinge").required(), a.hinge);
  visit(axle_point("ball", "its ball joint").required(), a.ball);
  visit(field::entry("hinge_on_beam", "the hinge is on the axle beam, the ball joint on the body"),
        a.hinge_on_beam);
}

enum class AxlePart { beam, body };
constexpr std::array<EnumName<AxlePart>, 2> names(AxlePart) {
  return {{{AxlePart::beam, "beam", "the axle beam"}, {AxlePart::body, "body", "the vehicle's body"}}};
}

struct AxleWattForm {
  std::string name = "Watt linkage";
  AxlePart pivot_on = AxlePart::beam;
  PointArray pivot{}, axis{1, 0, 0};
  std::vector<PointArray> crank, ends;
};
template <class Visitor>
void fields(Visitor&& visit, AxleWattForm& w) {
  visit(field::entry("name", "of the linkage, for messages and tables"), w.name);
  visit(field::entry("pivot_on", "part that carries the pivot of the bellcrank"), w.pivot_on);
  visit(axle_point("pivot", "of the bellcrank").required(), w.pivot);
  visit(axle_direction("axis", "direction of the pivot's axis, of any length"), w.axis);
  visit(axle_point("crank", "both ends of the bellcrank").required(), w.crank);
  visit(axle_point("ends", "other ends of the rods from these, on the part without the pivot").required(),
        w.ends);
}

struct AxleGuideForm {
  std::string name = "guide";
  PointArray beam{}, normal{0, 1, 0};
};
template <class Visitor>
void fields(Visitor&& visit, AxleGuideForm& g) {
  visit(field::entry("name", "of the guide, for messages and tables"), g.name);
  visit(axle_point("beam", "point of the axle beam that stays in a plane of the body").required(), g.beam);
  visit(axle_direction("normal", "direction across that plane, of any length"), g.normal);
}

struct AxleBallForm {
  std::string name = "torque tube";
  PointArray point{};
};
template <class Visitor>
void fields(Visitor&& visit, AxleBallForm& b) {
  visit(field::entry("name", "of the joint, for messages and tables"), b.name);
  visit(axle_point("point", "ball joint between the body and the axle beam").required(), b.point);
}

struct AxleShaftForm {
  std::string name;
  PointArray body{}, beam{};
  std::optional<PointArray> body_axis, beam_axis;
  bool both_sides = false;
};
template <class Visitor>
void fields(Visitor&& visit, AxleShaftForm& s) {
  visit(field::entry("name", "of the shaft, for tables").required(), s.name);
  visit(axle_point("body", "centre of its joint on the body").required(), s.body);
  visit(axle_point("beam", "centre of its joint on the axle beam").required(), s.beam);
  visit(axle_direction("body_axis", "direction of the shaft in the body; default: in line at the reference"),
        s.body_axis);
  visit(axle_direction("beam_axis", "direction of the shaft in the beam; default: in line at the reference"),
        s.beam_axis);
  visit(field::entry("both_sides", both_sides_summary), s.both_sides);
}

struct TwistBeamForm {
  std::string name = "twist beam";
  PointArray pivot{}, shear_centre{};
};
template <class Visitor>
void fields(Visitor&& visit, TwistBeamForm& t) {
  visit(field::entry("name", "of the axle, for messages and tables"), t.name);
  visit(axle_point("pivot", "bushing of the left arm; that of the right one mirrors it").required(), t.pivot);
  visit(axle_point("shear_centre", "of the cross member, in the middle of the vehicle").required(),
        t.shear_centre);
}

/// `[mechanism.steering]`.
struct BeamSteeringForm {
  std::vector<PointArray> kingpin, drag_link, pitman_axis;
  PointArray track_rod{};
};
template <class Visitor>
void fields(Visitor&& visit, BeamSteeringForm& s) {
  visit(
      axle_point("kingpin", "two points of the left kingpin, the lower one first; the right one mirrors them")
          .required(),
      s.kingpin);
  visit(axle_point("drag_link", "its joint on the Pitman arm, its joint on the left knuckle").required(),
        s.drag_link);
  visit(axle_point("pitman_axis", "two points on the axis of the Pitman arm's shaft").required(),
        s.pitman_axis);
  visit(axle_point("track_rod", "its joint on the left knuckle; that on the right one mirrors it").required(),
        s.track_rod);
}

/// `[mechanism]`.
struct BeamAxleForm {
  AxleWheelForm wheel;
  std::optional<AxleWheelForm> right_wheel;
  std::vector<AxleRodForm> rods;
  std::vector<AxleArmForm> arms;
  std::vector<AxleWattForm> watts;
  std::vector<AxleGuideForm> guides;
  std::vector<AxleBallForm> ball_joints;
  std::optional<TwistBeamForm> twist_beam;
  std::vector<AxleShaftForm> shafts;
  std::optional<BeamSteeringForm> steering;
  double pinion_angle = 0;
};
template <class Visitor>
void fields(Visitor&& visit, BeamAxleForm& a) {
  visit(field::entry("wheel", "the left wheel").required(), a.wheel);
  visit(field::entry("right_wheel", "the right wheel; default: the mirror image of the left one"),
        a.right_wheel);
  visit(field::entry("rod", "trailing links, diagonal links, Panhard rods"), a.rods);
  visit(field::entry("arm", "A-arms"), a.arms);
  visit(field::entry("watt_linkage", "bellcranks with two rods"), a.watts);
  visit(field::entry("guide", "sliding blocks and slots"), a.guides);
  visit(field::entry("ball_joint", "ball joints between body and beam, as of a torque tube"), a.ball_joints);
  visit(field::entry("twist_beam", "trailing arms on a cross member that twists, instead of all links"),
        a.twist_beam);
  visit(field::entry("shaft", "propeller shaft, half-shafts of a de Dion axle: angles and plunge"), a.shafts);
  visit(field::entry("steering", "knuckles on kingpins, drag link and track rod of a steered axle"),
        a.steering);
  visit(field::angle("pinion_angle", "of the pinion above the horizontal at the reference, > 0: nose up")
            .between(-1, 1),
        a.pinion_angle);
}

/// `[sweep]`.
struct BeamAxleSweep {
  std::optional<LengthValues> heave;
  std::optional<AngleValues> roll;
  std::optional<LengthValues> single;
  std::optional<AngleValues> pitman;
};
template <class Visitor>
void fields(Visitor&& visit, BeamAxleSweep& s) {
  visit(field::entry("heave", "changes of the mean height of the contacts").required(), s.heave);
  visit(field::entry("roll", "angles by which the body leans to the left; default: upright"), s.roll);
  visit(field::entry("single", "travels of the left wheel centre alone"), s.single);
  visit(field::entry("pitman",
                     "angles of the Pitman arm at the reference, right-handed about its axis from the first "
                     "point to the second"),
        s.pitman);
}

/// `[vehicle]`.
struct BeamAxleVehicle {
  AxlePlace axle = AxlePlace::rear;
  VehicleLayout layout;
  AxlePart brakes = AxlePart::beam, differential = AxlePart::beam;
  std::optional<OtherAxleForm> other_axle;
};
template <class Visitor>
void fields(Visitor&& visit, BeamAxleVehicle& v) {
  layout_fields(visit, v.axle, v.layout);
  visit(field::entry("brakes", "part that takes the braking torque"), v.brakes);
  visit(field::entry("differential",
                     "part that takes the driving torque: beam of a live axle, body of a de Dion axle"),
        v.differential);
  visit(field::entry("other_axle", "the other axle of the vehicle: roll axis and pitch centre"),
        v.other_axle);
}

/// A shaft with its name.
struct NamedShaft {
  std::string name;
  BeamShaft shaft;
};

/// An analysis as read.
struct BeamAxleStudy {
  BeamAxle axle;
  std::vector<NamedShaft> shafts;
  std::vector<std::string> handles;   ///< keys of the rods in the file, empty for mirrored ones
  double pinion_angle = 0;            ///< rad
  std::vector<double> heaves, rolls;  ///< m, rad, ascending
  std::vector<double> singles;        ///< m, ascending; empty = no table
  std::optional<BeamSteering> steering;
  std::vector<double> pitmans;  ///< rad, ascending; empty = no table
  std::optional<BeamAxleVehicle> vehicle;
  bool drawn = true;  ///< true if a scene is wanted
};

/// "analysis" of "suspension.beam_axle".
study::Kind beam_axle_kind();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader.
std::optional<BeamAxleStudy> read_beam_axle_study(study::ObjectReader& document, const study::Common& common,
                                                  Value& canonical);

/// A position of the grid and its parameters.
struct BeamAxleRow {
  BeamPosition position;
  BeamParameters parameters;  ///< singular where there is no position
};
/// Positions of every heave with every roll, the heave changing first. Each roll is gone to at the heave next
/// to zero, and the heaves outwards from there. Interrupted: the rolls so far.
std::vector<BeamAxleRow> solve_beam_axle_grid(const BeamAxlePlan& plan, const std::vector<double>& heaves,
                                              const std::vector<double>& rolls,
                                              const RunContext* context = nullptr);

/// The table of a grid; without rows, its columns.
Table beam_axle_table(const BeamAxleStudy& study, const std::vector<BeamAxleRow>& rows);

/// The axle over the grid, for the report.
study::Scene beam_axle_scene(const BeamAxleStudy& study, const BeamAxlePlan& plan,
                             const std::vector<BeamAxleRow>& rows);

/// Evaluates the grid and reports. Rows without a position hold NaN and their status.
study::Result run_beam_axle_study(const BeamAxleStudy& study, RunContext& context);

}  // namespace linkwright::suspension
