// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "linkwright/study/bind.h"

// Sizes of studies, judged before anything is allocated (core/memory.h has the limit).
namespace linkwright::study {

/// Bytes that a table of numbers takes at its most: as recorded, as a table, as JSON and as the text of its
/// files. Measured on simulations of 1e5 rows with all files: 118 to 129 bytes a number.
double table_bytes(double rows, double columns);

/// Bytes of a population method: the candidates, what is made of them, and their costs.
double population_bytes(double population, double variables);

/// An error at `key` of a table when what it asks for takes more memory than may be taken: "3e+09 rows would
/// take 23.4 TB of memory, at most 12 GB may be taken". `fix` says how to ask for less: "take fewer
/// samples". False when there was an error.
bool require_memory(ObjectReader& table, std::string_view key, double bytes, std::string_view what,
                    std::string_view mend);

}  // namespace linkwright::study
