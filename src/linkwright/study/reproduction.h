// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/study/result.h"

namespace linkwright::study {

/// A published table that is recomputed.
struct Reproduction {
  std::string id;                  ///< "boskovic-2018-table-2.7"
  std::string title;               ///< title of the table
  std::string source;              ///< place where it is printed
  std::vector<std::string> notes;  ///< notes needed to read it: corrections, conventions
  /// Numbers with their verdicts: "reproduced", "corrected" (right once a slip of the source is fixed),
  /// "improved" (a better answer to the same question), "not reproduced".
  std::function<Comparisons(RunContext& context)> run;
};

/// Reads a TOML text of published tables, which is part of the program.
/// @param toml the text
/// @returns its tree
/// @throws ContractError if the text has a mistake
Value read_published(std::string_view toml);

/// A function that computes a table, whose source it is given.
using ComputeTable = std::function<Comparisons(const std::string& source, RunContext& context)>;

/// The tables of a text that is part of the program, each with the function under its id. A [[table]] has its
/// id, title, source and notes, which end with those of [shared_notes] under the name that it gives.
/// @param toml the text
/// @param computed functions that compute the tables, by id
/// @returns the tables in the order of the text
/// @throws ContractError if the text and the functions do not belong together
std::vector<Reproduction> reproductions_of(std::string_view toml,
                                           const std::map<std::string, ComputeTable>& computed);

}  // namespace linkwright::study
