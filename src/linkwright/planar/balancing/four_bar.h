// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/sweep.h"
#include "linkwright/planar/link_mass.h"

namespace linkwright::planar {

/// Root of the sum of squares, divided by the number of intervals, which is one less than that of the
/// samples: (1/n) sqrt(sum over i = 0 ... n of x_i^2), Boskovic 2018, Eqs. (2.37), (2.80) taken literally. It
/// depends on the mesh: it falls like 1/sqrt(n).
///
/// @param samples the quantity, at least 2 samples
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there are too few samples
double rss_over_n(std::span<const double> samples);

/// Root of the mean of the squares. A periodic quantity must hold each sample once.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double rms(std::span<const double> samples);

/// Mean of the absolute values.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double mean_abs(std::span<const double> samples);

/// Largest absolute value.
///
/// @param samples the quantity, at least 1 sample
/// @returns the measure, in the unit of the samples; NaN if a sample is NaN
/// @throws ContractError if there is no sample
double max_abs(std::span<const double> samples);

/// The measures by name.
enum class Measure {
  rss_over_n,  ///< root of the sum of squares over the number of intervals
  rms,         ///< root mean square
  mean_abs,    ///< mean of the absolute values
  max_abs,     ///< largest absolute value
  maximum,     ///< largest value
  minimum,     ///< smallest value
  range        ///< from the smallest to the largest value
};
constexpr std::array<EnumName<Measure>, 7> names(Measure) {
  return {{{Measure::rss_over_n, "rss_over_n", "root of the sum of squares over the number of intervals"},
           {Measure::rms, "rms", "root mean square"},
           {Measure::mean_abs, "mean_abs", "mean of the absolute values"},
           {Measure::max_abs, "max_abs", "largest absolute value"},
           {Measure::maximum, "maximum", "largest value"},
           {Measure::minimum, "minimum", "smallest value"},
           {Measure::range, "range", "from the smallest to the largest value"}}};
}

/// A measure of a sampled quantity.
///
/// @param measure the measure
/// @param samples the quantity
/// @returns its value, in the unit of the samples
/// @throws ContractError if there are too few samples
double measure(Measure measure, std::span<const double> samples);

/// A measure of a quantity over a period. When the samples close, the last one is the first one again, and
/// means count one of the two. rss_over_n keeps both, as it is defined.
///
/// @param measure the measure
/// @param samples the quantity
/// @param closes true if the last sample is the first one again
/// @returns its value, in the unit of the samples
/// @throws ContractError if there are too few samples
double measure(Measure measure, std::span<const double> samples, bool closes);

/// Number of the samples of a period that count, from the first one on.
///
/// @param measure the measure
/// @param n number of samples
/// @param closes true if the last sample is the first one again
/// @returns n or n - 1
constexpr std::size_t counted(Measure measure, std::size_t n, bool closes) {
  return closes && n > 1 && (measure == Measure::rms || measure == Measure::mean_abs) ? n - 1 : n;
}

/// The properties of a measure that searches may build on.
struct MeasureProperties {
  /// True for a norm of the samples: it is convex, the same for x and -x, and zero only where all are.
  bool norm = false;
  bool quadratic = false;  ///< root of a sum of squares: smooth but at zero
};

/// The properties of a measure.
///
/// @param measure the measure
/// @returns its properties
constexpr MeasureProperties properties(Measure measure) {
  switch (measure) {
    case Measure::rss_over_n:
    case Measure::rms:
      return {.norm = true, .quadratic = true};
    case Measure::mean_abs:
    case Measure::max_abs:
      return {.norm = true};
    case Measure::maximum:
    case Measure::minimum:
    case Measure::range:
      break;
  }
  return {};
}

}  // namespace linkwright::planar

namespace linkwright::optimise {
struct SmoothProblem;
}

namespace linkwright::planar {

/// The numbers of a four-bar that balancing may choose, in the order of the variables (Boskovic 2018, section
/// 2.4: L1 ... L4, alpha1 ... alpha3, m1 ... m3, J1 ... J3, d1 ... d3, with L1 the crank and L4 the ground).
enum class FourBarNumber : std::size_t {
  crank,                    ///< length, m
  coupler,                  ///< length, m
  rocker,                   ///< length, m
  ground,                   ///< length, m
  crank_centre_angle,       ///< angle of its mass centre from the link line, rad
  coupler_centre_angle,     ///< angle of its mass centre from the link line, rad
  rocker_centre_angle,      ///< angle of its mass centre from the link line, rad
  crank_mass,               ///< kg
  coupler_mass,             ///< kg
  rocker_mass,              ///< kg
  crank_inertia,            ///< about its mass centre, kg m2
  coupler_inertia,          ///< about its mass centre, kg m2
  rocker_inertia,           ///< about its mass centre, kg m2
  crank_centre_distance,    ///< distance of its mass centre from O, m
  coupler_centre_distance,  ///< distance of its mass centre from A, m
  rocker_centre_distance    ///< distance of its mass centre from B0, m
};
/// Number of entries of FourBarNumber.
inline constexpr std::size_t four_bar_number_count = 16;

/// The place of a number among the variables.
///
/// @param number the number
/// @returns its index, from 0
constexpr std::size_t index(FourBarNumber number) { return static_cast<std::size_t>(number); }

/// The key of a number with its unit: "crank_m", "coupler_centre_angle_rad", "rocker_inertia_kg_m2".
///
/// @param number the number
/// @returns the key
std::string_view name(FourBarNumber number);

/// The numbers of a four-bar in the order of FourBarNumber, SI.
using FourBarNumbers = std::array<double, four_bar_number_count>;

/// The four-bar that has given numbers. Its pivot is the origin, its frame angle 0.
///
/// @param numbers in the order of FourBarNumber, SI
/// @param branch assembly branch
/// @returns the four-bar with its masses
FourBarMachine four_bar_machine(std::span<const double, four_bar_number_count> numbers,
                                Branch branch = Branch::open);

/// The numbers of a four-bar.
///
/// @param machine the four-bar with its masses
/// @returns its numbers in the order of FourBarNumber, SI
FourBarNumbers four_bar_numbers(const FourBarMachine& machine);

/// A component that may be balanced: a component of the joint forces, drive torque, shaking force and
/// moments, as in FourBarReactions. Names are those of the columns of the analysis without their unit.
enum class FourBarComponent {
  O1_x,                      ///< force of the ground on the crank, x, N
  O1_y,                      ///< force of the ground on the crank, y, N
  O2_x,                      ///< force of the crank on the coupler, x, N
  O2_y,                      ///< force of the crank on the coupler, y, N
  O3_x,                      ///< force of the rocker on the coupler, x, N
  O3_y,                      ///< force of the rocker on the coupler, y, N
  O4_x,                      ///< force of the ground on the rocker, x, N
  O4_y,                      ///< force of the ground on the rocker, y, N
  drive_torque,              ///< torque of the ground's motor on the crank, N m
  shaking_force_x,           ///< force of the mechanism on the ground, x, N, weight included
  shaking_force_y,           ///< force of the mechanism on the ground, y, N, weight included
  shaking_moment,            ///< moment on the ground about O1 by the joint forces alone, N m
  shaking_moment_with_drive  ///< the same with the motor's reaction, N m
};
constexpr std::array<EnumName<FourBarComponent>, 13> names(FourBarComponent) {
  using C = FourBarComponent;
  return {{{C::O1_x, "O1_x", "of ground on crank"},
           {C::O1_y, "O1_y"},
           {C::O2_x, "O2_x", "of crank on coupler"},
           {C::O2_y, "O2_y"},
           {C::O3_x, "O3_x", "of rocker on coupler"},
           {C::O3_y, "O3_y"},
           {C::O4_x, "O4_x", "of ground on rocker"},
           {C::O4_y, "O4_y"},
           {C::drive_torque, "O1_drive_torque"},
           {C::shaking_force_x, "shaking_force_x", "on the ground, weight included"},
           {C::shaking_force_y, "shaking_force_y"},
           {C::shaking_moment, "shaking_moment", "on the ground about O1 by the joint forces alone"},
           {C::shaking_moment_with_drive, "shaking_moment_with_drive", "what the ground feels"}}};
}

/// One quantity to be made small: a measure of a component over the motion, relative to a reference, for
/// example its value in the original machine.
struct BalancingObjective {
  FourBarComponent component = FourBarComponent::shaking_force_x;  ///< quantity that is measured
  Measure measure = Measure::rss_over_n;                           ///< number for it over the motion; a norm
  double reference = 1;                                            ///< N or N m, more than 0
};

/// Balancing of a four-bar: which numbers may change and how far, the motion, what is minimised, and
/// what must be kept.
struct FourBarBalancing {
  std::array<Range, four_bar_number_count> bounds{};  ///< lower = upper: fixed
  Branch branch = Branch::open;                       ///< assembly branch

  double crank_from = 0,  ///< first crank angle, rad; it is sampled
      crank_to = 2 * pi;  ///< last crank angle, rad; it is sampled
  int samples = 201;      ///< number of crank angles, at least 2
  /// The last sample is the first one again, a turn later: means count it once. Boskovic's tables count both.
  bool closes = false;
  double crank_speed = 1;         ///< rad/s, at every sample
  double crank_acceleration = 0;  ///< rad/s2, at every sample
  double gravity = 9.81;          ///< m/s2 along -y

  std::vector<BalancingObjective> objectives;  ///< quantities that are minimised

  /// The crank is the shortest link and turns fully: min((L1 + L2 + L3 + L4) / 2 - L1 - max(L2, L3, L4),
  /// min(L2, L3, L4) - L1) >= 0. If not asked for, the linkage must assemble from crank_from to crank_to.
  bool crank_rotates_fully = true;
  double min_transmission_angle = 0;  ///< rad, from crank_from to crank_to; 0 = no limit
  /// Angle (rad) between the ends of the rocker's swing over a full turn; needs crank_rotates_fully.
  std::optional<Range> rocker_swing;
};

/// Checks a balancing problem.
///
/// @param balancing the problem
/// @throws ContractError unless bounds are ordered and finite, lengths above 0, masses, inertias and
///   distances not negative, there are objectives with norms and with references above 0 and at least 2
///   samples from crank_from < crank_to, and limits lie in their ranges
void require_valid(const FourBarBalancing& balancing);

/// Names of the constraints in their order: "crank_rotates_fully" or "assembles", then, where asked for,
/// "transmission_angle" at the shortest and at the longest diagonal, "rocker_swing" from below and above.
///
/// @param balancing the problem
/// @returns the names, one a constraint
std::vector<std::string> balancing_constraints(const FourBarBalancing& balancing);

/// Objectives over their references, then constraints (met when <= 0), of each machine: as many numbers a
/// machine as there are objectives and constraints. Objectives are NaN where the machine does not reach every
/// sample; the constraints say how far it is from that. Lengths are relative to the sum of the upper bounds,
/// angles are compared by their cosine (transmission) or in radians (swing).
///
/// `softening` > 0 rounds the kinks of mean_abs and max_abs, by that share of the reference: sqrt(x^2 + s^2)
/// for |x|, and s log(sum of exp(|x| / s)) for the largest, which is at most s log(2 samples) too much; 0 =
/// exactly those.
///
/// Each machine is swept through SIMD registers of angles (FourBarSweep), in memory of the thread: nothing is
/// allocated once a thread has come through a call, and one machine at a time is as quick as many.
///
/// @param balancing the problem
/// @param machines the four-bars with their masses
/// @param values receives objectives and constraints, machine by machine
/// @param softening share of the references by which kinks are rounded, >= 0
/// @throws ContractError as require_valid does, and unless there is room for all numbers
void balancing_values(const FourBarBalancing& balancing, std::span<const FourBarMachine> machines,
                      std::span<double> values, double softening = 0);

/// The objectives of one machine times their references.
///
/// @param balancing the problem
/// @param machine the four-bar with its masses
/// @returns one measure an objective, N or N m
/// @throws ContractError as require_valid does
std::vector<double> balancing_measures(const FourBarBalancing& balancing, const FourBarMachine& machine);

/// Makes the measures of `machine`, an original or published design, the references of the objectives; it
/// need not lie within the bounds.
///
/// @param balancing the problem, whose references are set
/// @param machine the machine that serves as the reference
/// @throws ContractError as require_valid does, and naming a component that is 0 or that the machine does not
///   have because it does not reach every sample
void set_references(FourBarBalancing& balancing, const FourBarMachine& machine);

/// The problem in the sixteen numbers, which is smooth up to the kinks of mean_abs and max_abs (see
/// balancing_values).
///
/// @param balancing the problem
/// @param softening share of the references by which kinks are rounded, >= 0
/// @returns the problem for a gradient method
/// @throws ContractError as require_valid does, and unless softening is finite and not negative
optimise::SmoothProblem balancing_problem(const FourBarBalancing& balancing, double softening = 0);

/// First moments (kg m) in the frames of the links: own joint in the origin, link line along x.
struct ForceBalance {
  std::complex<double> crank,  ///< own joint O
      rocker;                  ///< own joint B0
};

/// The first moments that crank and rocker must have for the mass centre of the whole four-bar to stand
/// still, given the coupler: m2 L1 - S2 L1 / L2 and S2 L3 / L2 are opposed by those of crank and rocker, with
/// L1 the crank, L2 the coupler and L3 the rocker (Berkof and Lowen 1969). The shaking force is then the
/// weight alone, at any speed and acceleration; the shaking moment is not balanced, and the drive torque may
/// grow.
///
/// @param linkage the four-bar
/// @param coupler base parameters of the coupler; its own joint is A
/// @returns the first moments of crank and rocker (kg m)
/// @throws ContractError as require_lengths does
ForceBalance force_balance(const FourBar& linkage, const BaseParameters& coupler);

/// The mass that changes the first moment of a link by a wanted change when it is fixed to it at a radius.
/// Its angle is in (-pi, pi], 0 when nothing is to be changed.
///
/// @param change wanted change of the first moment in the frame of the link (kg m)
/// @param radius distance from the own joint of the link (m), more than 0
/// @returns the mass with its distance and angle
/// @throws ContractError unless the radius is more than 0 and everything is finite
PointMass counterweight(std::complex<double> change, double radius);

/// Counterweights of crank and rocker, at given radii, that balance a four-bar as it is.
struct Counterweights {
  PointMass crank,  ///< at O
      rocker;       ///< at B0
};

/// The counterweights that balance the shaking force of a four-bar as it is.
///
/// @param linkage the four-bar
/// @param masses masses of its links
/// @param crank_radius distance of the counterweight of the crank from O (m), more than 0
/// @param rocker_radius distance of the counterweight of the rocker from B0 (m), more than 0
/// @returns both counterweights
/// @throws ContractError as `force_balance`, `base_parameters` and `counterweight` do
Counterweights balancing_counterweights(const FourBar& linkage, const FourBarMasses& masses,
                                        double crank_radius, double rocker_radius);

/// The masses with the counterweights fixed to them.
///
/// @param masses masses of the links
/// @param weights counterweights of crank and rocker
/// @returns the inertia of the links with the counterweights fixed to them
/// @throws ContractError as `with_attached` does
FourBarMasses with_counterweights(const FourBarMasses& masses, const Counterweights& weights);

/// A balancing problem of Boskovic 2018 with the design that the source found best for it.
struct PublishedBalancing {
  std::string_view name;     ///< "sp-fa", "case1", "case2", "case3", "case3x"
  FourBarBalancing problem;  ///< references are those of the original machine
  /// Design by the hybrid of cuckoo search and fireflies; that of "sp-fa" by fireflies in two populations.
  FourBarMachine published;
};

/// The original machine: Boskovic 2018, Table 2.4, first column. Its coupler's inertia lies outside the
/// bounds.
///
/// @returns the machine with its masses
FourBarMachine balancing_original();

/// The five problems: "sp-fa" of Table 2.2, cases 1 to 3 of Table 2.4 and case 3 in the wider bounds of Table
/// 2.6; 300 rpm, 201 samples over a turn, Eq. (2.136). "sp-fa" has the shaking moment of the joint forces
/// alone, case 3 that with the drive.
///
/// @returns the problems in this order
std::vector<PublishedBalancing> published_balancings();

/// One of the published problems.
///
/// @param name its name
/// @returns the problem
/// @throws ContractError if there is no problem of that name
PublishedBalancing published_balancing(std::string_view name);

}  // namespace linkwright::planar
