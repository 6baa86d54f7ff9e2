// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/plan.h"

// Speed fluctuation of a machine: a linkage with one turning input over its cycle: one turn, or as many as
// its loads take to repeat.
namespace linkwright::planar {

struct SpeedFluctuationSetup {
  double start = 0;           ///< rad: input where the cycle begins
  double mean_speed = 1;      ///< rad/s, a turn over its time; not 0; negative: backwards
  double fluctuation = 0.02;  ///< wanted (largest - least) / mean speed, > 0
  int samples = 720;          ///< samples of a turn, at least 16
};

/// A driven cycle seen from the input: everything that moves as one inertia J that changes with the angle,
/// and all loads as one torque Q on it; J a + J' speed^2 / 2 = Q + motor.
struct SpeedFluctuation {
  Status status = Status::done;
  Sentence message;             ///< says in plain words why it is not `done`
  int turns = 1;                ///< turns of the cycle: after so many the loads repeat
  std::vector<double> input;    ///< rad, evenly from the start in the sense of turning, end excluded
  std::vector<double> inertia;  ///< kg m2: twice the kinetic energy over the squared speed
  std::vector<double> torque;   ///< N m: of weight, springs, loads and friction at the mean speed
  std::vector<double> energy;   ///< J: that the constant motor torque and Q have brought in since the start
  std::vector<double> speed;    ///< rad/s: of the motion with that motor and no flywheel
  std::vector<double> with_flywheel;  ///< rad/s: with the flywheel
  double motor_torque = 0;            ///< N m: constant torque that keeps the mean speed
  double energy_fluctuation = 0;      ///< J: largest less least of `energy`
  double fluctuation = 0;             ///< (largest - least) / mean of `speed`
  double flywheel = 0;                ///< kg m2 on the input, for the wanted fluctuation; 0 = none is needed
};

/// The constant motor torque, the fluctuation of energy and speed, and the flywheel for a wanted coefficient
/// of fluctuation. With kinetic energy (J + flywheel) speed^2 / 2 over the angle exactly, not to first order
/// of the fluctuation. Torques that go by speed are taken for motors and left out. Loads act as at the mean
/// speed.
///
/// no_assembly, singular or infeasible (change points) when the linkage does not rotate fully; cancelled,
/// deadline: without anything, or, when `speed` is not empty, without the flywheel and `with_flywheel`, which
/// are NaN. Throws ContractError when there is not one turning input whose turn is a cycle in closed form, a
/// load goes by time, a body has no mass, or the setup is out of range.
SpeedFluctuation speed_fluctuation(const Linkage& linkage, const LinkagePlan& plan,
                                   const SpeedFluctuationSetup& setup, const RunContext* context = nullptr);

/// The steady motion of a motor with its loads.
struct SteadyCycle {
  Status status = Status::done;
  Sentence message;
  int turns = 1;              ///< turns of the cycle
  std::vector<double> input;  ///< rad, evenly from the start, the cycle with both ends
  std::vector<double> speed;  ///< rad/s
  double period = 0;          ///< s
  double mean_speed = 0;      ///< rad/s, a turn over its time
  double fluctuation = 0;     ///< (largest - least) / mean
  int cycles = 0;             ///< cycles that were integrated until it repeated itself
};

/// Finds the speed at the start that repeats itself after a turn, to a relative 1e-9, from the mean speed of
/// `setup` on: cycle by cycle, and by the secant through the last two. Motors are torques that go by speed.
///
/// limit_reached when the linkage comes to rest within a turn; not_converged when no speed repeats itself,
/// as without a motor; cancelled, deadline; else as `speed_fluctuation`. `fluctuation` of the setup is not
/// used.
SteadyCycle steady_cycle(const Linkage& linkage, const LinkagePlan& plan, const SpeedFluctuationSetup& setup,
                         const RunContext* context = nullptr);

}  // namespace linkwright::planar
