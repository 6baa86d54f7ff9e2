#pragma once

#include <array>
#include <complex>
#include <span>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/core/status.h"

namespace linkwright::planar {

/// Assembly branch of a four-bar: on which side of the directed line A -> B0 the coupler-rocker pin B lies.
enum class Branch { open, crossed };
constexpr std::array<EnumName<Branch>, 2> names(Branch) {
  return {{{Branch::open, "open", "B to the left of A->B0"},
           {Branch::crossed, "crossed", "B to the right of A->B0"}}};
}
/// +1 for open, -1 for crossed.
constexpr double sign(Branch branch) { return branch == Branch::open ? 1.0 : -1.0; }
constexpr Branch other(Branch branch) { return branch == Branch::open ? Branch::crossed : Branch::open; }

/// Planar four-bar O-A-B-B0 with a tracing point C on the coupler. All lengths in metres, angles in radians.
/// O = (pivot_x, pivot_y); B0 = O + ground e^(i frame_angle); the crank angle is measured from O->B0;
/// C = A + (coupler_u + i coupler_v) e^(i coupler angle), u along A->B, v along its left normal.
/// Boskovic 2018, Eqs. (4.1)-(4.3): L1 = ground, L2 = crank, L3 = coupler, L4 = rocker, l1 = coupler_u, l2 =
/// coupler_v.
struct FourBar {
  double ground = 1;
  double crank = 1;
  double coupler = 1;
  double rocker = 1;
  double coupler_u = 0;
  double coupler_v = 0;
  double pivot_x = 0;
  double pivot_y = 0;
  double frame_angle = 0;
  Branch branch = Branch::open;
};

/// Position of a four-bar at one crank angle. Points in the global frame, angles relative to the ground link.
struct FourBarPosition {
  Status status =
      Status::done;  ///< done, no_assembly (points beyond A are not set) or singular (toggle: branches meet)
  std::complex<double> crank_pin;      ///< A
  std::complex<double> coupler_pin;    ///< B
  std::complex<double> coupler_point;  ///< C
  double coupler_angle = 0;            ///< of A->B, (-pi, pi]
  double rocker_angle = 0;             ///< of B0->B, (-pi, pi]
  double transmission_angle = 0;       ///< between coupler and rocker, folded to [0, pi/2]
  double gap =
      0;  ///< metres by which coupler and rocker are too short (> 0) or too long to close; 0 when assembled
};

/// Closed form on the given branch. Throws ContractError unless all link lengths are positive and finite.
FourBarPosition position(const FourBar& linkage, double crank_angle);

/// Throws ContractError unless all link lengths are positive and finite.
void require_lengths(const FourBar& linkage);

/// Points O and B0 in the global frame.
std::complex<double> crank_pivot(const FourBar& linkage);
std::complex<double> rocker_pivot(const FourBar& linkage);

}  // namespace linkwright::planar
