// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/detail/cam_follower.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"

namespace linkwright::planar {
namespace {

// The linkage without its cams, whose moved joints are driven instead; or, where a drive moves one already,
// the joint on which the cam turns.
Linkage without_cams(const Linkage& linkage) {
  Linkage out = linkage;
  const auto is_driven = [&out](int joint) {
    return std::find(out.driven.begin(), out.driven.end(), joint) != out.driven.end();
  };
  for (const LinkageCam& cam : linkage.cams)
    out.driven.push_back(is_driven(cam.moves) ? cam.turns : cam.moves);
  out.cams.clear();
  return out;
}

// The sign of the value of a programme that is farthest from the base circle.
double main_sense(const CamProgramme& programme) {
  constexpr int looks = 90;
  const ProgrammeCurve curve(programme);
  double farthest = 0;
  for (int k = 0; k <= looks; ++k) {
    const double value = curve(curve.breaks().back() * k / looks).value;
    if (std::abs(value) > std::abs(farthest)) farthest = value;
  }
  return farthest < 0 ? -1 : 1;
}

}  // namespace

Linkage with_second_roller(Linkage linkage, int cam) {
  LinkageCam& c = linkage.cams[at(cam)];
  c.contact = c.second_contact, c.roller_radius = c.second_roller_radius;
  c.form = CamForm::outside;
  return linkage;
}

std::optional<CamBodies> bodies_of(const Linkage& l, const LinkageCam& cam) {
  const LinkageJoint &turns = l.joints[at(cam.turns)], &moves = l.joints[at(cam.moves)];
  for (const auto& [base, turning] : {std::pair{turns.first, turns.second}, {turns.second, turns.first}})
    if (base.body == moves.first.body || base.body == moves.second.body) return CamBodies{base, turning};
  return std::nullopt;
}

CamFollower::CamFollower(const Linkage& linkage, int cam, const std::vector<double>& known)
    : linkage_(without_cams(linkage)),
      cam_(linkage.cams[at(cam)]),
      bodies_(bodies_of(linkage, cam_).value()) {
  PlanResult planned = plan_linkage(linkage_);
  problems_ = std::move(planned.problems);
  if (!problems_.empty()) return;
  plan_ = std::move(planned.plan);
  inputs_.resize(plan_.inputs());
  for (std::size_t k = 0; k < plan_.drawn_inputs.size(); ++k) inputs_[k].value = plan_.drawn_inputs[k];
  for (std::size_t k = 0; k < linkage_.driven.size(); ++k) {
    if (linkage_.driven[k] == cam_.moves) input_ = k;
    for (std::size_t c = 0; c < known.size(); ++c)
      if (linkage.cams[c].moves == linkage_.driven[k]) inputs_[k].value = known[c];
  }
  motion_.emplace(plan_);
}

std::optional<double> CamFollower::drawn() const {
  if (plan_.drawn_inputs.empty()) return std::nullopt;
  return plan_.drawn_inputs[input_];
}

void CamFollower::move(const math::Motion& m) {
  inputs_[input_] = {m.value, m.rate, m.acceleration};
  solve_motion(plan_, inputs_, *motion_);
}

math::Vec2 CamFollower::in_base(const math::Vec2& vector) const {
  return rotate_inverse(body_state(plan_, *motion_, bodies_.base.body).direction, vector);
}

double CamFollower::distance(double coordinate) {
  move({coordinate, 0, 0, 0});
  const auto place = [this](const BodyPoint& p) {
    return point_motion(linkage_, plan_, *motion_, p).position;
  };
  const math::Vec2 apart = place(cam_.contact) - place(bodies_.base);
  if (cam_.face != FollowerFace::flat) return norm(apart);
  const math::Vec2 along =
      rotate(body_state(plan_, *motion_, cam_.contact.body).direction, math::unit(cam_.face_direction));
  return dot(perpendicular(along), apart);
}

std::optional<double> CamFollower::on_base_circle(double base_radius) {
  constexpr int looks = 720;
  const double wanted = base_radius + cam_.roller(), middle = drawn().value_or(0),
               reach = plan_.rotary[input_] ? pi : 2 * (plan_.size + wanted + std::abs(middle)),
               away = drawn() ? 0 : main_sense(cam_.programme);
  const auto apart = [&](double coordinate) { return std::abs(distance(coordinate)) - wanted; };
  std::optional<double> best;
  double last_at = middle - reach, last = apart(last_at);
  for (int k = 1; k <= looks; ++k) {
    const double here = middle - reach + 2 * reach * k / looks, now = apart(here);
    if (std::isfinite(last) && std::isfinite(now) && (last <= 0) != (now <= 0) && away * (now - last) >= 0) {
      const double found = math::zero_between(apart, last_at, here);
      if (!best || std::abs(found - middle) < std::abs(*best - middle)) best = found;
    }
    last_at = here, last = now;
  }
  // A drawing may show the follower on a base circle that it only touches.
  if (!best && std::abs(apart(middle)) <= 1e-9 * plan_.size) best = middle;
  return best;
}

CamState CamFollower::contour(double offset, const math::Motion& m, double angle) {
  move({offset + m.value, m.rate, m.acceleration, 0});
  const double sense = cam_.sense();
  const auto place = [this](const BodyPoint& p) { return point_motion(linkage_, plan_, *motion_, p); };
  const auto vector = [this](const math::Vec2& v) {
    const math::Vec2 turned = in_base(v);
    return std::complex<double>(turned.x, turned.y);
  };
  const PointMotion point = place(cam_.contact);
  const std::complex<double> way = vector(point.position - place(bodies_.base).position),
                             rate = vector(point.velocity), acceleration = vector(point.acceleration);
  // The travel by unit of the coordinate is what the rates would be for a rate of 1.
  move({offset + m.value, 1, 0, 0});
  const std::complex<double> travel = vector(place(cam_.contact).velocity);
  const PartState<double> body = body_state(plan_, *motion_, cam_.contact.body);
  if (cam_.face != FollowerFace::flat) {
    // The programme may count against the sense in which the cam pushes.
    const CamState out = roller_contour({way, rate, acceleration, travel}, cam_.roller(), sense, angle);
    if (!(out.lever < 0)) return out;
    return roller_contour({way, rate, acceleration, -travel}, cam_.roller(), sense, angle);
  }
  const double turning = body.speed;  // of the face by unit of the coordinate
  move({offset + m.value, m.rate, m.acceleration, 0});
  const PartState<double> face = body_state(plan_, *motion_, cam_.contact.body);
  const std::complex<double> along = vector(rotate(face.direction, math::unit(cam_.face_direction))), i{0, 1};
  const double side = std::imag(std::conj(along) * way) < 0 ? -1 : 1;
  const std::complex<double> normal = side * i * along;
  const auto across = [&](const std::complex<double>& v) { return std::real(std::conj(normal) * v); };
  const auto beside = [&](const std::complex<double>& v) { return std::real(std::conj(i * normal) * v); };
  // Derivatives of the distance, whose direction turns with the face.
  const double w = face.speed;
  const FacePath path{{std::arg(normal), w, face.angular_acceleration},
                      {across(way), across(rate) + w * beside(way),
                       across(acceleration) + 2 * w * beside(rate) + face.angular_acceleration * beside(way) -
                           w * w * across(way)}};
  CamState out = face_contour(path, sense, angle);
  // The place of the contact along the face, from its point, and the travel of the face there.
  const std::complex<double> touch =
      std::complex<double>(out.profile.x, out.profile.y) * std::polar(1.0, sense * angle);
  const std::complex<double> there = touch - way;
  out.contact = std::real(std::conj(along) * there);
  std::complex<double> moved = travel + turning * i * there;
  if (across(moved) < 0) moved = -moved;
  out.lever = across(moved);
  out.pressure_angle = sense * std::arg(std::conj(moved) * normal);
  return out;
}

CamExtremes linkage_cam_extremes(const LinkagePlan& plan, int cam, CamFollower& follower, double roller) {
  const CamPair& pair = plan.cams[at(cam)];
  const auto contour = [&](const math::Motion& m, double angle) {
    return follower.contour(pair.offset, m, angle);
  };
  return contour_extremes(contour, roller, pair.is_flat, plan.size, pair.programme);
}

}  // namespace linkwright::planar
