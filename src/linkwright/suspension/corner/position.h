// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/suspension.h"

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
/// The coordinate that is prescribed beside the rack, as a change from the reference (m).
enum class Driver {
  wheel_centre_z,  ///< height of the wheel centre
  contact_z,       ///< height of the lowest point of the tyre
  spring           ///< length of the spring, longer positive
};
constexpr std::array<EnumName<Driver>, 3> names(Driver) {
  return {{{Driver::wheel_centre_z, "wheel_centre_z", "height of the wheel centre"},
           {Driver::contact_z, "contact_z", "height of the lowest point of the tyre"},
           {Driver::spring, "spring", "length of the spring, longer positive"}}};
}

/// The pose of a suspension.
template <class T>
struct BasicCornerPlace {
  BasicCarrierPose<T> carrier;  ///< pose of the carrier
  /// Angle of the RR arm, if there is one (rad, from the reference, right-handed from the first to the second
  /// body point).
  T arm{0};
};
/// The pose of a suspension, in numbers.
using CornerPlace = BasicCornerPlace<double>;

/// Rates of a suspension.
template <class T>
struct BasicTwist {
  Vector3<T> velocity;  ///< of the wheel centre, m/s
  Vector3<T> turning;   ///< angular velocity of the carrier, rad/s
  T arm{0};             ///< rate of the angle of the RR arm, rad/s
};
/// Rates of a suspension, in numbers.
using Twist = BasicTwist<double>;

/// Constants of a link in the equations. Offsets are those of carrier points from the wheel centre.
template <class T>
struct BasicLinkConstants {
  LinkType type = LinkType::US;      ///< joints of the link
  bool moved_by_rack = false;        ///< its body points move with the rack
  std::array<Vector3<T>, 2> body,    ///< body points, m
      offset;                        ///< carrier points from the wheel centre, m
  std::array<T, 2> length{};         ///< distances that the link keeps (m)
  Vector3<T> axis;                   ///< unit: strut line, hinge axis in the body (R, RR)
  Vector3<T> carrier_axis;           ///< unit: hinge axis in the carrier (R, RR)
  Vector3<T> standing_axis;          ///< unit: axis of the U joint in the body (US)
  std::array<Vector3<T>, 2> across;  ///< unit, normal to the strut line or to the carrier's axis
};
/// Constants of a link, in numbers.
using LinkConstants = BasicLinkConstants<double>;

/// A point fixed to a link, by three points of the link P, Q, S: P + a (Q - P) + b (S - P) + k (Q - P) x (S -
/// P).
template <class T>
struct BasicAffinePoint {
  T a{0},    ///< factor of Q - P
      b{0},  ///< factor of S - P
      k{0};  ///< factor of the product, 1/m
};
/// A point fixed to a link, in numbers.
using AffinePoint = BasicAffinePoint<double>;

/// A point fixed to a rod.
template <class T>
struct BasicRodPoint {
  T along{0},         ///< share of the rod's line, from its body point
      beside{0},      ///< offset along the axis of the joint that turns with the rod, m
      above{0};       ///< offset across that axis and the rod, m
  bool held = false;  ///< a U joint holds the spin of the rod, so that the offsets count
};
/// A point fixed to a rod, in numbers.
using RodPoint = BasicRodPoint<double>;

/// Constants of a coupler in the equations.
template <class T>
struct BasicCouplerConstants {
  int first = 0,              ///< index of the US link
      second = 0;             ///< index of the SR link
  BasicRodPoint<T> begin;     ///< its point on the US link
  T length{0};                ///< m, at the reference
  BasicAffinePoint<T> point;  ///< its point on the SR link
};
/// Constants of a coupler, in numbers.
using CouplerConstants = BasicCouplerConstants<double>;

/// Constants of a point fixed to a part.
template <class T>
struct BasicPartPoint {
  CornerPart part;  ///< part that it is fixed to
  /// Body: its place, m. Else an offset, m: carrier from the wheel centre, RR arm from its first body point,
  /// rocker from the first point of its axis.
  Vector3<T> at;
  BasicRodPoint<T> on_rod;    ///< point on a US or SS link
  BasicAffinePoint<T> point;  ///< point on an RS or SR link
};
/// Constants of a point fixed to a part, in numbers.
using PartPoint = BasicPartPoint<double>;

/// Constants of a rocker.
template <class T>
struct BasicRockerConstants {
  Vector3<T> at,             ///< first point of its axis, m
      axis,                  ///< unit vector that its angle counts about
      rod;                   ///< joint of the rod at the reference, from `at`, m
  BasicPartPoint<T> driver;  ///< other end of the rod
  T length{0};               ///< of the rod, m
  bool positive = true;      ///< assembly: sign of the rod's moment about the axis at the reference
};
/// Constants of a rocker, in numbers.
using RockerConstants = BasicRockerConstants<double>;

/// Constants of a length or an angle that is followed.
template <class T>
struct BasicElementConstants {
  BasicPartPoint<T> first,         ///< first end of a length
      second;                      ///< second end of a length
  std::optional<CornerPart> turn;  ///< part whose angle is followed instead
  Vector3<T> mark;                 ///< unit vector across the hinge of an R or RS link at the reference
  bool across = false;             ///< true if the first end is the mirror image of the second one
};
/// Constants of an element, in numbers.
using ElementConstants = BasicElementConstants<double>;

/// Constants of the spring in the equations.
template <class T>
struct BasicSpringConstants {
  BasicPartPoint<T> first,  ///< its end at the body
      second;               ///< its moving end
  T length{0};              ///< m, at the reference drawing
};
/// Constants of the spring, in numbers.
using SpringConstants = BasicSpringConstants<double>;

/// A suspension made ready for solving. Make it with `prepare_suspension`.
template <class T>
struct BasicCornerPlan {
  Side side = Side::left;                           ///< side of the vehicle
  BasicCornerWheel<T> wheel;                        ///< wheel at the reference
  Vector3<T> wheel_axis;                            ///< unit, outboard, at the reference
  Vector3<T> contact;                               ///< point of the tyre at the reference, m
  Vec3 rack_direction;                              ///< unit vector, as in Suspension
  std::optional<SteeringLinkage> steering_linkage;  ///< as in Suspension
  std::vector<BasicLinkConstants<T>> links;         ///< one a link
  std::vector<BasicCouplerConstants<T>> couplers;   ///< one a coupler
  std::optional<BasicSpringConstants<T>> spring;    ///< nothing without a spring
  std::vector<BasicRockerConstants<T>> rockers;     ///< one a rocker
  std::vector<BasicElementConstants<T>> elements;   ///< one an element
  CornerConstruction construction;                  ///< ball joints of the carrier and planes of the arms
  std::vector<std::string> labels;                  ///< names of the links and couplers
  std::vector<std::string> rocker_labels;           ///< names of the rockers
  int unknowns = 6;                                 ///< 7 with an RR arm
};
/// A suspension made ready for solving, in numbers.
using CornerPlan = BasicCornerPlan<double>;

/// Makes a suspension ready for solving.
///
/// @param suspension the suspension
/// @returns the plan
/// @throws ContractError if `check` finds errors in the suspension, or its constraints do not add up to five
CornerPlan prepare_suspension(const Suspension& suspension);

/// Largest number of unknowns: six of the carrier, one of an RR arm.
inline constexpr int max_unknowns = 7;

/// Residuals and their derivatives with respect to the unknowns - shift of the wheel centre, small turn of
/// the carrier, angle of the arm - and to the rack. First the constraints, in the order of links and couplers
/// (m; rad for directions of hinges), the driver last. A distance d that should be l has the residual (d^2 -
/// l^2) / (2 l); a strut has two distances across its line (equation 43, two rows); an RR arm is placed by
/// its angle, since its four distances (equation 44) lose rank where its axes meet or are parallel.
template <class T>
struct BasicCornerEquations {
  /// One an equation, the driver last; m, or rad for directions of hinges.
  std::array<T, max_unknowns> residual{};
  std::array<std::array<T, max_unknowns>, max_unknowns> jacobian{};  ///< [equation][unknown]
  std::array<T, max_unknowns> by_rack{};                             ///< derivatives with respect to the rack
};
/// Residuals and derivatives, in numbers.
using CornerEquations = BasicCornerEquations<double>;

/// Evaluates the equations at a pose.
///
/// @param plan the plan of the suspension
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @param driver coordinate that is prescribed; `spring` needs a plan with a spring
/// @param value wanted value of the driver, as a change from the reference (m)
/// @param out receives residuals and derivatives
/// @throws ContractError if the driver is `spring` and there is none
void evaluate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver, double value,
              CornerEquations& out);

/// The value of the driver's coordinate in a pose.
///
/// @param plan the plan of the suspension
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @param driver the coordinate
/// @returns its change from the reference (m)
/// @throws ContractError if the driver is `spring` and there is none
double driver_value(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver);

/// The rate of the driver's coordinate for a motion.
///
/// @param plan the plan of the suspension
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @param driver the coordinate
/// @param twist rates of the suspension
/// @param rack_rate rate of the rack (m/s)
/// @returns the rate (m/s)
/// @throws ContractError if the driver is `spring` and there is none
double driver_rate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver,
                   const Twist& twist, double rack_rate);

/// The place of a point of a part in a pose.
///
/// @param plan the plan of the suspension
/// @param point constants of the point: an end of its spring, of an element, of a rocker's rod
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @returns the place (m); NaN on a rocker whose rod does not reach
Vec3 place_of(const CornerPlan& plan, const PartPoint& point, const CornerPlace& place, double rack);

/// A rocker in a pose.
struct RockerState {
  bool reaches = true;  ///< false if its rod does not reach it: the other members then mean nothing
  double angle = 0;     ///< rad from the drawing, see BasicRocker
  double rate = 0;      ///< rad/s for the motion that was given
  double lever = 0;     ///< sine of the angle between rod and arm, seen along the axis; 0 at a toggle
};

/// The rockers in a pose.
///
/// @param plan the plan of the suspension
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @param motion rates of the suspension
/// @param rack_rate rate of the rack (m/s)
/// @returns one state a rocker
std::vector<RockerState> rocker_states(const CornerPlan& plan, const CornerPlace& place, double rack,
                                       const Twist& motion = {}, double rack_rate = 0);

/// The largest error of a US link's length, or of a distance that another link keeps, in a pose: too long (+)
/// or too short (-), and the link that has it. Hinges and struts are measured as they miss each other.
struct Misfit {
  int link = -1;   ///< links first, then couplers
  double gap = 0;  ///< m
};

/// The largest error of a pose.
///
/// @param plan the plan of the suspension
/// @param place the pose
/// @param rack rack displacement (m, to the left)
/// @returns the link with its error
Misfit worst_misfit(const CornerPlan& plan, const CornerPlace& place, double rack);

/// The prescribed input of a suspension.
struct CornerInput {
  double value = 0;  ///< driver's coordinate as a change from the reference, m
  double rack = 0;   ///< rack displacement, m, to the left
};

/// The position of a suspension, or the last one reached.
struct CornerPosition {
  /// done; no_assembly: the input lies beyond what the links reach, or the links do not meet at all;
  /// singular: at the start the links lose rank, so that no continuation is determined.
  Status status = Status::done;
  CornerPlace place;                       ///< no_assembly: the last position on the path, next to the limit
  Driver driver = Driver::wheel_centre_z;  ///< coordinate of the input
  CornerInput input;                       ///< input that was reached
  double reached = 1;                      ///< share of the path from the start that was covered
  double residual = 0;                     ///< largest of the equations (m)
  std::string reason;                      ///< empty, or why it ends there, with figures
};

/// The steps by which one position is reached from another: along the straight line between both inputs in
/// value and rack, in steps that grow while they succeed.
struct CornerStepping {
  double first = 0.01;      ///< m of the larger of both inputs
  double smallest = 1e-11;  ///< m: below, the position is at a limit
};

/// The position at the reference input, from the reference points: with prescribed lengths the links are
/// brought together, else it is the reference itself.
///
/// @param plan the plan of the suspension
/// @param driver coordinate of later inputs
/// @returns the position, with its status
CornerPosition reference_position(const CornerPlan& plan, Driver driver = Driver::wheel_centre_z);

/// The position at an input, followed from another position by predictor and Newton steps on rotations (no
/// angles, so no angle is singular), to a residual of 1e-14 m. A step counts only if it is short and the
/// determinant of the equations keeps its sign: past a fold, where the driver turns back, and on other
/// assemblies it does not, so that neither is ever returned. At a limit the fold is found to about
/// `smallest`.
///
/// @param plan the plan of the suspension
/// @param driver coordinate that the input prescribes
/// @param input wanted input
/// @param start position from which it is followed; it must be done
/// @param stepping steps of the continuation
/// @returns the position, or the last one reached
/// @throws ContractError if the start is not done, the driver is `spring` without a spring, the input is not
///   finite, or the steps are not positive
CornerPosition solve_position(const CornerPlan& plan, Driver driver, const CornerInput& input,
                              const CornerPosition& start, const CornerStepping& stepping = {});

/// Ends of the driver's range at a rack displacement: the folds, nearest below and above.
struct TravelLimits {
  std::array<double, 2> value{};  ///< lower and upper end, m
  /// no_assembly: a fold; done: none up to `range`.
  std::array<Status, 2> status{};
};

/// The ends of the driver's range at a rack displacement.
///
/// @param plan the plan of the suspension
/// @param driver the coordinate
/// @param rack rack displacement (m, to the left)
/// @param start position from which both ends are followed; it must be done
/// @param range largest change of the coordinate from the reference that is looked at (m)
/// @returns both ends
/// @throws ContractError as solve_position does
TravelLimits travel_limits(const CornerPlan& plan, Driver driver, double rack, const CornerPosition& start,
                           double range = 1);

/// Motions of a suspension at a position (equations 45, 46).
struct CornerRates {
  Status status = Status::done;  ///< singular: at a fold
  Twist bump,                    ///< at unit rate of the driver with the rack held
      steer;                     ///< at unit rate of the rack with the driver held
};

/// The motions at a position.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @param driver coordinate with unit rate, or held
/// @returns both motions
CornerRates solve_rates(const CornerPlan& plan, const CornerPosition& position, Driver driver);

}  // namespace linkwright::suspension
