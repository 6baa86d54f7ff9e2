// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/statics.h"

/// Small undamped vibrations of the straight link in the plane, about a hub at rest or in steady rotation.
/// Eigenvalues are counted, not computed: the negative pivots of K - lambda M say how many lie below lambda
/// (Sylvester's law; Wittrick and Williams 1971), so the cost grows with the number of cells and no more.
namespace linkwright::flexible {

struct Vibration {
  double speed = 0;       ///< speed of the hub (rad/s)
  Hub hub = Hub::driven;  ///< free: with the hub's inertia; a first frequency of 0 is its rotation
  /// Turns of all hinges (rad), about which it vibrates; empty: in line. Others than 0 of a hub at rest only.
  std::span<const double> turns = {};
  std::span<const std::size_t> locked = {};  ///< hinges that do not turn, such as those of given motion
};

struct Mode {
  /// omega (rad/s); 0 for a rigid rotation; where growth > 0, small motions do not vibrate but grow like
  /// exp(growth t), and this is 0.
  double frequency = 0;
  double growth = 0;  ///< 1/s
};

/// Number of modes of the chain.
int mode_count(const Chain& chain, const Vibration& about = {});

/// The first `count` modes, from the lowest omega^2 on, to 1e-12 relative or rounding. Gravity is left out.
///
/// Throws ContractError for more modes than the chain has coordinates, for an extensible chain on a free hub
/// that turns, and for modes of one that is unstable.
std::vector<Mode> modes(const Chain& chain, int count, const Vibration& about = {});

/// Number of modes with omega^2 < square (rad2/s2).
int modes_below(const Chain& chain, double square, const Vibration& about = {});

struct ModeShape {
  Deflection link;  ///< in axes of the hub; the largest |eta| is 1 m
  /// Angle of the hub in this mode (rad); 1 for a rigid rotation, where the link stays straight.
  double hub_angle = 0;
};
/// Shape of mode k = 1, 2, ..., by inverse iteration.
ModeShape mode_shape(const Chain& chain, int k, const Vibration& about = {});

/// Lowest speed (rad/s) at which the straight link on a driven hub loses its stability; nothing if it keeps
/// it up to `limit`. Real links keep it; where a chain loses it, its cells are too long for the speed.
std::optional<double> critical_speed(const Chain& chain, double limit);

/// Campbell diagram: rows for the speeds, columns speed_rad_per_s, mode_1_rad_per_s, ... NaN (status
/// `singular`) where the mode is unstable.
Table campbell(const Chain& chain, std::span<const double> speeds, int count, Hub hub = Hub::driven);

}  // namespace linkwright::flexible
