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
  crank_rocker,
  rocker_crank,
  double_crank,
  grashof_double_rocker,
  triple_rocker_00,
  triple_rocker_0pi,
  triple_rocker_pi0,
  triple_rocker_pipi,
  change_point
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
/// In words, a code after them: "crank-rocker", "non-Grashof, input through 0, output through pi (0pi)".
std::string in_words(FourBarType type);

/// Interval of crank angles [from, to], from < to, relative to the ground link, in which the linkage
/// assembles.
struct AngleInterval {
  double from = 0, to = 0;
};

struct FourBarClass {
  FourBarType type = FourBarType::change_point;
  bool grashof = false;
  bool crank_rotates_fully = false;
  int circuits = 1;  ///< 2 for Grashof linkages, else 1; 0 when the linkage assembles nowhere
  /// Metres; smallest margin of the full-rotation conditions, < 0 = does not rotate.
  double crank_margin = 0;
  /// Crank angles that assemble; one interval of length 2 pi when it rotates fully; empty = never.
  std::vector<AngleInterval> inputs;
};

/// Throws ContractError unless all link lengths are positive and finite. `tolerance` is relative to the sum
/// of the links.
FourBarClass classify(const FourBar& linkage, double tolerance = 1e-9);

/// Extremes of the transmission angle, folded to [0, pi/2], over a full crank turn or over the angles that
/// assemble.
struct TransmissionAngles {
  double minimum = 0, maximum = 0;
};
TransmissionAngles transmission_angles(const FourBar& linkage);
/// The same over the crank angles [from, to] only.
TransmissionAngles transmission_angles(const FourBar& linkage, double from, double to);

}  // namespace linkwright::planar
