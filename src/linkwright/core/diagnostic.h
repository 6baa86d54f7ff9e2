// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/core/value.h"

namespace linkwright {

/// One thing that is wrong with a file or an option: where, what was found, and how to fix it.
struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  std::string file;   ///< empty = not from a file
  Position position;  ///< line 0 = unknown
  std::string key;    ///< path of the key: "mechanism.parameters.crank_m"
  Sentence message;   ///< says what was found and what is allowed, with the numbers
  Sentence hint;      ///< says how to fix it; may be empty
};

using Diagnostics = std::vector<Diagnostic>;

bool has_errors(const Diagnostics& diagnostics);

/// "study.toml:12:3: error: mechanism.parameters.crnk_m: unknown key; did you mean 'crank_m'?"
std::string to_string(const Diagnostic& diagnostic);

/// The word of `allowed` that `word` was probably meant to be (edit distance incl. swaps, at most about a
/// third of its letters); empty if none is near.
std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& allowed);

/// The hint "did you mean 'crank'?" with the nearest word; `otherwise` when none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& allowed,
                         std::string otherwise = {});

}  // namespace linkwright
