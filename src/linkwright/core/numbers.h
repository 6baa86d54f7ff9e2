// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <numbers>

namespace linkwright {

inline constexpr double pi = std::numbers::pi,  ///< half a turn (rad)
    full_turn = 2 * pi;                         ///< a whole turn (rad)
/// A bound that does not bind; a cost that does not exist.
inline constexpr double infinity = std::numeric_limits<double>::infinity();
/// The value of a number that is not known: rows that do not assemble, columns that do not apply.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The index in a container. Models count in `int`, where -1 says "none".
/// @param i index of a body, joint or row, >= 0
/// @returns the same index
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace linkwright
