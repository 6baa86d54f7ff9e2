// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {
struct Reproduction;
}

namespace linkwright::app {

/// @returns every kind of study that this program can run: the one list of all domains' kinds
std::span<const study::Kind> catalogue();

/// The task that users solve with studies of a kind: "Follow a path".
/// @param kind `kind` of the study
/// @param mechanism `mechanism.type`; empty = none
/// @param target `target.type`; empty = none
/// @returns title of the group
std::string_view group_of(std::string_view kind, std::string_view mechanism, std::string_view target);
/// The first group: a dozen examples that everybody knows, whatever kind they are of.
inline constexpr std::string_view well_known = "Well-known machines";
/// @param group title of a group
/// @returns its position in lists, from 0; the number of groups for another text
std::size_t place_of_group(std::string_view group);

/// @param words words that are looked for
/// @param texts texts in which they may be
/// @returns true if each of the words is part of one of the texts, whatever its case
bool holds_words(std::span<const std::string> words, std::initializer_list<std::string_view> texts);

/// Finds a kind by its name.
/// @param name name as study::name_of gives it, or the beginning of one that fits no other ("synthesis",
/// "synthesis/planar.four_bar"), or else a part of one ("pi_joint/")
/// @param kinds kinds to choose from
/// @param diagnostics receives the reason if there is none or several
/// @returns the kind, an item of `kinds`; nullptr if there is none or several
const study::Kind* find_kind(std::string_view name, std::span<const study::Kind> kinds,
                             Diagnostics& diagnostics);

/// @returns every published table that this program can recompute
std::span<const study::Reproduction> reproductions();

/// Finds published tables.
/// @param id id of a table, the beginning of ids, or "all"
/// @param all tables to choose from
/// @param diagnostics receives the reason if there are none
/// @returns the tables, items of `all`; empty if there are none
std::vector<const study::Reproduction*> find_reproductions(std::string_view id,
                                                           std::span<const study::Reproduction> all,
                                                           Diagnostics& diagnostics);

/// @returns the version of the library: "0.1.0"
std::string_view version();

}  // namespace linkwright::app
