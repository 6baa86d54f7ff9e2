// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/corner/hard_point_list.h"

/// Files that say which point of a list a study means: one line a point, "lower wishbone front =
/// CHAS_LowFor".
namespace linkwright::suspension::lists {

/// Names of points in a study, each with its name in a list.
using PointNames = std::vector<std::pair<std::string, std::string>>;

/// Reads such a file for a list. Lines that begin with # are comments. Lines without a name on each side of
/// their sign, names that are given twice and points that the list does not have are problems, which are
/// appended with their line under the name `file`; nothing is returned then.
std::optional<PointNames> read_point_names(std::string_view text, const std::string& file,
                                           std::span<const ListedPoint> listed, Diagnostics& diagnostics);

/// Such a file for names of a study, to be checked and completed by hand: each has the point of the list
/// whose name has the most of its words, as suspension programs abbreviate them, or nothing where none or
/// several have. The points of the list that are not used follow as comments.
std::string proposed_point_names(std::span<const std::string> wanted, std::span<const ListedPoint> listed,
                                 std::string_view list_file);

}  // namespace linkwright::suspension::lists
