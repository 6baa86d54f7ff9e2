// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/study/study.h"
#include "support/message.h"

// Studies as texts: prepared, run, what is wrong with them, and what they computed. Modules give their kinds.
namespace linkwright::test {

/// The study of a TOML text named "study.toml" in `folder`; its problems are added to `messages`, one a line.
inline std::optional<study::Study> prepare(std::span<const study::Kind> kinds, const std::string& text,
                                           std::string& messages, const std::filesystem::path& folder = ".") {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  auto prepared = study::prepare(document, "study.toml", folder, kinds, diagnostics);
  messages += lines_of(diagnostics);
  return prepared;
}

/// The problems of a study that must have some.
inline std::string problems_of(std::span<const study::Kind> kinds, const std::string& text,
                               const std::filesystem::path& folder = ".") {
  std::string messages;
  EXPECT_FALSE(prepare(kinds, text, messages, folder)) << text;
  return messages;
}

/// The result of a study that must have no problems.
inline study::Result run_text(std::span<const study::Kind> kinds, const std::string& text,
                              const std::filesystem::path& folder = ".") {
  std::string messages;
  const auto prepared = prepare(kinds, text, messages, folder);
  EXPECT_TRUE(prepared) << messages;
  RunContext context;
  return prepared ? study::run_study(*prepared, context) : study::Result();
}

/// The sentence of a fact; "no fact" when there is none of this label.
inline Sentence sentence(const study::Result& result, std::string_view label) {
  for (const study::Fact& f : result.facts)
    if (f.label == label) return f.text;
  return "no fact";
}
inline std::string fact(const study::Result& result, std::string_view label) {
  return to_string(sentence(result, label));
}
/// Its value, which is NaN when it has none.
inline double value_of_fact(const study::Result& result, std::string_view label) {
  const auto value = sentence(result, label).value();
  return value ? value->si : nan;
}

/// The table of this name; a failure and an empty one if there is none.
inline const Table& table(const study::Result& result, std::string_view name) {
  for (const Table& t : result.tables)
    if (t.name == name) return t;
  ADD_FAILURE() << "no table " << name;
  static const Table none;
  return none;
}
/// A column of a table; a failure and {0} if there is none.
inline const std::vector<double>& column(const study::Result& result, std::string_view name,
                                         std::string_view key) {
  if (const Column* found = table(result, name).find(key)) return found->values;
  ADD_FAILURE() << "no column " << name << "." << key;
  static const std::vector<double> none{0};
  return none;
}
/// A column of the first table.
inline const std::vector<double>& column(const study::Result& result, std::string_view key) {
  return column(result, result.tables.at(0).name, key);
}
/// The largest magnitude; 0 of nothing.
inline double largest(std::span<const double> values) {
  double out = 0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

/// A file of examples/studies, and what it says.
inline std::filesystem::path example_path(const std::string& file) {
  return std::filesystem::path(LINKWRIGHT_SOURCE_DIR) / "examples/studies" / file;
}
inline std::string example_text(const std::string& file) {
  std::ifstream stream(example_path(file));
  std::ostringstream text;
  text << stream.rdbuf();
  EXPECT_FALSE(text.str().empty()) << file;
  return text.str();
}

/// The study of a file of examples/studies, which must have no problems.
inline std::optional<study::Study> prepare_example(std::span<const study::Kind> kinds,
                                                   const std::string& file) {
  const std::filesystem::path path = example_path(file);
  Diagnostics diagnostics;
  auto prepared = study::prepare(study::read_file(path, diagnostics), path.string(), path.parent_path(),
                                 kinds, diagnostics);
  EXPECT_EQ(lines_of(diagnostics), "") << file;
  return prepared;
}

/// The text with its first `what`, which must be there, replaced.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  if (at != std::string::npos) text.replace(at, what.size(), by);
  return text;
}

}  // namespace linkwright::test
