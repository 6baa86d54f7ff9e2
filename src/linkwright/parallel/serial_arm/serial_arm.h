// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "linkwright/core/field.h"
#include "linkwright/math/vector2.h"
#include "linkwright/parallel/pi_joint/dynamics.h"
#include "linkwright/parallel/robot/drives.h"

/// Planar serial arm of two Pi-joints (Milutinovic et al. 2014, figure 5, of which this is a reading): the
/// second is mounted on the coupler of the first. Couplers do not turn, so both arm angles are absolute, the
/// tool keeps its orientation, and each drive works against something that does not turn:
///
///     p = A + c + a1 u(q1) + a2 u(q2),   u(q) = (cos q, sin q).
///
/// Base axes x, y. SI units, radians.
namespace linkwright::parallel {

/// One number for each of the two arms.
using PerArm = std::array<double, 2>;
using Matrix2 = std::array<std::array<double, 2>, 2>;

struct SerialPiArm {
  math::Vec2 base{};             ///< A: pivot of the first arm (m)
  math::Vec2 offset{};           ///< c: all that couplers add between pivots and tool point, constant (m)
  PerArm arm{};                  ///< a1, a2 > 0 (m)
  std::array<Drive, 2> drive{};  ///< Pi-joints, or motors beside a passive parallelogram
};

/// Says what keeps it from being such an arm, with the value; nothing if it is one. The functions below do
/// not ask again.
std::optional<std::string> problem(const SerialPiArm& arm);

struct SerialAngles {
  /// done; no_assembly: too far or too near; singular: arms of equal length with the tool over the pivot,
  /// where q1 is open.
  Status status = Status::done;
  PerArm angle{};        ///< q1, q2 (rad, in (-pi, pi]); NaN when not done
  double shortfall = 0;  ///< length that the arms lack (m): > 0 too far, < 0 too near
};
/// `mode` 1 or -1: sign of sin(q2 - q1); 1 = the second arm turns to the left of the first. At the limits
/// both meet; what rounding puts beyond them is taken as there.
SerialAngles inverse(const SerialPiArm& arm, const math::Vec2& point, int mode);

/// Tool point (m).
math::Vec2 direct(const SerialPiArm& arm, const PerArm& angles);

/// J = [a1 u'(q1), a2 u'(q2)]: velocity by arm speeds (m).
Matrix2 jacobian(const SerialPiArm& arm, const PerArm& angles);
/// det J = a1 a2 sin(q2 - q1): its sign is the mode, 0 = arms in line (m2).
double determinant(const SerialPiArm& arm, const PerArm& angles);

/// Area of the tool points within reach, an annulus: 4 pi a1 a2 (m2), whatever the drives allow.
double reachable_area(const SerialPiArm& arm);

/// Drives of an arm; `joint` is the first that is not done, from 0.
struct SerialDrives {
  Status status = Status::done;
  int joint = -1;
  std::array<DriveAt, 2> drive{};
};
SerialDrives drives_at(const SerialPiArm& arm, const PerArm& angles);
/// Arm angles by values of the drives; no_assembly where a diagonal cannot be.
SerialAngles arm_angles(const SerialPiArm& arm, const PerArm& values);
/// J diag(1/j): velocity by rates of the drives' values; not finite where a Pi-joint is singular.
Matrix2 total_jacobian(const SerialPiArm& arm, const PerArm& angles);

/// The displacement of the tool point by one step of each drive; NaN or infinite where a Pi-joint is
/// singular.
struct SerialResolution {
  math::Vec2 along{};  ///< bound along each axis (m)
  double worst = 0;    ///< largest displacement over all combinations of signs (m)
};
SerialResolution resolution(const SerialPiArm& arm, const PerArm& angles);

/// Symmetric compliance of the tool point by the stiffnesses of the drives (m/N): a force moves it by this
/// times the force. 0 with rigid drives; not finite where a Pi-joint is singular.
Matrix2 compliance(const SerialPiArm& arm, const PerArm& angles);

struct SerialQuality {
  double sine = 0;            ///< sin(q2 - q1), 0 = arms in line: the tool cannot move along them
  PerArm singular_value{};    ///< singular values of J, descending (m)
  double condition = 0;       ///< largest over least, infinite in line
  double manipulability = 0;  ///< |det J| (m2)
  /// Transmission indices of the drives: sin(mu) of a Pi-joint, 1 of a motor; NaN where it cannot be.
  PerArm transmission{};
  bool singular = false;  ///< sine or a transmission is at most the limit in magnitude
};
SerialQuality quality(const SerialPiArm& arm, const PerArm& angles, double limit = 1e-6);

/// Torques of the drives on the arms (N m), and their efforts (N m, N).
struct SerialLoads {
  /// done; singular: a Pi-joint without lever, its effort alone is NaN; no_assembly: a Pi-joint does not turn
  /// so far; limit_reached: a drive beyond its travel, all the same known.
  Status status = Status::done;
  int joint = -1;  ///< first with the trouble, from 0
  PerArm arm_torque{};
  PerArm drive_value{}, drive_speed{}, drive_acceleration{};
  PerArm drive_effort{};
  PerArm drive_power{};  ///< W
};
/// Holds a force on the tool (N): tau = -J^T W. Never singular by the arms.
SerialLoads static_loads(const SerialPiArm& arm, const PerArm& angles, const math::Vec2& force,
                         double limit = 1e-6);

/// Masses of one joint.
struct SerialMasses {
  /// Inertia of both arms about their pivots together, with what a motor turns (kg m2).
  double arm_inertia = 0;
  double arm_mass = 0;    ///< mass of both arms together (kg)
  double arm_centre = 0;  ///< mass centre from the pivots along the arms (m)
  /// Mass of the coupler and of all that does not turn on it, also the next joint's frame and motor (kg).
  double coupler_mass = 0;
  /// Masses of the Pi-joint that drives, in place of inertia, mass and centre of the arms and of the coupler.
  std::optional<PiMasses> pi;
};
template <class Visitor>
void fields(Visitor&& visit, SerialMasses& m) {
  visit(field::inertia("arm_inertia", "of both arms about their pivots, with what a motor turns")
            .not_negative(),
        m.arm_inertia);
  visit(field::mass("arm_mass", "mass of both arms").not_negative(), m.arm_mass);
  visit(field::length("arm_centre", "mass centre of the arms from their pivots, negative = behind them"),
        m.arm_centre);
  visit(field::mass("coupler_mass", "mass of the coupler with all that does not turn on it").not_negative(),
        m.coupler_mass);
}
struct SerialArmMasses {
  std::array<SerialMasses, 2> joint{};
  double payload = 0;               ///< at the tool, not turning (kg)
  math::Vec2 gravity{0, -9.80665};  ///< m/s2
};
/// Says what keeps them from being masses of this arm, with the joint (from 1) and the value; nothing if they
/// are.
std::optional<std::string> problem(const SerialPiArm& arm, const SerialArmMasses& masses);

/// Exact inverse dynamics: torques and efforts for a motion of the arms (rad, rad/s, rad/s2) with a force on
/// the tool (N). Since couplers do not turn, the acceleration of its frame acts on the second joint as
/// gravity.
SerialLoads inverse_dynamics(const SerialPiArm& arm, const SerialArmMasses& masses, const PerArm& angles,
                             const PerArm& speeds, const PerArm& accelerations, const math::Vec2& force = {},
                             double limit = 1e-6);

/// Arm speeds and accelerations for those of the tool.
struct SerialRates {
  Status status = Status::done;  ///< singular: arms in line within the limit
  PerArm speed{}, acceleration{};
};
SerialRates arm_rates(const SerialPiArm& arm, const PerArm& angles, const math::Vec2& velocity,
                      const math::Vec2& acceleration, double limit = 1e-6);

}  // namespace linkwright::parallel
