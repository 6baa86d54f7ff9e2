// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/flexible/simulation.h"

/// Input shaping: a drive is given in a few shares, late by parts of a period, so that the vibrations they
/// excite cancel.
namespace linkwright::flexible {

enum class Shaper {
  zv,   ///< zero vibration: two impulses, half a period long (Smith 1957; Singer and Seering 1990)
  zvd,  ///< and zero derivative by the frequency: three, a period long (Singer and Seering 1990)
  ei,  ///< extra insensitive: three, a period long; leaves a little at the frequency itself, and no more than
       ///< that over a wide band around it (Singhose, Seering and Singer 1990)
};
constexpr std::array<EnumName<Shaper>, 3> names(Shaper) {
  return {{{Shaper::zv, "zv", "zero vibration; half a period"},
           {Shaper::zvd, "zvd", "zero vibration and derivative; a period"},
           {Shaper::ei, "ei", "extra insensitive; a period"}}};
}

/// A share of the drive and how late it comes (s).
struct Impulse {
  double time = 0;
  double share = 1;
};

/// The vibration that a shaper is for.
struct ShapedMode {
  double frequency = 0;  ///< undamped (rad/s)
  double damping = 0;    ///< ratio, in [0, 1)
};

/// Impulses of a shaper; their shares are positive and their sum is 1. `remaining` in (0, 1): what `ei`
/// leaves of the vibration at the frequency itself, at most (a share of that without shaping).
///
/// Throws ContractError for a frequency that is not positive, a damping or a rest out of range.
std::vector<Impulse> impulses(Shaper shaper, const ShapedMode& mode, double remaining = 0.05);

/// One shaper after another, for two vibrations: all products of their shares, in the order of time.
std::vector<Impulse> combined(std::span<const Impulse> first, std::span<const Impulse> second);

/// The vibration that remains right after the last impulse, as a share of that of one impulse (Singer and
/// Seering 1990).
double residual_vibration(std::span<const Impulse> impulses, const ShapedMode& mode);

/// The shaped drive at a time. The law is asked at earlier times, too, before time 0 among them, where it
/// must state what it was then: rest, or the uniform or harmonic motion that continues.
HubMotion shaped(AngleLaw law, std::span<const Impulse> impulses, double time);
/// No torque before time 0.
double shaped_torque(TorqueLaw law, std::span<const Impulse> impulses, double time);

/// Times at which the shaped drive jumps or kinks, for those of the drive; its beginning at 0 is one of them.
/// Sorted.
std::vector<double> shaped_breaks(std::span<const double> breaks, std::span<const Impulse> impulses);

}  // namespace linkwright::flexible
