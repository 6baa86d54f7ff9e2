// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

/// Screw and motor that change the diagonal of a Pi-joint, and what they make of it at its output
/// (Milutinovic et al. 2014, equation numbers in parentheses). Forces along the diagonal are positive where
/// they lengthen it, torques of the joint where they increase theta; so a force F gives the torque J F (13).
namespace linkwright::parallel {

struct PiScrew {
  double lead = 0;        ///< h > 0: travel of the nut for one turn (m)
  double efficiency = 1;  ///< eta in (0, 1], when the motor drives the load
};

/// Efficiency when the load drives the screw, 2 - 1/eta: friction takes the same from both directions. Not
/// above 0: self-locking.
double back_driving_efficiency(const PiScrew& screw);
bool self_locking(const PiScrew& screw);

/// Torque of the motor (N m) for a force on the load and the rate of the diagonal: (15), F h / (2 pi eta),
/// where the motor drives the load or starts to (force and rate of one sign, or no rate); F h eta_b / (2 pi)
/// where the load drives the screw, eta_b its back-driving efficiency. In a self-locking screw the latter has
/// the other sign: the motor must help a load down.
double motor_torque(const PiScrew& screw, double force, double rate);

/// Rate of the diagonal (m/s) for a speed of the motor (rad/s), and back.
double rate_of(const PiScrew& screw, double motor_speed);
double motor_speed_of(const PiScrew& screw, double rate);

/// A point of a torque-speed curve: the torque that a motor has at a speed.
struct MotorTorque {
  double speed = 0;   ///< rad/s
  double torque = 0;  ///< N m
};

struct PiMotor {
  double steps_per_turn = 0;    ///< 0: a motor without steps
  double top_speed = infinity;  ///< rad/s
  /// Torque over speed, straight between the points, the first one at speed 0; without torque beyond the
  /// last one, unless it is the only one, which holds at all speeds. Empty: as much as is asked for.
  std::vector<MotorTorque> torque;
};

struct PiDrive {
  PiScrew screw;
  PiMotor motor;
  double force_limit = infinity;  ///< largest force of screw and bearings (N)
  double rate_limit = infinity;   ///< largest speed of the diagonal (m/s)
};

/// Says what keeps it from being a drive, with the value; nothing if it is one.
std::optional<std::string> problem(const PiDrive& drive);

/// Step of the diagonal (m): lead by steps per turn; 0 for a motor without steps.
double quantum(const PiDrive& drive);

/// Fastest the diagonal can move (m/s): the lesser of its own limit and that of the motor, which is also
/// where its torque curve ends.
double top_rate(const PiDrive& drive);

/// The direction of the power flow through the screw.
enum class PowerFlow { motor_drives, load_drives };

/// Largest force along the diagonal (N) that can be driven, or held back, at a rate of the diagonal (m/s, of
/// any sign); 0 beyond top_rate.
double available_force(const PiDrive& drive, double rate, PowerFlow flow = PowerFlow::motor_drives);

/// The output of a drive at the joint (figures 15-17). At +-pi/2 torque is 0, the others infinite.
struct PiOutput {
  double torque = 0;      ///< from standstill (N m)
  double speed = 0;       ///< largest, without torque (rad/s)
  double resolution = 0;  ///< turn for a step (rad)
};
PiOutput output(const PiJoint& joint, const PiDrive& drive, double angle);

/// Torque that the joint gives in the direction of its motion at an angle and angular speed (N m, at least
/// 0); 0 where the drive is too slow.
double available_torque(const PiJoint& joint, const PiDrive& drive, double angle, double angular_speed);

}  // namespace linkwright::parallel
