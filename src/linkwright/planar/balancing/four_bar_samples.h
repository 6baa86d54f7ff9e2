// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "linkwright/planar/balancing/four_bar.h"

namespace linkwright::planar {

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
