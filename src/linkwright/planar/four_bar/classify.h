// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {

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

}  // namespace linkwright::planar
