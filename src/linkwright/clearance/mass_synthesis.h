// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/path_synthesis.h"

// Masses of coupler and rocker that make the clearance link turn as it should: the second stage of Varedi et
// al. 2014, and both stages at once.
namespace linkwright::clearance {

/// The design variables in the order of the variables, Eq. (29): mass, mass centre and inertia about it of
/// coupler (3) and rocker (4), in the frames of ClearanceFourBar.
enum class ClearanceMass : std::size_t {
  coupler_mass,
  coupler_u,
  coupler_v,
  coupler_inertia,
  rocker_mass,
  rocker_u,
  rocker_v,
  rocker_inertia
};
inline constexpr std::size_t clearance_mass_count = 8;

struct ClearanceMassProblem {
  ClearanceFourBar model;  ///< lengths, clearance, weight and damping; its masses do not count
  UniformCrank crank;
  double phase = 0;  ///< rad: by how much the clearance link is to lead the crank, Eq. (34)
  int samples = 72;  ///< points of a turn at which the phase is compared
  std::array<Range, clearance_mass_count> bounds{};
  ClearanceTolerances tolerances{.relative = 1e-8, .absolute = 1e-10};
};
/// Throws ContractError unless the model is valid, masses and inertias stay positive and bounds are in order.
void require_valid(const ClearanceMassProblem& problem);

/// The model with these masses.
ClearanceFourBar with_masses(const ClearanceFourBar& model, std::span<const double> x);

/// Objective of the source (rad), Eq. (30): of one turn that starts with the wanted phase at the speed of the
/// crank. Infinite where the linkage does not rotate fully, or the run is to stop.
double transient_phase_error(const ClearanceMassProblem& problem, std::span<const double> x,
                             const RunContext* context = nullptr);

/// For population methods: cost = transient_phase_error; constraint `rotates_fully`.
optimise::Problem clearance_mass_problem(const ClearanceMassProblem& problem);

struct ClearanceMassDesign {
  /// done; infeasible: no masses within the bounds press pin and bush together; not_converged: of the
  /// orbit; deadline, cancelled.
  Status status = Status::done;
  std::vector<double> x;
  ClearanceOrbit orbit;        ///< orbit with these masses
  double orbit_error = 0;      ///< rad: as the objective, on the orbit
  double transient_error = 0;  ///< rad: the objective of the source
  double min_tension = 0;      ///< N, on the orbit; not positive: pin and bush would part
  std::int64_t evaluations = 0;
};
/// The design with these masses; `x` is kept. Without an orbit, that is not_converged, when `context` asks to
/// stop.
ClearanceMassDesign clearance_mass_design(const ClearanceMassProblem& problem, std::vector<double> x,
                                          const RunContext* context = nullptr);

/// The recommended method. First the limit of small clearances, where the force of the ideal joint must point
/// along the wanted link: without integration, as that force is linear in masses, moments and inertias, by
/// least squares from `starts` places of the bounds. Then least squares on the periodic orbit itself, found
/// again by shooting for every trial. Deterministic for a seed.
ClearanceMassDesign synthesise_clearance_masses(const ClearanceMassProblem& problem, int starts,
                                                const optimise::Seed& seed, RunContext& context);

/// Angles (rad) between the force of the ideal pin and the wanted direction of the clearance link over a
/// turn, problem.samples of them; NaN where there is no force.
std::vector<double> force_phase_errors(const ClearanceMassProblem& problem, std::span<const double> x);

/// Lengths and masses together.
struct ClearanceDesign {
  Status status = Status::done;  ///< status, as in ClearanceMassDesign
  ClearanceFourBar model;
  std::vector<double> x;  ///< nine lengths, eight masses
  ClearanceOrbit orbit;
  double path_rms = 0;     ///< m: distance of the points on the orbit from their targets
  double limit_rms = 0;    ///< m: the same with the clearance link along the force of the ideal joint
  double min_tension = 0;  ///< N, on the orbit
  std::int64_t evaluations = 0;
};
/// The path that is traced on the periodic orbit itself is brought to the target, in lengths and masses at
/// once; no law for the clearance link is presumed, and `phase` of neither problem is used. Only designs
/// whose pin and bush stay in contact over the whole turn are taken. Timing must be prescribed. Starts from
/// the lengths of `path_x` (as of synthesise_clearance_path) and the masses of `mass_x`, and from what is
/// best in the limit of small clearances.
ClearanceDesign design_clearance_linkage(const ClearancePathProblem& path, const ClearanceMassProblem& mass,
                                         std::span<const double> path_x, std::span<const double> mass_x,
                                         RunContext& context);

}  // namespace linkwright::clearance
