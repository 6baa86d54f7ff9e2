// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/kind.h"
#include "linkwright/study/reproduction.h"

namespace linkwright::cli {

/// The words that may replace a value, by its name in the help: "KIND" -> the kinds of studies.
using CompletionWords = std::map<std::string, std::vector<std::string>, std::less<>>;
CompletionWords completion_words(std::span<const study::Kind> kinds,
                                 std::span<const study::Reproduction> reproductions);

/// A script for "bash", "zsh" or "fish" that completes commands, options, kinds, examples and files of
/// studies.
std::string completion_script(std::string_view shell, const CompletionWords& words);

}  // namespace linkwright::cli
