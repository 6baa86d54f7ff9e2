// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/form.h"

#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <string_view>

#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

std::complex<double> number(const Place& p) { return {p[0], p[1]}; }
Place place(std::complex<double> z) { return {z.real(), z.imag()}; }

// Resolves names against the bodies that exist.
class Names {
 public:
  Names(const Linkage& linkage, std::vector<FormProblem>& problems) : l_(linkage), problems_(problems) {}

  void at(std::string list, std::size_t index) { list_ = std::move(list), index_ = index; }
  int body(const std::string& key, const std::string& name) {
    const int found = body_index(l_, name);
    if (found < 0) {
      std::vector<std::string_view> known;
      for (const LinkageBody& b : l_.bodies) known.push_back(b.name);
      problem(key, fmt::format("there is no body '{}'", name), nearest(name, known));
    }
    return std::max(found, 0);
  }
  BodyPoint point(const std::string& key, const std::string& name) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) {
      problem(key, fmt::format("'{}' is not a point", name), "write body.point, as \"crank.A\"");
      return {};
    }
    const std::size_t before = problems_.size();
    const int b = body(key, name.substr(0, dot));
    if (problems_.size() > before) return {};
    const LinkageBody& body = l_.bodies[static_cast<std::size_t>(b)];
    const int p = point_index(body, name.substr(dot + 1));
    if (p < 0) {
      std::vector<std::string_view> known;
      for (const LinkagePoint& q : body.points) known.push_back(q.name);
      problem(key, fmt::format("body '{}' has no point '{}'", body.name, name.substr(dot + 1)),
              nearest(name.substr(dot + 1), known));
    }
    return {b, std::max(p, 0)};
  }
  void problem(const std::string& key, std::string message, std::string hint) {
    problems_.push_back({list_, index_, key, std::move(message), std::move(hint)});
  }

 private:
  static std::string nearest(std::string_view name, const std::vector<std::string_view>& known) {
    std::string all;
    for (std::string_view k : known) all += fmt::format("{}{}", all.empty() ? "there are: " : ", ", k);
    return did_you_mean(name, known, all);
  }
  const Linkage& l_;
  std::vector<FormProblem>& problems_;
  std::string list_;
  std::size_t index_ = 0;
};

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

}  // namespace

Linkage linkage_of(const LinkageForm& form, std::vector<FormProblem>& problems) {
  Linkage l;
  for (const BodyForm& b : form.bodies) l.bodies.push_back(body_of(b, form.drawn));
  l.moment_centre = number(form.moment_centre);
  Names names(l, problems);
  if (l.bodies.empty()) {
    names.problem("body", "the linkage has no bodies",
                  "add [[mechanism.body]] tables; the first is the ground");
    return l;
  }
  for (std::size_t i = 0; i < form.joints.size(); ++i) {
    const JointForm& f = form.joints[i];
    names.at("joint", i);
    LinkageJoint j{.name = f.name, .type = f.type};
    if (f.type == JointType::gear) {
      j.first = {names.body("first", f.first), 0};
      j.second = {names.body("second", f.second), 0};
      j.carrier = names.body("carrier", f.carrier);
      if (f.pressure_angle) j.pressure_angle = *f.pressure_angle;
    } else {
      j.first = names.point("first", f.first);
      j.second = names.point("second", f.second);
    }
    j.slide_first = f.direction;
    j.slide_second =
        f.direction_second.value_or(form.drawn && (f.type == JointType::prismatic) ? f.direction : 0.0);
    j.ratio = f.ratio, j.phase = f.phase;
    j.friction = f.friction, j.pin_radius = f.pin_radius, j.guide_length = f.guide_length;
    l.joints.push_back(std::move(j));
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
  for (std::size_t i = 0; i < form.springs.size(); ++i) {
    const SpringForm& s = form.springs[i];
    names.at("spring", i);
    l.springs.push_back({s.name, names.point("first", s.first), names.point("second", s.second), s.stiffness,
                         s.free_length, s.damping});
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
    l.forces.push_back(
        {f.name, names.point("point", f.point), number(f.force), f.turns_with_body, factor_of(f.factor)});
  }
  for (std::size_t i = 0; i < form.torques.size(); ++i) {
    const TorqueForm& t = form.torques[i];
    names.at("torque", i);
    l.torques.push_back(
        {t.name, names.body("body", t.body), names.body("from", t.from), t.torque, factor_of(t.factor)});
  }
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
    form.bodies.push_back(std::move(f));
  }
  for (const LinkageJoint& j : l.joints) {
    JointForm f{.name = j.name, .type = j.type};
    const bool gear = j.type == JointType::gear;
    f.first = gear ? body(j.first.body) : point(j.first);
    f.second = gear ? body(j.second.body) : point(j.second);
    f.direction = j.slide_first;
    if (j.type == JointType::prismatic || j.type == JointType::fixed) f.direction_second = j.slide_second;
    f.ratio = j.ratio, f.phase = j.phase, f.carrier = body(j.carrier);
    if (gear) f.pressure_angle = j.pressure_angle;
    f.friction = j.friction, f.pin_radius = j.pin_radius, f.guide_length = j.guide_length;
    form.joints.push_back(std::move(f));
  }
  for (const DyadMode& m : l.modes) form.assembly.push_back({{body(m.first), body(m.second)}, m.mode});
  for (const LinearSpring& s : l.springs)
    form.springs.push_back({s.name, point(s.first), point(s.second), s.stiffness, s.free_length, s.damping});
  for (const TorsionSpring& s : l.torsion_springs)
    form.torsion_springs.push_back(
        {s.name, body(s.first), body(s.second), s.stiffness, s.free_angle, s.damping});
  for (const PointForce& f : l.forces)
    form.forces.push_back({f.name, point(f.point), place(f.force), f.turns_with_body, form_of(f.factor)});
  for (const BodyTorque& t : l.torques)
    form.torques.push_back({t.name, body(t.body), body(t.from), t.torque, form_of(t.factor)});
  return form;
}

}  // namespace linkwright::planar
