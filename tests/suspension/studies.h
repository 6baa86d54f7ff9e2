// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/studies.h"
#include "support/study_text.h"

// Studies of this module as texts.
namespace linkwright::test {}
namespace linkwright::suspension::test {
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

/// A value of a table by the name of its row; NaN and a failure if there is none.
inline double named(const Table& table, std::string_view row, std::string_view column) {
  const Column* found = table.find(column);
  for (std::size_t i = 0; found && i < table.names.size(); ++i)
    if (table.names[i] == row) return found->values.at(i);
  ADD_FAILURE() << row << ", " << column;
  return std::nan("");
}

/// The beginning of a study of a wheel suspension, one of a sample, and sweeps to go on with.
inline const std::string head =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\n";
inline std::string sample(const std::string& name, const std::string& rest) {
  return head + "sample = \"" + name + "\"\n" + rest;
}
inline const std::string sweep = "[sweep.travel]\nfrom_mm = -80\nto_mm = 80\nstep_mm = 40\n";
inline const std::string racks = "[sweep.rack]\nvalues_mm = [-30, 0, 30]\n";

/// A point as study files write it.
inline std::string written(const Vec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }

/// The example of the kind with this target.
inline const std::string& example(std::string_view target) {
  for (const study::Kind& kind : kinds())
    if (kind.target == target) return kind.example;
  throw std::logic_error("no kind with this target");
}

}  // namespace linkwright::suspension::test
