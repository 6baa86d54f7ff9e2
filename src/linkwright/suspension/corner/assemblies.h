// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {

/// One assembly mode of a suspension at an input.
struct Assembly {
  CornerPlace place;
  double residual = 0;  ///< m
  int hits = 0;         ///< starts that ended here
};

/// The assembly modes of a suspension at an input, nearest to the reference first: Newton's method from
/// `starts` random places of the carrier, within twice the reach of its links and turned anyhow, the
/// reference being the first of them. Rigid links have several, most of them inverted and useless; the one
/// that belongs to the reference is what solve_position follows. Hinges put together the wrong way round and
/// struts of negative length are left out. Those with few hits may be missed: it is a search. The same seed
/// finds the same. Throws ContractError for no starts, and for the driver `spring` without a spring.
std::vector<Assembly> assemblies(const CornerPlan& plan, Driver driver, const CornerInput& input,
                                 std::uint64_t seed = 1, int starts = 400);

}  // namespace linkwright::suspension
