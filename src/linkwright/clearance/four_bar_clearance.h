// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::clearance {

/// Four-bar O2-A-B-O4 whose crank pin A has clearance in the bush A' of the coupler. Pin and bush are taken
/// to touch always, so that A' runs on a circle of the radial clearance about A: the joint is a massless
/// rigid link A-A' (Varedi et al. 2014, Eqs. (1), (2)). All angles are absolute, in radians,
/// counter-clockwise from the x axis; the direction of the ground link is `linkage.frame_angle`, and open is
/// the assembly mode with B to the left of A'->O4. The tracing point lies at coupler_u + i coupler_v from A',
/// u along A'->B.
struct ClearanceFourBar {
  planar::FourBar linkage;   ///< the linkage without clearance
  double clearance = 0;      ///< r, m: radius of the bush less radius of the pin; 0 = the ideal joint
  planar::BodyMass coupler;  ///< frame: origin A', x axis A'->B
  planar::BodyMass rocker;   ///< frame: origin O4, x axis O4->B
  std::complex<double> gravity{0, -9.81};  ///< m/s2, acceleration of free fall
  // Viscous torques against the absolute rates of coupler, rocker and clearance link (N m s), Eq. (27).
  /// Viscous torque against the absolute rate of the coupler (N m s), Eq. (27).
  double coupler_damping = 0,
         rocker_damping = 0,  ///< the same of the rocker
      link_damping = 0;       ///< the same of the clearance link
};

/// Checks a model.
///
/// @param model the model
/// @throws ContractError on lengths that are not positive, on a clearance that is negative or not shorter
///   than every link, and on masses, inertias and damping that are negative or not finite
void require_valid(const ClearanceFourBar& model);

/// The condition of full rotation: all links assemble at every angle of the crank and of the clearance link.
///
/// @param model the model
/// @returns true if the crank rotates fully wherever the pin lies in the bush (crank-rocker and double-crank
///   families)
bool turns_fully(const ClearanceFourBar& model);

/// |sin(coupler - rocker)| below which the linkage counts as singular: coupler and rocker in line.
inline constexpr double singular_sine = 1e-9;

/// Position of all joints. NaN where it is not known.
struct ClearancePosition {
  Status status = Status::done;          ///< no_assembly; singular: coupler and rocker in line
  std::complex<double> pin,              ///< A, m
      bush;                              ///< A', m
  std::complex<double> joint{nan, nan};  ///< B, m
  std::complex<double> point{nan, nan};  ///< tracing point P, m, Eq. (8)
  double coupler_angle = nan,            ///< rad, (-pi, pi]
      rocker_angle = nan;                ///< rad, (-pi, pi]
  double sine = nan;                     ///< sin(coupler angle - rocker angle)
  double gap = 0;  ///< m, by how much the links are too long or too short to close; 0 when assembled
};

/// Position in closed form for given directions of the crank and of the clearance link. Does not check the
/// model: see require_valid.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param link_angle absolute direction from A to A' (rad)
/// @returns the position, with its status
ClearancePosition clearance_position(const ClearanceFourBar& model, double crank_angle, double link_angle);

/// Change of coupler and rocker angle with the angles of the crank and the clearance link (Eq. (14)).
struct ClearanceInfluence {
  double coupler_by_link = 0,  ///< rad/rad
      rocker_by_link = 0,      ///< rad/rad
      coupler_by_crank = 0,    ///< rad/rad
      rocker_by_crank = 0;     ///< rad/rad
};

/// The change of coupler and rocker angle with the angles of the crank and the clearance link.
///
/// @param model the model
/// @param position its position at these angles
/// @param crank_angle absolute angle of the crank (rad)
/// @param link_angle absolute direction from A to A' (rad)
/// @returns the derivatives
ClearanceInfluence clearance_influence(const ClearanceFourBar& model, const ClearancePosition& position,
                                       double crank_angle, double link_angle);

/// Angle of the clearance link and its rate.
struct LinkState {
  double angle = 0;  ///< rad, not wrapped
  double rate = 0;   ///< rad/s
};

/// Motion and forces at one instant.
struct ClearanceInstant {
  Status status = Status::done;    ///< status of the position; singular also when the link moves no mass
  ClearancePosition position;      ///< position of all joints
  double link_acceleration = nan;  ///< rad/s2, from M a + h = 0 (Eq. (28))
  double link_inertia = nan;       ///< M, kg m2
  double coupler_rate = nan,       ///< rad/s
      rocker_rate = nan,           ///< rad/s
      coupler_acceleration = nan,  ///< rad/s2
      rocker_acceleration = nan;   ///< rad/s2
  /// Velocity of P (m/s).
  std::complex<double> point_velocity{nan, nan}, point_acceleration{nan, nan};  ///< acceleration of P, m/s2
  std::complex<double> bush_velocity{nan, nan};                                 ///< velocity of A', m/s
  std::complex<double> pin_force{nan, nan};    ///< N, of the crank pin on the coupler
  std::complex<double> joint_force{nan, nan};  ///< N, of the rocker on the coupler at B
  std::complex<double> pivot_force{nan, nan};  ///< N, of the ground on the rocker at O4
  /// Force in the clearance link (N). Positive: pin and bush are pressed together; zero or negative: they
  /// would part, and the model has left its range.
  double tension = nan;
  double tangential = nan;    ///< N, pin_force across the link, positive towards growing link angle
  double drive_torque = nan;  ///< N m, on the massless crank
};

/// Motion and forces at one instant by equations (24)-(28), with second derivatives in the form of
/// accelerations that remain when the clearance link has none, and the joint forces. With clearance 0 the
/// ideal linkage: the link angle is not used, its acceleration and inertia are 0, tension is the size of the
/// pin force and tangential is 0. Does not check the model.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param crank_rate rad/s
/// @param crank_acceleration rad/s2
/// @param link angle and rate of the clearance link
/// @returns motion and forces, with their status
ClearanceInstant clearance_instant(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                                   double crank_acceleration, const LinkState& link);

/// Limit of the link angle as the clearance goes to zero: the direction of the force that the coupler puts on
/// the pin in the ideal linkage, where pin and bush are pressed together. Damping of the link itself does not
/// count.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param crank_rate rad/s
/// @param crank_acceleration rad/s2
/// @returns the direction (rad), in (-pi, pi]; NaN where there is no force or no position
double force_direction(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                       double crank_acceleration);

}  // namespace linkwright::clearance
