// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/link_mass.h"

namespace linkwright::planar {

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
