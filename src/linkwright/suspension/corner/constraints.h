// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/constructions.h"
#include "linkwright/suspension/corner/suspension.h"

/// The equations of a wheel suspension: residuals of its joints and of a driver, with exact derivatives.
namespace linkwright::suspension {

/// The coordinate that is prescribed beside the rack, as a change from the reference (m).
enum class Driver { wheel_centre_z, contact_z, spring };
constexpr std::array<EnumName<Driver>, 3> names(Driver) {
  return {{{Driver::wheel_centre_z, "wheel_centre_z", "height of the wheel centre"},
           {Driver::contact_z, "contact_z", "height of the lowest point of the tyre"},
           {Driver::spring, "spring", "length of the spring, longer positive"}}};
}

/// The pose of a suspension: the carrier, and the angle (rad, from the reference, right-handed from the first
/// to the second body point) of its RR arm if it has one.
template <class T>
struct BasicCornerPlace {
  BasicCarrierPose<T> carrier;
  T arm{0};
};
using CornerPlace = BasicCornerPlace<double>;

/// Rates of a suspension: velocity of the wheel centre (m/s), angular velocity of the carrier (rad/s), rate
/// of the arm.
template <class T>
struct BasicTwist {
  Vector3<T> velocity;
  Vector3<T> turning;
  T arm{0};
};
using Twist = BasicTwist<double>;

/// Constants of a link in the equations. Offsets are those of carrier points from the wheel centre.
template <class T>
struct BasicLinkConstants {
  LinkType type = LinkType::US;
  bool moved_by_rack = false;
  std::array<Vector3<T>, 2> body, offset;
  std::array<T, 2> length{};         ///< distances that the link keeps (m)
  Vector3<T> axis;                   ///< unit: strut line, hinge axis in the body (R, RR)
  Vector3<T> carrier_axis;           ///< unit: hinge axis in the carrier (R, RR)
  Vector3<T> standing_axis;          ///< unit: axis of the U joint in the body (US)
  std::array<Vector3<T>, 2> across;  ///< unit, normal to the strut line or to the carrier's axis
};
using LinkConstants = BasicLinkConstants<double>;

/// A point fixed to a link, by three points of the link P, Q, S: P + a (Q - P) + b (S - P) + k (Q - P) x (S -
/// P).
template <class T>
struct BasicAffinePoint {
  T a{0}, b{0}, k{0};
};
using AffinePoint = BasicAffinePoint<double>;

/// A point fixed to a rod: its share of the rod's line, and where a U joint holds the rod's spin its offsets
/// from the line (m), along the axis of the joint that turns with the rod and across both.
template <class T>
struct BasicRodPoint {
  T along{0}, beside{0}, above{0};
  bool held = false;
};
using RodPoint = BasicRodPoint<double>;

template <class T>
struct BasicCouplerConstants {
  int first = 0, second = 0;
  BasicRodPoint<T> begin;
  T length{0};
  BasicAffinePoint<T> point;
};
using CouplerConstants = BasicCouplerConstants<double>;

template <class T>
struct BasicSpringConstants {
  Vector3<T> body;
  Vector3<T> offset;  ///< carrier: from the wheel centre; RR arm: from its first body point
  int link = -1;
  T length{0};
  BasicRodPoint<T> on_rod;
  BasicAffinePoint<T> point;
};
using SpringConstants = BasicSpringConstants<double>;

/// A suspension made ready for solving. Make it with `prepare_suspension`.
template <class T>
struct BasicCornerPlan {
  Side side = Side::left;
  BasicCornerWheel<T> wheel;
  Vector3<T> wheel_axis;  ///< unit, outboard, at the reference
  Vector3<T> contact;     ///< point of the tyre, at the reference
  Vec3 rack_direction;
  std::vector<BasicLinkConstants<T>> links;
  std::vector<BasicCouplerConstants<T>> couplers;
  std::optional<BasicSpringConstants<T>> spring;
  CornerConstruction construction;
  std::vector<std::string> labels;  ///< names of the links and couplers
  int unknowns = 6;                 ///< 7 with an RR arm
};
using CornerPlan = BasicCornerPlan<double>;

/// Throws ContractError for a suspension that `check` finds errors in, or whose constraints do not add up to
/// five.
CornerPlan prepare_suspension(const Suspension& suspension);

inline constexpr int max_unknowns = 7;

/// Residuals and their derivatives with respect to the unknowns - shift of the wheel centre, small turn of
/// the carrier, angle of the arm - and to the rack. First the constraints, in the order of links and couplers
/// (m; rad for directions of hinges), the driver last. A distance d that should be l has the residual (d^2 -
/// l^2) / (2 l); a strut has two distances across its line (equation 43, two rows); an RR arm is placed by
/// its angle, since its four distances (equation 44) lose rank where its axes meet or are parallel.
template <class T>
struct BasicCornerEquations {
  std::array<T, max_unknowns> residual{};
  std::array<std::array<T, max_unknowns>, max_unknowns> jacobian{};  ///< [equation][unknown]
  std::array<T, max_unknowns> by_rack{};
};
using CornerEquations = BasicCornerEquations<double>;

/// `value` is what the driver should have (m). The driver `spring` needs a plan with a spring.
void evaluate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver, double value,
              CornerEquations& out);

/// The value of the driver's coordinate in a pose (m, change from the reference), and its rate for a motion.
double driver_value(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver);
double driver_rate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver,
                   const Twist& twist, double rack_rate);

/// The largest error of a US link's length, or of a distance that another link keeps, in a pose: too long (+)
/// or too short (-), and the link that has it. Hinges and struts are measured as they miss each other.
struct Misfit {
  int link = -1;   ///< links first, then couplers
  double gap = 0;  ///< m
};
Misfit worst_misfit(const CornerPlan& plan, const CornerPlace& place, double rack);

}  // namespace linkwright::suspension
