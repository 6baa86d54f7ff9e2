// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/flexible/studies.h"
#include "support/study_text.h"

namespace linkwright::test {}
namespace linkwright::flexible::test {
using namespace linkwright::test;  // shared by the tests of all modules

inline const std::vector<study::Kind>& kinds() {
  static const auto all = studies();
  return all;
}
inline study::Result run(const std::string& text) { return run_text(kinds(), text); }
inline std::string problems(const std::string& text) { return problems_of(kinds(), text); }

}  // namespace linkwright::flexible::test
