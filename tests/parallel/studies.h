// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "linkwright/parallel/studies.h"
#include "support/study_text.h"

// Studies of this module as texts.
namespace linkwright::test {}
namespace linkwright::parallel::test {
using namespace linkwright::test;  // shared by the tests of all modules

using linkwright::test::fact;
using linkwright::test::replaced;

inline const std::vector<study::Kind>& kinds() {
  static const std::vector<study::Kind> all = studies();
  return all;
}
inline std::string problems_of(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::test::problems_of(kinds(), text, folder);
}
inline study::Result run_text(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::test::run_text(kinds(), text, folder);
}

/// The example of a kind: "analysis/parallel.delta".
inline const std::string& example(std::string_view name) {
  for (const study::Kind& kind : kinds())
    if (study::name_of(kind) == name) return kind.example;
  throw std::logic_error("no such kind");
}

}  // namespace linkwright::parallel::test
