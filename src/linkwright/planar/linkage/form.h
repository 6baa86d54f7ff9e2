// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/planar/linkage/linkage.h"

// A linkage as files hold it: everything by name, "body.point". `linkage_of` makes the model of it, `form_of`
// the way back.
namespace linkwright::planar {

using Place = std::array<double, 2>;

struct AttachedMassForm {
  std::string name;
  double mass = 0;
  Place at{};
};
struct StartForm {
  double x = 0, y = 0, angle = 0;
};
struct BodyForm {
  std::string name;
  std::vector<std::pair<std::string, Place>> points;
  std::optional<double> mass, inertia;
  std::optional<Place> centre;
  std::vector<AttachedMassForm> attached;
  std::optional<StartForm> start;
  std::optional<double> stiffness;
};
/// The wheel of a gear that has its teeth inside.
enum class InternalWheel {
  none,   ///< both have their teeth outside
  first,  ///< the first wheel is a ring
  second  ///< the second wheel is a ring
};
constexpr std::array<EnumName<InternalWheel>, 3> names(InternalWheel) {
  return {{{InternalWheel::none, "none", "both wheels have their teeth outside"},
           {InternalWheel::first, "first", "the first wheel is a ring with its teeth inside"},
           {InternalWheel::second, "second", "the second wheel is a ring with its teeth inside"}}};
}
/// The hand of a thread.
enum class ThreadHand {
  right,  ///< a positive turn moves the nut forward
  left    ///< a positive turn moves the nut backward
};
constexpr std::array<EnumName<ThreadHand>, 2> names(ThreadHand) {
  return {{{ThreadHand::right, "right", "a positive turn moves the nut forward"},
           {ThreadHand::left, "left", "a positive turn moves the nut backward"}}};
}
struct RatioCurveForm {
  std::vector<double> first, second;
};
struct CurvedSlotForm {
  std::vector<Place> points;
  bool closed = false;
  std::optional<Place> centre;
  std::optional<double> radius, from, to;
};
struct FrictionTableForm {
  std::vector<double> speed, coefficient;
};
struct JointForm {
  std::string name;
  JointType type = JointType::revolute;
  std::string first, second;
  double direction = 0;
  std::optional<double> direction_second;
  std::optional<double> ratio;
  std::optional<std::vector<int>> teeth;
  std::optional<std::vector<double>> pitch_radii;
  std::optional<InternalWheel> internal;
  std::optional<double> module;
  double phase = 0;
  std::optional<std::string> carrier;
  std::optional<double> pressure_angle;
  std::optional<double> radius;
  std::optional<double> efficiency;
  std::optional<RatioCurveForm> ratio_curve;
  std::optional<CurvedSlotForm> curve;
  std::optional<double> lead, pitch_diameter, flank_angle, spindle_inertia;
  std::optional<ThreadHand> hand;
  std::optional<int> slots;
  std::optional<double> slot_angle;
  std::optional<double> compliance;
  double friction = 0, pin_radius = 0, guide_length = 0;
  std::optional<double> friction_static, friction_torque, friction_force, stribeck_speed;
  std::optional<FrictionTableForm> friction_table;
  std::optional<FrictionFall> friction_fall;
};
/// The side of a belt on which a wheel lies.
enum class BeltSide {
  inside,  ///< within a closed belt, or to the left of a rope as it runs
  outside  ///< the back of the belt runs over it, or to the right of a rope
};
constexpr std::array<EnumName<BeltSide>, 2> names(BeltSide) {
  return {{{BeltSide::inside, "inside", "within a closed belt, or to the left of a rope as it runs"},
           {BeltSide::outside, "outside", "the back of the belt runs over it, or to the right of a rope"}}};
}
struct BeltWheelForm {
  std::string at;
  double radius = 0;
  BeltSide side = BeltSide::inside;
  std::optional<int> teeth;
};
struct BeltForm {
  std::string name;
  std::vector<BeltWheelForm> wheels;
  bool closed = true;
  std::optional<double> tension, length, pitch;
  std::optional<std::string> carrier;
};
struct AssemblyForm {
  std::vector<std::string> bodies;
  AssemblyMode mode = AssemblyMode::plus;
};
struct SpringForm {
  std::string name, first, second;
  double stiffness = 0, free_length = 0, damping = 0;
  std::optional<double> preload;
};
struct TorsionSpringForm {
  std::string name, first, second;
  double stiffness = 0, free_angle = 0, damping = 0;
};
struct FactorForm {
  LoadArgument against = LoadArgument::constant;
  std::vector<double> argument, factor;
  std::optional<double> period = {};
};
struct ForceForm {
  std::string name, point;
  std::optional<Place> force;
  bool turns_with_body = false;
  FactorForm factor;
  std::optional<std::vector<std::string>> formula;
};
struct TorqueForm {
  std::string name, body, from = "ground";
  std::optional<double> torque;
  FactorForm factor;
  std::optional<std::string> formula;
};
struct GasSpringForm {
  std::optional<double> extended_force, extended_length;
  double stroke = 0, progression = 1;
};
struct CylinderForm {
  double bore = 0, rod = 0;
  std::optional<double> pressure;
  double back_pressure = 0;
  std::optional<std::string> pressure_formula, back_pressure_formula;
};
struct StrutForm {
  std::string name, first, second;
  std::optional<double> force;
  LoadArgument against = LoadArgument::constant;
  std::optional<std::vector<double>> lengths, times, speeds,
      angles;  ///< arguments of the table, by their unit
  std::optional<std::vector<double>> force_table;
  std::optional<double> period;
  std::optional<GasSpringForm> gas;
  std::optional<CylinderForm> cylinder;
  std::optional<std::string> formula;
};
/// A value of a follower: of one that slides or of one that turns.
struct FollowerValueForm {
  std::optional<double> length, angle;
};
struct CamSegmentForm {
  CamLaw law = CamLaw::dwell;
  double over = 0;
  FollowerValueForm to;
  FollowerValueForm start_rate, start_acceleration, start_jerk;
  FollowerValueForm end_rate, end_acceleration, end_jerk;
};
struct CamTableForm {
  std::vector<double> angles;
  std::optional<std::vector<double>> lengths, follower_angles;
};
struct CamMemberForm {
  std::string name, turns, moves;
  FollowerFace follower = FollowerFace::roller;
  std::string contact;
  std::optional<std::string> second_contact;
  std::optional<double> roller_radius, second_roller_radius, base_radius, face_direction;
  CamForm form = CamForm::outside;
  Rotation sense = Rotation::counterclockwise;
  double phase = 0;
  FollowerValueForm start;
  bool sector = false;
  std::vector<CamSegmentForm> segments;
  std::optional<CamTableForm> table;
};
struct StopForm {
  std::string joint;
  std::optional<double> at_least_angle, at_least_length, at_most_angle, at_most_length;
  std::optional<double> restitution, stiffness, stiffness_angular, damping, damping_angular, arm;
};
struct LinkageForm {
  /// The points of all bodies are given where they are in one drawn position, in the global frame: body
  /// frames coincide with it there, and the drawing gives the assembly modes.
  bool drawn = false;
  Place moment_centre{};
  std::vector<BodyForm> bodies;
  std::vector<JointForm> joints;
  std::vector<AssemblyForm> assembly;
  std::vector<SpringForm> springs;
  std::vector<TorsionSpringForm> torsion_springs;
  std::vector<ForceForm> forces;
  std::vector<TorqueForm> torques;
  std::vector<BeltForm> belts;
  std::vector<StrutForm> struts;
  std::vector<CamMemberForm> cams;
  std::vector<StopForm> stops;
};

/// A problem of one entry of a form: list "joint", its index, the key in it.
struct FormProblem {
  std::string list;
  std::size_t index = 0;
  std::string key;
  std::string message, hint;
  bool warning = false;  ///< the study can be run
};

/// The model; names that do not exist become problems. Masses: a missing `inertia` or `centre` is that of a
/// uniform bar or plate over the joints (see set_uniform). Drives and gravity are not part of the form.
Linkage linkage_of(const LinkageForm& form, std::vector<FormProblem>& problems);

/// The form of a model.
LinkageForm form_of(const Linkage& linkage);

// ---------------------------------------------------------------------------------------------------------------

template <class Visitor>
void fields(Visitor&& visit, AttachedMassForm& m) {
  visit(field::entry("name", "its name"), m.name);
  visit(field::mass("mass", "mass").not_negative().required(), m.mass);
  visit(field::length("at", "where it sits, in the frame of the body").required(), m.at);
}
template <class Visitor>
void fields(Visitor&& visit, StartForm& s) {
  visit(field::length("x", "origin of the body, x"), s.x);
  visit(field::length("y", "origin of the body, y"), s.y);
  visit(field::angle("angle", "angle of the body"), s.angle);
}
template <class Visitor>
void fields(Visitor&& visit, BodyForm& b) {
  visit(field::entry("name", "its name; the first body is the ground").required(), b.name);
  visit(field::length("points", "named points in the frame of the body").required(), b.points);
  visit(field::mass("mass", "mass; only forces, torques and dynamics need it").not_negative(), b.mass);
  visit(field::inertia("inertia",
                       "moment of inertia about the mass centre; if absent that of a uniform bar between its "
                       "outermost joints, or plate over them")
            .not_negative(),
        b.inertia);
  visit(field::length("centre", "mass centre in the frame of the body; if absent that of the bar or plate"),
        b.centre);
  visit(field::entry("attached", "masses that sit on the body: counterweights, payloads"), b.attached);
  visit(field::entry("start", "approximate position of the body at the start"), b.start);
  visit(
      field::stiffness("stiffness", "axial stiffness between its two pins, for [redundant]; if absent rigid")
          .positive(),
      b.stiffness);
}
template <class Visitor>
void fields(Visitor&& visit, FrictionTableForm& t) {
  visit(field::speed("speed", "rising speeds of sliding from 0 on; of a pin at its rim").required(), t.speed);
  visit(field::entry("mu", "coefficient of friction at each of them, straight lines between")
            .not_negative()
            .required(),
        t.coefficient);
}
template <class Visitor>
void fields(Visitor&& visit, RatioCurveForm& c) {
  visit(field::angle("first", "rising angles of the first wheel from the carrier, over a turn or a sector")
            .required(),
        c.first);
  visit(field::angle("second", "angles of the second wheel there, all rising or all falling").required(),
        c.second);
}
/// The keys of gears, racks and Geneva drives.
template <class Visitor>
void wheel_fields(Visitor& visit, JointForm& j) {
  visit(field::entry("ratio",
                     "gear: turns of the second body for one of the first, seen from the carrier; "
                     "negative: external teeth")
            .between(-1e6, 1e6),
        j.ratio);
  visit(field::entry("teeth", "gear: teeth of both wheels, instead of `ratio`").between(1, 1000000), j.teeth);
  visit(field::length("pitch_radii", "gear: radii of both pitch circles, instead of `teeth` or `ratio`"),
        j.pitch_radii);
  visit(field::entry("internal",
                     "gear: wheel that is a ring with its teeth inside; Geneva drive: second, where the "
                     "crank turns within the wheel"),
        j.internal);
  visit(field::length("module",
                      "gear: module of the teeth; the distance of the centres then gives the pressure "
                      "angle at which they work")
            .positive(),
        j.module);
  visit(field::angle("phase",
                     "gear: angle of the second body when that of the first is 0; rack: angle of the pinion "
                     "from the rack when its centre is beside the point of the rack"),
        j.phase);
  visit(field::entry("carrier",
                     "gear: body that carries both axes; if absent the one that both wheels "
                     "have pins on"),
        j.carrier);
  visit(field::length("radius",
                      "rack: radius of the pinion, negative where its centre lies to the right of the pitch "
                      "line; if absent that of a drawn linkage"),
        j.radius);
  visit(field::angle("pressure_angle",
                     "gear, rack: of its teeth, which press their wheels apart; if absent 20 deg")
            .between(0, 0.8),
        j.pressure_angle);
  visit(
      field::entry("efficiency",
                   "gear: share of the rolling power, seen from the carrier, that the driven wheel gets; if "
                   "absent 1")
          .between(0.01, 1),
      j.efficiency);
  visit(field::entry("ratio_curve",
                     "gear of wheels that are not circular: angles of both, instead of `ratio` or `teeth`"),
        j.ratio_curve);
}
template <class Visitor>
void fields(Visitor&& visit, CurvedSlotForm& c) {
  visit(field::length("points", "points that it passes through, in the frame of the first body"), c.points);
  visit(field::entry("closed", "it returns to its first point"), c.closed);
  visit(field::length("centre", "instead of points: centre of an arc"), c.centre);
  visit(field::length("radius", "radius of the arc").positive(), c.radius);
  visit(field::angle("from", "direction from the centre in which the arc begins"), c.from);
  visit(field::angle("to", "direction in which it ends; without both it is a circle"), c.to);
}
template <class Visitor>
void screw_fields(Visitor& visit, JointForm& j) {
  visit(field::length("lead", "screw: displacement for one turn of the spindle").positive(), j.lead);
  visit(field::length("pitch_diameter", "screw: pitch diameter of the thread, for its friction").positive(),
        j.pitch_diameter);
  visit(field::angle("flank_angle", "screw: whole angle between the flanks of the thread; if absent 60 deg")
            .between(0, 3),
        j.flank_angle);
  visit(field::inertia("spindle_inertia", "screw: moment of inertia of what turns with the spindle")
            .not_negative(),
        j.spindle_inertia);
  visit(field::entry("hand", "screw: hand of the thread; if absent right"), j.hand);
}
template <class Visitor>
void friction_fields(Visitor& visit, JointForm& j) {
  visit(field::entry("compliance_m_per_N", "displacement by force (m/N), for [redundant]; if absent rigid")
            .positive(),
        j.compliance);
  visit(field::entry("friction", "coefficient of Coulomb friction; of a screw that of its thread")
            .between(0, 10),
        j.friction);
  visit(field::length("pin_radius", "radius of the pin, for its friction").not_negative(), j.pin_radius);
  visit(field::length("guide_length", "length of the slide, for the friction of its moment").not_negative(),
        j.guide_length);
  visit(field::entry("friction_static",
                     "coefficient of friction of the joint at rest, not below `friction`; if absent the same")
            .between(0, 10),
        j.friction_static);
  visit(field::torque("friction_torque",
                      "pin: friction that no load changes, as of a brake, a clutch or a seal; if absent none")
            .not_negative(),
        j.friction_torque);
  visit(field::force("friction_force", "slide, slot: friction that no load changes; if absent none")
            .not_negative(),
        j.friction_force);
  visit(field::speed("stribeck_speed",
                     "speed with which friction falls from `friction_static` to `friction`, of a pin at its "
                     "rim; if absent it falls at once")
            .positive(),
        j.stribeck_speed);
  visit(field::entry("friction_table",
                     "coefficients over the speed of sliding, instead of `friction` and `stribeck_speed`"),
        j.friction_table);
  visit(field::entry("friction_fall", "curve along which it falls with `stribeck_speed`; if absent stribeck"),
        j.friction_fall);
}
template <class Visitor>
void fields(Visitor&& visit, JointForm& j) {
  visit(field::entry("name", "its name; columns and drives use it").required(), j.name);
  visit(field::entry("type", "kind of joint"), j.type);
  visit(field::entry("first",
                     "point of the first body, \"body.point\"; of a gear the wheel or its "
                     "centre, of a rack the centre of the pinion")
            .required(),
        j.first);
  visit(field::entry("second",
                     "point of the second body; of a gear the wheel or its centre, of a rack a point of its "
                     "pitch line")
            .required(),
        j.second);
  visit(field::angle("direction",
                     "direction of a slide or slot in the frame of the first body; of a weld the angle of "
                     "the second body from the first; of a rack its pitch line in the frame of the second"),
        j.direction);
  visit(field::angle(
            "direction_second",
            "direction of a slide in the frame of the second body; if absent 0, or `direction` of a drawn "
            "linkage"),
        j.direction_second);
  visit(field::entry("curve", "pin_in_slot: middle line of a curved slot, instead of `direction`"), j.curve);
  wheel_fields(visit, j);
  screw_fields(visit, j);
  visit(field::entry("slots", "Geneva drive: slots of the wheel").between(3, 1000), j.slots);
  visit(
      field::angle(
          "slot_angle",
          "Geneva drive: direction of a slot in the frame of the wheel; if absent 0, or as the wheel stands "
          "in a drawn linkage"),
      j.slot_angle);
  friction_fields(visit, j);
}
template <class Visitor>
void fields(Visitor&& visit, BeltWheelForm& w) {
  visit(field::entry("at", "centre of the wheel on its own body, \"body.point\"").required(), w.at);
  visit(field::length("radius", "radius on which the belt runs; 0 of an end of a rope").not_negative(),
        w.radius);
  visit(field::entry("side", "side of the belt on which the wheel lies"), w.side);
  visit(field::entry("teeth", "teeth of a wheel of a chain with `pitch`, instead of `radius`").at_least(3),
        w.teeth);
}
template <class Visitor>
void fields(Visitor&& visit, BeltForm& b) {
  visit(field::entry("name", "its name; columns use it").required(), b.name);
  visit(field::entry("wheels", "its wheels in the order in which it runs; a rope begins and ends with one")
            .required(),
        b.wheels);
  visit(field::entry("closed", "it runs back to the first wheel; false: a rope"), b.closed);
  visit(field::force("tension", "closed belt on one carrier: mean tension of its strands").not_negative(),
        b.tension);
  visit(field::length("length", "its length, which is checked").positive(), b.length);
  visit(field::length("pitch", "chain: pitch, for wheels that give `teeth`").positive(), b.pitch);
  visit(field::entry("carrier",
                     "closed belt: body that carries the axes of all wheels; if absent the one on which all "
                     "wheels have pins"),
        b.carrier);
}
template <class Visitor>
void fields(Visitor&& visit, AssemblyForm& a) {
  visit(field::entry("bodies",
                     "a pair of bodies that are joined to each other; one body twice where the other is the "
                     "block of a slot")
            .required(),
        a.bodies);
  visit(field::entry("mode", "which of the two assembly modes").required(), a.mode);
}
template <class Visitor>
void fields(Visitor&& visit, SpringForm& s) {
  visit(field::entry("name", "its name").required(), s.name);
  visit(field::entry("first", "point at one end, \"body.point\"").required(), s.first);
  visit(field::entry("second", "point at the other end").required(), s.second);
  visit(field::stiffness("stiffness", "stiffness").not_negative(), s.stiffness);
  visit(field::length("free_length", "length without force").not_negative(), s.free_length);
  visit(field::damping("damping", "of a damper beside it").not_negative(), s.damping);
  visit(field::force("preload",
                     "pull of the spring in the drawn position, or where the bodies start, instead of "
                     "`free_length`; negative where it pushes"),
        s.preload);
}
template <class Visitor>
void fields(Visitor&& visit, TorsionSpringForm& s) {
  visit(field::entry("name", "its name").required(), s.name);
  visit(field::entry("first", "body at one end").required(), s.first);
  visit(field::entry("second", "body at the other end").required(), s.second);
  visit(field::stiffness_angular("stiffness", "stiffness").not_negative(), s.stiffness);
  visit(field::angle("free_angle", "angle of the second body from the first without torque"), s.free_angle);
  visit(field::damping_angular("damping", "of a damper beside it").not_negative(), s.damping);
}
template <class Visitor>
void fields(Visitor&& visit, FactorForm& f) {
  visit(field::entry("against", "what the load depends on"), f.against);
  visit(field::entry("argument", "rising values of it, in rad, m, s or rad/s"), f.argument);
  visit(field::entry("factor", "factor of the load at each of them, straight lines between"), f.factor);
  visit(field::entry("period",
                     "change of the argument after which the table repeats, 0 = never; default: a table of "
                     "whole turns of the input repeats after them")
            .not_negative(),
        f.period);
}
template <class Visitor>
void fields(Visitor&& visit, ForceForm& f) {
  visit(field::entry("name", "its name").required(), f.name);
  visit(field::entry("point", "where it acts, \"body.point\"").required(), f.point);
  visit(field::force("force", "components along x and y"), f.force);
  visit(field::entry("turns_with_body", "components in the frame of the body"), f.turns_with_body);
  fields(visit, f.factor);
  visit(field::entry(
            "formula",
            "instead of `force` and a table, its components as two formulas of time, the place x, y and "
            "the speed vx, vy of the point, and what other formulas name: [\"-3 N*s/m * vx\", \"0\"]"),
        f.formula);
}
template <class Visitor>
void fields(Visitor&& visit, TorqueForm& t) {
  visit(field::entry("name", "its name").required(), t.name);
  visit(field::entry("body", "the body it turns").required(), t.body);
  visit(field::entry("from", "the body that feels the opposite"), t.from);
  visit(field::torque("torque", "counter-clockwise positive"), t.torque);
  fields(visit, t.factor);
  visit(field::entry(
            "formula",
            "instead of `torque` and a table, a formula of time, the angular speed `speed` of the body "
            "against `from`, and what other formulas name: '5 N*m - 0.2 N*m*s * rate(\"O\")'"),
        t.formula);
}
/// Says to readers that a key stands for several quantities, which its unit tells apart.
template <class Visitor>
void told_apart_by_unit(Visitor& visit, std::initializer_list<Field> fields) {
  if constexpr (requires(const Field& f) { visit.has(f); })
    for (const Field& f : fields) static_cast<void>(visit.has(f));
}
template <class Visitor>
void fields(Visitor&& visit, GasSpringForm& g) {
  constexpr Field force = field::force("extended", "force when it is extended").positive(),
                  length = field::length("extended", "length from eye to eye when it is extended").positive();
  told_apart_by_unit(visit, {force, length});
  visit(force, g.extended_force);
  visit(length, g.extended_length);
  visit(field::length("stroke", "by which it can become shorter").positive().required(), g.stroke);
  visit(field::entry("progression", "force at the end of the stroke as a multiple of the extended one")
            .between(1, 100),
        g.progression);
}
template <class Visitor>
void fields(Visitor&& visit, CylinderForm& c) {
  visit(field::length("bore", "diameter of its bore").positive().required(), c.bore);
  visit(field::length("rod", "diameter of its rod").not_negative(), c.rod);
  visit(field::pressure("pressure", "pressure on the side of the bore, above that of the air"), c.pressure);
  visit(field::pressure("back_pressure", "pressure on the side of the rod, above that of the air"),
        c.back_pressure);
  visit(field::entry(
            "pressure_formula",
            "instead of `pressure`, a formula as that of a strut: \"table(time, 0 s, 0, 1 s, 12 MPa)\""),
        c.pressure_formula);
  visit(field::entry("back_pressure_formula", "instead of `back_pressure`, likewise"),
        c.back_pressure_formula);
}
template <class Visitor>
void fields(Visitor&& visit, StrutForm& s) {
  visit(field::entry("name", "its name; columns use it").required(), s.name);
  visit(field::entry("first", "point at one end, \"body.point\"").required(), s.first);
  visit(field::entry("second", "point at the other end").required(), s.second);
  visit(field::force("force", "constant force, positive where it pushes the points apart"), s.force);
  visit(field::entry("against", "what a table of forces depends on: length, speed, time or input"),
        s.against);
  constexpr Field lengths = field::length("argument",
                                          "rising lengths of the strut, or displacements of the "
                                          "first driven joint"),
                  times = field::time("argument", "rising times"),
                  speeds = field::speed("argument", "rising speeds at which the strut becomes longer"),
                  angles = field::angle("argument", "rising angles of the first driven joint");
  told_apart_by_unit(visit, {lengths, times, speeds, angles});
  visit(lengths, s.lengths);
  visit(times, s.times);
  visit(speeds, s.speeds);
  visit(angles, s.angles);
  visit(field::force("force_table", "force at each of them, straight lines between"), s.force_table);
  visit(
      field::entry("period",
                   "table over time or the input: change of the argument in SI units after which it repeats, "
                   "0 = never")
          .not_negative(),
      s.period);
  visit(field::entry("gas", "gas spring, instead of a force or a table"), s.gas);
  visit(field::entry("cylinder", "cylinder, instead of a force or a table"), s.cylinder);
  visit(
      field::entry(
          "formula",
          "force as a formula of time, length s and speed v, \"200 N + 15 N/mm * (s - 20 mm)\"; by names in "
          "quotes also of joints, q(\"O\"), rate(\"O\"), points, x, y, vx, vy(\"rod.B\"), and struts and "
          "springs, length, speed(\"spring\")"),
      s.formula);
}
template <class Visitor>
void follower_value(Visitor& visit, std::string_view key, std::string_view summary, FollowerValueForm& v) {
  const Field length = field::length(key, summary), angle = field::angle(key, summary);
  told_apart_by_unit(visit, {length, angle});
  visit(length, v.length);
  visit(angle, v.angle);
}
template <class Visitor>
void fields(Visitor&& visit, CamSegmentForm& s) {
  visit(field::entry("law", "law of the motion in the segment").required(), s.law);
  visit(field::angle("over", "angle of the cam in the segment").positive().required(), s.over);
  follower_value(visit, "to", "value at the end, from the base circle; a dwell takes none", s.to);
  follower_value(visit, "start_rate", "polynomial: first derivative at the start, by radian of the cam",
                 s.start_rate);
  follower_value(visit, "start_acceleration",
                 "polynomial: second derivative at the start, by radian of the cam squared",
                 s.start_acceleration);
  follower_value(visit, "start_jerk", "polynomial: third derivative at the start, by radian of the cam cubed",
                 s.start_jerk);
  follower_value(visit, "end_rate", "polynomial: first derivative at the end", s.end_rate);
  follower_value(visit, "end_acceleration", "polynomial: second derivative at the end", s.end_acceleration);
  follower_value(visit, "end_jerk", "polynomial: third derivative at the end", s.end_jerk);
}
template <class Visitor>
void fields(Visitor&& visit, CamTableForm& t) {
  visit(field::angle("angles", "angles of the cam, from 0 to a full turn").required(), t.angles);
  constexpr Field lengths = field::length("values", "values of the programme at these angles"),
                  angles = field::angle("values", "values of the programme at these angles");
  told_apart_by_unit(visit, {lengths, angles});
  visit(lengths, t.lengths);
  visit(angles, t.follower_angles);
}
template <class Visitor>
void fields(Visitor&& visit, CamMemberForm& c) {
  visit(field::entry("name", "its name; columns use it").required(), c.name);
  visit(field::entry("turns", "joint on which the cam turns, over whose angle its programme goes").required(),
        c.turns);
  visit(field::entry("moves", "joint of the follower, whose coordinate the programme gives").required(),
        c.moves);
  visit(field::entry("follower", "part of the follower that touches the cam"), c.follower);
  visit(field::entry("contact",
                     "centre of the roller, edge, or a point of the flat face, on the body that touches the "
                     "cam, \"body.point\"")
            .required(),
        c.contact);
  visit(field::length("roller_radius", "of a roller").positive(), c.roller_radius);
  visit(field::entry("second_contact",
                     "form conjugate: centre of the roller on the second disc, a point of the same body"),
        c.second_contact);
  visit(field::length("second_roller_radius", "of that roller; if absent that of the first").positive(),
        c.second_roller_radius);
  visit(
      field::length("base_radius",
                    "distance of the profile from the centre of the cam where the programme is 0; if absent "
                    "as a drawn linkage shows the follower")
          .positive(),
      c.base_radius);
  visit(field::angle("face_direction", "flat face: its direction in the frame of its body; if absent 0"),
        c.face_direction);
  visit(field::entry("form", "contour of the cam"), c.form);
  visit(field::entry("sense",
                     "sense of the angle over which the programme goes, from the body that carries "
                     "the cam"),
        c.sense);
  visit(field::angle("phase", "angle of the programme where that of the joint is 0"), c.phase);
  follower_value(visit, "start",
                 "value of the programme at its start, from the base circle, positive as the coordinate of "
                 "the moved joint; if absent 0",
                 c.start);
  visit(field::entry("sector", "true if the cam swings back and forth over its segments instead of turning"),
        c.sector);
  visit(field::entry("segment", "segments of the programme, in their order"), c.segments);
  visit(field::entry("table", "programme as a smooth curve through rows, instead of segments"), c.table);
}
template <class Visitor>
void fields(Visitor&& visit, StopForm& s) {
  visit(field::entry("joint", "pin, slide or slot that it stops").required(), s.joint);
  constexpr Field least_angle = field::angle("at_least", "pin: angle that it cannot fall below"),
                  least_length = field::length("at_least", "slide, slot: displacement likewise"),
                  most_angle = field::angle("at_most", "pin: angle that it cannot exceed"),
                  most_length = field::length("at_most", "slide, slot: displacement likewise"),
                  stiffness = field::stiffness("stiffness",
                                               "of a stop that gives way; of a pin at `arm`. If absent it is "
                                               "rigid")
                                  .positive(),
                  stiffness_angular =
                      field::stiffness_angular("stiffness", "of a stop of a pin that gives way").positive(),
                  damping = field::damping("damping", "beside the stiffness").not_negative(),
                  damping_angular =
                      field::damping_angular("damping", "of a pin, beside the stiffness").not_negative();
  told_apart_by_unit(visit, {least_angle, least_length, most_angle, most_length, stiffness, stiffness_angular,
                             damping, damping_angular});
  visit(least_angle, s.at_least_angle);
  visit(least_length, s.at_least_length);
  visit(most_angle, s.at_most_angle);
  visit(most_length, s.at_most_length);
  visit(field::entry("restitution",
                     "rigid stop: speed after an impact by that before; if absent 0, it stays on the stop")
            .between(0, 1),
        s.restitution);
  visit(stiffness, s.stiffness);
  visit(stiffness_angular, s.stiffness_angular);
  visit(damping, s.damping);
  visit(damping_angular, s.damping_angular);
  visit(field::length("arm", "pin: distance of the stop from its axis, for its force").positive(), s.arm);
}
template <class Visitor>
void fields(Visitor&& visit, LinkageForm& l) {
  visit(field::entry("drawn", "points are given in one drawn position, in the global frame"), l.drawn);
  visit(field::length("moment_centre", "shaking moments are about this place of the ground"),
        l.moment_centre);
  visit(field::entry("body", "the bodies; the first is the ground"), l.bodies);
  visit(field::entry("joint", "the joints"), l.joints);
  visit(field::entry("assembly", "which way pairs of bodies are assembled"), l.assembly);
  visit(field::entry("spring", "springs and dampers between two points"), l.springs);
  visit(field::entry("torsion_spring", "springs and dampers that turn two bodies"), l.torsion_springs);
  visit(field::entry("force", "forces on points"), l.forces);
  visit(field::entry("torque", "torques on bodies"), l.torques);
  visit(field::entry("belt", "belts, chains and ropes"), l.belts);
  visit(field::entry("strut", "forces between two points: gas springs, cylinders, tables"), l.struts);
  visit(field::entry("cam", "cams with their followers"), l.cams);
  visit(field::entry("stop", "stops of joints, rigid or with a stiffness"), l.stops);
}

}  // namespace linkwright::planar
