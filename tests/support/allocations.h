#pragma once

#include <cstddef>

namespace linkwright::test {

/// Calls of operator new (all forms) so far, from all threads. For test programs that link
/// linkwright_allocation_counter, which replaces the global operator new.
std::size_t allocations();

}  // namespace linkwright::test
