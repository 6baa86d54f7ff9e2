// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parameter_study/studies.h"

#include <gtest/gtest.h>

#include "linkwright/app/catalogue.h"
#include "linkwright/study/study.h"
#include "support/study_text.h"

namespace linkwright::parameter_study {
namespace {

TEST(ParameterStudies, TheTemplateRuns) {
  const std::vector<study::Kind> kinds = studies(app::catalogue());
  ASSERT_EQ(kinds.size(), 1u);
  EXPECT_EQ(name_of(kinds[0]), "sweep");
  const study::Result result = test::run_text(app::catalogue(), kinds[0].example);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(test::table(result, "trials").rows(), 441u);
  EXPECT_EQ(test::fact(result, "trials"), "386 of 441 done");
}

TEST(ParameterStudies, ItsSchemaHasNoMechanism) {
  const Value schema = study::schema_of(studies(app::catalogue())[0]);
  EXPECT_EQ(schema.find("properties")->find("mechanism"), nullptr);
  EXPECT_NE(schema.find("properties")->find("study"), nullptr);
}

}  // namespace
}  // namespace linkwright::parameter_study
