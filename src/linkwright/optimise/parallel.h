// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "linkwright/math/function_ref.h"

namespace linkwright::optimise {

/// Calls body(i) for i in [0, count) on up to `threads` threads (0 = all), in any order. Called from inside a
/// body it waits for its own work only. With one thread, or one call, nothing but the calls happens. An
/// exception of a body is thrown again here.
void parallel_for(std::size_t count, int threads, math::FunctionRef<void(std::size_t)> body);

}  // namespace linkwright::optimise
