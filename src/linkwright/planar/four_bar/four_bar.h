// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/link_mass.h"

namespace linkwright::planar {

/// Assembly branch of a four-bar: on which side of the directed line A -> B0 the coupler-rocker pin B lies.
enum class Branch {
  open,    ///< B lies to the left of A -> B0
  crossed  ///< B lies to the right of A -> B0
};
constexpr std::array<EnumName<Branch>, 2> names(Branch) {
  return {{{Branch::open, "open", "B to the left of A->B0"},
           {Branch::crossed, "crossed", "B to the right of A->B0"}}};
}

/// The sign of a branch in the formulas.
///
/// @param branch the branch
/// @returns +1 for open, -1 for crossed
constexpr double sign(Branch branch) { return branch == Branch::open ? 1.0 : -1.0; }

/// The other branch.
///
/// @param branch a branch
/// @returns crossed for open, open for crossed
constexpr Branch other(Branch branch) { return branch == Branch::open ? Branch::crossed : Branch::open; }

/// Planar four-bar O-A-B-B0 with a tracing point C on the coupler. All lengths in metres, angles in radians.
/// O = (pivot_x, pivot_y); B0 = O + ground e^(i frame_angle); the crank angle is measured from O->B0;
/// C = A + (coupler_u + i coupler_v) e^(i coupler angle), u along A->B, v along its left normal.
/// Boskovic 2018, Eqs. (4.1)-(4.3): L1 = ground, L2 = crank, L3 = coupler, L4 = rocker, l1 = coupler_u, l2 =
/// coupler_v.
struct FourBar {
  double ground = 1;             ///< L1, length of O -> B0, > 0
  double crank = 1;              ///< L2, length of O -> A, > 0
  double coupler = 1;            ///< L3, length of A -> B, > 0
  double rocker = 1;             ///< L4, length of B0 -> B, > 0
  double coupler_u = 0;          ///< l1, place of C along A -> B, from A
  double coupler_v = 0;          ///< l2, place of C along the left normal of A -> B
  double pivot_x = 0;            ///< x of O, global
  double pivot_y = 0;            ///< y of O, global
  double frame_angle = 0;        ///< angle of O -> B0 from the global x axis
  Branch branch = Branch::open;  ///< side of A -> B0 on which B lies
};

/// The numbers of a four-bar without the branch, in the order of FourBarParameter (path/four_bar/problem.h).
/// Lengths of links are those that must be more than 0.
template <class Visitor>
void fields(Visitor&& visit, FourBar& l) {
  const auto link = [&](std::string_view key, std::string_view summary, double& value) {
    visit(field::length(key, summary).positive().required(), value);
  };
  const auto place = [&](std::string_view key, std::string_view summary, double& value) {
    visit(field::length(key, summary), value);
  };
  link("ground", "length of the ground link O1-O4", l.ground);
  link("crank", "length of the crank O1-O2", l.crank);
  link("coupler", "length of the coupler O2-O3", l.coupler);
  link("rocker", "length of the rocker O4-O3", l.rocker);
  place("coupler_u", "coupler point along O2->O3", l.coupler_u);
  place("coupler_v", "coupler point along the left normal of O2->O3", l.coupler_v);
  place("pivot_x", "crank pivot O1, x", l.pivot_x);
  place("pivot_y", "crank pivot O1, y", l.pivot_y);
  visit(field::angle("frame_angle", "direction of O1->O4").between(-1e3, 1e3), l.frame_angle);
}

/// Position of a four-bar at one crank angle. Points in the global frame, angles relative to the ground link;
/// what is not determined is NaN.
struct FourBarPosition {
  /// done, no_assembly, or singular (toggle: branches meet); only A is known when the links do not meet, and
  /// when A lies on B0 (singular, too).
  Status status = Status::done;
  std::complex<double> crank_pin;                   ///< A
  std::complex<double> coupler_pin = {nan, nan};    ///< B
  std::complex<double> coupler_point = {nan, nan};  ///< C
  double coupler_angle = nan;                       ///< direction of A->B, (-pi, pi]
  double rocker_angle = nan;                        ///< direction of B0->B, (-pi, pi]
  double transmission_angle = nan;                  ///< between coupler and rocker, folded to [0, pi/2]
  /// Length (m, >= 0) by which coupler and rocker together are too short, or differ too much, to close; 0
  /// when assembled.
  double gap = 0;
};

/// Position of a four-bar in closed form, on the branch of the linkage.
///
/// @param linkage the four-bar
/// @param crank_angle crank angle, from the ground link (rad)
/// @returns the position, with its status
/// @throws ContractError on the lengths that require_lengths rejects and on a tracing point, pivot or angle
///   that is not finite
FourBarPosition position(const FourBar& linkage, double crank_angle);

/// Length of the shortest link (m): from it to that of the longest one no product of four lengths leaves the
/// range of a double.
inline constexpr double shortest_link = 1e-70,
                        max_link = 1e70;  ///< length of the longest link (m)

/// Checks the lengths of the links.
///
/// @param linkage the four-bar
/// @throws ContractError unless all link lengths are positive and finite, from shortest_link to max_link
void require_lengths(const FourBar& linkage);

/// The pivot O of the crank.
///
/// @param linkage the four-bar
/// @returns O in the global frame (m)
std::complex<double> crank_pivot(const FourBar& linkage);

/// The pivot B0 of the rocker.
///
/// @param linkage the four-bar
/// @returns B0 in the global frame (m)
std::complex<double> rocker_pivot(const FourBar& linkage);

/// Type of a four-bar by the signs of T1 = L1-L2+L3-L4, T2 = L1-L2-L3+L4, T3 = L3+L4-L1-L2. The last four do
/// not meet Grashof's condition; "0" and "pi" say through which collinear position input (first) and output
/// pass.
enum class FourBarType {
  crank_rocker,           ///< the crank rotates fully, the rocker swings
  rocker_crank,           ///< the crank swings, the rocker rotates fully
  double_crank,           ///< both rotate fully
  grashof_double_rocker,  ///< both swing, the coupler rotates fully
  triple_rocker_00,       ///< non-Grashof, input through 0, output through 0
  triple_rocker_0pi,      ///< non-Grashof, input through 0, output through pi
  triple_rocker_pi0,      ///< non-Grashof, input through pi, output through 0
  triple_rocker_pipi,     ///< non-Grashof, input through pi, output through pi
  change_point            ///< T1, T2 or T3 is zero within the tolerance
};
constexpr std::array<EnumName<FourBarType>, 9> names(FourBarType) {
  return {{{FourBarType::crank_rocker, "crank-rocker"},
           {FourBarType::rocker_crank, "rocker-crank"},
           {FourBarType::double_crank, "double-crank"},
           {FourBarType::grashof_double_rocker, "grashof-double-rocker"},
           {FourBarType::triple_rocker_00, "00", "non-Grashof, input through 0, output through 0"},
           {FourBarType::triple_rocker_0pi, "0pi", "non-Grashof, input through 0, output through pi"},
           {FourBarType::triple_rocker_pi0, "pi0", "non-Grashof, input through pi, output through 0"},
           {FourBarType::triple_rocker_pipi, "pipi", "non-Grashof, input through pi, output through pi"},
           {FourBarType::change_point, "change-point"}}};
}

/// The name of a type in words, with a code after them: "crank-rocker", "non-Grashof, input through 0, output
/// through pi (0pi)".
///
/// @param type the type
/// @returns the text
std::string in_words(FourBarType type);

/// Interval of crank angles [from, to], from < to, relative to the ground link, in which the linkage
/// assembles.
struct AngleInterval {
  double from = 0,  ///< rad
      to = 0;       ///< rad, more than `from`
};

/// The type of a four-bar and how its crank can turn.
struct FourBarClass {
  FourBarType type = FourBarType::change_point;  ///< by the signs of T1, T2 and T3
  bool grashof = false;  ///< the shortest and the longest link together are not longer than the other two
  bool crank_rotates_fully = false;  ///< the crank assembles over a full turn
  int circuits = 1;                  ///< 2 for Grashof linkages, else 1; 0 when the linkage assembles nowhere
  /// Metres; smallest margin of the full-rotation conditions, < 0 = does not rotate.
  double crank_margin = 0;
  /// Crank angles that assemble; one interval of length 2 pi when it rotates fully; empty = never.
  std::vector<AngleInterval> inputs;
};

/// Classifies a four-bar.
///
/// @param linkage the four-bar
/// @param tolerance relative to the sum of the links: a smaller T1, T2 or T3 counts as zero
/// @returns its type, and the crank angles that assemble
/// @throws ContractError on the lengths that require_lengths rejects and on a negative tolerance
FourBarClass classify(const FourBar& linkage, double tolerance = 1e-9);

/// Extremes of the transmission angle, folded to [0, pi/2].
struct TransmissionAngles {
  double minimum = 0,  ///< rad
      maximum = 0;     ///< rad
};

/// Extremes of the transmission angle over a full crank turn, or over the crank angles that assemble.
///
/// @param linkage the four-bar
/// @returns both extremes
/// @throws ContractError on the lengths that require_lengths rejects
TransmissionAngles transmission_angles(const FourBar& linkage);

/// The same over an interval of crank angles only.
///
/// @param linkage the four-bar
/// @param from first crank angle, from the ground link (rad)
/// @param to last crank angle (rad)
/// @returns both extremes
/// @throws ContractError on the lengths that require_lengths rejects, and unless from <= to
TransmissionAngles transmission_angles(const FourBar& linkage, double from, double to);

/// Motion of a four-bar at one instant: directions of the links in the global frame, and how fast they turn.
/// Speeds in rad/s and accelerations in rad/s2, counter-clockwise positive. What is not determined is NaN.
struct FourBarRates {
  /// done, no_assembly, or singular (dead point: the speeds are not determined).
  Status status = Status::done;
  std::complex<double> ground_direction;                ///< unit vector along O -> B0
  std::complex<double> crank_direction;                 ///< along O -> A
  std::complex<double> coupler_direction = {nan, nan};  ///< along A -> B
  std::complex<double> rocker_direction = {nan, nan};   ///< along B0 -> B
  double transmission_sine = nan;  ///< sin(rocker angle - coupler angle); its sign is that of the branch
  double crank_speed = 0,          ///< given
      crank_acceleration = 0;      ///< given
  double coupler_speed = nan,      ///< of the coupler
      coupler_acceleration = nan;  ///< of the coupler
  double rocker_speed = nan,       ///< of the rocker
      rocker_acceleration = nan;   ///< of the rocker
};

/// Rates of a four-bar in closed form, from the first and second derivative of the loop. They are singular if
/// the transmission angle is below tolerance::toggle_angle.
///
/// @param linkage the four-bar
/// @param crank_angle crank angle, from the ground link (rad)
/// @param crank_speed rad/s
/// @param crank_acceleration rad/s2
/// @returns the motion, with its status
/// @throws ContractError on the lengths that require_lengths rejects and on arguments that are not finite
FourBarRates rates(const FourBar& linkage, double crank_angle, double crank_speed,
                   double crank_acceleration = 0);

/// A linkage that traces the same curve (Roberts-Chebyshev).
struct Cognate {
  FourBar linkage;  ///< the cognate
  /// Its crank angle equals the original's; otherwise its input follows the coupler angle.
  bool same_timing = false;
};

/// The two cognates of a four-bar, with lambda = (coupler_u + i coupler_v) / coupler: the one on the pivots O
/// and C0 = O + lambda (B0 - O), whose input follows the coupler angle, and the one on C0 and B0, whose crank
/// angle equals the original's at every position and which lies on the opposite branch. The first one passes
/// its own toggles within the motion, so its branch is the one at `crank_angle`. A degenerate cognate
/// (tracing point on A or on B) is left out.
///
/// @param linkage the four-bar
/// @param crank_angle crank angle of the original, from its ground link (rad)
/// @returns the cognates, at most two
/// @throws ContractError if a length is not positive
std::vector<Cognate> cognates(const FourBar& linkage, double crank_angle);

/// Masses of the three moving links.
struct FourBarMasses {
  LinkMass crank,  ///< own joint O, line O -> A
      coupler,     ///< own joint A, line A -> B
      rocker;      ///< own joint B0, line B0 -> B
};
template <class Visitor>
void fields(Visitor&& visit, FourBarMasses& m) {
  visit(field::entry("crank", "own joint O1").required(), m.crank);
  visit(field::entry("coupler", "own joint O2").required(), m.coupler);
  visit(field::entry("rocker", "own joint O4").required(), m.rocker);
}

/// Forces (N) in the global frame and moments (N m), counter-clockwise positive. All NaN unless `status` is
/// done.
struct FourBarReactions {
  Status status = Status::done;                      ///< status of the rates
  std::complex<double> ground_on_crank{nan, nan};    ///< at O1 = O
  std::complex<double> crank_on_coupler{nan, nan};   ///< at O2 = A
  std::complex<double> rocker_on_coupler{nan, nan};  ///< at O3 = B
  std::complex<double> ground_on_rocker{nan, nan};   ///< at O4 = B0
  double drive_torque = nan;                         ///< torque of the ground's motor on the crank
  std::complex<double> shaking_force{nan, nan};  ///< force of the mechanism on the ground, weight included
  double shaking_moment = nan;                   ///< on the ground about O by the joint forces alone
  double shaking_moment_with_drive = nan;  ///< the same with the motor's reaction: the loads on the ground
};

/// Joint forces and drive torque by cutting the loop at B, closed form (Boskovic 2018, section 2.4.1, with
/// the sine instead of the printed cosine of Eqs. (2.112), (2.113)); shaking force and moments by Eqs.
/// (2.76)-(2.78). Forces grow like 1 / transmission_sine towards a dead point.
///
/// @param linkage the four-bar
/// @param masses masses of its links
/// @param rates rates of the same linkage
/// @param gravity acceleration of free fall (m/s2), along -y of the global frame
/// @returns forces and moments; NaN unless the rates are done
/// @throws ContractError if a mass, inertia or distance is negative or not finite, or the gravity is not
///   finite
FourBarReactions reactions(const FourBar& linkage, const FourBarMasses& masses, const FourBarRates& rates,
                           double gravity);

/// The same quantities from the nine equations of Newton and Euler solved at once (Boskovic 2018, Eq. (2.69),
/// moments of the rocker corrected): an independent and slower route to check the closed form with.
///
/// @param linkage the four-bar
/// @param masses masses of its links
/// @param rates rates of the same linkage
/// @param gravity acceleration of free fall (m/s2), along -y of the global frame
/// @returns forces and moments; NaN unless the rates are done
/// @throws ContractError as reactions does
FourBarReactions reactions_newton_euler(const FourBar& linkage, const FourBarMasses& masses,
                                        const FourBarRates& rates, double gravity);

/// The rate at which kinetic and potential energy grow; equal to drive_torque * crank_speed.
///
/// @param linkage the four-bar
/// @param masses masses of its links
/// @param rates rates of the same linkage
/// @param gravity acceleration of free fall (m/s2), along -y of the global frame
/// @returns W; NaN unless the rates are done
/// @throws ContractError as reactions does
double energy_rate(const FourBar& linkage, const FourBarMasses& masses, const FourBarRates& rates,
                   double gravity);

}  // namespace linkwright::planar
