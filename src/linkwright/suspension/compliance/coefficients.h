// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/suspension/compliance/compliance.h"

/// Compliance in the terms of chassis engineers, of a wheel and of an axle. SI: rad/N, rad/(N m), m/N; tables
/// for people multiply by the two factors below and turn rad into degrees.
namespace linkwright::suspension {

inline constexpr double per_kilonewton = 1e3;         ///< N
inline constexpr double per_100_newton_metres = 100;  ///< N m

/// Unit loads of a wheel (1 N or 1 N m) with the same sign for both wheels: what toes a left wheel out toes a
/// right one out.
enum class LoadCase {
  lateral,
  brake_outboard,
  brake_inboard,
  drive_inboard,
  drive_outboard,
  longitudinal_at_centre,
  vertical,
  vertical_at_centre,
  aligning_torque,
  overturning_torque
};
constexpr std::array<EnumName<LoadCase>, 10> names(LoadCase) {
  return {
      {{LoadCase::lateral, "lateral", "at the contact, outboard"},
       {LoadCase::brake_outboard, "brake_outboard", "at the contact, rearward, torque taken by the carrier"},
       {LoadCase::brake_inboard, "brake_inboard", "at the contact, rearward, torque taken by the body"},
       {LoadCase::drive_inboard, "drive_inboard", "at the contact, forward, torque taken by the body"},
       {LoadCase::drive_outboard, "drive_outboard",
        "at the contact, forward, torque taken by the carrier (wheel motor)"},
       {LoadCase::longitudinal_at_centre, "longitudinal_at_centre", "at the wheel centre, forward"},
       {LoadCase::vertical, "vertical", "at the contact, upward"},
       {LoadCase::vertical_at_centre, "vertical_at_centre", "at the wheel centre, upward"},
       {LoadCase::aligning_torque, "aligning_torque",
        "about the vertical, turning the front of the wheel outboard"},
       {LoadCase::overturning_torque, "overturning_torque",
        "about the longitudinal axis, turning the top of the wheel outboard"}}};
}

/// The load on the carrier about its wheel centre. A torque that the body takes (inboard brake, drive shaft)
/// leaves the wheel free to turn, so that the moment of the force about the wheel's axis does not reach the
/// carrier.
WheelLoad unit_load(const Compliance& compliance, LoadCase load);

/// Coefficients by the load cases above, toe and camber positive as everywhere (toe-in; top outboard).
/// Compliances are shifts along the load.
struct ComplianceCoefficients {
  Support support = Support::spring;
  double lateral_steer = 0, lateral_camber = 0;                ///< rad/N, lateral
  double lateral_at_contact = 0, lateral_at_centre = 0;        ///< m/N, lateral
  double longitudinal_at_contact = 0;                          ///< m/N, brake_outboard
  double longitudinal_at_centre = 0;                           ///< m/N, longitudinal_at_centre
  double longitudinal_steer = 0;                               ///< rad/N, longitudinal_at_centre
  double brake_outboard_steer = 0, brake_inboard_steer = 0;    ///< rad/N
  double brake_outboard_camber = 0, brake_inboard_camber = 0;  ///< rad/N
  /// rad/N, carrier about the wheel's axis by brake_outboard, > 0: forward at the top.
  double brake_wind_up = 0;
  double drive_steer = 0, drive_camber = 0;        ///< rad/N, drive_inboard
  double aligning_steer = 0, aligning_camber = 0;  ///< rad/(N m), aligning_torque
  double overturning_camber = 0;                   ///< rad/(N m), overturning_torque
  double vertical_at_contact = 0;                  ///< m/N, vertical; 0 with that height held
  /// N/m of the wheel centre along x, y, z by a force there alone, free in all other directions; infinite in
  /// directions that are held.
  Vec3 centre_stiffness;
};
ComplianceCoefficients compliance_coefficients(const Compliance& compliance);

/// 12 by 12: left wheel centre, then right; x, y, z, about x, y, z in the vehicle frame.
using Matrix12 = std::array<std::array<double, 12>, 12>;

/// What joins both wheels of an axle beside their rack.
struct AxleJoining {
  /// Stiffness of the mounts of the subframe against the body, for its shift and turn at the vehicle's
  /// origin; none: it is held.
  std::optional<Matrix6> subframe;
  double bar = 0;  ///< anti-roll bar: moment by the twist between its arms, N m/rad
  /// Twist of the bar by the shift of the left and of the right droplink's end along the droplink, rad/m.
  std::array<double, 2> twist{};
};

/// Both wheels of an axle, joined by their rack: by its stiffness against the body (N/m, `rigid` = held), and
/// by a subframe and an anti-roll bar.
struct AxleCompliance {
  Compliance left, right;
  AxleJoining joining;
  Matrix12 at_centres{};
  std::array<double, 12> rack{};  ///< shift of the rack (m, to the left) by loads as in the matrix
  std::array<std::array<double, 12>, 6> subframe{};  ///< shift and turn of the subframe, likewise
  std::array<double, 12> bar{};                      ///< moment of the bar (N m), likewise
};
/// Both compliances have to be done, and one of a left and one of a right wheel. A suspension without a link
/// on the rack does not feel it, nor does one without joints on the subframe or without a droplink.
AxleCompliance axle_compliance(const Compliance& left, const Compliance& right, double rack_stiffness,
                               const AxleJoining& joining = {});

struct AxleResponse {
  ElasticResponse left, right;
  double rack = 0;                   ///< m
  std::array<double, 6> subframe{};  ///< m, rad
  double bar = 0;                    ///< moment of the anti-roll bar, N m
  double steer = 0;                  ///< rad, mean of both steer angles about +z
  double toe_difference = 0;         ///< rad, left less right
};
AxleResponse respond(const AxleCompliance& axle, const WheelLoad& left, const WheelLoad& right);

/// Both wheels loaded at once by a case (unit load each): `parallel` in the same direction of the vehicle, as
/// lateral forces in a bend or aligning torques, `opposing` in opposite ones, as in the mirror for lateral
/// forces and torques. Loads along x and z are parallel when both wheels have the sign of the case.
enum class Pairing { parallel, opposing };
constexpr std::array<EnumName<Pairing>, 2> names(Pairing) {
  return {
      {{Pairing::parallel, "parallel",
        "both in the same direction of the vehicle, the left as its case says"},
       {Pairing::opposing, "opposing", "in opposite directions of the vehicle, the left as its case says"}}};
}
AxleResponse respond(const AxleCompliance& axle, LoadCase load, Pairing pairing);

}  // namespace linkwright::suspension
