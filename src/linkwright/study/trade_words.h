// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

// The words that people use elsewhere - in another program, in German, French or Spanish - and what studies
// call them. Only messages use it: a study is written in one language.
namespace linkwright::study {

/// The word of `allowed` that `word` was probably meant to be: the same but for case, blanks and punctuation
/// ("fourbar" is "planar.four_bar"), a word of the trade for it ("Kurbel" is "crank"), or the nearest
/// (nearest_word); empty if there is none.
std::string_view meant_word(std::string_view word, const std::vector<std::string_view>& allowed);

/// The hint "did you mean 'crank'?" with that word; `otherwise` when there is none.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed,
                       std::string otherwise = {});

}  // namespace linkwright::study
