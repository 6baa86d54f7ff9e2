#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/read.h"
#include "linkwright/study/study.h"

// Studies as texts: prepared, run, and what is wrong with them. Modules give their kinds.
namespace linkwright::test {

/// The study of a TOML text named "study.toml" in `folder`; its problems are added to `messages`, one a line.
inline std::optional<study::Study> prepare(std::span<const study::Kind> kinds, const std::string& text,
                                           std::string& messages, const std::filesystem::path& folder = ".") {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  auto prepared = study::prepare(document, "study.toml", folder, kinds, diagnostics);
  for (const Diagnostic& d : diagnostics) messages += to_string(d) + "\n";
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

/// Text of a fact; "no fact" when there is none of this label.
inline std::string fact(const study::Result& result, std::string_view label) {
  for (const study::Fact& f : result.facts)
    if (f.label == label) return f.text;
  return "no fact";
}

/// The text with its first `what`, which must be there, replaced.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  if (at != std::string::npos) text.replace(at, what.size(), by);
  return text;
}

}  // namespace linkwright::test
