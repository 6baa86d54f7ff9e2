// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/value.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

TEST(Value, KeepsOrderAndFindsMembers) {
  Value study;
  study["schema"] = 1;
  study["mechanism"]["type"] = "planar.four_bar";
  study["points"].push_back(0.5);
  EXPECT_EQ(study.as_object()[1].key, "mechanism");
  EXPECT_EQ(study.find("mechanism")->find("type")->as_string(), "planar.four_bar");
  EXPECT_EQ(study.find("nothing"), nullptr);
  EXPECT_EQ(study["points"].as_array().size(), 1u);
}

TEST(Value, IntegersAreNumbersAndCompareAsSuch) {
  EXPECT_TRUE(Value(1).is_number());
  EXPECT_EQ(Value(1), Value(1.0));
  EXPECT_EQ(Value(3).as_number(), 3.0);
  EXPECT_FALSE(Value("1") == Value(1));
}

TEST(Value, WrongTypeBreaksTheContract) {
  EXPECT_THROW(Value("text").as_number(), ContractError);
  EXPECT_THROW(Value(1.5).as_integer(), ContractError);
}

}  // namespace
}  // namespace linkwright
