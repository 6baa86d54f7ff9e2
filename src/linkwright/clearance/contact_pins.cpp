// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_pins.h"

#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {

ContactPins::ContactPins(OpenLinkage& open, std::span<const ContactJoint> joints)
    : open_(open),
      joints_(joints),
      first_force_(open.linkage.forces.size()),
      first_torque_(open.linkage.torques.size()),
      places_(joints.size()) {
  planar::Linkage& l = open_.linkage;
  for (std::size_t k = 0; k < joints_.size(); ++k)
    for (const auto& [point, side] : {std::pair{journal(k), "pin of "}, std::pair{bush(k), "bush of "}}) {
      if (point.body == 0) continue;
      l.forces.push_back({.name = side + open_.pins[k].name, .point = point});
      l.torques.push_back({.name = side + open_.pins[k].name, .body = point.body, .from = 0});
    }
}

planar::BodyPoint ContactPins::journal(std::size_t pin) const {
  return joints_[pin].pin == PinSide::first ? open_.pins[pin].first : open_.pins[pin].second;
}
planar::BodyPoint ContactPins::bush(std::size_t pin) const {
  return joints_[pin].pin == PinSide::first ? open_.pins[pin].second : open_.pins[pin].first;
}

void ContactPins::place(const planar::LinkageMotion& motion) {
  const auto speed = [&](const planar::BodyPoint& p) {
    return planar::body_state(open_.plan, motion, p.body).speed;
  };
  for (std::size_t k = 0; k < places_.size(); ++k) {
    PinPlace& s = places_[k];
    const double sign = joints_[k].pin == PinSide::second ? 1 : -1;
    const PinGap gap = pin_gap(open_, motion, k);
    s.eccentricity = sign * math::vec(gap.way);
    s.rate = sign * math::vec(gap.rate);
    s.distance = norm(s.eccentricity);
    s.normal = s.distance > 0 ? (1 / s.distance) * s.eccentricity : math::Vec2{1, 0};
    s.depth = s.distance - joints_[k].clearance;
    s.depth_rate = dot(s.rate, s.normal);
    const double pin_radius = joints_[k].bush_radius - joints_[k].clearance;
    s.slip = dot(s.rate, perpendicular(s.normal)) + speed(journal(k)) * pin_radius -
             speed(bush(k)) * (s.distance + pin_radius);
  }
}

void ContactPins::press(std::span<const PinForce> forces) {
  planar::Linkage& l = open_.linkage;
  std::size_t force = first_force_, torque = first_torque_;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const PinPlace& s = places_[k];
    const double pin_radius = joints_[k].bush_radius - joints_[k].clearance;
    const math::Vec2 on_pin = -forces[k].normal * s.normal - forces[k].friction * perpendicular(s.normal);
    if (journal(k).body != 0) {
      l.forces[force++].force = number(on_pin);
      l.torques[torque++].torque = cross(pin_radius * s.normal, on_pin);
    }
    if (bush(k).body != 0) {
      l.forces[force++].force = number(-on_pin);
      l.torques[torque++].torque = -cross((s.distance + pin_radius) * s.normal, on_pin);
    }
  }
}

math::Vec2 ContactPins::acceleration(const planar::LinkageMotion& motion, std::size_t pin) const {
  const auto of = [&](const planar::BodyPoint& p) {
    return planar::point_motion(open_.linkage, open_.plan, motion, p).acceleration;
  };
  return of(journal(pin)) - of(bush(pin));
}

double ContactPins::depth_acceleration(const planar::LinkageMotion& motion, std::size_t pin) const {
  const PinPlace& s = places_[pin];
  if (s.distance == 0) return 0;
  return dot(acceleration(motion, pin), s.normal) +
         (dot(s.rate, s.rate) - s.depth_rate * s.depth_rate) / s.distance;
}

double ContactPins::bush_angle(const planar::LinkageMotion& motion, std::size_t pin) const {
  return math::angle_difference(
      math::angle_of(places_[pin].eccentricity),
      math::angle_of(planar::body_state(open_.plan, motion, bush(pin).body).direction));
}

}  // namespace linkwright::clearance
