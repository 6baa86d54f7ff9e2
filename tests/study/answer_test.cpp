// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/answer.h"

#include <gmock/gmock.h>

#include <cmath>

namespace linkwright::study {
namespace {
using ::testing::ElementsAre;

TEST(Answer, PassesWhenNothingIsWrong) {
  Result result;
  result.facts = {{"length", "0.4 m", Fact::Verdict::good}};
  result.checks = {{.quantity = "q", .value = 1, .limit = "at_most 2", .passed = true}};
  const Answer answer = answer_of(result);
  EXPECT_EQ(answer.verdict, Verdict::passed);
  EXPECT_TRUE(answer.reasons.empty());
  EXPECT_FALSE(answer.first);
  EXPECT_FALSE(answer.worst);
}

TEST(Answer, TellsWhyNot) {
  Result result;
  result.facts = {{"transmission angle", "3 deg", Fact::Verdict::bad}};
  EXPECT_EQ(answer_of(result).verdict, Verdict::doubtful);
  EXPECT_THAT(answer_of(result).reasons, ElementsAre("transmission angle: 3 deg"));
  result.checks = {{.quantity = "q", .value = 3, .limit = "at_most 2"}};
  EXPECT_EQ(answer_of(result).verdict, Verdict::failed);
  EXPECT_EQ(answer_of(result).reasons[0], "check failed: q = 3 (at_most 2)");
  result.checks.clear();
  result.status = Status::deadline;
  EXPECT_EQ(answer_of(result).verdict, Verdict::incomplete);
  EXPECT_EQ(answer_of(result).reasons.back(), "the time limit was reached");
  result.status = Status::no_assembly;
  result.headline = "does not close";
  EXPECT_EQ(answer_of(result).verdict, Verdict::failed);
  EXPECT_EQ(answer_of(result).reasons[0], "does not close");
  result.status = Status::at_rest;
  result.facts.clear();
  EXPECT_EQ(answer_of(result).verdict, Verdict::passed) << "friction that holds is an answer";
}

TEST(Answer, FindsTroublesInTheRows) {
  Result result;
  Table& table = result.tables.emplace_back();
  table.name = "sweep";
  table.add("crank_angle_rad", "", {0, 1, 2, 3, 4});
  table.add("rod_m", "", {5, 5, 5, 5, 5});
  table.status = {"done", "singular", "done", "no_assembly", "no_assembly"};
  const Answer answer = answer_of(result);
  ASSERT_TRUE(answer.first);
  EXPECT_EQ(answer.first->what, "singular");
  EXPECT_EQ(answer.first->where.at(0).key, "crank_angle_rad");
  EXPECT_EQ(answer.first->where.at(0).value, 1);
  EXPECT_EQ(answer.worst->what, "no_assembly");
  EXPECT_EQ(answer.worst->where.at(0).value, 3);
  EXPECT_EQ(answer.worst->why, "2 of 5 rows of 'sweep' are no_assembly");
}

TEST(Answer, PrefersTheTroublesThatTheStudyNames) {
  Result result;
  result.status = Status::limit_reached;
  result.troubles = {{.what = "torque", .where = {{"time_s", 0.1}}, .share = 1.01},
                     {.what = "reach", .where = {{"time_s", 0.2}}},
                     {.what = "torque", .where = {{"time_s", 0.3}}, .share = 1.96}};
  const Answer answer = answer_of(result);
  EXPECT_EQ(answer.first->where.at(0).value, 0.1);
  EXPECT_EQ(answer.worst->share, 1.96);
}

}  // namespace
}  // namespace linkwright::study
