// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/diagnostic.h"

#include <fmt/core.h>

#include <algorithm>

namespace linkwright {
namespace {

// Optimal string alignment distance: insert, delete, replace, swap neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

bool has_errors(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::error; });
}

std::string to_string(const Diagnostic& d) {
  std::string text;
  if (!d.file.empty()) {
    text += d.file;
    if (d.position.line > 0) text += fmt::format(":{}:{}", d.position.line, d.position.column);
    text += ": ";
  }
  text += d.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
  if (!d.key.empty()) text += d.key + ": ";
  text += to_string(d.message);
  if (!d.hint.empty()) text += "; " + to_string(d.hint);
  return text;
}

std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& allowed) {
  constexpr std::size_t longest = 64;  // the distance costs O(n^2), and nobody misspells a longer word
  if (word.size() > longest) return {};
  std::string_view nearest;
  std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (std::string_view candidate : allowed) {
    if (candidate.size() > longest) continue;
    if (const std::size_t distance = edit_distance(word, candidate); distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return smallest < std::max<std::size_t>(1, std::min(word.size(), nearest.size())) ? nearest
                                                                                    : std::string_view();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& allowed,
                         std::string otherwise) {
  const std::string_view nearest = nearest_word(word, allowed);
  return nearest.empty() ? otherwise : "did you mean '" + std::string(nearest) + "'?";
}

}  // namespace linkwright
