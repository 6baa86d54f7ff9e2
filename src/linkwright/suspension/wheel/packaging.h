// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/suspension/corner/position.h"

// Angles of ball joints and half-shafts, and distances between parts, at a position of a wheel suspension.
namespace linkwright::suspension {

/// A drive shaft between a joint on the body and a joint on the carrier, as drawn.
struct HalfShaft {
  Vec3 inner, outer;         ///< centres of its joints, m
  Vec3 inner_axis{0, 1, 0};  ///< of the shaft of the gearbox, of any length
};
/// A half-shaft at a position.
struct HalfShaftState {
  double inner_angle = 0,  ///< between the half-shaft and the shaft of the gearbox, rad, 0 to pi/2
      outer_angle = 0;     ///< between the half-shaft and the wheel's axis, rad, 0 to pi/2
  double length = 0;       ///< distance of the joints, m
  /// Change of that distance along the shaft of the gearbox since the reference, > 0: further apart, m.
  double plunge = 0;
};
HalfShaftState half_shaft(const CornerPlan& plan, const HalfShaft& shaft, const CornerPosition& position);

/// A ball joint of a link: its stud is fixed to the carrier, or to the body at the other end, and has a place
/// at the reference as the link sees it.
struct BallJoint {
  int link = 0;
  bool at_carrier = true;  ///< false: the joint at the body
  Vec3 stud;               ///< direction of the stud at the reference, of any length
};
/// The angle of the stud from its place at the reference (rad). Of a rod that turns freely about its line
/// (SS), the stud lies along the rod. Throws ContractError for a joint that the link does not have.
double ball_joint_angle(const Suspension& suspension, const CornerPlan& plan, const BallJoint& joint,
                        const CornerPosition& position);

/// The straight line between two points, m.
struct Segment {
  Vec3 from, to;
};
/// The least distance of two lines, m.
double distance(const Segment& a, const Segment& b);
/// The least distance of a line and a circle about `centre` with the unit axis `axis`, m.
double distance(const Segment& line, const Vec3& centre, const Vec3& axis, double radius);

/// A box along the axes of the vehicle: a side member, an engine, a wheel house.
struct Box {
  Vec3 lower, upper;  ///< opposite corners, each coordinate of `lower` at most that of `upper`, m
};
/// The least distance of a line and a box, m; 0 where the line passes through the box.
double distance(const Segment& line, const Box& box);

/// The lines of a link at a position: one of a rod, two of a wishbone. Empty for links without any.
std::vector<Segment> lines_of(const CornerPlan& plan, int link, const CornerPosition& position);

/// A tyre as a torus: the middle circle of its cross-section.
struct TyreCircle {
  Vec3 centre, axis;  ///< m; unit, outboard
  double radius = 0;  ///< m, of the middle circle
};
TyreCircle tyre_circle(const CornerPlan& plan, double width, const CornerPosition& position);
/// The least distance of the middle circle of a tyre and a box, m; 0 where the circle passes through the box.
double distance(const TyreCircle& tyre, const Box& box);

}  // namespace linkwright::suspension
