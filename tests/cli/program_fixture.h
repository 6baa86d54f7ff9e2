// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/study.h"

namespace linkwright::test {}
namespace linkwright::cli::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// Runs a built program as users do, in a folder of its own: exit codes and both streams.
class ProgramFixture : public ::testing::Test {
 protected:
  explicit ProgramFixture(std::string program)
      : folder_(std::filesystem::temp_directory_path() / ("linkwright-cli-" + std::to_string(::getpid()))),
        program_(std::move(program)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ProgramFixture() override { std::filesystem::remove_all(folder_); }

  static std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  void write(const std::string& name, std::string_view text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  pid_t start(std::vector<std::string> words) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    words.insert(words.begin(), "linkwright");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (::chdir(folder_.c_str()) != 0 || !std::freopen(input_.c_str(), "r", stdin) ||
        !std::freopen("stdout", "w", stdout) || !std::freopen("stderr", "w", stderr))
      ::_exit(99);
    ::execv(program_.c_str(), arguments.data());
    ::_exit(98);
  }
  int finish(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    out_ = text_of(folder_ / "stdout");
    err_ = text_of(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int run(std::vector<std::string> words) { return finish(start(std::move(words))); }

  Value result(const std::string& name) {
    Diagnostics diagnostics;
    Value value = study::read_file(folder_ / name, diagnostics);
    EXPECT_TRUE(diagnostics.empty());
    return value;
  }

  const std::filesystem::path folder_;
  const std::string program_;
  std::string input_ = "/dev/null";  ///< the file on standard input
  std::string out_, err_;
};

}  // namespace linkwright::cli::test
