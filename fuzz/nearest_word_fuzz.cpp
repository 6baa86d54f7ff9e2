// SPDX-License-Identifier: BSD-3-Clause

// The first line is the misspelt word, the other lines are the words that are allowed.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string_view> lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  const std::string_view word = lines.front();
  const std::vector<std::string_view> allowed(lines.begin() + 1, lines.end());

  const std::string_view nearest = linkwright::nearest_word(word, allowed);
  FUZZ_REQUIRE(nearest.empty() || std::find(allowed.begin(), allowed.end(), nearest) != allowed.end());
  // A word that is allowed is its own nearest; longer words are not compared.
  if (!word.empty() && word.size() <= 64 && std::find(allowed.begin(), allowed.end(), word) != allowed.end())
    FUZZ_REQUIRE(nearest == word);

  linkwright::Diagnostic diagnostic;
  diagnostic.file = "study.toml";
  diagnostic.key = word;
  diagnostic.message = "unknown key";
  const std::string line = to_string(diagnostic);
  FUZZ_REQUIRE(line.starts_with("study.toml: error: ") && line.ends_with("unknown key"));
  return 0;
}
