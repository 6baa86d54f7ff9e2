// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::test {

/// The rows of the table with that id, computed anew; fails the test if there is none.
inline std::vector<study::Comparison> rows_of(const std::vector<study::Reproduction>& tables,
                                              std::string_view id) {
  for (const study::Reproduction& r : tables)
    if (r.id == id) {
      RunContext context;
      return r.run(context);
    }
  ADD_FAILURE() << "no table " << id;
  return {};
}

/// Every table has what its list and its page show.
inline void expect_complete(const std::vector<study::Reproduction>& tables) {
  std::set<std::string> ids;
  for (const study::Reproduction& r : tables) {
    EXPECT_TRUE(ids.insert(r.id).second) << r.id;
    EXPECT_FALSE(r.title.empty() || r.source.empty() || r.notes.empty()) << r.id;
  }
}

}  // namespace linkwright::test
