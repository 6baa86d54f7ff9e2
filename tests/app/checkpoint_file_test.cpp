// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/checkpoint_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include "linkwright/app/sha256.h"
#include "support/message.h"

namespace linkwright::app {
namespace {
namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

const CheckpointOwner owner = {"linkwright 9.8.7", std::string(64, 'a')};

class CheckpointFileTest : public ::testing::Test {
 protected:
  CheckpointFileTest()
      : folder_(fs::temp_directory_path() / ("linkwright-checkpoint-" + std::to_string(::getpid()))),
        file_(folder_ / checkpoint_name) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CheckpointFileTest() override { fs::remove_all(folder_); }

  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(file_, std::ios::binary).rdbuf();
    return text.str();
  }
  void write(std::string_view text) const { std::ofstream(file_, std::ios::binary) << text; }

  /// The message of load about the file as it is; it must stay as it is.
  std::string refusal() const {
    const std::string before = text();
    CheckpointFile checkpoint(file_, owner);
    Diagnostics diagnostics;
    EXPECT_FALSE(checkpoint.load(diagnostics));
    EXPECT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(checkpoint.size(), 0u);
    EXPECT_EQ(text(), before);
    return diagnostics.empty() ? "" : to_string(diagnostics[0]).substr(file_.string().size());
  }

  fs::path folder_, file_;
};

TEST_F(CheckpointFileTest, AnotherRunFindsWhatWasKept) {
  Diagnostics diagnostics;
  {
    CheckpointFile checkpoint(file_, owner);
    ASSERT_TRUE(checkpoint.load(diagnostics));
    EXPECT_EQ(checkpoint.size(), 0u);
    Value value;
    value["x"] = pack_numbers(std::vector<double>{0.1, -0.0});
    value["text"] = "two\nlines, \"quotes\" and \xC3\xA9";
    checkpoint.keep("seed 1", value);
    checkpoint.keep("seed 2/positive", Value(1));
    checkpoint.keep("seed 2/positive", Value(2));
    checkpoint.keep("seed 20", Value(3));
    checkpoint.keep("seed 3/positive", Value(4));
    checkpoint.keep("seed 3/negative", Value(5));
    checkpoint.keep("seed 3", Value(true));  // and with it what stood below
    checkpoint.finish(diagnostics);
  }
  EXPECT_EQ(text(), checkpoint_text(owner, {{"seed 1",
                                             "{\"name\":\"seed 1\",\"value\":{\"x\":"
                                             "\"3fb999999999999a8000000000000000\",\"text\":\"two\\nlines, "
                                             "\\\"quotes\\\" and \xC3\xA9\"}}"},
                                            {"seed 2/positive", R"({"name":"seed 2/positive","value":2})"},
                                            {"seed 20", R"({"name":"seed 20","value":3})"},
                                            {"seed 3", R"({"name":"seed 3","value":true})"}}));
  CheckpointFile again(file_, owner);
  ASSERT_TRUE(again.load(diagnostics));
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(again.size(), 4u);
  EXPECT_EQ(again.find("seed 1").find("text")->as_string(), "two\nlines, \"quotes\" and \xC3\xA9");
  EXPECT_EQ(again.find("seed 2/positive").as_integer(), 2);
  EXPECT_TRUE(again.find("seed 2").is_null());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);

  CheckpointFile anew(file_, owner);
  anew.discard();
  EXPECT_FALSE(fs::exists(file_));
  anew.finish(diagnostics);
  EXPECT_FALSE(fs::exists(file_)) << "nothing was kept";
}

TEST_F(CheckpointFileTest, ThreadsKeepAndFind) {
  CheckpointFile checkpoint(file_, owner);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 100; ++i) {
        const std::string name = "seed " + std::to_string(100 * t + i);
        checkpoint.keep(name + "/part", Value(i));
        checkpoint.keep(name, Value(i));
        EXPECT_EQ(checkpoint.find(name).as_integer(), i);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(checkpoint.size(), 400u);
}

// Nobody asks for it and no second thing is kept: a run that is killed a while later has lost nothing.
TEST_F(CheckpointFileTest, IsWrittenByItself) {
  CheckpointFile checkpoint(file_, owner);
  checkpoint.keep("seed 1", Value(1));
  while (!fs::exists(file_)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(text(), checkpoint_text(owner, {{"seed 1", R"({"name":"seed 1","value":1})"}}));
}

TEST_F(CheckpointFileTest, OthersAreRefused) {
  constexpr std::string_view mend = "; run without --resume to start again and replace it";
  const CheckpointLines lines = {{"seed 1", R"({"name":"seed 1","value":2})"}};
  write(checkpoint_text({"linkwright 9.8.6", owner.study_sha256}, lines));
  EXPECT_EQ(refusal(),
            ": error: was written by linkwright 9.8.6 in format 1; this is linkwright 9.8.7, which "
            "continues only its own checkpoints, in format 1" +
                std::string(mend));
  write(checkpoint_text({owner.tool, std::string(64, 'b')}, lines));
  EXPECT_EQ(refusal(),
            ": error: belongs to another study (SHA-256 bbbbbbbbbbbb..., this one has "
            "aaaaaaaaaaaa...): the file was changed since, or --seed or --set are not the same" +
                std::string(mend));
  std::string later = checkpoint_text(owner, lines);
  later.replace(later.find("\"checkpoint\":1"), 14, "\"checkpoint\":2");
  write(later);
  EXPECT_THAT(refusal(), HasSubstr("was written by linkwright 9.8.7 in format 2; this is"));
}

TEST_F(CheckpointFileTest, DamageIsToldApart) {
  const std::string good = checkpoint_text(
      owner, {{"seed 1", R"({"name":"seed 1","value":2})"}, {"seed 2", R"({"name":"seed 2","value":3})"}});
  write(good.substr(0, good.size() - 5));
  EXPECT_THAT(refusal(),
              HasSubstr(": error: is truncated or damaged: 51 bytes after its first line, must be 56;"));
  write(good.substr(0, 20));
  EXPECT_THAT(refusal(),
              HasSubstr(": error: is not a checkpoint, or its first line is damaged; run without"));
  std::string changed = good;
  changed[changed.size() - 3] = '9';
  write(changed);
  EXPECT_THAT(refusal(),
              HasSubstr(": error: is damaged: the SHA-256 of its lines is not the one in its first line;"));
  write("");
  EXPECT_THAT(refusal(), HasSubstr(": error: cannot be read, or is empty; run without"));
  for (const std::string& text :
       {std::string("\n"), std::string("{}\n"), std::string("{\"checkpoint\":1}\n"), std::string("nonsense"),
        std::string(5000, '{'), std::string(100, '\0'), std::string("\xFF\xFE\n"),
        std::string("{\"checkpoint\":1.5,\"tool\":\"t\",\"study_sha256\":\"s\"}\n"),
        // Characters that would act on a terminal.
        std::string("{\"checkpoint\":1,\"tool\":\"\\u001b[2J\",\"study_sha256\":\"s\"}\n")}) {
    write(text);
    EXPECT_THAT(refusal(), HasSubstr("is not a checkpoint, or its first line is damaged;")) << text;
  }
  write("x");
  fs::resize_file(file_, largest_checkpoint + 1);  // a file with a hole: takes no room
  CheckpointFile huge(file_, owner);
  Diagnostics diagnostics;
  EXPECT_FALSE(huge.load(diagnostics));
  EXPECT_THAT(to_string(diagnostics.at(0)),
              HasSubstr("has 536870913 bytes; at most 536870912 (512 MiB) are read;"));

  fs::remove(file_);
  fs::create_directory(file_);
  EXPECT_THAT(to_string((huge.load(diagnostics), diagnostics.back())),
              HasSubstr("cannot be read, or is empty"));
}

// Somebody who changes lines can also change the checksum.
TEST_F(CheckpointFileTest, LinesThatAreNone) {
  const auto message = [&](const std::string& body) {
    const std::string text = "{\"checkpoint\":1,\"tool\":\"linkwright 9.8.7\",\"study_sha256\":\"" +
                             owner.study_sha256 + "\",\"bytes\":" + std::to_string(body.size()) +
                             ",\"sha256\":\"" + sha256(body) + "\"}\n" + body;
    Diagnostics diagnostics;
    const auto lines = read_checkpoint(text, owner, "c", diagnostics);
    EXPECT_NE(lines.has_value(), has_errors(diagnostics));
    return lines ? "good" : to_string(diagnostics.at(0));
  };
  const std::string line = R"({"name":"seed 1","value":2})";
  EXPECT_EQ(message(""), "good");
  EXPECT_EQ(message(line + "\n"), "good");
  EXPECT_EQ(message(line), "good");
  EXPECT_EQ(message(line + "\n" + line + "\n"),
            "c: error: is damaged: line 3 names no value of its own; run without --resume to start again and "
            "replace it");
  for (const std::string& wrong :
       {std::string("\n"), std::string(R"({"name":"seed 1"})"), std::string(R"({"name":7,"value":2})"),
        std::string(R"(["name","value"])"), std::string("name = 'seed 1'\nvalue = 2"),
        R"({"name":"seed 1","value":)" + std::string(100, '[') + std::string(100, ']') + "}",
        std::string(R"({"name":"seed 1","value":1e999})"), std::string(R"({"name":"\u0007","value":2})"),
        std::string(R"({"name":"s","name":"t","value":2})")})
    EXPECT_THAT(message(wrong), HasSubstr("is damaged: line 2 names no value of its own")) << wrong;
}

TEST_F(CheckpointFileTest, AFailedWriteIsAWarning) {
  CheckpointFile checkpoint(folder_ / "none" / "c", owner);
  checkpoint.keep("seed 1", Value(1));
  Diagnostics diagnostics;
  checkpoint.finish(diagnostics);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_FALSE(has_errors(diagnostics));
  EXPECT_THAT(
      to_string(diagnostics[0]),
      EndsWith("none/c: warning: cannot be written: No such file or directory; an interrupted run could "
               "not be resumed"));
}

TEST_F(CheckpointFileTest, WhatCannotBeReadBackIsNotKept) {
  CheckpointFile checkpoint(file_, owner);
  checkpoint.keep("a", Value(1));
  checkpoint.keep("a", Value(std::string(std::size_t{16} << 20, 'x')));
  EXPECT_EQ(checkpoint.find("a").as_integer(), 1);
  EXPECT_THAT(linkwright::test::message([&] { checkpoint.keep(std::string(101, 'x'), Value(1)); }),
              HasSubstr("name of 101 characters"));
}

}  // namespace
}  // namespace linkwright::app
