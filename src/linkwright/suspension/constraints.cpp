#include "linkwright/suspension/constraints.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/structure.h"
#include "linkwright/suspension/wheel.h"

namespace linkwright::suspension {
namespace {

/// One equation: a sum of weights on moving points.
struct Row {
  std::array<double, most_unknowns>& of;
  double& by_rack;

  void add(const Vec3& weight, const Vec3& turn) {
    of[0] += weight.x;
    of[1] += weight.y;
    of[2] += weight.z;
    of[3] += turn.x;
    of[4] += turn.y;
    of[5] += turn.z;
  }
  /// weight . (shift of the carrier's point at `offset` from the wheel centre)
  void point(const Vec3& weight, const Vec3& offset) { add(weight, cross(offset, weight)); }
  void turn(const Vec3& weight) { add({}, weight); }
};

struct Writer {
  GuideEquations& out;
  int next = 0;
  Row row(double residual) {
    out.residual[next] = residual;
    out.jacobian[next] = {};
    out.by_rack[next] = 0;
    Row made{out.jacobian[next], out.by_rack[next]};
    ++next;
    return made;
  }
};

constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// A place with what many rows use.
struct Placed {
  const GuidePlan& plan;
  const GuidePlace& at;
  double rack;

  Vec3 offset(const Vec3& reference) const { return at.carrier.rotation * reference; }
  Vec3 point(const Vec3& turned) const { return at.carrier.centre + turned; }
  Vec3 body(const LinkConstants& link, int i) const {
    return link.moved_by_rack ? link.body[i] + rack * plan.rack_direction : link.body[i];
  }
  Vec3 rack_speed(const LinkConstants& link) const {
    return link.moved_by_rack ? plan.rack_direction : Vec3{};
  }
};

Vec3 affine(const AffinePoint& at, const Vec3& p, const Vec3& f1, const Vec3& f2) {
  return p + at.a * f1 + at.b * f2 + at.k * cross(f1, f2);
}

AffinePoint affine_of(const Vec3& point, const Vec3& p, const Vec3& q, const Vec3& s) {
  const Vec3 f1 = q - p, f2 = s - p, normal = cross(f1, f2), d = point - p;
  const double area = dot(normal, normal);
  return {dot(cross(d, f2), normal) / area, dot(cross(f1, d), normal) / area, dot(d, normal) / area};
}

/// Weights on f1 and f2 that give weight . (a f1 + b f2 + k f1 x f2) to first order.
std::array<Vec3, 2> affine_weights(const AffinePoint& at, const Vec3& weight, const Vec3& f1,
                                   const Vec3& f2) {
  return {at.a * weight + at.k * cross(f2, weight), at.b * weight + at.k * cross(weight, f1)};
}

/// A point of a link and how it moves: adds weight . (its shift) to a row.
struct LinkPoint {
  Vec3 at;
  const LinkConstants* link = nullptr;  ///< null = the carrier
  Vec3 offset;                          ///< carrier
  double fraction = 0;                  ///< KS
  AffinePoint affine;                   ///< SR: from the first hinge point; RS: from the first body point
  Vec3 f1, f2, r1, r2;
};

LinkPoint rod_point(const Placed& placed, const LinkConstants& link, double fraction) {
  LinkPoint out{.link = &link, .fraction = fraction};
  out.r1 = placed.offset(link.offset[0]);
  const Vec3 from = placed.body(link, 0);
  out.at = from + fraction * (placed.point(out.r1) - from);
  return out;
}

LinkPoint frame_point(const Placed& placed, const LinkConstants& link, const AffinePoint& point) {
  LinkPoint out{.link = &link, .affine = point};
  out.r1 = placed.offset(link.offset[0]);
  if (link.type == LinkType::SR) {  // P, Q, S = hinge point, ball joint at the body, other hinge point
    out.r2 = placed.offset(link.offset[1]);
    const Vec3 p = placed.point(out.r1);
    out.f1 = placed.body(link, 0) - p;
    out.f2 = out.r2 - out.r1;
    out.at = affine(point, p, out.f1, out.f2);
  } else {  // RS: hinge point, other hinge point, ball joint at the carrier
    const Vec3 p = placed.body(link, 0);
    out.f1 = link.body[1] - link.body[0];
    out.f2 = placed.point(out.r1) - p;
    out.at = affine(point, p, out.f1, out.f2);
  }
  return out;
}

void add_point(const Placed& placed, const LinkPoint& point, const Vec3& weight, Row& row) {
  const LinkConstants& link = *point.link;
  const Vec3 speed = placed.rack_speed(link);
  if (link.type == LinkType::SR) {
    const auto [w1, w2] = affine_weights(point.affine, weight, point.f1, point.f2);
    row.point(weight - w1 - w2, point.r1);
    row.point(w2, point.r2);
    row.by_rack += dot(w1, speed);
  } else if (link.type == LinkType::RS) {
    const Vec3 w2 = affine_weights(point.affine, weight, point.f1, point.f2)[1];
    row.point(w2, point.r1);
    row.by_rack += dot(weight - w2, speed);
  } else {
    row.point(point.fraction * weight, point.r1);
    row.by_rack += (1 - point.fraction) * dot(weight, speed);
  }
}

/// Residual of a distance that should be `length`, and the weight on the end that moves.
double distance_residual(const Vec3& d, double length) {
  return (dot(d, d) - length * length) / (2 * length);
}

void write_distance(const Placed& placed, const LinkConstants& link, int body, int carrier, int which,
                    Writer& to) {
  const Vec3 r = placed.offset(link.offset[carrier]);
  const Vec3 d = placed.point(r) - placed.body(link, body);
  const double length = link.length[which];
  Row row = to.row(distance_residual(d, length));
  const Vec3 weight = (1 / length) * d;
  row.point(weight, r);
  row.by_rack = -dot(weight, placed.rack_speed(link));
}

void write_meeting(const Placed& placed, const LinkConstants& link, const Vec3& r, const Vec3& target,
                   Writer& to) {
  const Vec3 miss = placed.point(r) - target, speed = placed.rack_speed(link);
  const std::array<double, 3> residual{miss.x, miss.y, miss.z}, by_rack{-speed.x, -speed.y, -speed.z};
  for (int k = 0; k < 3; ++k) {
    Row row = to.row(residual[k]);
    row.point(axes[k], r);
    row.by_rack = by_rack[k];
  }
}

void write_link(const Placed& placed, const LinkConstants& link, Writer& to) {
  switch (link.type) {
    case LinkType::KS:
    case LinkType::SS:
      write_distance(placed, link, 0, 0, 0, to);
      return;
    case LinkType::RS:
      write_distance(placed, link, 0, 0, 0, to);
      write_distance(placed, link, 1, 0, 1, to);
      return;
    case LinkType::SR:
      write_distance(placed, link, 0, 0, 0, to);
      write_distance(placed, link, 0, 1, 1, to);
      return;
    case LinkType::SP: {
      const Vec3 r = placed.offset(link.offset[0]), d = placed.point(r) - placed.body(link, 0);
      for (const Vec3& normal : link.across) {
        const Vec3 n = placed.offset(normal);
        Row row = to.row(dot(d, n));
        row.point(n, r);
        row.turn(cross(n, d));
        row.by_rack = -dot(n, placed.rack_speed(link));
      }
      return;
    }
    case LinkType::S:
      write_meeting(placed, link, placed.offset(link.offset[0]), placed.body(link, 0), to);
      return;
    case LinkType::R: {
      write_meeting(placed, link, placed.offset(link.offset[0]), placed.body(link, 0), to);
      const Vec3 w = placed.offset(link.carrier_axis);
      for (const Vec3& normal : link.across) to.row(dot(w, normal)).turn(cross(w, normal));
      return;
    }
    case LinkType::RR: {
      const Vec3 p0 = placed.body(link, 0);
      const Mat3 arm = math::turn_about(placed.at.arm * link.axis);
      const Vec3 reach = arm * (placed.plan.wheel.centre + link.offset[0] - link.body[0]);
      const int first = to.next;
      write_meeting(placed, link, placed.offset(link.offset[0]), p0 + reach, to);
      const Vec3 by_arm = cross(link.axis, reach);
      to.out.jacobian[first][6] = -by_arm.x;
      to.out.jacobian[first + 1][6] = -by_arm.y;
      to.out.jacobian[first + 2][6] = -by_arm.z;
      const Vec3 w = placed.offset(link.carrier_axis);
      for (const Vec3& normal : link.across) {
        const Vec3 n = arm * normal;
        Row row = to.row(dot(w, n));
        row.turn(cross(w, n));
        row.of[6] = dot(w, cross(link.axis, n));
      }
      return;
    }
  }
}

struct CouplerEnds {
  LinkPoint first, second;
  Vec3 between;
};

CouplerEnds ends(const Placed& placed, const CouplerConstants& coupler) {
  CouplerEnds out{rod_point(placed, placed.plan.links[coupler.first], coupler.fraction),
                  frame_point(placed, placed.plan.links[coupler.second], coupler.point),
                  {}};
  out.between = out.second.at - out.first.at;
  return out;
}

void write_coupler(const Placed& placed, const CouplerConstants& coupler, Writer& to) {
  const CouplerEnds at = ends(placed, coupler);
  Row row = to.row(distance_residual(at.between, coupler.length));
  const Vec3 weight = (1 / coupler.length) * at.between;
  add_point(placed, at.second, weight, row);
  add_point(placed, at.first, -weight, row);
}

/// Length of the spring; adds its derivatives to the row.
double spring_length(const Placed& placed, Row& row) {
  const SpringConstants& spring = *placed.plan.spring;
  const LinkConstants* link = spring.link < 0 ? nullptr : &placed.plan.links[spring.link];
  const auto pull = [&](const Vec3& end) {
    const Vec3 d = end - spring.body;
    return std::pair{norm(d), unit(d)};
  };
  if (!link) {
    const Vec3 r = placed.offset(spring.offset);
    const auto [length, weight] = pull(placed.point(r));
    row.point(weight, r);
    return length;
  }
  if (link->type == LinkType::RR) {
    const Vec3 reach = math::turn_about(placed.at.arm * link->axis) * spring.offset;
    const auto [length, weight] = pull(placed.body(*link, 0) + reach);
    row.of[6] += dot(weight, cross(link->axis, reach));
    row.by_rack += dot(weight, placed.rack_speed(*link));
    return length;
  }
  const bool rod = link->type == LinkType::KS || link->type == LinkType::SS;
  const LinkPoint end =
      rod ? rod_point(placed, *link, spring.fraction) : frame_point(placed, *link, spring.point);
  const auto [length, weight] = pull(end.at);
  add_point(placed, end, weight, row);
  return length;
}

/// Value of the driver's coordinate; its derivatives go to the row, which starts as zeros.
double write_driver(const Placed& placed, Driver driver, Row& row) {
  const GuideWheel& wheel = placed.plan.wheel;
  const double rise = placed.at.carrier.centre.z - wheel.centre.z;
  switch (driver) {
    case Driver::wheel_centre_z:
      row.of[2] = 1;
      return rise;
    case Driver::contact_z: {
      const Vec3 u = placed.offset(placed.plan.wheel_axis);
      const double cosine = std::sqrt(1 - u.z * u.z), radius = wheel.tyre_diameter / 2;
      row.add({0, 0, 1}, (radius * u.z / cosine) * cross(u, Vec3{0, 0, 1}));
      return rise - radius * (cosine - std::cos(wheel.camber));
    }
    case Driver::spring:
      return spring_length(placed, row) - placed.plan.spring->length;
  }
  return 0;
}

void require_spring(const GuidePlan& plan, Driver driver) {
  LINKWRIGHT_REQUIRE(driver != Driver::spring || plan.spring,
                     "the driver is the spring, and the guide has none");
}

}  // namespace

GuidePlan prepare(const WheelGuide& guide) {
  const Diagnostics problems = check(guide);
  LINKWRIGHT_REQUIRE(problems.empty(), "{} problems, the first: {}", problems.size(),
                     to_string(problems.front()));
  const int freedoms = mobility(structure_of(guide), static_cast<int>(guide.couplers.size()));
  LINKWRIGHT_REQUIRE(freedoms == 1, "the count of constraints leaves {} freedoms", freedoms);

  GuidePlan plan{.side = guide.side,
                 .wheel = guide.wheel,
                 .wheel_axis = wheel_axis(guide.side, guide.wheel.toe, guide.wheel.camber),
                 .rack_direction = guide.rack_direction};
  const Vec3& centre = guide.wheel.centre;
  plan.contact = centre + contact_offset(guide.side, guide.wheel.tyre_diameter,
                                         {guide.wheel.toe, guide.wheel.camber, 0});
  for (int i = 0; i < static_cast<int>(guide.links.size()); ++i) {
    const GuideLink& from = guide.links[i];
    LinkConstants link{.type = from.type, .moved_by_rack = from.moved_by_rack};
    for (std::size_t k = 0; k < from.body.size(); ++k) link.body[k] = from.body[k];
    for (std::size_t k = 0; k < from.carrier.size(); ++k) link.offset[k] = from.carrier[k] - centre;
    if (from.body.size() == 2) link.axis = unit(from.body[1] - from.body[0]);
    switch (from.type) {
      case LinkType::KS:
      case LinkType::SS:
        link.length[0] = from.length.value_or(norm(from.carrier[0] - from.body[0]));
        break;
      case LinkType::RS:
        for (int k = 0; k < 2; ++k) link.length[k] = norm(from.carrier[0] - from.body[k]);
        break;
      case LinkType::SR:
        for (int k = 0; k < 2; ++k) link.length[k] = norm(from.carrier[k] - from.body[0]);
        break;
      case LinkType::SP:
        link.axis = unit(from.carrier[0] - from.body[0]);
        link.across = math::across(link.axis);
        break;
      case LinkType::S:
        link.offset[0] = from.body[0] - centre;
        break;
      case LinkType::R:
        link.offset[0] = from.body[0] - centre;
        link.carrier_axis = link.axis;
        link.across = math::across(link.axis);
        break;
      case LinkType::RR:
        link.carrier_axis = unit(from.carrier[1] - from.carrier[0]);
        link.across = math::across(link.carrier_axis);
        plan.unknowns = 7;
        break;
    }
    plan.links.push_back(link);
    plan.labels.push_back(link_label(guide, i));
  }
  for (const Coupler& from : guide.couplers) {
    const GuideLink &rod = guide.links[from.first], &second = guide.links[from.second];
    CouplerConstants coupler{.first = from.first, .second = from.second, .fraction = from.fraction};
    coupler.point = affine_of(from.point, second.carrier[0], second.body[0], second.carrier[1]);
    coupler.length = norm(from.point - (rod.body[0] + from.fraction * (rod.carrier[0] - rod.body[0])));
    plan.couplers.push_back(coupler);
    plan.labels.push_back(from.name.empty() ? "coupler " + std::to_string(plan.couplers.size()) : from.name);
  }
  if (guide.spring) {
    const GuideSpring& from = *guide.spring;
    SpringConstants spring{.body = from.body,
                           .offset = from.moving - centre,
                           .link = from.link,
                           .length = norm(from.moving - from.body)};
    if (from.link >= 0) {
      const GuideLink& link = guide.links[from.link];
      if (link.type == LinkType::RR) {
        spring.offset = from.moving - link.body[0];
      } else if (link.type == LinkType::RS) {
        spring.point = affine_of(from.moving, link.body[0], link.body[1], link.carrier[0]);
      } else if (link.type == LinkType::SR) {
        spring.point = affine_of(from.moving, link.carrier[0], link.body[0], link.carrier[1]);
      } else {
        const Vec3 along = link.carrier[0] - link.body[0];
        spring.fraction = dot(from.moving - link.body[0], along) / dot(along, along);
      }
    }
    plan.spring = spring;
  }
  return plan;
}

void evaluate(const GuidePlan& plan, const GuidePlace& place, double rack, Driver driver, double value,
              GuideEquations& out) {
  require_spring(plan, driver);
  const Placed placed{plan, place, rack};
  Writer to{out};
  for (const LinkConstants& link : plan.links) write_link(placed, link, to);
  for (const CouplerConstants& coupler : plan.couplers) write_coupler(placed, coupler, to);
  const int last = to.next;
  Row row = to.row(0);
  out.residual[last] = write_driver(placed, driver, row) - value;
}

double driver_value(const GuidePlan& plan, const GuidePlace& place, double rack, Driver driver) {
  require_spring(plan, driver);
  std::array<double, most_unknowns> unused{};
  double by_rack = 0;
  Row row{unused, by_rack};
  return write_driver({plan, place, rack}, driver, row);
}

double driver_rate(const GuidePlan& plan, const GuidePlace& place, double rack, Driver driver,
                   const Twist& twist, double rack_rate) {
  require_spring(plan, driver);
  std::array<double, most_unknowns> by{};
  double by_rack = 0;
  Row row{by, by_rack};
  write_driver({plan, place, rack}, driver, row);
  return dot(Vec3{by[0], by[1], by[2]}, twist.velocity) + dot(Vec3{by[3], by[4], by[5]}, twist.turning) +
         by[6] * twist.arm + by_rack * rack_rate;
}

Misfit worst_misfit(const GuidePlan& plan, const GuidePlace& place, double rack) {
  const Placed placed{plan, place, rack};
  Misfit worst;
  const auto keep = [&](int link, double gap) {
    if (std::abs(gap) > std::abs(worst.gap) || worst.link < 0) worst = {link, gap};
  };
  const int links = static_cast<int>(plan.links.size());
  for (int i = 0; i < links; ++i) {
    const LinkConstants& link = plan.links[i];
    const auto point = [&](int k) { return placed.point(placed.offset(link.offset[k])); };
    const Vec3 d = point(0) - placed.body(link, 0);
    switch (link.type) {
      case LinkType::KS:
      case LinkType::SS:
        keep(i, norm(d) - link.length[0]);
        break;
      case LinkType::RS:
        keep(i, norm(d) - link.length[0]);
        keep(i, norm(point(0) - placed.body(link, 1)) - link.length[1]);
        break;
      case LinkType::SR:
        keep(i, norm(d) - link.length[0]);
        keep(i, norm(point(1) - placed.body(link, 0)) - link.length[1]);
        break;
      case LinkType::SP:
        keep(i, norm(cross(d, placed.offset(link.axis))));
        break;
      case LinkType::S:
      case LinkType::R:
        keep(i, norm(d));
        break;
      case LinkType::RR:
        keep(i, norm(d - math::turn_about(place.arm * link.axis) *
                             (plan.wheel.centre + link.offset[0] - link.body[0])));
        break;
    }
  }
  for (std::size_t i = 0; i < plan.couplers.size(); ++i)
    keep(links + static_cast<int>(i), norm(ends(placed, plan.couplers[i]).between) - plan.couplers[i].length);
  return worst;
}

}  // namespace linkwright::suspension
