// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/clearance/studies.h"
#include "support/study_text.h"

// Studies of this module as texts.
namespace linkwright::test {}
namespace linkwright::clearance::test {
using namespace linkwright::test;  // shared by the tests of all modules

using linkwright::test::fact;
using linkwright::test::replaced;

inline const std::vector<study::Kind>& kinds() {
  static const std::vector<study::Kind> all = studies();
  return all;
}
inline std::optional<study::Study> prepare(const std::string& text, std::string& messages) {
  return linkwright::test::prepare(kinds(), text, messages);
}
inline std::string problems_of(const std::string& text) {
  return linkwright::test::problems_of(kinds(), text);
}
inline study::Result run_text(const std::string& text) { return linkwright::test::run_text(kinds(), text); }

}  // namespace linkwright::clearance::test
