// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::clearance {

/// Four-bar O2-A-B-O4 whose crank pin A has clearance in the bush A' of the coupler. Pin and bush are taken
/// to touch always, so that A' runs on a circle of the radial clearance about A: the joint is a massless
/// rigid link A-A' (Varedi et al. 2014, Eqs. (1), (2)). All angles are absolute, in radians,
/// counter-clockwise from the x axis; the direction of the ground link is `linkage.frame_angle`, and open is
/// the assembly mode with B to the left of A'->O4. The tracing point lies at coupler_u + i coupler_v from A',
/// u along A'->B.
struct ClearanceFourBar {
  planar::FourBar linkage;   ///< the linkage without clearance
  double clearance = 0;      ///< r, m: radius of the bush less radius of the pin; 0 = the ideal joint
  planar::BodyMass coupler;  ///< frame: origin A', x axis A'->B
  planar::BodyMass rocker;   ///< frame: origin O4, x axis O4->B
  std::complex<double> gravity{0, -9.81};  ///< m/s2, acceleration of free fall
  // Viscous torques against the absolute rates of coupler, rocker and clearance link (N m s), Eq. (27).
  /// Viscous torque against the absolute rate of the coupler (N m s), Eq. (27).
  double coupler_damping = 0,
         rocker_damping = 0,  ///< the same of the rocker
      link_damping = 0;       ///< the same of the clearance link
};

/// Checks a model.
///
/// @param model the model
/// @throws ContractError on lengths that are not positive, on a clearance that is negative or not shorter
///   than every link, and on masses, inertias and damping that are negative or not finite
void require_valid(const ClearanceFourBar& model);

/// The condition of full rotation: all links assemble at every angle of the crank and of the clearance link.
///
/// @param model the model
/// @returns true if the crank rotates fully wherever the pin lies in the bush (crank-rocker and double-crank
///   families)
bool turns_fully(const ClearanceFourBar& model);

/// |sin(coupler - rocker)| below which the linkage counts as singular: coupler and rocker in line.
inline constexpr double singular_sine = 1e-9;

/// Position of all joints. NaN where it is not known.
struct ClearancePosition {
  Status status = Status::done;          ///< no_assembly; singular: coupler and rocker in line
  std::complex<double> pin,              ///< A, m
      bush;                              ///< A', m
  std::complex<double> joint{nan, nan};  ///< B, m
  std::complex<double> point{nan, nan};  ///< tracing point P, m, Eq. (8)
  double coupler_angle = nan,            ///< rad, (-pi, pi]
      rocker_angle = nan;                ///< rad, (-pi, pi]
  double sine = nan;                     ///< sin(coupler angle - rocker angle)
  double gap = 0;  ///< m, by how much the links are too long or too short to close; 0 when assembled
};

/// Position in closed form for given directions of the crank and of the clearance link. Does not check the
/// model: see require_valid.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param link_angle absolute direction from A to A' (rad)
/// @returns the position, with its status
ClearancePosition clearance_position(const ClearanceFourBar& model, double crank_angle, double link_angle);

/// Change of coupler and rocker angle with the angles of the crank and the clearance link (Eq. (14)).
struct ClearanceInfluence {
  double coupler_by_link = 0,  ///< rad/rad
      rocker_by_link = 0,      ///< rad/rad
      coupler_by_crank = 0,    ///< rad/rad
      rocker_by_crank = 0;     ///< rad/rad
};

/// The change of coupler and rocker angle with the angles of the crank and the clearance link.
///
/// @param model the model
/// @param position its position at these angles
/// @param crank_angle absolute angle of the crank (rad)
/// @param link_angle absolute direction from A to A' (rad)
/// @returns the derivatives
ClearanceInfluence clearance_influence(const ClearanceFourBar& model, const ClearancePosition& position,
                                       double crank_angle, double link_angle);

/// Angle of the clearance link and its rate.
struct LinkState {
  double angle = 0;  ///< rad, not wrapped
  double rate = 0;   ///< rad/s
};

/// Motion and forces at one instant.
struct ClearanceInstant {
  Status status = Status::done;    ///< status of the position; singular also when the link moves no mass
  ClearancePosition position;      ///< position of all joints
  double link_acceleration = nan;  ///< rad/s2, from M a + h = 0 (Eq. (28))
  double link_inertia = nan;       ///< M, kg m2
  double coupler_rate = nan,       ///< rad/s
      rocker_rate = nan,           ///< rad/s
      coupler_acceleration = nan,  ///< rad/s2
      rocker_acceleration = nan;   ///< rad/s2
  /// Velocity of P (m/s).
  std::complex<double> point_velocity{nan, nan}, point_acceleration{nan, nan};  ///< acceleration of P, m/s2
  std::complex<double> bush_velocity{nan, nan};                                 ///< velocity of A', m/s
  std::complex<double> pin_force{nan, nan};    ///< N, of the crank pin on the coupler
  std::complex<double> joint_force{nan, nan};  ///< N, of the rocker on the coupler at B
  std::complex<double> pivot_force{nan, nan};  ///< N, of the ground on the rocker at O4
  /// Force in the clearance link (N). Positive: pin and bush are pressed together; zero or negative: they
  /// would part, and the model has left its range.
  double tension = nan;
  double tangential = nan;    ///< N, pin_force across the link, positive towards growing link angle
  double drive_torque = nan;  ///< N m, on the massless crank
};

/// Motion and forces at one instant by equations (24)-(28), with second derivatives in the form of
/// accelerations that remain when the clearance link has none, and the joint forces. With clearance 0 the
/// ideal linkage: the link angle is not used, its acceleration and inertia are 0, tension is the size of the
/// pin force and tangential is 0. Does not check the model.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param crank_rate rad/s
/// @param crank_acceleration rad/s2
/// @param link angle and rate of the clearance link
/// @returns motion and forces, with their status
ClearanceInstant clearance_instant(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                                   double crank_acceleration, const LinkState& link);

/// Limit of the link angle as the clearance goes to zero: the direction of the force that the coupler puts on
/// the pin in the ideal linkage, where pin and bush are pressed together. Damping of the link itself does not
/// count.
///
/// @param model the model
/// @param crank_angle absolute angle of the crank (rad)
/// @param crank_rate rad/s
/// @param crank_acceleration rad/s2
/// @returns the direction (rad), in (-pi, pi]; NaN where there is no force or no position
double force_direction(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                       double crank_acceleration);

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

/// The problem of the first stage, see clearance/path_synthesis.h.
struct ClearancePathProblem;  // clearance/path_synthesis.h

/// The problem of the second stage, see clearance/mass_synthesis.h.
struct ClearanceMassProblem;  // clearance/mass_synthesis.h

/// The first design: Table 1, made without clearance, with the masses of Table 2 (mass centres read as
/// metres), no weight: Varedi, Daniali, Dardel and Fathi 2014 (Sharif Journal of Mechanical Engineering 30-3,
/// 2/2), which prints neither the clearance nor speed, weight, start or target path. @returns the model
ClearanceFourBar published_design_1();
/// The second design: Table 1, made with clearance, with the masses of Table 3. @returns the model
ClearanceFourBar published_design_2();

/// The clearance with which design 2, its clearance link 10 degrees ahead of the crank, comes closest to the
/// path of design 1 without clearance, at equal crank angles. The 1 mm is inferred from it.
///
/// @returns m
double inferred_clearance();

/// First stage: the path of design 1 without clearance at even steps of its crank (36, from 0), a phase of 10
/// degrees, and bounds of our own.
///
/// @returns the problem
ClearancePathProblem published_path_problem();

/// Second stage: the phase of 10 degrees for design 2 at 10 rad/s without weight, and bounds of our own.
///
/// @returns the problem
ClearanceMassProblem published_mass_problem();

/// A published statement beside what is computed here.
struct ClearanceComparison {
  std::string quantity;   ///< quantity with its unit
  std::string published;  ///< value in the source, in words where it prints no number
  double ours = 0;        ///< value computed here
  std::string verdict;    ///< "reproduced", "corrected" or "not reproduced"
  std::string note;       ///< remark on the difference; may be empty
};
/// Computes all published statements again; takes some hundredths of a second. @returns one entry a statement
std::vector<ClearanceComparison> compare_with_published_clearance();

}  // namespace linkwright::clearance
