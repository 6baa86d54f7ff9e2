// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/processes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace linkwright::platform {
namespace {

TEST(Processes, ExistUntilTheyHaveEnded) {
  EXPECT_EQ(process_id(), ::getpid());
  EXPECT_TRUE(process_exists(process_id()));
  const pid_t other = ::fork();
  if (other == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(other, nullptr, 0), other);
  EXPECT_FALSE(process_exists(other));
}

TEST(Processes, ProgramsAreStartedWithoutWaiting) {
  EXPECT_EQ(program_file().filename(), "core_test");
  EXPECT_EQ(start_program("no-program-of-this-name", "x"), std::errc::no_such_file_or_directory);
  EXPECT_FALSE(start_program("true", "x"));
  int status = 1;
  ASSERT_GT(::wait(&status), 0);
  EXPECT_EQ(status, 0);
}

TEST(Processes, VariablesThatAreSetKeepTheirValue) {
  set_where_unset("LINKWRIGHT_OF_A_TEST", "first");
  set_where_unset("LINKWRIGHT_OF_A_TEST", "second");
  EXPECT_EQ(std::getenv("LINKWRIGHT_OF_A_TEST"), std::string("first"));
}

TEST(Processes, LibrariesAreLoadedByFile) {
  std::string problem;
  void* library = load_library("libm.so.6", problem);
  ASSERT_TRUE(library) << problem;
  auto* cosine = reinterpret_cast<double (*)(double)>(function_of(library, "cos"));
  ASSERT_TRUE(cosine);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_FALSE(function_of(library, "no_function_of_this_name"));
  EXPECT_FALSE(load_library("/no/library.so", problem));
  EXPECT_NE(problem.find("/no/library.so"), std::string::npos) << problem;
}

TEST(Processes, TheFirstSignalAsksAndTheSecondEnds) {
  const auto count = [](void* times) { ++*static_cast<int*>(times); };
  int times = 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    const StopRequest request(count, &times);
    std::raise(signal);
  }
  EXPECT_EQ(times, 2);
  const auto twice = [&] {
    const StopRequest request(count, &times);
    std::raise(SIGTERM);
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(twice(), ::testing::KilledBySignal(SIGTERM), "");
}

TEST(Processes, PipesAreNoTerminals) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const int out = ::dup(STDOUT_FILENO), err = ::dup(STDERR_FILENO);
  ::dup2(ends[1], STDOUT_FILENO);
  ::dup2(ends[1], STDERR_FILENO);
  const bool terminals = is_terminal(Stream::out) || is_terminal(Stream::err);
  const std::size_t columns = terminal_columns();
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  for (const int descriptor : {ends[0], ends[1], out, err}) ::close(descriptor);
  EXPECT_FALSE(terminals);
  EXPECT_EQ(columns, 0u);
}

}  // namespace
}  // namespace linkwright::platform
