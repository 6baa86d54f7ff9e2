// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cctype>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension::test {

/// The corner of pushrod_corner.h as a study; y before a number is the sign of the side.
inline const std::string pushrod_template = head + R"(side = "SIDE"

[mechanism.wheel]
centre_mm        = [0, y600, 203]
camber_deg       = 1.5
tyre_diameter_mm = 406

[[mechanism.link]]
name       = "lower wishbone"
type       = "RS"
body_mm    = [[150, y220, 120], [-160, y230, 118]]
carrier_mm = [5, y560, 115]

[[mechanism.link]]
name       = "upper wishbone"
type       = "RS"
body_mm    = [[140, y260, 270], [-150, y265, 262]]
carrier_mm = [-12, y535, 290]

[[mechanism.link]]
name       = "tie rod"
type       = "US"
body_mm    = [60, y225, 160]
carrier_mm = [75, y550, 165]
moved_by   = "rack"

[[mechanism.rocker]]
name      = "rocker"
axis_mm   = [[40, y200, 430], [-40, y200, 430]]
rod_mm    = [[3, y500, 280], [0, y260, 460]]
driven_by = "upper wishbone"

[mechanism.spring]
body_mm            = [0, y20, 500]
moving_mm          = [0, y215, 520]
attached_to        = "rocker"
stiffness_N_per_mm = 35
preload_N          = 900

[mechanism.damper]
damping_N_s_per_m = 3000

[mechanism.anti_roll_bar]
axis_mm     = [[120, y0, 250], [120, y100, 250]]
droplink_mm = [[20, y170, 470], [20, y170, 250]]
attached_to = "rocker"
stiffness_N_m_per_rad = 1200

[mechanism.bump_stop]
clearance_mm       = 20
stiffness_N_per_mm = 100

[sweep.travel]
values_mm = [-30, -15, 0, 15, 30]

[ride]
sprung_mass_kg          = 70
tyre_stiffness_N_per_mm = 120
)";

inline std::string pushrod_text(Side side) {
  std::string out;
  for (std::size_t i = 0; i < pushrod_template.size(); ++i) {
    const bool mark =
        pushrod_template[i] == 'y' && std::isdigit(static_cast<unsigned char>(pushrod_template[i + 1]));
    if (!mark)
      out += pushrod_template[i];
    else if (side == Side::right)
      out += '-';
  }
  return replaced(out, "SIDE", std::string(name_of(side)));
}
inline const std::string pushrod_study = pushrod_text(Side::left);

}  // namespace linkwright::suspension::test
