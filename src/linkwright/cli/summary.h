// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/result.h"

namespace linkwright::cli {

/// The text of a run on standard output: title, answer, facts, checks, remarks and the files that were
/// written; the last line says which report to open, if there is one.
std::string summary(std::string_view title, const study::Result& result,
                    const std::vector<std::filesystem::path>& written, bool colours);

}  // namespace linkwright::cli
