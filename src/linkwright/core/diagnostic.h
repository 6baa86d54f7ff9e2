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
  /// Consequence of a diagnostic.
  enum class Severity {
    error,   ///< nothing is run or written
    warning  ///< the run continues
  };
  Severity severity = Severity::error;  ///< error or warning
  std::string file;                     ///< empty = not from a file
  Position position;                    ///< line 0 = unknown
  std::string key;                      ///< path of the key: "mechanism.parameters.crank_m"
  Sentence message;                     ///< says what was found and what is allowed, with the numbers
  Sentence hint;                        ///< says how to fix it; may be empty
};

/// Diagnostics in the order of the file.
using Diagnostics = std::vector<Diagnostic>;

/// @param diagnostics any number of diagnostics
/// @returns true if at least one of them is an error
bool has_errors(const Diagnostics& diagnostics);

/// The diagnostic in one line: "study.toml:12:3: error: mechanism.parameters.crnk_m: unknown key; did you
/// mean 'crank_m'?"
/// @param diagnostic the diagnostic; an empty file, an unknown position and an empty key are left out
/// @returns the line, without a line break
std::string to_string(const Diagnostic& diagnostic);

/// The word that another one was probably meant to be, by the edit distance including swaps of neighbours.
/// @param word word as it was written; more than 64 characters are like no word
/// @param allowed words that could have been meant
/// @returns the nearest word of `allowed`, within two letters or about a third of the letters of `word`, and
/// closer than all letters of either; empty if none is near
std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& allowed);

/// The hint "did you mean 'crank'?" with the nearest word.
/// @param word word as it was written
/// @param allowed words that could have been meant
/// @param otherwise hint when none is near
/// @returns the hint
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& allowed,
                         std::string otherwise = {});

}  // namespace linkwright
