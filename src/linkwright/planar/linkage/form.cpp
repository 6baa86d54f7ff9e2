// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/form.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <span>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/detail/form_parts.h"
#include "linkwright/planar/linkage/detail/load_formula.h"

namespace linkwright::planar {
namespace {

std::complex<double> number(const Place& p) { return {p[0], p[1]}; }
Place place(std::complex<double> z) { return {z.real(), z.imag()}; }

LoadFactor factor_of(const FactorForm& f) { return {f.against, f.argument, f.factor, f.period}; }
FactorForm form_of(const LoadFactor& f) { return {f.against, f.argument, f.factor, f.period}; }

LinkageBody body_of(const BodyForm& form, bool drawn) {
  LinkageBody body{.name = form.name};
  for (const auto& [name, at] : form.points) body.points.push_back({name, number(at)});
  std::size_t n = 0;
  for (const AttachedMassForm& m : form.attached)
    body.attached.push_back({m.name.empty() ? fmt::format("mass {}", ++n) : m.name, m.mass, number(m.at)});
  if (form.start)
    body.start = math::Pose{form.start->x, form.start->y, form.start->angle};
  else if (drawn)
    body.start = math::Pose{};
  if (form.mass) body.mass = BodyMass{*form.mass, 0, 0};
  body.stiffness = form.stiffness.value_or(0);
  return body;
}

// Completes a mass from the joints of the body.
void complete_mass(Linkage& l, std::size_t b, const BodyForm& form) {
  LinkageBody& body = l.bodies[b];
  if (!form.mass) return;
  if (!body.points.empty() && (!form.inertia || !form.centre)) {
    Linkage alone = l;  // bodies may share a name, which is reported elsewhere
    alone.bodies[b].name = "\n";
    set_uniform(alone, "\n", *form.mass);
    body.mass = alone.bodies[b].mass;
    body.mass->assumed = true;
  }
  if (form.inertia) body.mass->inertia = *form.inertia;
  if (form.centre) body.mass->centre = number(*form.centre);
}

// The length of a spring without force, from its pull in the drawn position or where its bodies start.
double free_length_of(const Linkage& l, const SpringForm& f, FormNames& names) {
  const auto place_at_start = [&](const BodyPoint& p) -> std::optional<std::complex<double>> {
    const std::optional<math::Pose>& start = l.bodies[static_cast<std::size_t>(p.body)].start;
    if (p.body == 0) return place_of(l, p);
    if (!start) return std::nullopt;
    return std::complex<double>(start->x, start->y) + std::polar(1.0, start->angle) * place_of(l, p);
  };
  const auto first = place_at_start(l.springs.back().first), second = place_at_start(l.springs.back().second);
  if (f.free_length != 0) {
    names.problem("preload_N", fmt::format("spring '{}' has a preload and a free length", f.name),
                  "leave one");
  } else if (f.stiffness == 0) {
    names.problem("preload_N", fmt::format("spring '{}' has a preload but no stiffness", f.name),
                  "give the stiffness, or a strut with a constant force");
  } else if (!first || !second) {
    names.problem("preload_N",
                  fmt::format("the length at which spring '{}' has its preload is not known", f.name),
                  "draw the linkage (drawn = true), give its bodies a start, or write free_length_mm");
  } else {
    const double length = std::abs(*second - *first), free = length - *f.preload / f.stiffness;
    if (free >= 0) return free;
    names.problem("preload_N",
                  fmt::format("spring '{}' is {:.6g} mm long there and cannot pull with {:.6g} N: its free "
                              "length would be {:.6g} mm",
                              f.name, length * 1e3, *f.preload, free * 1e3),
                  fmt::format("pull with {:.6g} N at most, or take a stiffer spring", f.stiffness * length));
  }
  return 0;
}

// The table of a strut, whose argument has the unit of what it goes by.
LoadFactor table_of(const StrutForm& f, FormNames& names) {
  struct Argument {
    const std::optional<std::vector<double>>& values;
    const char* key;
    bool fits;
  };
  using enum LoadArgument;
  const Argument all[] = {{f.lengths, "argument_mm", f.against == length || f.against == input},
                          {f.times, "argument_s", f.against == time},
                          {f.speeds, "argument_mm_per_s", f.against == speed},
                          {f.angles, "argument_deg", f.against == input}};
  LoadFactor table{f.against, {}, f.force_table.value_or(std::vector<double>()), f.period};
  const std::string against(name_of(f.against));
  if (f.against == x || f.against == y) {
    names.problem("against", fmt::format("strut '{}' goes by {}, but has two points", f.name, against),
                  "let it go by length, speed, time or input");
    return table;
  }
  if (!f.force_table)
    names.problem("against", fmt::format("strut '{}' goes by {} but has no table", f.name, against),
                  "write force_table_N with the force at each argument");
  std::string fitting;
  bool given = false;
  for (const Argument& a : all) {
    if (a.fits) fitting = fitting.empty() ? a.key : fitting + " or " + a.key;
    if (!a.values) continue;
    if (!a.fits)
      names.problem("argument",
                    fmt::format("strut '{}' goes by {}, which is not in {}", f.name, against, a.key), "");
    given = true;
    table.argument = *a.values;
  }
  if (!given)
    names.problem("against", fmt::format("the table of strut '{}' has no arguments", f.name),
                  "write them as " + fitting);
  return table;
}

Strut strut_of(const StrutForm& f, FormNames& names) {
  Strut s{.name = f.name, .first = names.point("first", f.first), .second = names.point("second", f.second)};
  const int laws = (f.force ? 1 : 0) + (f.gas ? 1 : 0) + (f.cylinder ? 1 : 0) + (f.formula ? 1 : 0) +
                   (f.force_table || f.against != LoadArgument::constant ? 1 : 0);
  if (laws != 1)
    names.problem("name", fmt::format("strut '{}' has {}", f.name, laws == 0 ? "no force" : "several forces"),
                  "give one of force_N, force_table_N, gas, cylinder and formula");
  s.force = f.force.value_or(1);
  if (f.against != LoadArgument::constant)
    s.factor = table_of(f, names);
  else if (f.force_table)
    names.problem("against",
                  fmt::format("strut '{}' has a table, but it is not said what it goes by", f.name),
                  "write against = \"length\", \"speed\", \"time\" or \"input\"");
  if (f.gas) {
    if (!f.gas->extended_force || !f.gas->extended_length)
      names.problem("gas",
                    fmt::format("gas spring '{}' has no extended {}", f.name,
                                f.gas->extended_force ? "length" : "force"),
                    "write extended_N and extended_mm, its force and length when it is extended");
    s.gas = GasSpring{f.gas->extended_force.value_or(1), f.gas->extended_length.value_or(1), f.gas->stroke,
                      f.gas->progression};
  }
  if (f.cylinder) {
    const CylinderForm& c = *f.cylinder;
    if (c.pressure.has_value() == c.pressure_formula.has_value())
      names.problem("cylinder",
                    fmt::format("cylinder '{}' has {}", f.name,
                                c.pressure ? "a pressure and a formula of it" : "no pressure"),
                    "give one of pressure_MPa and pressure_formula");
    if (c.back_pressure != 0 && c.back_pressure_formula)
      names.problem("cylinder", fmt::format("cylinder '{}' has a back pressure and a formula of it", f.name),
                    "leave one out");
    s.cylinder = Cylinder{c.bore, c.rod, c.pressure.value_or(0), c.back_pressure};
  }
  return s;
}

StrutForm form_of(const Strut& s, std::string first, std::string second, bool rotary) {
  StrutForm f{.name = s.name, .first = std::move(first), .second = std::move(second)};
  if (s.gas) {
    f.gas = GasSpringForm{s.gas->extended_force, s.gas->extended_length, s.gas->stroke, s.gas->progression};
  } else if (s.cylinder) {
    f.cylinder = CylinderForm{.bore = s.cylinder->bore, .rod = s.cylinder->rod};
    if (s.formula) {
      const std::vector<std::string> pressures = texts_of(*s.formula);
      f.cylinder->pressure_formula = pressures[0], f.cylinder->back_pressure_formula = pressures[1];
    } else {
      f.cylinder->pressure = s.cylinder->pressure, f.cylinder->back_pressure = s.cylinder->back_pressure;
    }
  } else if (s.formula) {
    f.formula = texts_of(*s.formula).front();
  } else if (s.factor.against == LoadArgument::constant) {
    f.force = s.force;
  } else {
    f.against = s.factor.against;
    f.period = s.factor.period;
    f.force_table = s.factor.factor;
    for (double& force : *f.force_table) force *= s.force;
    const bool angle = f.against == LoadArgument::input && rotary;
    (f.against == LoadArgument::time    ? f.times
     : f.against == LoadArgument::speed ? f.speeds
     : angle                            ? f.angles
                                        : f.lengths) = s.factor.argument;
  }
  return f;
}

StopForm form_of(const Linkage& l, const JointStop& s) {
  const LinkageJoint& joint = l.joints[static_cast<std::size_t>(s.joint)];
  const bool pin = joint.type == JointType::revolute;
  StopForm f{.joint = joint.name};
  (s.side > 0 ? pin ? f.at_least_angle : f.at_least_length
   : pin      ? f.at_most_angle
              : f.at_most_length) = s.limit;
  if (s.arm > 0) f.arm = s.arm;
  if (s.stiffness) {
    (pin ? f.stiffness_angular : f.stiffness) = s.stiffness;
    (pin ? f.damping_angular : f.damping) = s.damping;
  } else {
    f.restitution = s.restitution;
  }
  return f;
}

// Friction at rest, of falling curves and without load.
void set_friction(LinkageJoint& j, const JointForm& f, FormNames& names) {
  if (f.friction_torque && j.type != JointType::revolute)
    names.problem("friction_torque_N_m",
                  fmt::format("joint '{}' is not a pin, and has a friction torque", f.name),
                  "a slide or slot has a friction_force");
  if (f.friction_force && j.type != JointType::prismatic && j.type != JointType::pin_in_slot)
    names.problem("friction_force_N",
                  fmt::format("joint '{}' is not a slide or slot, and has a friction force", f.name),
                  "a pin has a friction_torque");
  if (j.screw && (f.friction_static || f.friction_force || f.stribeck_speed || f.friction_table))
    names.problem("friction", fmt::format("screw '{}' has friction of a slide", f.name),
                  "the friction of its thread is `friction` alone");
  if (f.friction_static && *f.friction_static < f.friction)
    names.problem("friction_static",
                  fmt::format("friction_static {} of joint '{}' is below its friction {}", *f.friction_static,
                              f.name, f.friction),
                  "friction_static is the larger of the two");
  if (f.stribeck_speed && !f.friction_static)
    names.problem("stribeck_speed",
                  fmt::format("the friction of joint '{}' falls with the speed from no value", f.name),
                  "give friction_static, the value at rest");
  if (f.friction_fall && !f.stribeck_speed)
    names.problem("friction_fall", fmt::format("joint '{}' has a curve of friction without a speed", f.name),
                  "give stribeck_speed");
  if (const auto& table = f.friction_table) {
    if (f.friction > 0 || f.stribeck_speed)
      names.problem("friction_table", fmt::format("joint '{}' has a table and a curve of friction", f.name),
                    "leave out friction and stribeck_speed");
    j.friction_speeds = table->speed;
    j.friction_values = table->coefficient;
  }
  j.friction_static = f.friction_static.value_or(0);
  j.friction_effort = f.friction_torque.value_or(0) + f.friction_force.value_or(0);
  j.friction_speed = f.stribeck_speed.value_or(0);
  j.friction_fall = f.friction_fall.value_or(FrictionFall::stribeck);
}

// The curve of a slot.
std::optional<CurvedSlot> slot_of(const JointForm& f, FormNames& names) {
  if (!f.curve) return std::nullopt;
  const CurvedSlotForm& c = *f.curve;
  const bool is_arc = c.centre || c.radius || c.from || c.to;
  if (f.type != JointType::pin_in_slot)
    names.problem("curve", fmt::format("joint '{}' is not a pin_in_slot, and has a curve", f.name),
                  "leave the curve out, or set type = \"pin_in_slot\"");
  if (is_arc && !c.points.empty())
    names.problem("curve", fmt::format("the slot of joint '{}' has points and an arc", f.name), "leave one");
  if (is_arc && !c.radius)
    names.problem("curve", fmt::format("the arc of the slot of joint '{}' has no radius", f.name),
                  "give radius_mm beside centre_mm");
  if (is_arc && c.from.has_value() != c.to.has_value())
    names.problem("curve", fmt::format("the arc of the slot of joint '{}' has one end", f.name),
                  "give from_deg and to_deg, or neither for a circle");
  CurvedSlot out{.points = {}, .closed = c.closed};
  for (const Place& p : c.points) out.points.push_back(number(p));
  if (c.centre) out.centre = number(*c.centre);
  out.radius = c.radius.value_or(0);
  if (c.from && c.to) out.from = *c.from, out.to = *c.to;
  return out;
}

LinkageJoint joint_of(const JointForm& f, bool drawn, FormNames& names) {
  LinkageJoint j{.name = f.name, .type = f.type};
  if (f.type == JointType::gear) {
    j.first = names.wheel("first", f.first);
    j.second = names.wheel("second", f.second);
    j.ratio = ratio_of(f, names);
    if (f.carrier) j.carrier = names.body("carrier", *f.carrier);
    if (f.pressure_angle) j.pressure_angle = *f.pressure_angle;
    if (f.ratio_curve) j.curve = RatioCurve{f.ratio_curve->first, f.ratio_curve->second};
    j.efficiency = f.efficiency.value_or(1);
  } else {
    j.first = f.curve ? names.wheel("first", f.first) : names.point("first", f.first);
    j.second = names.point("second", f.second);
  }
  j.slot = slot_of(f, names);
  if (f.type == JointType::geneva) {
    const InternalWheel internal = f.internal.value_or(InternalWheel::none);
    if (internal == InternalWheel::first)
      names.problem("internal", fmt::format("the pin of Geneva drive '{}' is on its first body", f.name),
                    "write second, where the crank turns within the wheel");
    if (!f.slots)
      names.problem("slots", fmt::format("the wheel of Geneva drive '{}' has no slots", f.name),
                    "give their number, such as slots = 4");
    j.type = JointType::gear;
    j.pressure_angle = 0;
    j.geneva = Geneva{{f.slots.value_or(4), internal == InternalWheel::second}, f.slot_angle};
    if (!drawn && !f.slot_angle) j.geneva->slot = 0;
    if (f.carrier) j.carrier = names.body("carrier", *f.carrier);
  }
  if (f.type == JointType::screw) {
    if (!f.lead)
      names.problem("lead_mm", fmt::format("screw '{}' has no lead", f.name),
                    "give the displacement for one turn of the spindle");
    j.type = JointType::prismatic;
    j.screw = Screw{f.lead.value_or(1),
                    f.pitch_diameter.value_or(0),
                    f.friction,
                    f.flank_angle.value_or(pi / 3),
                    f.spindle_inertia.value_or(0),
                    f.hand == ThreadHand::left};
  }
  j.compliance = f.compliance.value_or(0);
  j.slide_first = f.direction;
  j.slide_second = f.direction_second.value_or(drawn && (j.type == JointType::prismatic) ? f.direction : 0.0);
  j.phase = f.phase;
  if (f.type == JointType::rack) {
    j.slide_first = 0, j.slide_second = f.direction;
    if (f.pressure_angle) j.pressure_angle = *f.pressure_angle;
  }
  j.friction = j.screw ? 0 : f.friction, j.pin_radius = f.pin_radius, j.guide_length = f.guide_length;
  set_friction(j, f, names);
  return j;
}

// The stops of one entry: a lower one, an upper one, or both.
void add_stops(const StopForm& f, Linkage& l, FormNames& names) {
  const int joint = names.joint("joint", f.joint);
  if (joint < 0) return;
  const bool pin = l.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
  const auto &least = pin ? f.at_least_angle : f.at_least_length,
             &most = pin ? f.at_most_angle : f.at_most_length;
  if (pin ? f.at_least_length || f.at_most_length : f.at_least_angle || f.at_most_angle)
    return names.problem(
        "joint",
        fmt::format("joint '{}' {}", f.joint,
                    pin ? "turns, and its stop is at a length" : "slides, and its stop is at an angle"),
        pin ? "write at_least_deg or at_most_deg" : "write at_least_mm or at_most_mm");
  if (!least && !most)
    return names.problem("joint", fmt::format("the stop of joint '{}' has no place", f.joint),
                         pin ? "write at_least_deg or at_most_deg" : "write at_least_mm or at_most_mm");
  if (f.arm && !pin)
    return names.problem("arm_mm", fmt::format("joint '{}' slides, and its stop has an arm", f.joint),
                         "leave the arm out");
  if (pin && !f.arm && (f.stiffness || f.damping))
    return names.problem("stiffness_N_per_m",
                         fmt::format("the stop of '{}' has no arm on which its stiffness acts", f.joint),
                         "give arm_mm, or stiffness_N_m_per_rad");
  if (!pin && (f.stiffness_angular || f.damping_angular))
    return names.problem("stiffness_N_m_per_rad",
                         fmt::format("joint '{}' slides, and its stop has a stiffness of a turn", f.joint),
                         "write stiffness_N_per_m");
  const double square = pin ? f.arm.value_or(0) * f.arm.value_or(0) : 1;
  JointStop stop{.joint = joint, .restitution = f.restitution.value_or(0), .arm = f.arm.value_or(0)};
  if (f.stiffness) stop.stiffness = *f.stiffness * square;
  if (f.stiffness_angular) stop.stiffness = *f.stiffness_angular;
  stop.damping = f.damping.value_or(0) * square + f.damping_angular.value_or(0);
  if (stop.stiffness && f.restitution)
    return names.problem("restitution",
                         fmt::format("the stop of '{}' has a stiffness and a restitution", f.joint),
                         "a rigid stop has a restitution, one that gives way has a damping: leave one");
  if (!stop.stiffness && stop.damping > 0)
    return names.problem("damping", fmt::format("the stop of '{}' has a damping but no stiffness", f.joint),
                         "give the stiffness, or the restitution of a rigid stop");
  for (const double side : {1.0, -1.0}) {
    const auto& limit = side > 0 ? least : most;
    if (!limit) continue;
    stop.limit = *limit, stop.side = side;
    l.stops.push_back(stop);
  }
}

// A load has a size, which a table may change, or a formula.
void require_one_law(bool sized, bool has_formula, const FactorForm& factor, const char* what,
                     const char* key, const std::string& name, FormNames& names) {
  if (sized == has_formula)
    names.problem(sized ? "formula" : key,
                  fmt::format("{} '{}' has {}", what, name, sized ? "a size and a formula" : "no size"),
                  fmt::format("give one of {} and formula", key));
  else if (has_formula && factor.against != LoadArgument::constant)
    names.problem("against", fmt::format("{} '{}' has a table and a formula", what, name),
                  "leave one out; a formula may have table(...) in it");
}

// The formulas of loads, once all that they may name is known.
void add_formulas(const LinkageForm& form, Linkage& l, FormNames& names) {
  using Kind = LoadQuantity::Kind;
  const LoadQuantity time{.kind = Kind::time};
  const auto read = [&](std::span<const std::string> texts, Dimension result,
                        std::span<const NamedQuantity> known, const char* example,
                        const char* key = "formula") {
    std::string problem;
    auto formula = load_formula(l, texts, result, known, problem);
    if (!formula) names.problem(key, problem, fmt::format("write for example {}", example));
    return formula;
  };
  for (std::size_t i = 0; i < form.forces.size(); ++i) {
    if (!form.forces[i].formula) continue;
    names.at("force", i);
    PointForce& f = l.forces[i];
    const auto of_point = [&f](Kind kind) { return LoadQuantity{.kind = kind, .first = f.point}; };
    const NamedQuantity known[] = {{{"time", Dimension::time}, time},
                                   {{"x", Dimension::length}, of_point(Kind::x)},
                                   {{"y", Dimension::length}, of_point(Kind::y)},
                                   {{"vx", Dimension::speed}, of_point(Kind::x_speed)},
                                   {{"vy", Dimension::speed}, of_point(Kind::y_speed)}};
    f.formula = read(*form.forces[i].formula, Dimension::force, known,
                     "[\"-3 N*s/m * vx\", \"10 N * sin(2*pi*time / (0.5 s))\"]");
  }
  for (std::size_t i = 0; i < form.torques.size(); ++i) {
    if (!form.torques[i].formula) continue;
    names.at("torque", i);
    BodyTorque& t = l.torques[i];
    const NamedQuantity known[] = {{{"time", Dimension::time}, time},
                                   {{"speed", Dimension::speed_angular},
                                    {.kind = Kind::turning, .first = {t.body, 0}, .second = {t.from, 0}}}};
    t.formula = read(std::array{*form.torques[i].formula}, Dimension::torque, known,
                     "'5 N*m - 0.2 N*m*s * rate(\"O\")'");
  }
  for (std::size_t i = 0; i < form.struts.size(); ++i) {
    const auto& cylinder = form.struts[i].cylinder;
    const bool by_pressure = cylinder && (cylinder->pressure_formula || cylinder->back_pressure_formula);
    if (!form.struts[i].formula && !by_pressure) continue;
    names.at("strut", i);
    Strut& s = l.struts[i];
    const NamedQuantity known[] = {
        {{"time", Dimension::time}, time},
        {{"s", Dimension::length}, {.kind = Kind::length, .first = s.first, .second = s.second}},
        {{"v", Dimension::speed}, {.kind = Kind::lengthening, .first = s.first, .second = s.second}}};
    if (!by_pressure) {
      s.formula = read(std::array{*form.struts[i].formula}, Dimension::force, known,
                       "\"200 N + 15 N/mm * (s - 20 mm)\"");
      continue;
    }
    const auto text = [](const std::optional<std::string>& formula, double constant) {
      return formula.value_or(fmt::format("{} Pa", constant));
    };
    const std::array pressures{text(cylinder->pressure_formula, cylinder->pressure.value_or(0)),
                               text(cylinder->back_pressure_formula, cylinder->back_pressure)};
    s.formula =
        read(pressures, Dimension::pressure, known, "\"table(time, 0 s, 0, 1 s, 12 MPa)\"", "cylinder");
  }
}

// Springs, forces, torques, struts and stops.
void add_loads(const LinkageForm& form, Linkage& l, FormNames& names) {
  for (std::size_t i = 0; i < form.springs.size(); ++i) {
    const SpringForm& s = form.springs[i];
    names.at("spring", i);
    l.springs.push_back({s.name, names.point("first", s.first), names.point("second", s.second), s.stiffness,
                         s.free_length, s.damping});
    if (s.preload && names.clean()) l.springs.back().free_length = free_length_of(l, s, names);
  }
  for (std::size_t i = 0; i < form.torsion_springs.size(); ++i) {
    const TorsionSpringForm& s = form.torsion_springs[i];
    names.at("torsion_spring", i);
    l.torsion_springs.push_back({s.name, names.body("first", s.first), names.body("second", s.second),
                                 s.stiffness, s.free_angle, s.damping});
  }
  for (std::size_t i = 0; i < form.forces.size(); ++i) {
    const ForceForm& f = form.forces[i];
    names.at("force", i);
    require_one_law(f.force.has_value(), f.formula.has_value(), f.factor, "force", "force_N", f.name, names);
    if (f.formula && f.formula->size() != 2)
      names.problem("formula", fmt::format("force '{}' has {} formulas", f.name, f.formula->size()),
                    "write two, of its components along x and y: [\"10 N\", \"0\"]");
    l.forces.push_back({f.name, names.point("point", f.point), number(f.force.value_or(Place{})),
                        f.turns_with_body, factor_of(f.factor)});
  }
  for (std::size_t i = 0; i < form.torques.size(); ++i) {
    const TorqueForm& t = form.torques[i];
    names.at("torque", i);
    require_one_law(t.torque.has_value(), t.formula.has_value(), t.factor, "torque", "torque_N_m", t.name,
                    names);
    l.torques.push_back({t.name, names.body("body", t.body), names.body("from", t.from), t.torque.value_or(0),
                         factor_of(t.factor)});
  }
  for (std::size_t i = 0; i < form.struts.size(); ++i) {
    names.at("strut", i);
    l.struts.push_back(strut_of(form.struts[i], names));
  }
  for (std::size_t i = 0; i < form.stops.size(); ++i) {
    names.at("stop", i);
    add_stops(form.stops[i], l, names);
  }
  if (names.clean()) add_formulas(form, l, names);
}

}  // namespace

Linkage linkage_of(const LinkageForm& form, std::vector<FormProblem>& problems) {
  Linkage l;
  for (const BodyForm& b : form.bodies) l.bodies.push_back(body_of(b, form.drawn));
  l.moment_centre = number(form.moment_centre);
  FormNames names(l, problems);
  if (l.bodies.empty()) {
    names.problem("body", "the linkage has no bodies",
                  "add [[mechanism.body]] tables; the first is the ground");
    return l;
  }
  for (std::size_t i = 0; i < form.joints.size(); ++i) {
    names.at("joint", i);
    l.joints.push_back(joint_of(form.joints[i], form.drawn, names));
  }
  const bool pins_known = problems.empty();
  for (std::size_t i = 0; i < form.joints.size() && pins_known; ++i) {
    names.at("joint", i);
    if (form.joints[i].type == JointType::rack)
      measure_rack(l, form.joints[i], form.drawn, l.joints[i], names);
    if (l.joints[i].type != JointType::gear) continue;
    complete_gear(l, form.joints[i], l.joints[i], names);
  }
  for (std::size_t i = 0; i < form.belts.size() && pins_known; ++i) {
    names.at("belt", i);
    const std::size_t before = problems.size();
    Belt belt = belt_of(form.belts[i], names);
    if (problems.size() == before) complete_belt(l, form.belts[i], form.drawn, belt, names);
    l.belts.push_back(std::move(belt));
  }
  for (std::size_t i = 0; i < form.cams.size(); ++i) {
    names.at("cam", i);
    l.cams.push_back(cam_of(l, form.cams[i], names));
  }
  for (std::size_t i = 0; i < form.assembly.size(); ++i) {
    const AssemblyForm& a = form.assembly[i];
    names.at("assembly", i);
    if (a.bodies.empty() || a.bodies.size() > 2) {
      names.problem("bodies", fmt::format("has {} bodies, must have two", a.bodies.size()),
                    "or one, when the other is the block of a slot");
      continue;
    }
    l.modes.push_back(
        {names.body("bodies", a.bodies.front()), names.body("bodies", a.bodies.back()), a.mode});
  }
  add_loads(form, l, names);
  for (std::size_t b = 0; b < form.bodies.size(); ++b) complete_mass(l, b, form.bodies[b]);
  return l;
}

LinkageForm form_of(const Linkage& l) {
  LinkageForm form;
  form.moment_centre = place(l.moment_centre);
  const auto body = [&](int b) { return l.bodies[static_cast<std::size_t>(b)].name; };
  const auto point = [&](const BodyPoint& p) {
    return body(p.body) + "." +
           l.bodies[static_cast<std::size_t>(p.body)].points[static_cast<std::size_t>(p.point)].name;
  };
  for (const LinkageBody& b : l.bodies) {
    BodyForm f{.name = b.name};
    for (const LinkagePoint& p : b.points) f.points.emplace_back(p.name, place(p.at));
    if (b.mass) f.mass = b.mass->mass, f.inertia = b.mass->inertia, f.centre = place(b.mass->centre);
    for (const AttachedMass& m : b.attached) f.attached.push_back({m.name, m.mass, place(m.at)});
    if (b.start) f.start = StartForm{b.start->x, b.start->y, b.start->angle};
    if (b.stiffness > 0) f.stiffness = b.stiffness;
    form.bodies.push_back(std::move(f));
  }
  for (const LinkageJoint& j : l.joints) {
    JointForm f{.name = j.name, .type = j.type};
    const bool gear = j.type == JointType::gear;
    f.first = gear && !j.geneva ? body(j.first.body) : point(j.first);
    f.second = gear && !j.geneva ? body(j.second.body) : point(j.second);
    f.direction = j.type == JointType::rack ? j.slide_second : j.slide_first;
    if (j.type == JointType::prismatic || j.type == JointType::fixed) f.direction_second = j.slide_second;
    f.phase = j.phase;
    if (gear) f.ratio = j.ratio, f.carrier = body(j.carrier), f.pressure_angle = j.pressure_angle;
    if (j.efficiency < 1) f.efficiency = j.efficiency;
    if (j.geneva) {
      f.type = JointType::geneva;
      f.slots = j.geneva->slots.count, f.slot_angle = j.geneva->slot;
      if (j.geneva->slots.internal) f.internal = InternalWheel::second;
      f.ratio.reset(), f.pressure_angle.reset();
    }
    if (const auto& s = j.slot) {
      f.curve = CurvedSlotForm{.points = {}, .closed = s->closed};
      for (const std::complex<double>& p : s->points) f.curve->points.push_back(place(p));
      if (s->radius > 0) {
        f.curve->centre = place(s->centre), f.curve->radius = s->radius;
        f.curve->from = s->from, f.curve->to = s->to;
      }
    }
    if (j.curve) f.ratio_curve = RatioCurveForm{j.curve->first, j.curve->second}, f.ratio.reset();
    if (j.type == JointType::rack) f.radius = j.radius, f.pressure_angle = j.pressure_angle;
    if (j.screw) {
      const Screw& s = *j.screw;
      f.type = JointType::screw;
      f.lead = s.lead, f.flank_angle = s.flank_angle, f.spindle_inertia = s.spindle_inertia;
      if (s.pitch_diameter > 0) f.pitch_diameter = s.pitch_diameter;
      f.hand = s.left_hand ? ThreadHand::left : ThreadHand::right;
    }
    f.friction = j.screw ? j.screw->friction : j.friction, f.pin_radius = j.pin_radius,
    f.guide_length = j.guide_length;
    if (j.compliance > 0) f.compliance = j.compliance;
    if (j.friction_static > 0) f.friction_static = j.friction_static;
    if (!j.friction_values.empty())
      f.friction_table = FrictionTableForm{j.friction_speeds, j.friction_values};
    if (j.friction_effort > 0)
      (j.type == JointType::revolute ? f.friction_torque : f.friction_force) = j.friction_effort;
    if (j.friction_speed > 0) {
      f.stribeck_speed = j.friction_speed;
      if (j.friction_fall != FrictionFall::stribeck) f.friction_fall = j.friction_fall;
    }
    form.joints.push_back(std::move(f));
  }
  for (const DyadMode& m : l.modes) form.assembly.push_back({{body(m.first), body(m.second)}, m.mode});
  for (const LinearSpring& s : l.springs)
    form.springs.push_back(
        {s.name, point(s.first), point(s.second), s.stiffness, s.free_length, s.damping, {}});
  for (const TorsionSpring& s : l.torsion_springs)
    form.torsion_springs.push_back(
        {s.name, body(s.first), body(s.second), s.stiffness, s.free_angle, s.damping});
  for (const PointForce& f : l.forces)
    form.forces.push_back({f.name, point(f.point), f.formula ? std::nullopt : std::optional(place(f.force)),
                           f.turns_with_body, form_of(f.factor),
                           f.formula ? std::optional(texts_of(*f.formula)) : std::nullopt});
  for (const BodyTorque& t : l.torques)
    form.torques.push_back({t.name, body(t.body), body(t.from),
                            t.formula ? std::nullopt : std::optional(t.torque), form_of(t.factor),
                            t.formula ? std::optional(texts_of(*t.formula).front()) : std::nullopt});
  for (const Belt& b : l.belts) {
    BeltForm f{.name = b.name, .closed = b.closed, .tension = b.tension};
    for (const BeltWheel& w : b.wheels)
      f.wheels.push_back({point(w.centre), w.radius, w.side > 0 ? BeltSide::inside : BeltSide::outside, {}});
    if (b.carrier >= 0) f.carrier = body(b.carrier);
    form.belts.push_back(std::move(f));
  }
  for (const LinkageCam& c : l.cams) form.cams.push_back(form_of(c, l));
  const bool rotary =
      !l.driven.empty() && l.joints[static_cast<std::size_t>(l.driven[0])].type == JointType::revolute;
  for (const Strut& s : l.struts) form.struts.push_back(form_of(s, point(s.first), point(s.second), rotary));
  for (const JointStop& s : l.stops) form.stops.push_back(form_of(l, s));
  return form;
}

}  // namespace linkwright::planar
