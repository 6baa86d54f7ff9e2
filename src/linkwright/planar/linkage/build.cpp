// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/build.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/tolerance.h"

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

// Corners of the smallest convex polygon around the points, counter-clockwise from the lowest of the
// leftmost; its two ends when they lie on a line to rounding, one when they coincide.
std::vector<std::complex<double>> hull(std::vector<std::complex<double>> points) {
  double size = 0;
  for (const auto& p : points) size = std::max(size, std::abs(p - points[0]));
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  const auto turns_left = [&](const auto& a, const auto& b, const auto& c) {
    return std::imag(std::conj(b - a) * (c - a)) > tolerance::closure * size * size;
  };
  std::vector<std::complex<double>> out;
  for (const bool back : {false, true}) {
    const std::size_t first = out.size();
    for (const auto& p : points) {
      while (out.size() >= first + 2 && !turns_left(out[out.size() - 2], out.back(), p)) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();  // the first of the return path
    if (!back) std::reverse(points.begin(), points.end());
  }
  if (size == 0) out.assign(1, points[0]);
  return out;
}

// The shape of a body with its mass spread evenly over a bar or plate: its centre, and the mean square of the
// distances from it.
struct UniformShape {
  std::complex<double> centre;
  double square = 0;
};
UniformShape uniform_shape(const std::vector<std::complex<double>>& corners) {
  const std::complex<double> first = corners[0];
  if (corners.size() == 1) return {first, 0};
  if (corners.size() == 2) return {(first + corners[1]) / 2.0, std::norm(corners[1] - first) / 12};
  // Triangles from the first corner: a third of the sum of their corners, a sixth of the sum of products.
  double area = 0, square = 0;
  std::complex<double> moment = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const std::complex<double> u = corners[k] - first, v = corners[k + 1] - first;
    const double twice = std::imag(std::conj(u) * v);
    area += twice / 2;
    moment += twice / 6 * (u + v);
    square += twice / 12 * (std::norm(u) + std::norm(v) + std::real(std::conj(u) * v));
  }
  const std::complex<double> arm = moment / area;
  return {first + arm, square / area - std::norm(arm)};
}

// Points that carry a body without a shape of its own: its joints; when these are one place, what else holds
// or loads it; else all its points.
std::vector<std::complex<double>> outline_points(const Linkage& linkage, int body) {
  const std::vector<LinkagePoint>& points = linkage.bodies[static_cast<std::size_t>(body)].points;
  std::vector<std::complex<double>> out;
  const auto add = [&](const BodyPoint& p) {
    if (p.body == body && p.point >= 0 && static_cast<std::size_t>(p.point) < points.size())
      out.push_back(points[static_cast<std::size_t>(p.point)].at);
  };
  const auto one_place = [&] {
    return std::all_of(out.begin(), out.end(), [&](const auto& p) { return p == out[0]; });
  };
  for (const LinkageJoint& j : linkage.joints)
    if (j.type != JointType::gear) add(j.first), add(j.second);
  if (!one_place()) return out;
  for (const LinearSpring& s : linkage.springs) add(s.first), add(s.second);
  for (const PointForce& f : linkage.forces) add(f.point);
  for (const Strut& s : linkage.struts) add(s.first), add(s.second);
  if (!one_place()) return out;
  for (const LinkagePoint& p : points) out.push_back(p.at);
  return out;
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

int add_rack(Linkage& linkage, std::string name, std::string_view pinion, std::string_view rack,
             double radius, double direction, double phase) {
  return add_joint(linkage, {.name = std::move(name),
                             .type = JointType::rack,
                             .first = point_named(linkage, pinion),
                             .second = point_named(linkage, rack),
                             .slide_second = direction,
                             .phase = phase,
                             .radius = radius});
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
  const int b = body_named(linkage, name);
  LinkageBody& body = linkage.bodies[static_cast<std::size_t>(b)];
  LINKWRIGHT_REQUIRE(!body.points.empty(), "body '{}' has no points", name);
  const std::vector<std::complex<double>> outline = hull(outline_points(linkage, b));
  const UniformShape shape = uniform_shape(outline);
  body.mass = BodyMass{mass, mass * shape.square, shape.centre};
}

void set_uniform_all(Linkage& linkage, double mass_per_metre) {
  const double least = 0.1 * size_of(linkage);
  for (std::size_t b = 1; b < linkage.bodies.size(); ++b)
    set_uniform(linkage, linkage.bodies[b].name, mass_per_metre * std::max(reach(linkage.bodies[b]), least));
}

}  // namespace linkwright::planar
