// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/drive.h"
#include "linkwright/flexible/response.h"

/// @file
/// Motion of hub and link in time.
namespace linkwright::flexible {

/// A motor in a hinge: turns the outer link against the inner one by a given angle, or with a given torque.
struct HingeDrive {
  std::size_t hinge = 0;  ///< 0, 1, ... from the hub outwards (links.h)
  /// Angle of the outer link against the inner one; exactly one of motion and torque is given.
  std::optional<AngleLaw> motion = {};
  std::optional<TorqueLaw> torque = {};  ///< torque on the outer link
};

/// Options of a simulation.
struct SimulationOptions {
  double end = 0;              ///< s, from 0
  double output_interval = 0;  ///< s: samples at 0, one interval, two, ... and at the end
  double step = 0;  ///< s: longest step; steps end at samples and breaks, and are halved where they fail
  /// Times (s) at which the drive jumps or kinks: steps end there, and the drive is asked just before and
  /// just after.
  std::span<const double> breaks = {};

  /// Runs with the step and with half of it, and takes the limit of both (Richardson): fourth order for
  /// smooth drives, and an estimate of the error.
  bool extrapolate = false;
  /// Tolerance of extrapolate, which halves the step until the extrapolation moves the tip by no more than
  /// this (m); 0: the step as it is.
  double tolerance = 0;

  double spectral_radius = 0.9;  ///< rho_inf in [0, 1): what is left of the stiffest vibrations after a step
  /// Tolerance of the residuals, relative to the largest force and couple in the chain.
  double newton_tolerance = 1e-10;
  int max_iterations = 50;                  ///< of Newton's method in a step
  std::span<const HingeDrive> hinges = {};  ///< hinges without one turn freely about their springs
  bool keep_states = false;                 ///< keeps the state of every sample
  const RunContext* context = nullptr;      ///< looked at every few steps; receives the stage "simulation"
};

/// The start of a motion; empty lists: undeformed, at rest.
struct Start {
  double angle = 0,       ///< angle of the hub, where it is free, rad
      rate = 0;           ///< its rate, rad/s
  std::vector<double> q,  ///< coordinates of the chain, three a cell
      v;                  ///< their rates
};

/// The outcome of a simulation.
struct Simulation {
  /// done; not_converged: a step was too long for the motion, or the tolerance could not be met;
  /// limit_reached: the chain folded (fold_limit); cancelled, deadline. Samples up to
  /// there are kept.
  Status status = Status::done;
  std::string message;                ///< says why it is not `done`
  std::vector<std::string> warnings;  ///< reasons why the result is doubtful though it is `done`
  /// The hub turned faster than the straight chain bears (critical_speed): what the samples show there is an
  /// error of the cells, not of the link.
  bool unstable = false;
  std::vector<Sample> samples;     ///< one for each output time
  std::vector<ChainState> states;  ///< states, one a sample, with keep_states
  /// Torque of each drive of a hinge (N m), given or needed: hinge_torques[i][k] of sample i, drive k.
  std::vector<std::vector<double>> hinge_torques;
  ChainState last;  ///< state at the end of the finest run
  /// Largest change of the tip by the extrapolation (m), NaN if the coarser run failed; 0 without
  /// extrapolate.
  double error = 0;
  double step = 0;          ///< step of the finest run (s)
  long steps = 0,           ///< steps of all runs
      iterations = 0,       ///< iterations of all runs
      factorisations = 0;   ///< factorisations of all runs
  double largest_kink = 0;  ///< largest angle between two bars of a link, rad
  double fastest = 0;       ///< largest |rate| of the hub (rad/s)
};

/// Motion under a given turn of the hub. Generalised-alpha method (Arnold and Bruls 2007) on the residuals,
/// of second order, without a condition on the step; it also takes chains with massless turns.
///
/// @param chain the chain
/// @param law angle of the hub as a function of time
/// @param options times, steps and tolerances
/// @param start deformation and rates at the start
/// @returns the samples, with their status
/// @throws ContractError if times, the tolerance of Newton's method or its iterations are not positive, the
///   spectral radius is outside [0, 1), the start has another size, or drives of hinges are not there or not
///   of one law each
Simulation simulate_motion(const Chain& chain, AngleLaw law, const SimulationOptions& options,
                           const Start& start = {});

/// Motion under a given torque on the hub.
///
/// @param chain the chain
/// @param law torque on the hub as a function of time
/// @param options times, steps and tolerances
/// @param start state at the start
/// @returns the samples, with their status
/// @throws ContractError as simulate_motion does
Simulation simulate_torque(const Chain& chain, TorqueLaw law, const SimulationOptions& options,
                           const Start& start = {});

}  // namespace linkwright::flexible
