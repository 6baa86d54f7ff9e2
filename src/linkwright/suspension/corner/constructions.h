// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/suspension/corner/suspension.h"

/// @file
/// The basis of the drawing-board constructions of a wheel suspension: the ball joints of the carrier,
/// through which the geometric steering axis passes, and the planes of its arms, in which the instant axis of
/// the wheel's travel is looked for. Both are known from the types of the links, and from rods that share an
/// end.
namespace linkwright::suspension {

/// Points nearer than this (m) are one joint.
inline constexpr double same_joint = 1e-6;

/// A ball joint about which the carrier, with what is hinged to it, can turn: that of a wishbone (RS), the
/// one at the body of an SR link, of a strut (SP) or of an S joint, or the common carrier point of two rods.
struct CarrierBall {
  int link = 0;          ///< index of the link, or of the first of two rods
  bool at_body = false;  ///< the link's first body point; else its first carrier point
};

/// The direction of the plane of an arm; the axis of a pure turn of the carrier lies in it, too.
enum class ArmKind {
  wishbone,         ///< RS: through the hinge at the body and the ball joint
  blade,            ///< SR: through the hinge at the carrier and the ball joint
  strut,            ///< SP: through the ball joint, across the strut
  hinge,            ///< R: two planes through the axis itself
  rods_at_carrier,  ///< two rods with one point at the carrier
  rods_at_body      ///< two rods with one point at the body
};

/// An arm with its plane.
struct Arm {
  ArmKind kind = ArmKind::wishbone;  ///< kind of the plane
  int link = 0,                      ///< index of the link
      other = -1;                    ///< index of the second rod; -1 without one
};

/// The ball joints and arms of a suspension. Links on the rack are tie rods and no part of a construction.
struct CornerConstruction {
  std::vector<CarrierBall> balls;  ///< ball joints of the carrier
  std::vector<Arm> arms;           ///< arms with a plane

  /// True if there is a geometric steering axis. @returns true if the carrier has two ball joints
  bool has_axis() const { return balls.size() == 2; }
  /// Two planes, or one hinge, give an instant axis. @returns true if there are two planes or one hinge
  bool has_planes() const {
    return arms.size() == 2 ? arms[0].kind != ArmKind::hinge && arms[1].kind != ArmKind::hinge
                            : arms.size() == 1 && arms[0].kind == ArmKind::hinge;
  }
};

/// The construction of a suspension whose links have as many points as their types need.
///
/// @param suspension the suspension
/// @returns its ball joints and arms
CornerConstruction construction_of(const Suspension& suspension);

/// The reason why a suspension has no geometric steering axis: "one ball joint holds the carrier (lower
/// wishbone), ...".
///
/// @param suspension the suspension
/// @returns the reason; empty if it has one
std::string why_no_axis(const Suspension& suspension);

/// The reason why a suspension has no roll centre and instant centres by planes of arms.
///
/// @param suspension the suspension
/// @returns the reason; empty if it has them
std::string why_no_planes(const Suspension& suspension);

namespace kernel {

/// The construction by the types and points of links.
///
/// @param links the links
/// @returns ball joints and arms
template <class T>
CornerConstruction construction_of(const std::vector<BasicCornerLink<T>>& links) {
  CornerConstruction out;
  const int count = static_cast<int>(links.size());
  const auto rod = [&](int i) {
    return (links[i].type == LinkType::US || links[i].type == LinkType::SS) && !links[i].moved_by_rack;
  };
  const auto same = [](const Vector3<T>& a, const Vector3<T>& b) {
    return dot(a - b, a - b) < same_joint * same_joint;
  };
  // Rods that share an end with link i, the first of them, and whether others came before it.
  struct Mates {
    int count = 0, first = -1;
    bool earlier = false;
  };
  const auto mates = [&](int i, bool at_carrier) {
    Mates found;
    for (int k = 0; k < count; ++k) {
      if (k == i || !rod(k)) continue;
      const auto &a = at_carrier ? links[i].carrier : links[i].body,
                 &b = at_carrier ? links[k].carrier : links[k].body;
      if (!same(a[0], b[0])) continue;
      ++found.count;
      found.earlier = found.earlier || k < i;
      if (found.first < 0) found.first = k;
    }
    return found;
  };
  for (int i = 0; i < count; ++i) {
    switch (links[i].type) {
      case LinkType::RS:
        out.balls.push_back({i, false});
        out.arms.push_back({ArmKind::wishbone, i});
        break;
      case LinkType::SR:
        out.balls.push_back({i, true});
        out.arms.push_back({ArmKind::blade, i});
        break;
      case LinkType::SP:
        out.balls.push_back({i, true});
        out.arms.push_back({ArmKind::strut, i});
        break;
      case LinkType::S:
        out.balls.push_back({i, true});
        break;
      case LinkType::R:
        out.arms.push_back({ArmKind::hinge, i});
        break;
      case LinkType::RR:
        break;
      case LinkType::US:
      case LinkType::SS: {
        if (!rod(i)) break;
        // Three rods with one end hold a point, but lie in no plane.
        const Mates at_carrier = mates(i, true), at_body = mates(i, false);
        if (at_carrier.count > 0 && !at_carrier.earlier) out.balls.push_back({i, false});
        if (at_carrier.count == 1 && !at_carrier.earlier)
          out.arms.push_back({ArmKind::rods_at_carrier, i, at_carrier.first});
        if (at_body.count == 1 && !at_body.earlier)
          out.arms.push_back({ArmKind::rods_at_body, i, at_body.first});
        break;
      }
    }
  }
  return out;
}

}  // namespace kernel
}  // namespace linkwright::suspension
