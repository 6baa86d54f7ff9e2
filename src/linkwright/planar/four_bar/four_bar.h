// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"

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

}  // namespace linkwright::planar
