// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/report/viewer.h"
#include "tests/report/sample_result.h"
#include "tests/report/sample_spatial.h"

namespace linkwright::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string page(const study::Result& result, const std::string& text) {
  return html({.result = result,
               .study_toml = text,
               .title = text,
               .source = text,
               .tool = text,
               .command = text,
               .result_json = test::sample_json(result)});
}

TEST(Html, LoadsNothing) {
  const std::string text = page(test::sample_result(), "title");
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  for (const char* loading : {"<link", " src=\"", "@import", "url(http", "fetch("})
    EXPECT_THAT(text, Not(HasSubstr(loading))) << loading;
}

TEST(Html, HostileTextStaysText) {
  auto result = test::sample_result();
  result.headline = test::hostile;
  const std::string text = page(result, test::hostile);
  EXPECT_THAT(text, Not(HasSubstr("<script>document.body.dataset")));
  EXPECT_THAT(text, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(text, HasSubstr("&lt;script&gt;document.body.dataset"));
}

TEST(Html, ScriptsEndOnlyWhereTheyShould) {
  const std::string text = page(test::sample_result(), test::hostile);
  std::size_t ends = 0;
  for (std::size_t at = text.find("</script"); at != std::string::npos; at = text.find("</script", at + 1))
    ++ends;
  EXPECT_EQ(ends, LINKWRIGHT_HAS_VIEWER ? 7u : 0u);
  EXPECT_THAT(text, Not(HasSubstr("<!--")));
}

TEST(Html, OnlySpatialReportsDrawInSpace) {
  const std::string flat = page(test::sample_result(), "a"), spatial = page(test::sample_spatial(), "a");
  EXPECT_THAT(flat, Not(HasSubstr("space-script")));
  EXPECT_EQ(spatial.find("id=\"space-script\"") != std::string::npos, LINKWRIGHT_HAS_VIEWER);
  EXPECT_THAT(spatial, HasSubstr("<figure class=\"drawing\" data-scene=\"0\">"));
  EXPECT_THAT(flat, Not(HasSubstr("data-scene=")));
  EXPECT_THAT(spatial, Not(HasSubstr("<!--")));
  for (const char* loading : {"<link", " src=\"", "@import", "url(http"})
    EXPECT_THAT(spatial, Not(HasSubstr(loading))) << loading;
}

TEST(Html, LicencesOfPackedScriptsCanBeRead) {
  if (!LINKWRIGHT_HAS_VIEWER) return;
  const std::string flat = page(test::sample_result(), "a"), spatial = page(test::sample_spatial(), "a");
  const auto says = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(flat, "Preact, (c) 2015-present Jason Miller"));
  EXPECT_FALSE(says(flat, "three.js authors"));
  EXPECT_TRUE(says(spatial, "three.js, (c) 2010-2026 three.js authors"));
  EXPECT_TRUE(says(spatial, "Permission is hereby granted, free of charge"));
}

TEST(Html, SameInputSameBytes) {
  const auto result = test::sample_result();
  EXPECT_EQ(page(result, "a"), page(result, "a"));
}

}  // namespace
}  // namespace linkwright::report
