// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/jobs.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "linkwright/study/study.h"
#include "tests/serve/long_study.h"

namespace linkwright::serve {
namespace {
using namespace std::chrono_literals;
using ::testing::HasSubstr;

struct Read {
  std::string json;
  std::vector<double> numbers;
};
Read read_frame(std::string_view bytes) {
  std::uint32_t sizes[2];
  EXPECT_GE(bytes.size(), sizeof sizes);
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  EXPECT_EQ(bytes.size(), sizeof sizes + 8 * sizes[1] + sizes[0]);
  Read read;
  read.numbers.resize(sizes[1]);
  if (sizes[1] > 0) std::memcpy(read.numbers.data(), bytes.data() + sizeof sizes, 8 * sizes[1]);
  read.json = bytes.substr(bytes.size() - sizes[0]);
  return read;
}

/// The answer of a run that ends by itself, and what it reported before.
Read answer_of(Job& job, int* told = nullptr) {
  for (;;) {
    const Job::News news = job.news(1s);
    if (news.last) return read_frame(news.frames);
    if (told && !news.frames.empty()) ++*told;
  }
}

std::string without_time(std::string json) { return json.substr(0, json.rfind("\"seconds\"")); }

TEST(Frame, HoldsTheDocumentAndTheNumbersAsTheyAre) {
  const Read read = read_frame(frame({"{\"a\":1}", {1.5, -0.0, 1e300}}));
  EXPECT_EQ(read.json, "{\"a\":1}");
  EXPECT_EQ(read.numbers, (std::vector<double>{1.5, -0.0, 1e300}));
  EXPECT_EQ(frame({"", {}}), std::string(8, '\0'));
}

TEST(Jobs, AnswersAsTheLibrary) {
  Jobs jobs(".", 1);
  const std::string text = test::example("hoeken");
  const std::string edits = R"({"edits": [{"key": "title", "value": "Mine"}]})";
  const Read ours = answer_of(*jobs.start({.run = "a.1", .text = text, .edits = edits}));
  RunContext context;
  const app::View theirs = app::run_text(text, edits, ".", context);
  EXPECT_EQ(without_time(ours.json), without_time(theirs.json));
  EXPECT_EQ(ours.numbers.size(), theirs.numbers.size());
  EXPECT_EQ(std::memcmp(ours.numbers.data(), theirs.numbers.data(), 8 * theirs.numbers.size()), 0);
}

TEST(Jobs, FilesThatComeWithAStudyAreFoundAndGoneAfterwards) {
  Jobs jobs("/nowhere", 1);
  const app::Example* with = nullptr;
  for (const app::Example& example : app::examples())
    if (!example.beside.empty() && !with) with = &example;
  ASSERT_NE(with, nullptr);
  RunRequest request{.run = "a.1", .text = std::string(with->text), .seconds = 1};
  EXPECT_THAT(answer_of(*jobs.start(request)).json, HasSubstr("cannot read '/nowhere/"));
  for (const app::EmbeddedFile& file : with->beside) request.files[std::string(file.path)] = file.text;
  EXPECT_THAT(answer_of(*jobs.start(request)).json, HasSubstr("\"canonical\""));
}

TEST(Jobs, ALongRunReportsAndEndsWhenItIsAskedTo) {
  Jobs jobs(".", 2);
  const auto job = jobs.start({.run = "a.1", .text = test::long_study()});
  while (job->news(1s).frames.empty()) continue;
  EXPECT_FALSE(jobs.cancel("a.2"));
  EXPECT_FALSE(jobs.cancel("b.1"));
  EXPECT_FALSE(job->finished());
  EXPECT_TRUE(jobs.cancel("a.1"));
  EXPECT_THAT(answer_of(*job).json, HasSubstr("\"status\":\"cancelled\""));
  EXPECT_FALSE(jobs.cancel("a.1"));
}

TEST(Jobs, TheNextRunOfATabEndsTheOneBefore) {
  Jobs jobs(".", 2);
  const auto first = jobs.start({.run = "a.1", .text = test::long_study()});
  const auto of_another = jobs.start({.run = "b.1", .text = test::long_study()});
  EXPECT_EQ(jobs.start({.run = "c.1", .text = ""}), nullptr);
  EXPECT_EQ(jobs.start({.run = "a.2", .text = ""}), nullptr);  // the first has not ended yet
  EXPECT_THAT(answer_of(*first).json, HasSubstr("\"status\":\"cancelled\""));
  EXPECT_THAT(answer_of(*jobs.start({.run = "a.3", .text = ""})).json, HasSubstr("\"severity\":\"error\""));
  EXPECT_FALSE(of_another->finished());
  jobs.cancel_all();
  EXPECT_THAT(answer_of(*of_another).json, HasSubstr("\"status\":\"cancelled\""));
}

TEST(Jobs, ALimitOfTimeEndsWithTheBestSoFar) {
  Jobs jobs(".", 1);
  EXPECT_THAT(answer_of(*jobs.start({.run = "a.1", .text = test::long_study(), .seconds = 0.2})).json,
              HasSubstr("\"status\":\"deadline\""));
}

}  // namespace
}  // namespace linkwright::serve
