// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/minimise_smooth.h"
#include "linkwright/planar/balancing/four_bar.h"

namespace linkwright::planar {

/// The recommended way to balance a four-bar: optimise::minimise_smooth in the sixteen numbers.
///
/// Where measures have kinks (mean_abs, max_abs), its searches see rounded ones, and the best ends continue
/// with less and less rounding (balancing_values: softening 1e-3, a quarter of it each time, down to 1e-9).
/// What is reported is without: `objectives`, `cost`, `violation` and the choice of the best; `ends` are
/// those of the first searches, and prices and stationarity belong to the last rounding. Caps then hold
/// within 1e-6 of their size.
///
/// Throws as minimise_smooth and require_valid do.
optimise::SmoothReport balance_four_bar(const FourBarBalancing& balancing,
                                        const optimise::SmoothOptions& options, const optimise::Seed& seed,
                                        RunContext& context);

}  // namespace linkwright::planar
