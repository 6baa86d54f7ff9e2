// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/linkage.h"
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

/// Says that no machine was found, and why the nearest one is no answer; `error_of_nearest` is its root mean
/// square error in the unit of the search.
void report_none_found(const TypeSearchAnswer& answer, const Measured& error_of_nearest,
                       study::Result& result);

/// The machine with the least error of those outside the limits, null if there is none.
const FoundMachine* nearest_outside(const TypeSearchAnswer& answer);

/// Adds the lengths of the moving links to the numbers of a solution, each from the first point of its link.
void add_link_lengths(const Linkage& linkage, study::Solution& solution);

}  // namespace linkwright::planar
