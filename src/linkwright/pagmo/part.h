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
  std::unique_ptr<Optimiser> (*make_cma_es)(std::span<const Variable> variables, const CmaEsOptions& options,
                                            const Seed& seed);
  FrontReport (*minimise)(const Problem& problem, const PagmoOptions& method, const FrontOptions& options,
                          const Seed& seed, RunContext& context);
  double (*hypervolume)(std::span<const double> costs, std::span<const double> reference);
  double (*hypervolume_of_front)(std::span<const ParetoPoint> front, std::span<const double> reference);
};

/// Name under which the plug-in gives them, and of what type.
inline constexpr const char* pagmo_part_name = "linkwright_pagmo_part";
using GivePagmoPart = const PagmoPart*();

}  // namespace linkwright::optimise
