// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/math/function_ref.h"

/// @file
/// Motion of hub and link in time.
namespace linkwright::flexible {

/// Angle of the hub and its derivatives.
struct HubMotion {
  double angle = 0,      ///< rad
      rate = 0,          ///< rad/s
      acceleration = 0;  ///< rad/s2
};

/// Angle of the hub as a function of time (s).
using AngleLaw = math::FunctionRef<HubMotion(double)>;
/// Torque (N m) as a function of time (s).
using TorqueLaw = math::FunctionRef<double(double)>;

/// Spin-up (Boskovic 2018, (3.50)): from rest to a steady rate within a time, without a jump of the
/// acceleration.
struct SpinUp {
  double rate = 0;      ///< omega_0 (rad/s), of either sign
  double duration = 0;  ///< T > 0 (s)
  /// The motion at a time.
  ///
  /// @param time s
  /// @returns angle, rate and acceleration of the hub
  /// @throws ContractError unless the duration is positive
  HubMotion operator()(double time) const;
};

/// One period of a sine (Boskovic 2018, (3.51)), then none.
struct SinePulse {
  double torque = 0;    ///< tau_0 (N m)
  double duration = 0;  ///< T > 0 (s): a break
  /// The torque at a time.
  ///
  /// @param time s
  /// @returns N m
  /// @throws ContractError unless the duration is positive
  double operator()(double time) const;
};

/// Torque in straight lines between rows; none before the first and after the last.
struct TorqueTable {
  std::vector<double> times;    ///< s, increasing: breaks
  std::vector<double> torques;  ///< N m
  /// The torque at a time.
  ///
  /// @param time s
  /// @returns N m
  /// @throws ContractError unless there are times, and as many torques
  double operator()(double time) const;
};

/// The quantities of hub and link at one time.
struct Sample {
  double time = 0;  ///< s
  /// Angle of the hub, and its derivatives (rad, rad/s, rad/s2).
  double angle = 0,      ///< angle of the hub, rad
      rate = 0,          ///< its rate, rad/s
      acceleration = 0;  ///< its acceleration, rad/s2
  double torque = 0;     ///< torque of the drive: given, or needed for the given motion (N m)
  /// Displacement of the tip along xi from its place on the undeformed link (m).
  double tip_xi = 0,
         tip_eta = 0;    ///< the same along eta, m
  double tip_angle = 0;  ///< angle of the link there against the hub (rad)
  /// Force of the hub on the link at O1 along xi (N).
  double reaction_xi = 0,
         reaction_eta = 0,      ///< the same along eta, N
      moment = 0;               ///< couple of the hub on the link at O1, N m
  double bending_moment = 0;    ///< largest |M| along the link (N m); NaN for source_linearised
  double kinetic = 0,           ///< J
      potential = 0;            ///< J
  double work = 0;              ///< work of all drives since the start (J)
  double dissipated = 0;        ///< by all dampers (J)
  double angular_momentum = 0;  ///< about O (N m s)

  /// The balance kinetic + potential + dissipated - work, which stays as it was at the start. @returns J
  double energy_balance() const { return kinetic + potential + dissipated - work; }
};

/// The smallest or largest value of a sampled quantity between two times, with the time, refined by a
/// parabola through three samples.
struct Extreme {
  double time = 0,  ///< s
      value = 0;    ///< value of the quantity
};

/// The smallest value of a quantity.
///
/// @param samples the samples
/// @param quantity the member of Sample
/// @param from first time (s)
/// @param to last time (s)
/// @returns value and time
/// @throws ContractError if there is no sample with a number between both times
Extreme smallest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);

/// The largest value of a quantity.
///
/// @param samples the samples
/// @param quantity the member of Sample
/// @param from first time (s)
/// @param to last time (s)
/// @returns value and time
/// @throws ContractError if there is no sample with a number between both times
Extreme largest(std::span<const Sample> samples, double Sample::*quantity, double from, double to);

/// The bending stress by a moment.
///
/// @param beam the beam
/// @param moment bending moment (N m)
/// @param fibre_distance distance of the outer fibre from the neutral line (m), > 0
/// @returns the stress (Pa)
/// @throws ContractError unless the distance is positive
double bending_stress(const Beam& beam, double moment, double fibre_distance);

/// The samples as a table, one row a sample; columns time_s, hub_angle_rad, ..., energy_balance_J, the last
/// from what it was in the first sample.
///
/// @param samples the samples
/// @returns the table "response"
Table table_of(std::span<const Sample> samples);

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
