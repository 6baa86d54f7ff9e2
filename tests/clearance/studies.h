#pragma once

#include <string_view>
#include <vector>

#include "linkwright/clearance/studies.h"
#include "support/study_text.h"

// Studies of this module as texts.
namespace linkwright::test {}
namespace linkwright::clearance::test {
using namespace linkwright::test;  // what the tests of all modules share

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

/// The table of that name; fails the test and is empty if there is none.
inline const Table& table(const study::Result& r, std::string_view name) {
  for (const Table& t : r.tables)
    if (t.name == name) return t;
  ADD_FAILURE() << "no table " << name;
  static const Table none;
  return none;
}
/// The values of a column; fails the test and is {0} if there is none.
inline const std::vector<double>& values(const study::Result& r, std::string_view name,
                                         std::string_view key) {
  if (const Column* c = table(r, name).find(key)) return c->values;
  ADD_FAILURE() << "no column " << name << "." << key;
  static const std::vector<double> none{0};
  return none;
}

}  // namespace linkwright::clearance::test
