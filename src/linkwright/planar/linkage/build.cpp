#include "linkwright/planar/linkage/build.h"

#include <algorithm>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {

int body_named(const Linkage& linkage, std::string_view name) {
  const int body = body_index(linkage, name);
  LINKWRIGHT_REQUIRE(body >= 0, "there is no body '{}'", name);
  return body;
}

int add_joint(Linkage& linkage, LinkageJoint joint) {
  linkage.joints.push_back(std::move(joint));
  return static_cast<int>(linkage.joints.size()) - 1;
}

double reach(const LinkageBody& body) {
  double out = 0;
  for (const LinkagePoint& p : body.points)
    for (const LinkagePoint& q : body.points) out = std::max(out, std::abs(p.at - q.at));
  return out;
}

}  // namespace

Linkage grounded(std::vector<LinkagePoint> points) {
  Linkage l;
  l.bodies.push_back({"ground", std::move(points), {}, {}, {}});
  return l;
}

int add_body(Linkage& linkage, std::string name, std::vector<LinkagePoint> points) {
  linkage.bodies.push_back({std::move(name), std::move(points), {}, {}, {}});
  return static_cast<int>(linkage.bodies.size()) - 1;
}

int add_bar(Linkage& linkage, std::string name, std::string from, std::string to, double length) {
  return add_body(linkage, std::move(name), {{std::move(from), {0, 0}}, {std::move(to), {length, 0}}});
}

int add_drawn(Linkage& linkage, std::string name, std::vector<LinkagePoint> points) {
  const int body = add_body(linkage, std::move(name), std::move(points));
  linkage.bodies.back().start = math::Pose{};
  return body;
}

void set_start(Linkage& linkage, std::string_view body, std::complex<double> origin, double angle) {
  linkage.bodies[static_cast<std::size_t>(body_named(linkage, body))].start =
      math::Pose{origin.real(), origin.imag(), angle};
}

BodyPoint point_named(const Linkage& linkage, std::string_view name) {
  const auto dot = name.rfind('.');
  LINKWRIGHT_REQUIRE(dot != std::string_view::npos, "'{}' is not a point: write body.point", name);
  const int body = body_named(linkage, name.substr(0, dot));
  const int point = point_index(linkage.bodies[static_cast<std::size_t>(body)], name.substr(dot + 1));
  LINKWRIGHT_REQUIRE(point >= 0, "body '{}' has no point '{}'", name.substr(0, dot), name.substr(dot + 1));
  return {body, point};
}

std::vector<BodyPoint> points_named(const Linkage& linkage, std::initializer_list<std::string_view> names) {
  std::vector<BodyPoint> out;
  for (std::string_view name : names) out.push_back(point_named(linkage, name));
  return out;
}

int add_pin(Linkage& linkage, std::string name, std::string_view first, std::string_view second) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::revolute,
                             .first = point_named(linkage, first),
                             .second = point_named(linkage, second)});
}
int add_slide(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
              double direction_first, double direction_second) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::prismatic,
                             .first = point_named(linkage, first),
                             .second = point_named(linkage, second),
                             .slide_first = direction_first,
                             .slide_second = direction_second});
}
int add_slot(Linkage& linkage, std::string name, std::string_view slot, std::string_view pin,
             double direction) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::pin_in_slot,
                             .first = point_named(linkage, slot),
                             .second = point_named(linkage, pin),
                             .slide_first = direction});
}
int add_weld(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double angle) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::fixed,
                             .first = point_named(linkage, first),
                             .second = point_named(linkage, second),
                             .slide_first = angle});
}
int add_gear(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double ratio, double phase, std::string_view carrier) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::gear,
                             .first = {body_named(linkage, first), 0},
                             .second = {body_named(linkage, second), 0},
                             .ratio = ratio,
                             .phase = phase,
                             .carrier = body_named(linkage, carrier)});
}

void add_drive(Linkage& linkage, std::string_view joint) {
  const int j = joint_index(linkage, joint);
  LINKWRIGHT_REQUIRE(j >= 0, "there is no joint '{}'", joint);
  linkage.driven.push_back(j);
}

void set_mode(Linkage& linkage, std::string_view first, std::string_view second, AssemblyMode mode) {
  linkage.modes.push_back({body_named(linkage, first), body_named(linkage, second), mode});
}

void set_uniform(Linkage& linkage, std::string_view name, double mass) {
  LinkageBody& body = linkage.bodies[static_cast<std::size_t>(body_named(linkage, name))];
  LINKWRIGHT_REQUIRE(!body.points.empty(), "body '{}' has no points", name);
  const auto n = static_cast<double>(body.points.size());
  std::complex<double> centre = 0;
  for (const LinkagePoint& p : body.points) centre += p.at / n;
  double spread = 0;
  for (const LinkagePoint& p : body.points) spread += std::norm(p.at - centre) / n;
  // Two equal masses at the ends of a bar have three times the inertia of the bar.
  body.mass = BodyMass{mass, mass * (body.points.size() == 2 ? spread / 3 : spread), centre};
}

void set_uniform_all(Linkage& linkage, double mass_per_metre) {
  const double least = 0.1 * size_of(linkage);
  for (std::size_t b = 1; b < linkage.bodies.size(); ++b)
    set_uniform(linkage, linkage.bodies[b].name, mass_per_metre * std::max(reach(linkage.bodies[b]), least));
}

}  // namespace linkwright::planar
