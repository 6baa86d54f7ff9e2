// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/result_schema.h"

#include <gtest/gtest.h>

#include "linkwright/app/result_json.h"
#include "linkwright/study/answer.h"

namespace linkwright::app {
namespace {

// The program checks in tests/tools that results of all kinds fit.
TEST(ResultSchema, NamesEveryStatusVerdictAndMember) {
  const Value schema = result_schema();
  const auto& status = schema.find("$defs")->find("status")->find("enum")->as_array();
  EXPECT_EQ(status.front().as_string(), "done");
  EXPECT_EQ(status.back().as_string(), "cancelled");
  EXPECT_EQ(schema.find("$defs")->find("verdict")->find("enum")->as_array().size(),
            names(study::Verdict{}).size());
  EXPECT_FALSE(schema.find("additionalProperties")->as_bool());
  for (const Value& member : schema.find("required")->as_array())
    EXPECT_NE(schema.find("properties")->find(member.as_string()), nullptr) << member.as_string();
}

}  // namespace
}  // namespace linkwright::app
