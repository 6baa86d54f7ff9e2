// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/dexterity/synthesis.h"

namespace linkwright::parallel {

/// Benchmarks of a DELTA that serves a cylinder 0.8 m wide and 0.25 m high on its axis, with a constraint
/// index of at least 0.2 all over it:
///
///     worst   B1: the least conditioning index as large as possible, arm + rod at most 1.2 m
///     mean    B2: its mean as large as possible, arm + rod at most 1.2 m
///     size    B3: arm + rod as short as possible with a conditioning index of at least 0.4, an arm travel of
///             at most 120 deg, a side swing of the rods of at most 40 deg and an input index of at least 0.5
DexterityTask dexterity_benchmark(DexterityGoal goal);

/// B3 with Pi-joints, designed together with the robot, instead of the limit of the arm travel: their
/// diagonals telescope by 2 at most, and their transmission angles are at least `transmission` (rad).
DexterityTask dexterity_benchmark_with_pi_joints(double transmission);

}  // namespace linkwright::parallel
