// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/check.h"

#include <gmock/gmock.h>

namespace linkwright {
namespace {

void set_length(double length) { LINKWRIGHT_REQUIRE(length > 0, "length {} is not positive", length); }

TEST(Require, PassesWhatKeepsTheContract) { EXPECT_NO_THROW(set_length(1)); }

TEST(Require, TellsFunctionValuesAndCondition) {
  EXPECT_THAT([] { set_length(-2.5); }, ::testing::ThrowsMessage<ContractError>(::testing::StrEq(
                                            "set_length: length -2.5 is not positive [length > 0]")));
}

TEST(Require, IsOneStatement) {
  bool reached = false;
  if (false)
    LINKWRIGHT_REQUIRE(false, "never evaluated");
  else
    reached = true;
  EXPECT_TRUE(reached);
}

}  // namespace
}  // namespace linkwright
