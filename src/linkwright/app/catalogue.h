// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/reproduction.h"

namespace linkwright::app {

/// Every kind of study that this program can run: the one list of all domains' kinds.
std::span<const study::Kind> catalogue();

/// The task that users solve with the studies of a kind, a mechanism and a target: "Follow a path".
std::string_view group_of(std::string_view kind, std::string_view mechanism, std::string_view target);
/// The first group: a dozen examples that everybody knows, whatever kind they are of.
inline constexpr std::string_view well_known = "Well-known machines";
/// The position of a group in lists.
std::size_t place_of_group(std::string_view group);

/// True if each of the words is part of one of the texts, whatever its case.
bool holds_words(std::span<const std::string> words, std::initializer_list<std::string_view> texts);

/// The kind with a name as `name_of` gives it, with the beginning of one that fits no other ("synthesis",
/// "synthesis/planar.four_bar"), or else with a part of one ("pi_joint/"). nullptr and a diagnostic if there
/// is none or several.
const study::Kind* find_kind(std::string_view name, std::span<const study::Kind> kinds,
                             Diagnostics& diagnostics);

/// Every published table that this program can recompute.
std::span<const study::Reproduction> reproductions();

/// The reproductions with an id, with ids that begin with it, or all ("all"). Empty and a diagnostic if there
/// are none.
std::vector<const study::Reproduction*> find_reproductions(std::string_view id,
                                                           std::span<const study::Reproduction> all,
                                                           Diagnostics& diagnostics);

/// "0.1.0"
std::string_view version();

}  // namespace linkwright::app
