// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/screw.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {
std::string group_key(std::string name) {
  for (std::size_t i; (i = name.find(" + ")) != std::string::npos;) name.replace(i, 3, "_");
  return identifier(name);
}

const std::vector<Word>& linkage_quantity_words() {
  static const std::vector<Word> words = {
      {"position", "angles and origins of the bodies, displacements of the slides, traced points"},
      {"rates", "their speeds and accelerations"},
      {"reactions", "forces and moments in the joints"},
      {"drive", "torques and forces of the drives"},
      {"shaking", "force and moments of the linkage on the ground"},
      {"transmission_angle", "of every dyad, folded to 0..90 deg: sine of the angle of force transmission"},
      {"power", "of drives, weight and loads, and the rate of the kinetic energy"}};
  return words;
}
LinkageQuantities chosen_quantities(const std::vector<std::string>& listed) {
  const auto has = [&](std::string_view word) {
    return listed.empty() || std::find(listed.begin(), listed.end(), word) != listed.end();
  };
  return {.position = has("position"),
          .rates = has("rates"),
          .reactions = has("reactions"),
          .drive = has("drive"),
          .shaking = has("shaking"),
          .transmission_angle = has("transmission_angle"),
          .power = has("power")};
}

void unwrap(const LinkageColumn& column, std::span<double> rows) {
  if (column.angle && !column.counted) math::unwrap_angles(rows);
}

double value_of(const LinkageColumn& column, const LinkageInstant& instant) {
  using Needs = LinkageColumn::Needs;
  const Status status = instant.motion->status;
  const bool known = column.needs == Needs::nothing || status == Status::done ||
                     (column.needs == Needs::pose && status == Status::singular);
  return known ? column.value(instant) : nan;
}

const LinkageJoint& input_joint(const Linkage& l, std::size_t input) { return l.joints[at(l.driven[input])]; }
namespace {
/// True if a body has the name of a driven joint: the columns of both would be called alike.
bool shares_name(const Linkage& l, std::size_t input) {
  const std::string name = identifier(input_joint(l, input).name);
  return std::any_of(l.bodies.begin(), l.bodies.end(),
                     [&](const LinkageBody& body) { return identifier(body.name) == name; });
}

std::string input_axis(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return identifier(input_joint(l, input).name) + (shares_name(l, input) ? "_joint" : "") +
         (plan.rotary[input] ? "_angle" : "_displacement");
}
}  // namespace

std::string input_key(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return input_axis(l, plan, input) + (plan.rotary[input] ? "_rad" : "_m");
}
std::string input_label(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return fmt::format("{}{} {}", shares_name(l, input) ? "joint " : "", input_joint(l, input).name,
                     plan.rotary[input] ? "angle (rad)" : "displacement (m)");
}
Measured input_place(const Linkage& l, const LinkagePlan& plan, std::size_t input, double value, int digits) {
  return at_place(input_axis(l, plan, input),
                  plan.rotary[input] ? degrees_of(value, digits) : millimetres(value, digits));
}

std::string moment_centre_name(const Linkage& l) {
  if (l.moment_centre == std::complex<double>()) return "the origin";
  for (const LinkagePoint& p : l.bodies[0].points)
    if (p.at == l.moment_centre) return p.name;
  return fmt::format("({:.6g}, {:.6g}) m", l.moment_centre.real(), l.moment_centre.imag());
}

namespace {

// The angle of a body, in the turn that its joints count where drives and gears alone turn it.
double angle_with_turns(const LinkagePlan& plan, const LinkageInstant& instant, int body) {
  const double angle = angle_of(body_state(plan, *instant.motion, body).direction);
  const BodyOnPart& on = plan.bodies[at(body)];
  const auto& driven = plan.turned[at(on.part)];
  if (!driven) return angle;
  double counted = math::wrap_angle(driven->angle + angle_of(on.turn));
  for (std::size_t k = 0; k < driven->gains.size(); ++k)
    counted += driven->gains[k] * instant.inputs[k].value;
  return angle + full_turn * std::round((counted - angle) / full_turn);
}

/// A slide's displacement and its rates, second point from first along the slide.
struct SlideMotion {
  double displacement = 0, speed = 0, acceleration = 0;
};
SlideMotion slide_motion(const Linkage& l, const LinkagePlan& plan, const LinkageInstant& i, std::size_t j) {
  const LinkageJoint& joint = l.joints[j];
  if (joint.slot) {
    const JointMotion m = joint_motion(l, plan, *i.motion, static_cast<int>(j));
    return {m.value, m.rate, m.acceleration};
  }
  const auto place = [&](const BodyPoint& p) { return point_motion(l, plan, *i.motion, p); };
  const PartState<double> first = body_state(plan, *i.motion, joint.first.body);
  const math::Vec2 along = rotate(first.direction, math::unit(joint.slide_first));
  const PointMotion a = place(joint.first), b = place(joint.second);
  return {dot(along, b.position - a.position), dot(along, b.velocity - velocity_at(first, b.position)),
          dot(along, b.acceleration - acceleration_at(first, b.position))};
}

// The rows of the tables: what stands behind the name of a body, slide, point or joint, and the number.
namespace column_rows {
using enum Dimension;
template <class From>
struct Row {
  std::string_view key;
  Dimension dimension;
  double (*of)(const From&);
  std::string_view words = key;  ///< "_" of the key are spaces
  bool of_pair = false;          ///< the label names both bodies of the joint
};
using Body = PartState<double>;
constexpr Row<Body> body_places[] = {{"x", length, [](const Body& b) { return b.origin.x; }, "origin x"},
                                     {"y", length, [](const Body& b) { return b.origin.y; }, "origin y"}};
constexpr Row<Body> body_rates[] = {
    {"speed", speed_angular, [](const Body& b) { return b.speed; }},
    {"acceleration", acceleration_angular, [](const Body& b) { return b.angular_acceleration; }}};
using Slide = SlideMotion;
constexpr Row<Slide> slide_places[] = {
    {"displacement", length, [](const Slide& s) { return s.displacement; }}};
constexpr Row<Slide> slide_rates[] = {
    {"speed", speed, [](const Slide& s) { return s.speed; }},
    {"acceleration", acceleration, [](const Slide& s) { return s.acceleration; }}};
using Point = PointMotion;
constexpr Row<Point> point_places[] = {{"x", length, [](const Point& p) { return p.position.x; }},
                                       {"y", length, [](const Point& p) { return p.position.y; }}};
constexpr Row<Point> point_rates[] = {
    {"speed_x", speed, [](const Point& p) { return p.velocity.x; }},
    {"speed_y", speed, [](const Point& p) { return p.velocity.y; }},
    {"acceleration_x", acceleration, [](const Point& p) { return p.acceleration.x; }},
    {"acceleration_y", acceleration, [](const Point& p) { return p.acceleration.y; }}};
using Joint = JointReaction;
constexpr Row<Joint> joint_forces[] = {{"x", force, [](const Joint& j) { return j.force.x; }, "x", true},
                                       {"y", force, [](const Joint& j) { return j.force.y; }, "y", true}};
constexpr Row<Joint> tooth_forces[] = {
    {"tangential", force, [](const Joint& j) { return j.tangential; }, "along the teeth", true},
    {"separating", force, [](const Joint& j) { return j.separating; }, "that presses the wheels apart"},
    {"tooth", force, [](const Joint& j) { return norm(j.force); }, "of the teeth"},
    {"flank", none, [](const Joint& j) { return j.tangential < 0 ? -1.0 : 1.0; },
     "flank that presses, 1 or -1 as the force along the teeth"}};
constexpr Row<Joint> joint_moments[] = {
    {"moment", torque, [](const Joint& j) { return j.moment; }, "moment", true}};
using Forces = LinkageForces;
constexpr Row<Forces> shaking_forces[] = {
    {"shaking_force_x", force, [](const Forces& f) { return f.shaking_force.x; }},
    {"shaking_force_y", force, [](const Forces& f) { return f.shaking_force.y; }},
    {"shaking_force", force, [](const Forces& f) { return norm(f.shaking_force); }}};
constexpr Row<Forces> shaking_moments[] = {
    {"shaking_moment", torque, [](const Forces& f) { return f.shaking_moment; }, "without drive torques"},
    {"shaking_moment_with_drive", torque, [](const Forces& f) { return f.shaking_moment_with_drive; },
     "with the drives"}};
constexpr Row<Forces> powers[] = {
    {"drive_power", power, [](const Forces& f) { return f.drive_power; }, "power of the drives"},
    {"weight_power", power, [](const Forces& f) { return f.weight_power; }, "power of the weight"},
    {"load_power", power, [](const Forces& f) { return f.load_power; }, "power of springs and loads"},
    {"kinetic_power", power, [](const Forces& f) { return f.kinetic_power; }, "rate of the kinetic energy"}};
}  // namespace column_rows

using ColumnValue = std::function<double(const LinkageInstant&)>;
void add_column(std::vector<LinkageColumn>& out, const Quantity& what, ColumnValue value) {
  out.push_back({what.column_key(), what.label(), std::move(value)});
}

/// The numbers of what `from` gives at an instant; `pair` says who pushes whom.
template <class Rows, class From>
void add_columns(std::vector<LinkageColumn>& out, const Rows& rows, const std::string& key,
                 const std::string& name, const From& from, const std::string& pair = {}) {
  for (const auto& row : rows) {
    std::string words(row.words);
    std::replace(words.begin(), words.end(), '_', ' ');
    add_column(out,
               {key + std::string(row.key), name + words + (row.of_pair ? ", " + pair : ""), row.dimension},
               [from, of = row.of](const LinkageInstant& i) { return of(from(i)); });
  }
}

void add_reaction_columns(std::vector<LinkageColumn>& out, const Linkage& l, const LinkagePlan& plan) {
  for (std::size_t j = 0; j < l.joints.size(); ++j) {
    const LinkageJoint& joint = l.joints[j];
    const std::string pair =
        fmt::format("{} on {}", l.bodies[at(joint.first.body)].name, l.bodies[at(joint.second.body)].name);
    const auto add_rows = [&](const auto& rows) {
      add_columns(
          out, rows, identifier(joint.name) + "_", joint.name + " ",
          [j](const LinkageInstant& i) -> const JointReaction& { return i.forces->joints[j]; }, pair);
    };
    if (joint.type == JointType::rack) {
      add_rows(column_rows::tooth_forces);
      continue;
    }
    if (joint.type != JointType::gear) {
      add_rows(column_rows::joint_forces);
      add_column(out, {identifier(joint.name), joint.name, Dimension::force},
                 [j](const LinkageInstant& i) { return norm(i.forces->joints[j].force); });
    }
    const auto meshes = [j](const Group& g) {
      return std::any_of(g.gears.begin(), g.gears.end(), [j](const PlanGear& gear) {
        return gear.joint == static_cast<int>(j) && gear.mesh;
      });
    };
    const auto meshes_curved = [j](const Group& g) {
      return std::any_of(g.pairs.begin(), g.pairs.end(), [j](const PlanPair& pair) {
        const auto* curve = std::get_if<CurvePair>(&pair.kind);
        return curve && pair.joint == static_cast<int>(j) && curve->mesh;
      });
    };
    if (std::any_of(plan.groups.begin(), plan.groups.end(), meshes) ||
        std::any_of(plan.groups.begin(), plan.groups.end(), meshes_curved))
      add_rows(column_rows::tooth_forces);
    if (joint.type == JointType::prismatic || joint.type == JointType::fixed || joint.type == JointType::gear)
      add_rows(column_rows::joint_moments);
  }
  for (std::size_t c = 0; c < l.cams.size(); ++c) {
    const std::string key = identifier(l.cams[c].name) + "_", &name = l.cams[c].name;
    const std::string pair = fmt::format("{} on {}", l.bodies[at(plan.cams[c].cam_body)].name,
                                         l.bodies[at(l.cams[c].contact.body)].name);
    add_column(out, {key + "contact", fmt::format("{} contact force, {}", name, pair), Dimension::force},
               [c](const LinkageInstant& i) {
                 const CamContact& contact = i.forces->cams[c];
                 return contact.on_second ? -contact.force : contact.force;
               });
    add_column(out, {key + "pressure_angle", name + " pressure angle", Dimension::angle},
               [c](const LinkageInstant& i) { return i.forces->cams[c].pressure_angle; });
  }
  for (std::size_t s = 0; s < plan.strands.size(); ++s) {
    const PlanStrand& strand = plan.strands[s];
    const std::string &belt = l.belts[at(strand.belt)].name, &first = l.bodies[at(strand.first)].name,
                      &second = l.bodies[at(strand.second)].name;
    add_column(out,
               {fmt::format("{}_{}_{}_tension", identifier(belt), identifier(first), identifier(second)),
                fmt::format("{} tension from {} to {}", belt, first, second), Dimension::force},
               [s](const LinkageInstant& i) { return i.forces->strands[s].tangential; });
  }
}

void add_spindle_columns(std::vector<LinkageColumn>& out, const Screw& screw, const std::string& name,
                         std::size_t input) {
  const double turning = spindle_turning(screw);
  const auto add = [&](const char* key, Dimension dimension, ColumnValue value) {
    add_column(out,
               {fmt::format("{}_spindle_{}", identifier(name), key), fmt::format("{} spindle {}", name, key),
                dimension},
               std::move(value));
  };
  add("angle", Dimension::angle, [=](const LinkageInstant& i) { return turning * i.inputs[input].value; });
  add("speed", Dimension::speed_angular,
      [=](const LinkageInstant& i) { return turning * i.inputs[input].rate; });
  add("torque", Dimension::torque, [=](const LinkageInstant& i) {
    const InputMotion& nut = i.inputs[input];
    return spindle_torque(screw, i.forces->drives[input], nut.rate, nut.acceleration);
  });
}

void add_strut_columns(std::vector<LinkageColumn>& out, const Linkage& l, const LinkagePlan& plan,
                       const LinkageQuantities& q) {
  using Needs = LinkageColumn::Needs;
  for (const Strut& s : l.struts) {
    const auto add = [&](bool wanted, const char* key, Dimension dimension, Needs needs, auto value) {
      if (!wanted) return;
      add_column(out, {identifier(s.name) + "_" + key, s.name + " " + key, dimension},
                 [&l, &plan, &s, value](const LinkageInstant& i) {
                   return value(i, span_of(l, plan, *i.motion, s.first, s.second));
                 });
      out.back().needs = needs;
    };
    add(q.position, "length", Dimension::length, Needs::pose,
        [](const LinkageInstant&, const Span& span) { return span.length; });
    add(q.rates, "speed", Dimension::speed, Needs::motion,
        [](const LinkageInstant&, const Span& span) { return span.rate; });
    add(q.drive, "force", Dimension::force, Needs::motion,
        [&l, &plan, &s](const LinkageInstant& i, const Span& span) {
          const double input = i.inputs.empty() ? 0 : i.inputs[0].value;
          return beyond_stroke(s, span.length) ? nan : push_of(s, l, plan, *i.motion, span, i.time, input);
        });
    add(q.power && stores_energy(s), "energy", Dimension::energy, Needs::motion,
        [&s](const LinkageInstant&, const Span& span) {
          return beyond_stroke(s, span.length) ? nan : stored_energy(s, span.length);
        });
  }
}

// The efforts of stops. Where a drive prescribes the position, a rigid stop on which its joint stands can
// carry what the drive pushes with.
void add_stop_columns(std::vector<LinkageColumn>& out, const Linkage& l, const LinkagePlan& plan) {
  for (std::size_t k = 0; k < l.stops.size(); ++k) {
    const JointStop& s = l.stops[k];
    const bool pin = l.joints[at(s.joint)].type == JointType::revolute;
    const auto effort = [&l, &plan, &s, k, pin](const LinkageInstant& i) {
      if (s.stiffness || !i.motion->stops.empty()) return stop_effort(l, plan, *i.motion, k);
      constexpr double near = 1e-9;  // rad, and sizes of the linkage
      const double gap = stop_motion(l, plan, *i.motion, k).gap / (pin ? 1 : plan.size);
      const auto input = std::find(l.driven.begin(), l.driven.end(), s.joint);
      if (!(std::abs(gap) <= near) || input == l.driven.end()) return 0.0;
      return std::max(0.0, s.side * i.forces->drives[static_cast<std::size_t>(input - l.driven.begin())]);
    };
    const std::string name = stop_name(l, k);
    add_column(out,
               {identifier(name) + (pin ? "_torque" : "_force"), name + (pin ? " torque" : " force"),
                pin ? Dimension::torque : Dimension::force},
               effort);
    if (s.arm > 0)
      add_column(out, {identifier(name) + "_force", name + " force", Dimension::force},
                 [effort, arm = s.arm](const LinkageInstant& i) { return effort(i) / arm; });
  }
}

}  // namespace

std::vector<LinkageColumn> linkage_columns(const Linkage& l, const LinkagePlan& plan,
                                           const LinkageQuantities& q, const std::vector<BodyPoint>& traces) {
  std::vector<LinkageColumn> out;
  const auto bodies = [&](const auto& rows, const auto& before) {
    for (int b = 1; b < static_cast<int>(l.bodies.size()); ++b) {
      if (plan.bodies[at(b)].part == 0) continue;
      const std::string &name = l.bodies[at(b)].name, key = identifier(name) + "_";
      before(b, key, name + " ");
      add_columns(out, rows, key, name + " ",
                  [&plan, b](const LinkageInstant& i) { return body_state(plan, *i.motion, b); });
    }
  };
  const auto traced = [&](const auto& rows) {
    for (const BodyPoint& t : traces) {
      const LinkageBody& body = l.bodies[at(t.body)];
      const LinkagePoint& point = body.points[at(t.point)];
      add_columns(out, rows, identifier(body.name) + "_" + identifier(point.name) + "_",
                  body.name + "." + point.name + " ",
                  [&plan, b = t.body, p = point.at](const LinkageInstant& i) {
                    return point_motion(plan, *i.motion, b, p);
                  });
    }
  };
  const auto slides = [&](const auto& rows, bool with_inputs) {
    for (std::size_t j = 0; j < l.joints.size(); ++j) {
      const bool driven = std::find(l.driven.begin(), l.driven.end(), static_cast<int>(j)) != l.driven.end();
      const bool slides = l.joints[j].type == JointType::prismatic || l.joints[j].slot;
      if (slides && (with_inputs || !driven))
        add_columns(out, rows, identifier(l.joints[j].name) + "_", l.joints[j].name + " ",
                    [&l, &plan, j](const LinkageInstant& i) { return slide_motion(l, plan, i, j); });
    }
  };
  if (q.position) {
    bodies(column_rows::body_places, [&](int b, const std::string& key, const std::string& name) {
      add_column(out, {key + "angle", name + "angle", Dimension::angle},
                 [&plan, b](const LinkageInstant& i) { return angle_with_turns(plan, i, b); });
      out.back().angle = true;
      out.back().counted = plan.turned[at(plan.bodies[at(b)].part)].has_value();
    });
    slides(column_rows::slide_places, false);
    traced(column_rows::point_places);
  }
  for (LinkageColumn& c : out) c.needs = LinkageColumn::Needs::pose;
  if (q.rates) {
    bodies(column_rows::body_rates, [](auto&&...) {});
    slides(column_rows::slide_rates, true);
    traced(column_rows::point_rates);
  }
  if (q.reactions) add_reaction_columns(out, l, plan);
  if (q.drive)
    for (std::size_t k = 0; k < plan.inputs(); ++k) {
      const std::string& name = input_joint(l, k).name;
      if (const auto& screw = input_joint(l, k).screw) add_spindle_columns(out, *screw, name, k);
      out.push_back({identifier(name) + (plan.rotary[k] ? "_drive_torque_N_m" : "_drive_force_N"),
                     fmt::format("drive {} at {}", plan.rotary[k] ? "torque (N m)" : "force (N)", name),
                     [k](const LinkageInstant& i) { return i.forces->drives[k]; }});
    }
  const auto forces = [](const LinkageInstant& i) -> const LinkageForces& { return *i.forces; };
  if (q.drive) add_stop_columns(out, l, plan);
  if (q.shaking) {
    add_columns(out, column_rows::shaking_forces, "", "", forces);
    add_columns(out, column_rows::shaking_moments, "", "shaking moment about " + moment_centre_name(l) + ", ",
                forces);
  }
  if (q.transmission_angle)
    for (std::size_t g = 0; g < plan.groups.size(); ++g)
      if (plan.groups[g].as<Dyad>())
        add_column(out,
                   {group_key(plan.groups[g].name) + "_transmission_angle",
                    plan.groups[g].name + " transmission angle", Dimension::angle},
                   [g](const LinkageInstant& i) {
                     return std::asin(std::min(1.0, std::abs(i.motion->groups[g].sine)));
                   });
  if (q.power) add_columns(out, column_rows::powers, "", "", forces);
  add_strut_columns(out, l, plan, q);
  add_column(out, {"closure_residual", "closure residual", Dimension::length},
             [](const LinkageInstant& i) { return i.motion->closure_residual; });
  return out;
}

}  // namespace linkwright::planar
