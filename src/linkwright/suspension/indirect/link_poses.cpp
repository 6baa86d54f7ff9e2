// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_poses.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/detail/steering_kernel.h"

namespace linkwright::suspension {
namespace {

/// Axes along the first edge of a triangle, across it in the triangle, and across the triangle, as columns.
Mat3 frame(const Vec3& p, const Vec3& q, const Vec3& s) {
  const Vec3 along = unit(q - p), normal = unit(cross(q - p, s - p));
  return transposed(Mat3{{along, cross(normal, along), normal}});
}

/// The shortest turn that takes the unit vector a to b; about any axis across them if they are opposite.
Mat3 turn_between(const Vec3& a, const Vec3& b) {
  const Vec3 axis = cross(a, b);
  const double sine = norm(axis), cosine = dot(a, b);
  if (sine == 0) return cosine > 0 ? Mat3{} : math::turn_about(std::acos(-1.0) * math::across(a)[0]);
  return math::turn_about((std::atan2(sine, cosine) / sine) * axis);
}

}  // namespace

Vec3 body_point(const Suspension& suspension, int link, int point, double rack) {
  const CornerLink& of = suspension.links.at(link);
  const Vec3& at = of.body.at(point);
  return of.moved_by_rack ? kernel::steered_point(suspension, at, rack) : at;
}

Vec3 by_rack(const Suspension& suspension, int link, const Vec3& now, double rack) {
  if (!suspension.links.at(link).moved_by_rack) return {};
  return suspension.steering_linkage ? kernel::centre_link(*suspension.steering_linkage, rack).speed(now)
                                     : suspension.rack_direction;
}

Vec3 carrier_point(const Suspension& suspension, int link, int point, const CarrierPose& carrier) {
  return place(carrier, suspension.links.at(link).carrier.at(point), suspension.wheel.centre);
}

std::vector<LinkPose> link_poses(const Suspension& suspension, const CornerPlace& at, double rack) {
  std::vector<LinkPose> out;
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const CornerLink& link = suspension.links[i];
    const auto body = [&](int k) { return body_point(suspension, i, k, rack); };
    const auto carrier = [&](int k) { return carrier_point(suspension, i, k, at.carrier); };
    LinkPose pose{link.body[0], body(0), {}};
    switch (link.type) {
      case LinkType::US: {
        const Vec3 then = unit(link.carrier[0] - link.body[0]), now = unit(carrier(0) - body(0));
        const Vec3 axis = standing_axis(link.cross_axis, link.carrier[0] - link.body[0]);
        const auto axes = [&](const Vec3& line) {
          const Vec3 turning = unit(cross(axis, line));
          return transposed(Mat3{{line, turning, cross(line, turning)}});
        };
        pose.rotation = axes(now) * transposed(axes(then));
        break;
      }
      case LinkType::SS:
        pose.rotation = turn_between(unit(link.carrier[0] - link.body[0]), unit(carrier(0) - body(0)));
        break;
      case LinkType::RS:
        pose.rotation = frame(body(0), body(1), carrier(0)) *
                        transposed(frame(link.body[0], link.body[1], link.carrier[0]));
        break;
      case LinkType::SR:
        pose.rotation = frame(body(0), carrier(0), carrier(1)) *
                        transposed(frame(link.body[0], link.carrier[0], link.carrier[1]));
        break;
      case LinkType::RR:
        pose.rotation = math::turn_about(at.arm * unit(link.body[1] - link.body[0]));
        break;
      case LinkType::R:
      case LinkType::S:
      case LinkType::SP:
        pose.rotation = at.carrier.rotation;
        break;
    }
    out.push_back(pose);
  }
  return out;
}

std::array<Vec3, 2> cross_axes(const Suspension& suspension, int link, const CarrierPose& carrier,
                               double rack) {
  const CornerLink& rod = suspension.links.at(link);
  LINKWRIGHT_REQUIRE(rod.type == LinkType::US, "{} has no universal joint", link_label(suspension, link));
  const Vec3 standing = standing_axis(rod.cross_axis, rod.carrier[0] - rod.body[0]);
  const Vec3 line = carrier_point(suspension, link, 0, carrier) - body_point(suspension, link, 0, rack);
  return {standing, unit(cross(standing, line))};
}

namespace {

/// A point fixed to a rod: a share of the rod, whose length need not be the distance of its reference points,
/// and what lies off its line as the rod has turned.
Vec3 rod_point(const Suspension& suspension, int index, const Vec3& reference, const CornerPlace& at,
               double rack) {
  const CornerLink& link = suspension.links.at(index);
  const Vec3 from = body_point(suspension, index, 0, rack), along = link.carrier[0] - link.body[0];
  const double share = dot(reference - link.body[0], along) / dot(along, along);
  const Vec3 on_line = from + share * (carrier_point(suspension, index, 0, at.carrier) - from);
  if (link.type == LinkType::SS) return on_line;
  return on_line +
         link_poses(suspension, at, rack)[index].rotation * (reference - link.body[0] - share * along);
}

}  // namespace

Vec3 coupler_begin(const Suspension& suspension, const Coupler& coupler, const CornerPlace& at, double rack) {
  if (coupler.begin) return rod_point(suspension, coupler.first, *coupler.begin, at, rack);
  const Vec3 from = body_point(suspension, coupler.first, 0, rack);
  return from + coupler.fraction * (carrier_point(suspension, coupler.first, 0, at.carrier) - from);
}

Vec3 spring_end(const Suspension& suspension, const CornerPlace& at, double rack) {
  LINKWRIGHT_REQUIRE(suspension.spring, "the suspension has no spring");
  const CornerSpring& spring = *suspension.spring;
  LINKWRIGHT_REQUIRE(acts_directly(spring), "the spring acts through a rocker");
  if (spring.link < 0) return place(at.carrier, spring.moving, suspension.wheel.centre);
  const CornerLink& link = suspension.links.at(spring.link);
  if (link.type != LinkType::US && link.type != LinkType::SS)
    return placed(link_poses(suspension, at, rack)[spring.link], spring.moving);
  return rod_point(suspension, spring.link, spring.moving, at, rack);
}

}  // namespace linkwright::suspension
