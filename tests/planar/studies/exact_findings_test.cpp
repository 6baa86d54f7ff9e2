// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/exact_findings.h"

#include <gmock/gmock.h>

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

ExactFindings three_of_ten() {
  return {.what = "solutions",
          .whole = 10,
          .completeness = Completeness::complete_uncertified,
          .classes = 10,
          .real_classes = 3,
          .designs = 3,
          .defect_free = 1,
          .branch = 2,
          .answers = 1};
}

TEST(ExactFindings, ASetIsCompleteWhenNothingIsMissing) {
  ExactFindings f = three_of_ten();
  EXPECT_EQ(completeness_of(f), Completeness::complete_uncertified);
  f.classes = 9;
  EXPECT_EQ(completeness_of(f), Completeness::special_target);
  f.lost = 1;
  EXPECT_EQ(completeness_of(f), Completeness::incomplete);
  f.lost = 0, f.stopped = Status::deadline;
  EXPECT_EQ(completeness_of(f), Completeness::incomplete);
}

TEST(ExactFindings, TheVerdictNamesWhatIsMissing) {
  ExactFindings f = three_of_ten();
  EXPECT_EQ(judge(f).status, Status::done);
  EXPECT_EQ(judge(f).outcome, "complete_uncertified");
  f.answers = 0;
  EXPECT_EQ(judge(f).status, Status::infeasible);
  EXPECT_EQ(judge(f).outcome, "all_defective");
  f.real_classes = 0;
  EXPECT_EQ(judge(f).outcome, "no_real_solution");
  f.classes = 0;
  EXPECT_EQ(judge(f).outcome, "no_solution");
  f.completeness = Completeness::incomplete;
  EXPECT_EQ(judge(f).status, Status::not_converged);
  f.stopped = Status::cancelled;
  EXPECT_EQ(judge(f).status, Status::cancelled);
}

TEST(ExactFindings, TheTextsCountMechanisms) {
  ExactFindings f = three_of_ten();
  EXPECT_EQ(to_string(found_text(f)), "All 10 solutions; 3 of them are real.");
  EXPECT_EQ(to_string(answer_text(f, "their", "a crank-rocker")),
            "1 of their 3 four-bars passes the points in one motion and in their order; the best is a "
            "crank-rocker.");
  f.mechanism = "slider-crank";
  f.answers = 0;
  EXPECT_THAT(to_string(answer_text(f, "these", "")),
              HasSubstr("None of the 1 slider-cranks that pass the points"));
  f.defect_free = 0;
  EXPECT_THAT(
      to_string(answer_text(f, "these", "")),
      HasSubstr(
          "None of these 3 slider-cranks passes the points in one motion and in their order: 2 change"));
  f.designs = 0;
  EXPECT_EQ(to_string(answer_text(f, "these", "")), "There is no slider-crank to build.");
}

TEST(ExactFindings, TheOrderThatMostPassIsOffered) {
  Diagnostics diagnostics;
  offer_order(study::AddWarning{diagnostics}, three_of_ten(), {{}, {0, 2, 1}, {1, 0, 2}, {0, 2, 1}});
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(to_string(diagnostics[0].message),
            "in the order 1, 3, 2 2 of these four-bars would pass the points in one motion");
  offer_order(study::AddWarning{diagnostics}, three_of_ten(), {{}, {}});
  EXPECT_EQ(diagnostics.size(), 1U);
}

}  // namespace
}  // namespace linkwright::planar
