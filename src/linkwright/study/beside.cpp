// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/beside.h"

#include <fmt/core.h>

#include <fstream>
#include <sstream>

#include "linkwright/core/csv.h"

namespace linkwright::study {

std::string in_file(const Diagnostic& problem) {
  const std::string_view severity = problem.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
  std::string text = to_string(problem);
  // In the text before it, only the name of the file could hold the word.
  const std::size_t at = text.find(severity, problem.file.size());
  return text.erase(at, severity.size());
}

std::optional<std::string> read_beside(ObjectReader& reader, std::string_view key,
                                       const std::filesystem::path& folder, const std::string& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{4} << 20;
  const std::filesystem::path path = folder / file;
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  if (failed || !std::filesystem::is_regular_file(path, failed)) {
    reader.unreadable(key, fmt::format("cannot read '{}'", path.string()),
                      "file names are relative to the folder of the study");
    return std::nullopt;
  }
  if (size > largest) {
    reader.unreadable(key, fmt::format("'{}' has {} bytes, at most {} are allowed", file, size, largest));
    return std::nullopt;
  }
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  std::string no_text;
  std::optional<std::string> utf8 = to_utf8(text.str(), no_text);
  if (!utf8) reader.unreadable(key, fmt::format("'{}' cannot be read: {}", file, no_text));
  return utf8;
}

}  // namespace linkwright::study
