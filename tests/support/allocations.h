// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace linkwright::test {

/// Calls of operator new (all forms), malloc, calloc and realloc so far, from all threads. For test programs
/// that link linkwright_allocation_counter, which replaces them.
std::size_t allocations();

}  // namespace linkwright::test
