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

/// Each step of the integration is held to these.
struct ClearanceTolerances {
  double relative = 1e-10;
  double absolute = 1e-12;  ///< rad; of rates, times the speed of the crank at the start (at least 1 rad/s)
  long max_steps = 1'000'000;
};

/// One row of a simulation; valid during the call that receives it.
struct ClearanceRow {
  double time = 0;
  math::Motion crank;
  LinkState link;
  const ClearanceInstant* instant = nullptr;
};
/// false ends the simulation.
using ClearanceOutput = std::function<bool(const ClearanceRow&)>;

struct ClearanceRun {
  /// done; no_assembly, singular: at the start; limit_reached: the crank cannot turn on; not_converged;
  /// cancelled, deadline. Rows so far are kept.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  double time = 0;      ///< reached, s
  LinkState link;       ///< then
  /// s: when the tension first is zero or less, so that pin and bush would part; NaN when it never is. What
  /// follows is outside of the model.
  double first_separation = nan;
  double separated = 0;           ///< share of the time during which the tension is zero or less, 0 to 1
  int sign_changes = 0;           ///< sign changes of the tension
  double min_tension = infinity;  ///< N, over steps and rows
  double max_tension = -infinity;
  double fastest_link = 0;  ///< rad/s: largest |rate| of the clearance link, over steps and rows
  long steps = 0, evaluations = 0;
};

/// Motion of the clearance link while the crank moves as the law says (absolute angle, rad), from `start` at
/// times.front(). `times` (s, rising, two at least) are those of the rows and have no influence on the steps.
/// Throws ContractError as require_valid, for a clearance of 0, and for times and laws that do not work.
ClearanceRun simulate_clearance(const ClearanceFourBar& model, const math::MotionLaw& crank,
                                const LinkState& start, std::span<const double> times,
                                const ClearanceTolerances& tolerances = {},
                                const ClearanceOutput& output = {}, const RunContext* context = nullptr);

/// A crank that rotates uniformly.
struct UniformCrank {
  double angle = 0;  ///< rad, at time 0
  double speed = 1;  ///< rad/s, not 0
};

/// Motion that repeats itself with every turn of the crank. `phase` is the angle of the clearance link before
/// the crank, `slope` its derivative by the angle of the crank, both at the start.
struct ClearanceOrbit {
  /// done; not_converged: Newton's method found no orbit, or the motion did not settle; no_assembly,
  /// singular: the linkage does not rotate fully; deadline, cancelled.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  double phase = 0, slope = 0;
  double residual = infinity;  ///< largest change of either over one turn
  /// Floquet multipliers: what becomes of small departures over one turn. On the unit circle for a stable
  /// orbit without damping, within it with damping.
  std::array<std::complex<double>, 2> multipliers{};
  /// Derivative of phase and slope after a turn by those before it, row by row: where the multipliers come
  /// from.
  std::array<double, 4> derivative{};
  int iterations = 0;  ///< iterations of Newton's method, or turns of the crank

  LinkState start(const UniformCrank& crank) const {
    return {crank.angle + phase, crank.speed * (1 + slope)};
  }
};

/// Shooting: Newton's method on (phase, slope) over one turn, with central differences and steps of at most
/// 0.5, from a guess. There may be several orbits, or none.
ClearanceOrbit find_orbit(const ClearanceFourBar& model, const UniformCrank& crank, double phase = 0,
                          double slope = 0, const ClearanceTolerances& tolerances = {},
                          const RunContext* context = nullptr);

/// The orbit of a model that differs a little from one whose orbit is known: as find_orbit, with the
/// derivative of the known orbit as long as that converges, so that most steps cost one turn. Derivative and
/// multipliers may be those of the known orbit.
ClearanceOrbit follow_orbit(const ClearanceFourBar& model, const UniformCrank& crank,
                            const ClearanceOrbit& known, const ClearanceTolerances& tolerances = {},
                            const RunContext* context = nullptr);

/// Lets the motion run from `start` until two turns differ by at most `tolerance` in phase and slope, as
/// motions with damping do; not_converged when it has not within so many turns. No multipliers.
ClearanceOrbit settle(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                      int turns, double tolerance = 1e-9, const ClearanceTolerances& tolerances = {},
                      const RunContext* context = nullptr);

/// Root of the sum of the squares of (link angle - crank angle - phase) over `samples` points of one turn,
/// divided by their number (rad), of the motion from `start`: Varedi et al. 2014, Eq. (30), with the wanted
/// angle of Eq. (34). Infinite when the linkage does not rotate fully, or the run is to stop.
double phase_error(const ClearanceFourBar& model, const UniformCrank& crank, const LinkState& start,
                   double phase, int samples, const ClearanceTolerances& tolerances = {},
                   const RunContext* context = nullptr);

}  // namespace linkwright::clearance
