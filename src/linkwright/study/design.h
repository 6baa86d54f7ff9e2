// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "linkwright/core/value.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"

// Found designs as studies to continue with: Solution::study.
namespace linkwright::study {

/// A study in SI units with all numbers in the given units; one that is converted is rounded to 15 digits.
/// Empty lists and tables are left out.
Value as_people_write(Value study, const DisplayUnits& units);

/// Largest number of solutions of a result that get a study, the best ones.
inline constexpr std::size_t max_designs = 20;

/// Makes whole studies of what a domain put into `Solution::study`: adds the version, the kind "analysis"
/// unless the domain chose another one, and the title "<title of the source>: <label of the solution>", and
/// writes them as_people_write(). Solutions beyond `max_designs` lose theirs.
void complete_designs(Result& result, std::string_view title, const DisplayUnits& units);

/// The name of the file of a solution's study, without ending: "1-crank-rocker-open". Numbers count from 1;
/// long labels are cut off.
std::string design_name(const Solution& solution, std::size_t number);

/// The text of that file: TOML after the line by which editors find the schema and a remark that says where
/// the design comes from. The study must be complete; `source` is the title of the study that found it,
/// `tool` the program and its version.
std::string design_toml(const Solution& solution, std::size_t number, std::string_view source,
                        std::string_view tool);

}  // namespace linkwright::study
