// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <functional>
#include <span>
#include <string>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/math/motion_law.h"

namespace linkwright::clearance {

/// Tolerances of each step of the integration.
struct ClearanceTolerances {
  double relative = 1e-10;  ///< of each step
  double absolute = 1e-12;  ///< rad; of rates, times the speed of the crank at the start (at least 1 rad/s)
  long max_steps = 1'000'000;  ///< steps after which it ends as not_converged
};

/// One row of a simulation; valid during the call that receives it.
struct ClearanceRow {
  double time = 0;                            ///< s
  math::Motion crank;                         ///< absolute angle of the crank (rad) with its rates
  LinkState link;                             ///< angle and rate of the clearance link
  const ClearanceInstant* instant = nullptr;  ///< motion and forces
};
/// A function that receives the rows; false ends the simulation.
using ClearanceOutput = std::function<bool(const ClearanceRow&)>;

/// The outcome of a simulation.
struct ClearanceRun {
  /// done; no_assembly, singular: at the start; limit_reached: the crank cannot turn on; not_converged;
  /// cancelled, deadline. Rows so far are kept.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  double time = 0;      ///< reached, s
  LinkState link;       ///< state of the clearance link then
  /// Time (s) when the tension first is zero or less, so that pin and bush would part; NaN when it never is.
  /// Results after it are outside of the model.
  double first_separation = nan;
  double separated = 0;            ///< share of the time during which the tension is zero or less, 0 to 1
  int sign_changes = 0;            ///< sign changes of the tension
  double min_tension = infinity;   ///< N, over steps and rows
  double max_tension = -infinity;  ///< N, over steps and rows
  double fastest_link = 0;         ///< rad/s: largest |rate| of the clearance link, over steps and rows
  long steps = 0,                  ///< of the integration
      evaluations = 0;             ///< of the equations of motion
};

/// Motion of the clearance link while the crank moves as the law says (absolute angle, rad). The times of the
/// rows have no influence on the steps.
///
/// @param model the model
/// @param crank law of the crank: absolute angle (rad) over time (s)
/// @param start state of the clearance link at the first time
/// @param times times of the rows (s), rising, two at least
/// @param tolerances tolerances of each step
/// @param output receives the rows; empty: none
/// @param context deadline and cancellation; null: none
/// @returns the outcome
/// @throws ContractError as require_valid does, for a clearance of 0, and for times and laws that do not work
ClearanceRun simulate_clearance(const ClearanceFourBar& model, const math::MotionLaw& crank,
                                const LinkState& start, std::span<const double> times,
                                const ClearanceTolerances& tolerances = {},
                                const ClearanceOutput& output = {}, const RunContext* context = nullptr);

/// A crank that rotates uniformly.
struct UniformCrank {
  double angle = 0;  ///< rad, at time 0
  double speed = 1;  ///< rad/s, not 0
};

/// A motion that repeats itself with every turn of the crank.
struct ClearanceOrbit {
  /// done; not_converged: Newton's method found no orbit, or the motion did not settle; no_assembly,
  /// singular: the linkage does not rotate fully; deadline, cancelled.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  /// Angle of the clearance link before the crank at the start (rad).
  double phase = 0,
         slope = 0;            ///< its derivative by the angle of the crank
  double residual = infinity;  ///< largest change of either over one turn
  /// Floquet multipliers: the factors by which small departures change over one turn. They lie on the unit
  /// circle for a stable orbit without damping, within it with damping.
  std::array<std::complex<double>, 2> multipliers{};
  /// Derivative of phase and slope after a turn by those before it, row by row; the multipliers are its
  /// eigenvalues.
  std::array<double, 4> derivative{};
  int iterations = 0;  ///< iterations of Newton's method, or turns of the crank

  /// The state of the clearance link at the start of the orbit.
  ///
  /// @param crank motion of the crank
  /// @returns angle (rad) and rate (rad/s)
  LinkState start(const UniformCrank& crank) const {
    return {crank.angle + phase, crank.speed * (1 + slope)};
  }
};

/// Finds a periodic motion by shooting: Newton's method on (phase, slope) over one turn, with central
/// differences and steps of at most 0.5, from a guess. There may be several orbits, or none.
///
/// @param model the model
/// @param crank motion of the crank
/// @param phase guess of the phase (rad)
/// @param slope guess of the slope
/// @param tolerances tolerances of each step
/// @param context deadline and cancellation; null: none
/// @returns the orbit, with its status
/// @throws ContractError as require_valid does, for a clearance of 0, and for a crank that is not finite or
///   at rest
ClearanceOrbit find_orbit(const ClearanceFourBar& model, const UniformCrank& crank, double phase = 0,
                          double slope = 0, const ClearanceTolerances& tolerances = {},
                          const RunContext* context = nullptr);

/// The orbit of a model that differs a little from one whose orbit is known: as find_orbit, with the
/// derivative of the known orbit as long as that converges, so that most steps cost one turn. Derivative and
/// multipliers may be those of the known orbit.
///
/// @param model the model
/// @param crank motion of the crank
/// @param known orbit of the other model
/// @param tolerances tolerances of each step
/// @param context deadline and cancellation; null: none
/// @returns the orbit, with its status
/// @throws ContractError as find_orbit does
ClearanceOrbit follow_orbit(const ClearanceFourBar& model, const UniformCrank& crank,
                            const ClearanceOrbit& known, const ClearanceTolerances& tolerances = {},
                            const RunContext* context = nullptr);

/// Runs the motion until two turns differ little in phase and slope, as motions with damping do. The result
/// has no multipliers.
///
/// @param model the model
/// @param crank motion of the crank
/// @param start state of the clearance link at time 0
/// @param turns largest number of turns, at least 1
/// @param tolerance largest difference of phase (rad) and of slope
/// @param tolerances tolerances of each step
/// @param context deadline and cancellation; null: none
/// @returns the orbit; not_converged if it is not periodic within so many turns
/// @throws ContractError as find_orbit does, and unless there is one turn at least
ClearanceOrbit settle(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                      int turns, double tolerance = 1e-9, const ClearanceTolerances& tolerances = {},
                      const RunContext* context = nullptr);

/// Root of the sum of the squares of (link angle - crank angle - phase) over the points of one turn, divided
/// by their number: Varedi et al. 2014, Eq. (30), with the wanted angle of Eq. (34).
///
/// @param model the model
/// @param crank motion of the crank
/// @param start state of the clearance link at time 0
/// @param phase wanted angle of the clearance link before the crank (rad)
/// @param samples number of points, at least 1
/// @param tolerances tolerances of each step
/// @param context deadline and cancellation; null: none
/// @returns the error (rad); infinite if the linkage does not rotate fully, or the run is to stop
/// @throws ContractError as find_orbit does, and unless there is one sample at least
double phase_error(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                   double phase, int samples, const ClearanceTolerances& tolerances = {},
                   const RunContext* context = nullptr);

}  // namespace linkwright::clearance
