// SPDX-License-Identifier: BSD-3-Clause
#include <span>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/optimise/cma_es.h"
#include "linkwright/optimise/pagmo_bridge.h"

// Replaces the calls of pagmo when the library is built without it.
namespace linkwright::optimise {
namespace {

[[noreturn]] void missing(const char* what) {
  throw ContractError(std::string(what) +
                      " is pagmo's, and this library was built with LINKWRIGHT_PAGMO=OFF");
}

}  // namespace

FrontReport minimise_with_pagmo(const Problem&, const PagmoOptions&, const FrontOptions&, const Seed&,
                                RunContext&) {
  missing("the search for a front");
}
double hypervolume(std::span<const double>, std::span<const double>) { missing("the hypervolume"); }
double hypervolume(std::span<const ParetoPoint>, std::span<const double>) { missing("the hypervolume"); }
std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable>, const CmaEsOptions&, const Seed&) {
  missing("CMA-ES");
}

}  // namespace linkwright::optimise
