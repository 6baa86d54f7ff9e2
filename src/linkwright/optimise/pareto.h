#pragma once

#include <span>

namespace linkwright::optimise {

/// Whether costs a dominate costs b, as many: none is more, and one at least is less.
bool dominates(std::span<const double> a, std::span<const double> b);

}  // namespace linkwright::optimise
