// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "linkwright/study/result.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/studies/springs.h"

// The damper as it acts at the wheel at speeds of the wheel.
namespace linkwright::suspension {

/// Largest number of speeds of the wheel.
inline constexpr double most_wheel_speeds = 1000;

/// A position of a wheel with its damper.
struct DampedPosition {
  double travel = 0;  ///< m
  double ratio = 0;   ///< length of the damper by travel
  double rate = 0;    ///< wheel rate of springs and stops, N/m
};

/// The table `damping` over positions and speeds of the wheel, a diagram, and facts about one position.
///
/// @param result receives them
/// @param damper with a damping or a curve
/// @param ride speeds of the wheel, and the mass for damping ratios
/// @param positions of the wheel
/// @param stated the position that facts are about; speeds that are not given are those of the curve there
void add_damping(study::Result& result, const DamperDescription& damper, const RideForm& ride,
                 std::span<const DampedPosition> positions, std::size_t stated);

}  // namespace linkwright::suspension
