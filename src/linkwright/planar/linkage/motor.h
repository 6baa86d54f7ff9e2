// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"

/// @file
/// The choice of a motor for a drive: what the drive asks of the motor through its gear, against what the
/// motor can give.
namespace linkwright::planar {

/// A motor of a catalogue.
struct Motor {
  std::string name;         ///< its name in the catalogue
  double rated_torque = 0;  ///< N m, that it gives for any time: limit of the root mean square
  double peak_torque = 0;   ///< N m, that it gives for a short time
  double max_speed = 0;     ///< rad/s
  double inertia = 0;       ///< kg m2, of the rotor, brake and what turns with it
  std::vector<double> gear_ratio{
      1};                      ///< turns of the motor for one of the drive, or of the screw; any of them
  double gear_efficiency = 1;  ///< share of the power that the gear passes on
  double lead = 0;             ///< m, of a screw for a drive that slides; 0: there is none
};

/// The demand of a drive over a cycle, one entry an instant. Angles of a drive that turns, lengths of one
/// that slides.
struct MotorLoad {
  std::vector<double> time;          ///< s, rising
  std::vector<double> effort;        ///< N m or N
  std::vector<double> speed;         ///< rad/s or m/s
  std::vector<double> acceleration;  ///< rad/s2 or m/s2
  std::vector<double> inertia;       ///< kg m2 or kg: reduced to the drive while the others rest
};

/// The use of a motor with one of its gear ratios.
struct MotorUse {
  double gear_ratio = 1;   ///< the ratio
  double turning = 1;      ///< rad of the motor for a unit of the drive (rad/rad or rad/m)
  double rms_torque = 0;   ///< N m
  double peak_torque = 0;  ///< N m
  double peak_speed = 0;   ///< rad/s
  double inertia_ratio =
      0;  ///< greatest inertia of the load at the motor over that of the motor; NaN without
  std::vector<double> torque,  ///< N m, of the motor, one entry an instant
      speed;                   ///< rad/s, likewise
  /// The greatest of the shares of rated torque, peak torque and speed; the motor suffices up to 1.
  double share = 0;
  /// @returns true if the motor suffices
  bool fits() const { return share <= 1; }
};

/// The use of a motor by a drive.
///
/// @param motor the motor; a lead of more than 0 for a drive that slides
/// @param gear_ratio turns of the motor for one of the drive, or of the screw
/// @param load demand of the drive
/// @returns torques, speed and shares
/// @throws ContractError if the lists of the load differ in length or are empty
MotorUse motor_use(const Motor& motor, double gear_ratio, const MotorLoad& load);

/// Root mean square of a quantity that stays the same in each interval.
///
/// @param values one for each interval
/// @param durations durations of the intervals (s)
/// @returns root of the mean of the squares over the whole time, rests included
/// @throws ContractError if the lists differ in length, or the durations do not sum up to more than 0
double rms_of_steps(std::span<const double> values, std::span<const double> durations);

/// Root mean square of a quantity that changes linearly between instants.
///
/// @param times instants (s), rising
/// @param values one for each instant
/// @returns root of the mean of the squares over the whole time; the value itself of a single instant
/// @throws ContractError if the lists differ in length or are empty
double rms_over(std::span<const double> times, std::span<const double> values);

// ---------------------------------------------------------------------------------------------------------------

template <class Visitor>
void fields(Visitor&& visit, Motor& m) {
  visit(field::entry("name", "name of the motor in its catalogue").required(), m.name);
  visit(field::torque("rated_torque", "torque that it gives for any time, at least the root mean square")
            .positive()
            .required(),
        m.rated_torque);
  visit(field::torque("peak_torque", "torque that it gives for a short time").positive().required(),
        m.peak_torque);
  visit(field::speed_angular("max_speed", "greatest speed").positive().required(), m.max_speed);
  visit(field::inertia("inertia", "of the rotor and what turns with it").not_negative(), m.inertia);
  visit(
      field::entry("gear_ratio", "turns of the motor for one of the drive, or of its screw; any of the list")
          .between(1e-6, 1e6),
      m.gear_ratio);
  visit(field::entry("gear_efficiency", "share of the power that gear and screw pass on").between(0.01, 1),
        m.gear_efficiency);
  visit(field::length("lead",
                      "of the screw that moves a drive that slides; if absent 0, the motor turns its drive")
            .not_negative(),
        m.lead);
}

}  // namespace linkwright::planar
