// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/study/bind.h"

// The tables [[mechanism.link]] and [[drive]] that arms of every kind share; [[drive]] says how the joints of
// the links move.
namespace linkwright::study {

/// Checks the list of links of an arm: 1 to 20 of them, whose names begin the names of columns. A link
/// without a name becomes "link1", "link2", ... Names that no column can begin with, and those of two links,
/// are errors at the key `name`.
/// @param mechanism  the table [mechanism]
/// @param names      of the links that were read, in their order
void complete_arm_links(ObjectReader& mechanism, std::span<std::string* const> names);

/// The index of the link that a table of [[drive]] names: 0 is the first; nothing where it names none of
/// them, which is an error.
std::optional<std::size_t> driven_link(ObjectReader& drive, std::string_view link,
                                       std::span<const std::string_view> links);

}  // namespace linkwright::study
