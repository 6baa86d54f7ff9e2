#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/studies.h"
#include "linkwright/study/read.h"
#include "linkwright/study/study.h"

// Studies of this room as texts: prepared, run, and what is wrong with them.
namespace linkwright::planar::testing {

/// The study of a TOML text named "study.toml" in `folder`; its problems are added to `messages`, one a line.
inline std::optional<study::Study> prepare(const std::string& text, std::string& messages,
                                           const std::filesystem::path& folder = ".") {
  static const std::vector<study::Kind> kinds = studies();
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  auto prepared = study::prepare(document, "study.toml", folder, kinds, diagnostics);
  for (const Diagnostic& d : diagnostics) messages += to_string(d) + "\n";
  return prepared;
}

/// The problems of a study that must have some.
inline std::string problems_of(const std::string& text) {
  std::string messages;
  EXPECT_FALSE(prepare(text, messages)) << text;
  return messages;
}

/// The result of a study that must have no problems.
inline study::Result run_text(const std::string& text) {
  std::string messages;
  const auto prepared = prepare(text, messages);
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

}  // namespace linkwright::planar::testing
