#pragma once

#include <array>
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
};
struct JointForm {
  std::string name;
  JointType type = JointType::revolute;
  std::string first, second;
  double direction = 0;
  std::optional<double> direction_second;
  double ratio = 1, phase = 0;
  std::string carrier = "ground";
  std::optional<double> pressure_angle;
  double friction = 0, pin_radius = 0, guide_length = 0;
};
struct AssemblyForm {
  std::vector<std::string> bodies;
  AssemblyMode mode = AssemblyMode::plus;
};
struct SpringForm {
  std::string name, first, second;
  double stiffness = 0, free_length = 0, damping = 0;
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
  Place force{};
  bool turns_with_body = false;
  FactorForm factor;
};
struct TorqueForm {
  std::string name, body, from = "ground";
  double torque = 0;
  FactorForm factor;
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
};

/// A problem of one entry of a form: list "joint", its index, the key in it.
struct FormProblem {
  std::string list;
  std::size_t index = 0;
  std::string key;
  std::string message, hint;
};

/// The model; names that do not exist become problems. Masses: a missing `inertia` or `centre` is that of a
/// uniform bar or plate over the joints (see set_uniform). Drives and gravity are not part of the form.
Linkage linkage_of(const LinkageForm& form, std::vector<FormProblem>& problems);

/// The form of a model.
LinkageForm form_of(const Linkage& linkage);

// ---------------------------------------------------------------------------------------------------------------

namespace linkage_fields {

inline constexpr double most = 1e9;
constexpr Field place(std::string_view key, std::string_view summary, bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::length,
          .minimum = -most,
          .maximum = most,
          .required = required};
}
constexpr Field angle(std::string_view key, std::string_view summary) {
  return {.key = key, .summary = summary, .dimension = Dimension::angle, .minimum = -1e6, .maximum = 1e6};
}
constexpr Field positive(std::string_view key, std::string_view summary, Dimension dimension,
                         bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = 0,
          .maximum = 1e18,
          .required = required};
}
constexpr Field text(std::string_view key, std::string_view summary, bool required = true) {
  return {.key = key, .summary = summary, .required = required};
}

}  // namespace linkage_fields

template <class Visitor>
void fields(Visitor&& visit, AttachedMassForm& m) {
  using namespace linkage_fields;
  visit(text("name", "its name", false), m.name);
  visit(positive("mass", "mass", Dimension::mass, true), m.mass);
  visit(place("at", "where it sits, in the frame of the body", true), m.at);
}
template <class Visitor>
void fields(Visitor&& visit, StartForm& s) {
  using namespace linkage_fields;
  visit(place("x", "origin of the body, x"), s.x);
  visit(place("y", "origin of the body, y"), s.y);
  visit(angle("angle", "angle of the body"), s.angle);
}
template <class Visitor>
void fields(Visitor&& visit, BodyForm& b) {
  using namespace linkage_fields;
  visit(text("name", "its name; the first body is the ground"), b.name);
  visit(place("points", "named points in the frame of the body", true), b.points);
  visit(positive("mass", "mass; only forces, torques and dynamics need it", Dimension::mass), b.mass);
  visit(positive("inertia",
                 "moment of inertia about the mass centre; if absent that of a uniform bar between its "
                 "outermost joints, or plate over them",
                 Dimension::inertia),
        b.inertia);
  visit(place("centre", "mass centre in the frame of the body; if absent that of the bar or plate"),
        b.centre);
  visit(Field{.key = "attached", .summary = "masses that sit on the body: counterweights, payloads"},
        b.attached);
  visit(Field{.key = "start", .summary = "approximate position of the body at the start"}, b.start);
}
template <class Visitor>
void fields(Visitor&& visit, JointForm& j) {
  using namespace linkage_fields;
  visit(text("name", "its name; columns and drives use it"), j.name);
  visit(Field{.key = "type", .summary = "kind of joint"}, j.type);
  visit(text("first", "point of the first body, \"body.point\"; of a gear the body"), j.first);
  visit(text("second", "point of the second body; of a gear the body"), j.second);
  visit(angle("direction",
              "direction of a slide or slot in the frame of the first body; of a weld the angle of "
              "the second body from the first"),
        j.direction);
  visit(angle("direction_second",
              "direction of a slide in the frame of the second body; if absent 0, or `direction` of a drawn "
              "linkage"),
        j.direction_second);
  visit(Field{.key = "ratio",
              .summary = "gear: turns of the second body for one of the first, seen from the carrier",
              .minimum = -1e6,
              .maximum = 1e6},
        j.ratio);
  visit(angle("phase", "gear: angle of the second body when that of the first is 0"), j.phase);
  visit(text("carrier", "gear: body that carries both axes", false), j.carrier);
  visit(Field{.key = "pressure_angle",
              .summary = "gear: of its teeth, which press their wheels apart; if absent 20 deg",
              .dimension = Dimension::angle,
              .minimum = 0,
              .maximum = 0.8},
        j.pressure_angle);
  visit(Field{.key = "friction", .summary = "coefficient of Coulomb friction", .minimum = 0, .maximum = 10},
        j.friction);
  visit(positive("pin_radius", "radius of the pin, for its friction", Dimension::length), j.pin_radius);
  visit(positive("guide_length", "length of the slide, for the friction of its moment", Dimension::length),
        j.guide_length);
}
template <class Visitor>
void fields(Visitor&& visit, AssemblyForm& a) {
  visit(Field{.key = "bodies",
              .summary =
                  "a pair of bodies that are joined to each other; one body twice where the other is the "
                  "block of a slot",
              .required = true},
        a.bodies);
  visit(Field{.key = "mode", .summary = "which of the two assembly modes", .required = true}, a.mode);
}
template <class Visitor>
void fields(Visitor&& visit, SpringForm& s) {
  using namespace linkage_fields;
  visit(text("name", "its name"), s.name);
  visit(text("first", "point at one end, \"body.point\""), s.first);
  visit(text("second", "point at the other end"), s.second);
  visit(positive("stiffness", "stiffness", Dimension::stiffness), s.stiffness);
  visit(positive("free_length", "length without force", Dimension::length), s.free_length);
  visit(positive("damping", "of a damper beside it", Dimension::damping), s.damping);
}
template <class Visitor>
void fields(Visitor&& visit, TorsionSpringForm& s) {
  using namespace linkage_fields;
  visit(text("name", "its name"), s.name);
  visit(text("first", "body at one end"), s.first);
  visit(text("second", "body at the other end"), s.second);
  visit(positive("stiffness", "stiffness", Dimension::stiffness_angular), s.stiffness);
  visit(angle("free_angle", "angle of the second body from the first without torque"), s.free_angle);
  visit(positive("damping", "of a damper beside it", Dimension::damping_angular), s.damping);
}
template <class Visitor>
void fields(Visitor&& visit, FactorForm& f) {
  visit(Field{.key = "against", .summary = "what the load depends on"}, f.against);
  visit(Field{.key = "argument", .summary = "rising values of it, in rad, m, s or rad/s"}, f.argument);
  visit(Field{.key = "factor", .summary = "factor of the load at each of them, straight lines between"},
        f.factor);
  visit(
      Field{.key = "period",
            .summary = "change of the argument after which the table repeats, 0 = never; default: a table of "
                       "whole turns of the input repeats after them",
            .minimum = 0},
      f.period);
}
template <class Visitor>
void fields(Visitor&& visit, ForceForm& f) {
  using namespace linkage_fields;
  visit(text("name", "its name"), f.name);
  visit(text("point", "where it acts, \"body.point\""), f.point);
  visit(Field{.key = "force",
              .summary = "components along x and y",
              .dimension = Dimension::force,
              .minimum = -1e15,
              .maximum = 1e15,
              .required = true},
        f.force);
  visit(Field{.key = "turns_with_body", .summary = "components in the frame of the body"}, f.turns_with_body);
  fields(visit, f.factor);
}
template <class Visitor>
void fields(Visitor&& visit, TorqueForm& t) {
  using namespace linkage_fields;
  visit(text("name", "its name"), t.name);
  visit(text("body", "the body it turns"), t.body);
  visit(text("from", "the body that feels the opposite", false), t.from);
  visit(Field{.key = "torque",
              .summary = "counter-clockwise positive",
              .dimension = Dimension::torque,
              .minimum = -1e15,
              .maximum = 1e15,
              .required = true},
        t.torque);
  fields(visit, t.factor);
}
template <class Visitor>
void fields(Visitor&& visit, LinkageForm& l) {
  visit(Field{.key = "drawn", .summary = "points are given in one drawn position, in the global frame"},
        l.drawn);
  visit(linkage_fields::place("moment_centre", "shaking moments are about this place of the ground"),
        l.moment_centre);
  visit(Field{.key = "body", .summary = "the bodies; the first is the ground"}, l.bodies);
  visit(Field{.key = "joint", .summary = "the joints"}, l.joints);
  visit(Field{.key = "assembly", .summary = "which way pairs of bodies are assembled"}, l.assembly);
  visit(Field{.key = "spring", .summary = "springs and dampers between two points"}, l.springs);
  visit(Field{.key = "torsion_spring", .summary = "springs and dampers that turn two bodies"},
        l.torsion_springs);
  visit(Field{.key = "force", .summary = "forces on points"}, l.forces);
  visit(Field{.key = "torque", .summary = "torques on bodies"}, l.torques);
}

}  // namespace linkwright::planar
