#pragma once

#include <span>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/study/kind.h"

namespace linkwright::app {

/// Every kind of study that this program can run: the one list of all domains' kinds.
std::span<const study::Kind> catalogue();

/// The kind with a name as `name_of` gives it, or with the beginning of one that fits no other ("synthesis",
/// "synthesis/planar.four_bar"). nullptr and a diagnostic if there is none or several.
const study::Kind* find_kind(std::string_view name, std::span<const study::Kind> kinds,
                             Diagnostics& diagnostics);

/// "0.1.0"
std::string_view version();

}  // namespace linkwright::app
