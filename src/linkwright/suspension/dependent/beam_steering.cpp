// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_steering.h"

#include <fmt/core.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/vector3.h"

namespace linkwright::suspension {
namespace {

constexpr double no_lever = 1e-9;  ///< m

/// A knuckle on the beam: its kingpin where it is now.
struct Knuckle {
  Vec3 at, axis;
  double turn = 0;

  Vec3 place(const Vec3& straight) const { return at + math::turn_about(turn * axis) * (straight - at); }

  /// Turns until a joint is at the length of its rod from a point, on the side of the drawing; false, with
  /// the gap, if it does not come there.
  ///
  /// @param straight the joint with the knuckle straight ahead
  /// @param from the other end of the rod
  /// @param length length of the rod
  /// @param side sign of the lever arm of the rod in the drawing
  bool reach(const Vec3& straight, const Vec3& from, double length, double side, double& gap) {
    const Vec3 e = straight - at, d = from - at, across = e - dot(e, axis) * axis;
    const double a = dot(across, d), b = dot(cross(axis, across), d),
                 c = (dot(e, e) + dot(d, d) - length * length) / 2 - dot(e, axis) * dot(axis, d),
                 square = a * a + b * b, rest = square - c * c;
    if (!(rest > 0)) {
      gap = std::abs(std::abs(c) - std::sqrt(square)) / length;
      return false;
    }
    const double s = side * std::sqrt(rest);
    turn = std::atan2(b * c - a * s, a * c + b * s);
    return true;
  }
};

/// Lever of a rod about a kingpin, m2: b of `reach` straight ahead.
double lever(const Vec3& at, const Vec3& axis, const Vec3& joint, const Vec3& other) {
  return dot(cross(axis, joint - at), other - at);
}

struct Kingpins {
  std::array<Vec3, 2> at, axis;  ///< left, right
};
Kingpins kingpins_of(const BeamSteering& s) {
  const Vec3 axis = unit(s.kingpin[1] - s.kingpin[0]);
  return {{s.kingpin[0], math::mirrored(s.kingpin[0])}, {axis, math::mirrored(axis)}};
}

}  // namespace

std::string problem(const BeamSteering& s) {
  if (!(norm(s.kingpin[1] - s.kingpin[0]) > no_lever)) return "both points of the kingpin are one point";
  if (!(norm(s.pitman_axis[1] - s.pitman_axis[0]) > no_lever))
    return "both points of the Pitman arm's axis are one point";
  if (!(s.kingpin[1].z > s.kingpin[0].z)) return "the second point of the kingpin is not above the first one";
  const Kingpins k = kingpins_of(s);
  const auto has_lever = [](const Vec3& at, const Vec3& axis, const Vec3& joint, const Vec3& other) {
    return std::abs(lever(at, axis, joint, other)) > no_lever * norm(other - joint);
  };
  if (!has_lever(k.at[0], k.axis[0], s.drag_knuckle, s.drag_body))
    return "the drag link points at the kingpin: it cannot turn the knuckle";
  for (std::size_t i = 0; i < 2; ++i)
    if (!has_lever(k.at[i], k.axis[i], s.track_rod[i], s.track_rod[1 - i]))
      return "the track rod points at a kingpin: it cannot turn the knuckle";
  return {};
}

BeamSteer steer_beam(const BeamAxlePlan& plan, const BeamSteering& s, const BeamPlace& place, double pitman) {
  const std::string wrong = problem(s);
  LINKWRIGHT_REQUIRE(wrong.empty(), "{}", wrong);
  BeamSteer out;
  const Kingpins pins = kingpins_of(s);
  const std::array<Side, 2> sides{Side::left, Side::right};
  std::array<Knuckle, 2> knuckles;
  std::array<Mat3, 2> beam;
  for (std::size_t i = 0; i < 2; ++i) {
    beam[i] = half_rotation(plan, place, sides[i]);
    knuckles[i] = {on_beam(plan, place, pins.at[i]), beam[i] * pins.axis[i]};
  }
  const Vec3 shaft = unit(s.pitman_axis[1] - s.pitman_axis[0]),
             joint = s.pitman_axis[0] + math::turn_about(pitman * shaft) * (s.drag_body - s.pitman_axis[0]);
  double gap = 0;
  const auto ends = [&](const char* rod) {
    out.status = Status::no_assembly;
    out.reason = fmt::format("the {} does not reach, by {:.3g} mm", rod, 1e3 * gap);
    out.turn = out.steer = {nan, nan};
    return out;
  };
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  if (!knuckles[0].reach(on_beam(plan, place, s.drag_knuckle), joint, norm(s.drag_knuckle - s.drag_body),
                         sign(lever(pins.at[0], pins.axis[0], s.drag_knuckle, s.drag_body)), gap))
    return ends("drag link");
  const Vec3 left = knuckles[0].place(on_beam(plan, place, s.track_rod[0]));
  if (!knuckles[1].reach(on_beam(plan, place, s.track_rod[1]), left, norm(s.track_rod[1] - s.track_rod[0]),
                         sign(lever(pins.at[1], pins.axis[1], s.track_rod[1], s.track_rod[0])), gap))
    return ends("track rod");
  for (std::size_t i = 0; i < 2; ++i) {
    out.turn[i] = knuckles[i].turn;
    const Mat3 rotation = math::turn_about(knuckles[i].turn * knuckles[i].axis) * beam[i];
    out.angles[i] = wheel_angles(sides[i], i == 0 ? plan.axle.left : plan.axle.right, rotation);
    out.steer[i] = (i == 0 ? -1 : 1) * out.angles[i].toe;
  }
  return out;
}

}  // namespace linkwright::suspension
