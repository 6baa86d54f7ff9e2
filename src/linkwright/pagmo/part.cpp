// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/pagmo/part.h"

using namespace linkwright::optimise;

extern "C" __attribute__((visibility("default"))) const PagmoPart* linkwright_pagmo_part() {
  static constexpr PagmoPart part = {make_optimiser, minimise_with_pagmo, hypervolume, hypervolume};
  return &part;
}
