// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "linkwright/study/bind.h"

namespace linkwright::study {

/// "points.csv:3:1: 'x' is not a number; write ...": a problem of such a file, as part of the message at the
/// key that names it.
std::string in_file(const Diagnostic& problem);

/// Text of a file that a study names at `key`, relative to its folder, as UTF-8 (core/csv.h, to_utf8).
/// Nothing, and the problem reported there, if it cannot be read, is no text or has more than 4 MiB.
std::optional<std::string> read_beside(ObjectReader& reader, std::string_view key,
                                       const std::filesystem::path& folder, const std::string& file);

}  // namespace linkwright::study
