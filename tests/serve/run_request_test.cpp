// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/run_request.h"

#include <gtest/gtest.h>

#include <string>

namespace linkwright::serve {
namespace {

std::string problem_of(std::string_view body) {
  std::string problem;
  EXPECT_FALSE(read_run_request(body, problem).has_value());
  return problem;
}

TEST(RunRequest, IsReadWithAllItsMembers) {
  std::string problem;
  const auto request = read_run_request(
      R"({"run": "tab0.12", "text": "schema = 1\n", "edits": "{}", "files": {"a.csv": "1,2", "b": ""}, "seconds": 0.5, "more": 1})",
      problem);
  ASSERT_TRUE(request.has_value()) << problem;
  EXPECT_EQ(request->run, "tab0.12");
  EXPECT_EQ(request->text, "schema = 1\n");
  EXPECT_EQ(request->edits, "{}");
  EXPECT_EQ(request->files, (std::map<std::string, std::string>{{"a.csv", "1,2"}, {"b", ""}}));
  EXPECT_EQ(request->seconds, 0.5);
}

TEST(RunRequest, NeedsItsNameAndAText) {
  std::string problem;
  const auto request = read_run_request(R"({"run": "a.1", "text": ""})", problem);
  ASSERT_TRUE(request.has_value()) << problem;
  EXPECT_EQ(request->edits, "");
  EXPECT_TRUE(request->files.empty());
  EXPECT_EQ(request->seconds, 0);
  EXPECT_EQ(problem_of(R"({"text": ""})"), "run: must be a text");
  EXPECT_EQ(problem_of(R"({"run": "a.1"})"), "text: must be a text");
  EXPECT_EQ(problem_of(R"({"run": 1, "text": ""})"), "run: must be a text");
  EXPECT_EQ(problem_of(R"({"run": "a.1", "text": "", "edits": []})"), "edits: must be a text");
}

TEST(RunRequest, NamesAreOfATabAndANumber) {
  EXPECT_EQ(tab_of("a1Z.0"), "a1Z");
  EXPECT_EQ(tab_of(std::string(64, 'x') + ".123456789012345"), std::string(64, 'x'));
  for (const std::string& run :
       {std::string(), std::string("a"), std::string(".1"), std::string("a."), std::string("a.b"),
        std::string("a.1.2"), std::string("a b.1"), std::string("a/b.1"), std::string("a.-1"),
        std::string(65, 'x') + ".1", std::string("a.1234567890123456"), std::string("a\0.1", 4)})
    EXPECT_EQ(tab_of(run), "") << run;
  EXPECT_EQ(problem_of(R"({"run": "a", "text": ""})"),
            "run: must be TAB.NUMBER, with at most 64 letters and digits for the tab");
}

TEST(RunRequest, FilesStayWhereTheyArePut) {
  for (const char* name : {"", ".", "..", "../a", "/etc/passwd", "a/b", "a\\\\b", "a\\u0000b"})
    EXPECT_EQ(problem_of(std::string(R"({"run": "a.1", "text": "", "files": {")") + name + R"(": "x"}})"),
              "files: must be texts by names without a folder")
        << name;
  EXPECT_EQ(problem_of(R"({"run": "a.1", "text": "", "files": {"a": 1}})"),
            "files: must be texts by names without a folder");
  EXPECT_EQ(problem_of(R"({"run": "a.1", "text": "", "files": ["a"]})"),
            "files: must be a table of at most 64 texts");
  std::string many;
  for (int i = 0; i < 65; ++i) many += (i ? ",\"f" : "\"f") + std::to_string(i) + "\":\"\"";
  EXPECT_EQ(problem_of(R"({"run": "a.1", "text": "", "files": {)" + many + "}}"),
            "files: must be a table of at most 64 texts");
}

TEST(RunRequest, TimesAreNumbers) {
  for (const char* seconds : {"-1", "\"1\"", "true", "[]"})
    EXPECT_EQ(problem_of(std::string(R"({"run": "a.1", "text": "", "seconds": )") + seconds + "}"),
              "seconds: must be a number, 0 or more")
        << seconds;
}

TEST(RunRequest, WhatIsNoJsonSaysWhere) {
  EXPECT_EQ(problem_of("{\"run\": \"a.1\",\n \"text\": }").substr(0, 19), "request:2:10: error");
  EXPECT_NE(problem_of(""), "");
  EXPECT_NE(problem_of("[]"), "");
  EXPECT_NE(problem_of("\xff"), "");
  EXPECT_NE(problem_of(std::string(100000, '[')), "");
}

}  // namespace
}  // namespace linkwright::serve
