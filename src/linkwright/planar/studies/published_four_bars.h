// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

// The balanced four-bars of Boskovic 2018, section 2.4, as printed: facts to compare with.
namespace linkwright::planar {

/// A number of a design that the source prints with a slip.
struct FourBarRepair {
  std::size_t number = 0;  ///< its place in PublishedFourBar::numbers
  double printed = 0;
};

struct PublishedFourBar {
  std::string label;         ///< "case 1, H-CS-FA"
  std::string design_table;  ///< "2.4": where the design is printed
  std::string change_table;  ///< "2.7": where its reductions are printed
  /// L1 ... L4 (crank, coupler, rocker, ground; m), alpha1 ... alpha3 (rad), m1 ... m3 (kg), J1 ... J3 about
  /// the mass centres (kg m2), d1 ... d3 (m), repaired.
  std::array<double, 16> numbers;
  /// Reductions in per cent without their signs, of X and Y of O1 ... O4, drive torque, shaking force x and
  /// y, shaking moment; NaN where none is printed.
  std::array<double, 12> unsigned_percent;
  std::array<double, 12> band;  ///< possible effect of rounding in the printed design, percentage points
  std::optional<FourBarRepair> repaired;
};

/// SP-FA, then cases 1 to 3 by FA, CS and H-CS-FA, then case 3x.
std::span<const PublishedFourBar> published_four_bars();

}  // namespace linkwright::planar
