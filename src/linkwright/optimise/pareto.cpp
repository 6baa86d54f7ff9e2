#include "linkwright/optimise/pareto.h"

#include <cstddef>

#include "linkwright/core/check.h"

namespace linkwright::optimise {

bool dominates(std::span<const double> a, std::span<const double> b) {
  LINKWRIGHT_REQUIRE(a.size() == b.size(), "{} and {} objectives", a.size(), b.size());
  bool less = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!(a[k] <= b[k])) return false;
    less |= a[k] < b[k];
  }
  return less;
}

}  // namespace linkwright::optimise
