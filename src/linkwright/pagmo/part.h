// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "linkwright/optimise/cma_es.h"
#include "linkwright/optimise/pagmo_bridge.h"

// The contents of the program's plug-in for pagmo. Loading pagmo takes as long as many a study, since it
// fills tables of test functions when it starts: the program does so when a method of pagmo is asked for.
namespace linkwright::optimise {

/// The functions of cma_es.h and pagmo_bridge.h.
struct PagmoPart {
  /// The function `make_optimiser` of cma_es.h.
  std::unique_ptr<Optimiser> (*make_cma_es)(std::span<const Variable> variables, const CmaEsOptions& options,
                                            const Seed& seed);
  /// The function `minimise_with_pagmo` of pagmo_bridge.h.
  FrontReport (*minimise)(const Problem& problem, const PagmoOptions& method, const FrontOptions& options,
                          const Seed& seed, RunContext& context);
  /// The function `hypervolume` of pagmo_bridge.h for costs.
  double (*hypervolume)(std::span<const double> costs, std::span<const double> reference);
  /// The function `hypervolume` of pagmo_bridge.h for a front.
  double (*hypervolume_of_front)(std::span<const ParetoPoint> front, std::span<const double> reference);
};

/// Name under which the plug-in gives these functions.
inline constexpr const char* pagmo_part_name = "linkwright_pagmo_part";
/// Type of the function of that name.
using GivePagmoPart = const PagmoPart*();

}  // namespace linkwright::optimise
