#pragma once

#include <vector>

#include "linkwright/suspension/studies.h"
#include "support/study_text.h"

// Studies of this room as texts.
namespace linkwright::suspension::testing {

using linkwright::testing::fact;
using linkwright::testing::replaced;

inline const std::vector<study::Kind>& kinds() {
  static const std::vector<study::Kind> all = studies();
  return all;
}
inline std::optional<study::Study> prepare(const std::string& text, std::string& messages,
                                           const std::filesystem::path& folder = ".") {
  return linkwright::testing::prepare(kinds(), text, messages, folder);
}
inline std::string problems_of(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::testing::problems_of(kinds(), text, folder);
}
inline study::Result run_text(const std::string& text, const std::filesystem::path& folder = ".") {
  return linkwright::testing::run_text(kinds(), text, folder);
}

}  // namespace linkwright::suspension::testing
