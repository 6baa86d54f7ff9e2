// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "linkwright/planar/type_synthesis/search.h"
#include "linkwright/study/result.h"

namespace linkwright::planar {

/// The error that machines of a search are compared by: its column, unit, and what a size of the target is in
/// that unit.
struct SearchError {
  std::string_view key, unit;
  double scale = 1;
};

/// Adds what a search did: the tables "families" and "progress" with their diagram, and its counts.
void add_search_tables(const TypeSearchAnswer& answer, const SearchError& error, study::Result& result);

}  // namespace linkwright::planar
