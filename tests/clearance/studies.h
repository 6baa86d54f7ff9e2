#pragma once

#include <vector>

#include "linkwright/clearance/studies.h"
#include "support/study_text.h"

// Studies of this room as texts.
namespace linkwright::clearance::testing {

using linkwright::testing::fact;
using linkwright::testing::replaced;

inline const std::vector<study::Kind>& kinds() {
  static const std::vector<study::Kind> all = studies();
  return all;
}
inline std::optional<study::Study> prepare(const std::string& text, std::string& messages) {
  return linkwright::testing::prepare(kinds(), text, messages);
}
inline std::string problems_of(const std::string& text) {
  return linkwright::testing::problems_of(kinds(), text);
}
inline study::Result run_text(const std::string& text) {
  return linkwright::testing::run_text(kinds(), text);
}

}  // namespace linkwright::clearance::testing
