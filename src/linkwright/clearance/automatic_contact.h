// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/contact_simulation.h"
#include "linkwright/clearance/joint_clearance.h"
#include "linkwright/core/numbers.h"

// Pins that stay on their bushes as long as they are pressed on, and from the loss of contact on fly, strike
// and slide: the model of joint_clearance.h until it leaves its range, that of contact_simulation.h from
// there on.
namespace linkwright::clearance {

/// A pin that has clearance.
struct AutomaticPin {
  ContactJoint contact;  ///< its start does not count
  /// Angle (rad) and rate (rad/s) of the clearance link at the start, as in JointClearance.
  double angle = 0, rate = 0;
};

/// The joints as the model of continuous contact takes them.
std::vector<JointClearance> continuous_joints(std::span<const AutomaticPin> pins);

/// The pins in contact, at an instant of continuous contact: in the same directions, turning as fast, pressed
/// in as deep as their tension needs. Those without tension are free by a billionth of their clearance.
std::vector<ContactJoint> contact_joints(std::span<const AutomaticPin> pins,
                                         std::span<const ClearanceState> states);

struct AutomaticContactOutput {
  JointClearanceOutput continuous = {};  ///< rows before the switch
  /// Rows from the switch on; work, dissipated energy and drift are those since the start of the motion.
  ContactOutput contact = {};
};

struct AutomaticContactRun {
  Status status = Status::done;  ///< status of the model in which the run ended
  std::string message;
  double time = 0;               ///< reached, s
  JointClearanceRun continuous;  ///< until the switch
  ContactRun contact;            ///< from the switch on; empty when there is none
  /// s: when the tension of a pin is lost for the first time; NaN when continuous contact holds throughout.
  double switched = nan;
  int pin = -1;                               ///< pin that parted then
  std::vector<planar::InputMotion> inputs;    ///< inputs of the linkage at the switch
  double energy_step = 0;                     ///< J: energy after the switch less before it
  double largest_drift = 0, peak_energy = 0;  ///< J, over the rows of both
  long steps = 0, evaluations = 0;            ///< steps and evaluations of both models
};

/// The motion, as simulate_joint_clearance until the tension of any pin is lost, and as simulate_contact from
/// that instant on, for all pins and for good: others that are still pressed on begin in contact. At the
/// switch directions and rates stay; energy grows by what presses the others in (energy_step; zero with one
/// pin). Friction of contacts acts after the switch only. Options are those of the contacts; in continuous
/// contact the tolerance is that of the steps, too. Throws as both of them do.
AutomaticContactRun simulate_automatic_contact(const planar::Linkage& linkage,
                                               std::span<const AutomaticPin> pins,
                                               std::span<const planar::InputDrive> drives,
                                               std::span<const double> times,
                                               const ContactOptions& options = {},
                                               const AutomaticContactOutput& output = {},
                                               const RunContext* context = nullptr);

}  // namespace linkwright::clearance
