// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "linkwright/planar/studies.h"
#include "support/study_text.h"

// Studies of this module as texts.
namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

using linkwright::test::fact;
using linkwright::test::replaced;

inline const std::vector<study::Kind>& kinds() {
  static const std::vector<study::Kind> all = studies();
  return all;
}
inline std::optional<study::Study> prepare(const std::string& text, std::string& messages,
                                           const std::filesystem::path& folder = ".") {
  return linkwright::test::prepare(kinds(), text, messages, folder);
}
inline std::string problems_of(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::test::problems_of(kinds(), text, folder);
}
inline study::Result run_text(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::test::run_text(kinds(), text, folder);
}

/// A study of named parts in the order of their names, with some replaced or added.
inline std::string text_of(std::map<std::string, std::string> parts,
                           const std::map<std::string, std::string>& changed) {
  for (const auto& [name, text] : changed) parts[name] = text;
  std::string all;
  for (const auto& [name, text] : parts) all += text;
  return all;
}

/// Keys of all columns.
inline std::vector<std::string> keys(const Table& table) {
  std::vector<std::string> out;
  for (const Column& column : table.columns) out.push_back(column.key);
  return out;
}

}  // namespace linkwright::planar::test
