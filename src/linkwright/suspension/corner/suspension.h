// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/math/vector3.h"

/// @file
/// Wheel suspensions: the mechanisms between a vehicle body and a wheel carrier (Poznanovic 2016). The body
/// is fixed. Frame of the vehicle: x forward, y to the left, z up, y = 0 in the middle; m, rad. All points
/// are given in it, at the reference position. Templates take the scalar: plain numbers, or dual numbers that
/// carry derivatives along.
namespace linkwright::suspension {

using math::Mat3;
using math::Matrix3;
using math::Vec3;
using math::Vector3;

/// The joints of a link: the first letter to the body, the second to the carrier; one letter is a joint
/// between body and carrier without a link. R revolute, S spherical, U universal, P prismatic (slides and
/// turns).
enum class LinkType {
  R,   ///< carrier hinged to the body: two body points on the axis
  RR,  ///< arm hinged to the body (two points) and to the carrier (two points)
  S,   ///< ball joint between body and carrier: one body point
  RS,  ///< wishbone: hinged to the body (two points), ball joint at the carrier
  SR,  ///< ball joint at the body, hinged to the carrier (two points)
  SP,  ///< strut: ball joint at the body, slides along its line in the carrier
  US,  ///< rod: one point at the body, one at the carrier
  SS   ///< the same as US, free to turn about its line
};
constexpr std::array<EnumName<LinkType>, 8> names(LinkType) {
  return {{{LinkType::R, "R", "carrier hinged to the body: two body points on the axis"},
           {LinkType::RR, "RR", "arm hinged to the body (two points) and to the carrier (two points)"},
           {LinkType::S, "S", "ball joint between body and carrier: one body point"},
           {LinkType::RS, "RS", "wishbone: hinged to the body (two points), ball joint at the carrier"},
           {LinkType::SR, "SR", "ball joint at the body, hinged to the carrier (two points)"},
           {LinkType::SP, "SP", "strut: ball joint at the body, slides along its line in the carrier"},
           {LinkType::US, "US", "rod: one point at the body, one at the carrier"},
           {LinkType::SS, "SS", "the same as US, free to turn about its line"}}};
}

/// A link. Number of points, body and carrier: R 2 and 0, RR 2 and 2, S 1 and 0, RS 2 and 1, SR 1 and 2, SP,
/// US and SS 1 and 1. Two points stand for the axis of a revolute joint.
template <class T>
struct BasicCornerLink {
  std::string name;                 ///< name in messages; may be empty
  LinkType type = LinkType::US;     ///< joints of the link
  std::vector<Vector3<T>> body;     ///< points at the body, m
  std::vector<Vector3<T>> carrier;  ///< points at the carrier, m
  /// Length of a US or SS link (m) instead of the distance of its points: they then are no position, and
  /// what is reported at zero travel has to be solved for, too.
  std::optional<T> length;
  bool moved_by_rack = false;  ///< its body points move with the rack, or with the centre link
  /// US: direction of the axis of its U joint that is fixed in the body; the other axis of the joint lies
  /// across it and across the rod. It says how the rod turns about its own line, which only what is fixed to
  /// the rod off that line takes. Not given: level, and across the rod at the reference.
  std::optional<Vec3> cross_axis{};
  /// Lengths of an RS or SR link as it is made (m), from its single point to both others, instead of the
  /// distances of its points: the link then keeps them when a point moves.
  std::optional<std::array<T, 2>> made{};
};
/// A link, in numbers.
using CornerLink = BasicCornerLink<double>;

/// A rod between two links (interconnected mechanisms): from a point of a US link to a point fixed to an SR
/// link. Its length is the distance at the reference position.
template <class T>
struct BasicCoupler {
  std::string name;  ///< name in messages; may be empty
  int first = 0;     ///< index of the US link
  T fraction{0.5};   ///< position as a fraction of the US link's length, from its body point
  int second = 0;    ///< index of the SR link
  Vector3<T> point;  ///< end of the coupler on the SR link, m
  /// Begin of the coupler on the US link, which may lie off its line; replaces `fraction`.
  std::optional<Vector3<T>> begin{};
};
/// A rod between two links, in numbers.
using Coupler = BasicCoupler<double>;

/// The kind of a part of a suspension.
enum class PartKind { body, carrier, link, rocker };

/// A part of a suspension, to which points are fixed.
struct CornerPart {
  PartKind kind = PartKind::carrier;  ///< kind of the part
  int index = 0;                      ///< index of the link or of the rocker

  /// Compares two parts. @returns true if they are the same
  friend bool operator==(const CornerPart&, const CornerPart&) = default;
};

/// A point and the part that it is fixed to.
template <class T>
struct BasicFixedPoint {
  Vector3<T> at;    ///< at the reference, m
  CornerPart part;  ///< on a link: US, SS (on its line), RS, SR or RR
};
/// A point and its part, in numbers.
using FixedPoint = BasicFixedPoint<double>;

/// A rocker (bell crank): it turns about an axis of the body and is driven by a pushrod, a pullrod or a
/// droplink from another part. Its angle is zero at the reference drawing and right-handed about the
/// direction from the first to the second point of the axis; on the right side of the vehicle it is
/// left-handed, so that a mirrored suspension has the same angles. Of the two assemblies of the rod it has
/// the one that is nearer to the drawing.
template <class T>
struct BasicRocker {
  std::string name;                ///< name in messages and tables
  std::array<Vector3<T>, 2> axis;  ///< two points of its axis, m
  Vector3<T> rod;                  ///< joint of the rod on the rocker, m
  BasicFixedPoint<T> driven_by;    ///< other end of the rod: on the carrier, a link or an earlier rocker
  std::optional<T> length{};       ///< length of the rod instead of the distance of its points, m
};
/// A rocker, in numbers.
using Rocker = BasicRocker<double>;

/// Something whose length or angle is followed beside the spring: a damper, a torsion bar, the arm of an
/// anti-roll bar.
template <class T>
struct BasicCornerElement {
  std::string name;          ///< name in messages and tables
  BasicFixedPoint<T> first,  ///< first end of a length
      second;                ///< second end of a length
  std::optional<CornerPart>
      turn;  ///< an angle instead: of a rocker, or of an R, RS or RR link about its hinge
  /// True if the first end is the counterpart of the second one at the other wheel. The length is then that
  /// with both wheels of a symmetric axle at the same position.
  bool across = false;
};
/// An element, in numbers.
using CornerElement = BasicCornerElement<double>;

/// Spring (or damper) between the body and the carrier, a link or a rocker.
template <class T>
struct BasicCornerSpring {
  Vector3<T> body;    ///< its end at the body, m
  Vector3<T> moving;  ///< its other end, m
  /// US, SS, RS, SR or RR link that it is fixed to; -1 = the carrier. On an SS link: on its line.
  int link = -1;
  int rocker = -1;                          ///< rocker that it is fixed to instead; -1 = none
  CornerPart body_part = {PartKind::body};  ///< part that its first end is fixed to
};
/// A spring, in numbers.
using CornerSpring = BasicCornerSpring<double>;

/// The part that the moving end of a spring is fixed to.
///
/// @param spring the spring
/// @returns the carrier, a link or a rocker
template <class T>
CornerPart moving_part(const BasicCornerSpring<T>& spring) {
  return spring.rocker >= 0 ? CornerPart{PartKind::rocker, spring.rocker}
         : spring.link >= 0 ? CornerPart{PartKind::link, spring.link}
                            : CornerPart{PartKind::carrier};
}

/// Test for springs that act without a rocker.
///
/// @param spring the spring
/// @returns true if it acts between the body and the carrier or a link
template <class T>
bool acts_directly(const BasicCornerSpring<T>& spring) {
  return spring.rocker < 0 && spring.body_part.kind == PartKind::body;
}

/// The side of the vehicle.
enum class Side {
  left,  ///< y > 0
  right  ///< y < 0
};
constexpr std::array<EnumName<Side>, 2> names(Side) {
  return {{{Side::left, "left", "y > 0"}, {Side::right, "right", "y < 0"}}};
}

/// The wheel at the reference position.
template <class T>
struct BasicCornerWheel {
  Vector3<T> centre;         ///< m
  T toe{0};                  ///< rad, > 0: front of the wheel towards the vehicle
  T camber{0};               ///< rad, > 0: top of the wheel away from the vehicle
  double tyre_diameter = 0;  ///< m, > 0
};
/// The wheel at the reference position, in numbers.
using CornerWheel = BasicCornerWheel<double>;

/// A steering linkage in place of a rack: a Pitman arm on the shaft of the steering box, an idler arm, and
/// the centre link between them, to which the tie rods are joined. Both shafts are parallel. Its points are
/// those of the vehicle, straight ahead; they are the same for both wheels.
struct SteeringLinkage {
  Vec3 axis{0, 0, 1};    ///< direction of both shafts, of any length
  Vec3 pitman_pivot,     ///< a point of the shaft of the Pitman arm, m
      pitman_joint,      ///< joint of the Pitman arm and the centre link, m
      idler_pivot,       ///< a point of the shaft of the idler arm, m
      idler_joint;       ///< joint of the idler arm and the centre link, m
  double box_ratio = 0;  ///< turn of the steering wheel by that of the Pitman arm; 0 = not known

  /// Compares two linkages. @returns true if all numbers are equal
  friend bool operator==(const SteeringLinkage&, const SteeringLinkage&) = default;
};

/// A wheel suspension: plain data.
template <class T>
struct BasicSuspension {
  Side side = Side::left;                 ///< side of the vehicle
  BasicCornerWheel<T> wheel;              ///< wheel at the reference position
  std::vector<BasicCornerLink<T>> links;  ///< links between body and carrier
  std::vector<BasicCoupler<T>> couplers;  ///< rods between links
  Vec3 rack_direction{0, 1, 0};  ///< unit; a rack displacement is positive to the left, for both wheels
  std::optional<BasicCornerSpring<T>> spring;   ///< nothing without a spring
  std::vector<BasicRocker<T>> rockers;          ///< a rocker is driven by what stands before it
  std::vector<BasicCornerElement<T>> elements;  ///< dampers, torsion bars, arms of anti-roll bars
  /// Moves the tie rods instead of a rack. What is called the rack displacement is then that of the Pitman
  /// arm's joint along its arc (m, positive to the left).
  std::optional<SteeringLinkage> steering_linkage;
};
/// A wheel suspension, in numbers.
using Suspension = BasicSuspension<double>;

/// The position of the carrier: its wheel centre (m) and its rotation from the reference position.
template <class T>
struct BasicCarrierPose {
  Vector3<T> centre;    ///< wheel centre, m
  Matrix3<T> rotation;  ///< rotation from the reference position

  /// Compares two poses. @returns true if all numbers are equal
  friend bool operator==(const BasicCarrierPose&, const BasicCarrierPose&) = default;
};
/// The position of the carrier, in numbers.
using CarrierPose = BasicCarrierPose<double>;

/// The place of a point of the carrier in a pose (equation 54).
///
/// @param pose pose of the carrier
/// @param reference the point at the reference position (m)
/// @param reference_centre wheel centre at the reference position (m)
/// @returns the point (m)
constexpr Vec3 place(const CarrierPose& pose, const Vec3& reference, const Vec3& reference_centre) {
  return pose.centre + pose.rotation * (reference - reference_centre);
}

/// Unit vector along the wheel's axis, away from the vehicle (equations 23, 24): for the left wheel (sin toe
/// cos camber, cos toe cos camber, -sin camber).
///
/// @param side side of the vehicle
/// @param toe rad, > 0: front of the wheel towards the vehicle
/// @param camber rad, > 0: top of the wheel away from the vehicle
/// @returns the unit vector
Vec3 wheel_axis(Side side, double toe, double camber);

/// The other wheel of a symmetric axle. A rack displacement moves it as the opposite displacement moves this
/// one.
///
/// @param suspension a suspension
/// @returns its mirror image on the other side
Suspension mirrored(const Suspension& suspension);

/// Test for upright rods.
///
/// @param along vector along the rod
/// @returns true if it is within a thousandth of the vertical
template <class T>
bool is_upright(const Vector3<T>& along) {
  return along.x * along.x + along.y * along.y < 1e-6 * (along.z * along.z);
}

/// Number of points of a link at the body.
///
/// @param type type of the link
/// @returns the number, 1 or 2
int body_points(LinkType type);

/// Number of points of a link at the carrier.
///
/// @param type type of the link
/// @returns the number, 0 to 2
int carrier_points(LinkType type);

/// The axis of a rod's U joint that is fixed in the body: the given one, or else level and across the rod.
/// For an upright rod no level axis is more across than another: it is x.
///
/// @param given direction of the axis, if it is given
/// @param along vector along the rod
/// @returns the unit vector
template <class T>
Vector3<T> standing_axis(const std::optional<Vec3>& given, const Vector3<T>& along) {
  if (given) {
    const Vec3 axis = unit(*given);
    return {T(axis.x), T(axis.y), T(axis.z)};
  }
  if (is_upright(along)) return {T(1), T(0), T(0)};
  return unit(Vector3<T>{-along.y, along.x, T(0)});
}

/// The name of the link in messages: its name, or "link 3 (US)".
///
/// @param suspension the suspension
/// @param link index of the link
/// @returns the text
std::string link_label(const Suspension& suspension, int link);

/// The name of a rocker in messages: its name, or "rocker 1".
///
/// @param suspension the suspension
/// @param rocker index of the rocker
/// @returns the text
std::string rocker_label(const Suspension& suspension, int rocker);

/// Checks the description by itself: numbers of points, numbers that are not finite, links and axes of no
/// length, lengths of links that have none, couplers and springs on links that cannot hold them, rockers
/// whose rods do not reach or do not turn them. Keys of the diagnostics are "link.<name>", "coupler.<name>",
/// "rocker.<name>", the name of an element, "wheel", "spring", "rack". Its mobility is examined by
/// `check_structure`.
///
/// @param suspension the suspension
/// @returns errors; empty if there are none
Diagnostics check(const Suspension& suspension);

/// The angles of a wheel: rad; as rates rad/s (or per m). Carrier pitch is the turn of the carrier about the
/// wheel's axis, zero at the reference and positive about +y (for both wheels: forward at the top). Right
/// wheels are treated as the mirror image of left ones, so that angles of both have the same signs.
template <class T>
struct BasicWheelAngles {
  T toe{0},              ///< > 0: front of the wheel towards the vehicle
      camber{0},         ///< > 0: top of the wheel away from the vehicle
      carrier_pitch{0};  ///< > 0: forward at the top
};
/// The angles of a wheel, in numbers.
using WheelAngles = BasicWheelAngles<double>;

/// Rotation of the carrier from the reference (equation 50, and 51 with its signs corrected).
///
/// @param side side of the vehicle
/// @param reference wheel at the reference position
/// @param angles angles of the wheel
/// @returns the rotation matrix
Mat3 carrier_rotation(Side side, const CornerWheel& reference, const WheelAngles& angles);

/// The angles of a rotation (equations 23, 24 and 50 inverted).
///
/// @param side side of the vehicle
/// @param reference wheel at the reference position
/// @param rotation rotation of the carrier from the reference
/// @returns the angles; camber in (-pi/2, pi/2)
WheelAngles wheel_angles(Side side, const CornerWheel& reference, const Mat3& rotation);

/// Angular velocity of the carrier from the rates of the angles (equation 53).
///
/// @param side side of the vehicle
/// @param at angles of the wheel
/// @param rates rates of the angles (rad/s)
/// @returns the angular velocity (rad/s)
Vec3 angular_velocity(Side side, const WheelAngles& at, const WheelAngles& rates);

/// The rates of the angles from the angular velocity of the carrier; at a camber of a right angle toe has no
/// rate.
///
/// @param side side of the vehicle
/// @param at angles of the wheel
/// @param turning angular velocity of the carrier (rad/s)
/// @returns the rates (rad/s)
WheelAngles angle_rates(Side side, const WheelAngles& at, const Vec3& turning);

/// The vector from the wheel centre to the lowest point of the tyre, a thin disc (equation 25).
///
/// @param side side of the vehicle
/// @param tyre_diameter m
/// @param angles angles of the wheel
/// @returns the vector (m)
Vec3 contact_offset(Side side, double tyre_diameter, const WheelAngles& angles);

/// Two velocities at the contact. They differ along the tyre by the carrier pitch.
template <class T>
struct BasicContactVelocity {
  /// Velocity of the point of the carrier there (equation 28 with its sign corrected): the wheel is held by
  /// the carrier, as by an outboard brake.
  Vector3<T> on_carrier;
  /// Velocity of the contact point itself: the wheel turns freely.
  Vector3<T> geometric;
};
/// Two velocities at the contact, in numbers.
using ContactVelocity = BasicContactVelocity<double>;

/// The velocities at the contact.
///
/// @param side side of the vehicle
/// @param tyre_diameter m
/// @param at angles of the wheel
/// @param velocity velocity of the wheel centre (m/s)
/// @param turning angular velocity of the carrier (rad/s)
/// @returns both velocities (m/s)
ContactVelocity contact_velocity(Side side, double tyre_diameter, const WheelAngles& at, const Vec3& velocity,
                                 const Vec3& turning);

/// A built-in wheel suspension.
struct CornerSample {
  std::string name;       ///< "2RS-US": a basic mechanism; or that of a published example
  std::string summary;    ///< description in one line
  Suspension suspension;  ///< the suspension
};

/// All samples: the twelve basic mechanisms, one realistic left wheel each, movable by at least 80 mm both
/// ways and five of them steered; then the four examples of Poznanovic 2016 (sections 6.1 to 6.4).
///
/// @returns the samples; they exist as long as the program
std::span<const CornerSample> corner_samples();

/// The sample of a name.
///
/// @param name name of the sample
/// @returns the sample
/// @throws ContractError if there is no sample of that name
const CornerSample& corner_sample(std::string_view name);

}  // namespace linkwright::suspension
