// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/optimise/nlopt_bridge.h"

// Replaces the calls of NLopt when the library is built without it.
namespace linkwright::optimise {

LocalReport minimise_local(CostFunction, std::size_t, ValuesFunction, std::span<double>,
                           std::span<const double>, std::span<const double>, const LocalOptions&,
                           RunContext&) {
  throw ContractError("local searches are NLopt's, and this library was built with LINKWRIGHT_NLOPT=OFF");
}
LocalReport minimise_local(CostFunction cost, std::span<double> x, std::span<const double> lower,
                           std::span<const double> upper, const LocalOptions& options, RunContext& context) {
  return minimise_local(
      cost, 0, [](auto, auto, auto) {}, x, lower, upper, options, context);
}

}  // namespace linkwright::optimise
