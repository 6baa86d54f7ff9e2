// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/reproduction.h"

#include <gmock/gmock.h>

#include "linkwright/core/check.h"

namespace linkwright::study {
namespace {

using ::testing::ElementsAre;

constexpr const char* two_tables = R"(
[shared_notes]
slips = ["A digit is lost."]

[[table]]
id = "second"
title = "lengths"
source = "Table 2"
notes = ["Lengths are in m."]
shared_notes = "slips"

[[table]]
id = "first"
title = "angles"
source = "Table 1"
notes = ["Angles are in rad."]
)";

Comparisons one_row(const std::string& source, RunContext&) {
  return {{"a", source, 1, 1, "reproduced", ""}};
}

TEST(Reproduction, TablesComeInTheOrderOfTheTextWithTheirNotesAndTheirFunction) {
  const auto tables = reproductions_of(two_tables, {{"first", one_row}, {"second", one_row}});
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].id, "second");
  EXPECT_EQ(tables[0].title, "lengths");
  EXPECT_THAT(tables[0].notes, ElementsAre("Lengths are in m.", "A digit is lost."));
  EXPECT_THAT(tables[1].notes, ElementsAre("Angles are in rad."));
  RunContext context;
  EXPECT_EQ(tables[0].run(context).at(0).source, "Table 2");
}

TEST(Reproduction, TablesAndFunctionsBelongTogether) {
  EXPECT_THROW(reproductions_of(two_tables, {{"first", one_row}}), ContractError);
  EXPECT_THROW(reproductions_of(two_tables, {{"first", one_row}, {"second", one_row}, {"third", one_row}}),
               ContractError);
  EXPECT_THROW(read_published("table = "), ContractError);
}

}  // namespace
}  // namespace linkwright::study
