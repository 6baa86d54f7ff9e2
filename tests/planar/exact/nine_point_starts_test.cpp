// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/nine_point_starts.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const StartSet<NinePoints>> shared_starts() {
  RunContext context;
  return nine_point_starts(test::starts_folder(), context);
}

// A folder of its own, gone afterwards.
class NinePointStarts : public testing::Test {
 protected:
  NinePointStarts()
      : folder_(fs::path(testing::TempDir()) /
                ("nine-point-starts-" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
  }
  ~NinePointStarts() override { fs::remove_all(folder_); }
  fs::path file() const { return *fs::directory_iterator(folder_); }

  fs::path folder_;
};

TEST_F(NinePointStarts, MonodromyFindsAllClassesWhateverTheSeed) {
  for (const std::uint64_t seed : {1, 2}) {
    RunContext context;
    const auto starts = find_starts<NinePoints>(seed, nine_point_classes, context);
    EXPECT_EQ(starts.status, Status::done) << seed;
    EXPECT_EQ(starts.points.size(), nine_point_classes) << seed;
    EXPECT_LE(starts.lost, starts.followed / 3000) << seed;
    EXPECT_TRUE(trace_test(starts, context).passed) << seed;
  }
}

TEST_F(NinePointStarts, TheTraceTestPassesAndFailsWithoutOneClass) {
  RunContext context;
  const TraceTest test = trace_test(*shared_starts(), context);
  EXPECT_TRUE(test.passed);
  EXPECT_LE(test.second, 1e-9 * test.first);
  EXPECT_GT(test.least, 1e3 * test.second);  // one class less would show, whichever it is
  const TraceTest without = trace_test(*shared_starts(), context, 700);
  EXPECT_FALSE(without.passed);
  EXPECT_GT(without.second, 1e-8 * without.first);
}

TEST_F(NinePointStarts, AFileGivesBackTheSameNumbers) {
  write_nine_point_starts(folder_, *shared_starts());
  const auto read = read_nine_point_starts(folder_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->status, Status::done);
  const auto expect_same = [](const ComplexNumber& a, const ComplexNumber& b) {
    EXPECT_EQ(a.re, b.re);
    EXPECT_EQ(a.im, b.im);
  };
  for (std::size_t k = 0; k < NinePoints::data; ++k) expect_same(read->base[k], shared_starts()->base[k]);
  for (std::size_t i = 0; i < nine_point_classes; ++i)
    for (std::size_t k = 0; k < NinePoints::unknowns; ++k)
      expect_same(read->points[i][k], shared_starts()->points[i][k]);
}

TEST_F(NinePointStarts, ADamagedFileIsNoStartSet) {
  EXPECT_FALSE(read_nine_point_starts(folder_));
  write_nine_point_starts(folder_, *shared_starts());
  std::ifstream in(file(), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto readable = [&](const std::string& text) {
    std::ofstream(file(), std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
    return read_nine_point_starts(folder_).has_value();
  };
  EXPECT_TRUE(readable(whole));
  EXPECT_FALSE(readable(""));
  EXPECT_FALSE(readable(whole.substr(0, whole.size() - 1)));
  EXPECT_FALSE(readable(whole + " "));
  const std::size_t point = 16 * NinePoints::unknowns;
  std::string twice = whole;  // the last class repeats the one before
  twice.replace(whole.size() - point, point, whole, whole.size() - 2 * point, point);
  EXPECT_FALSE(readable(twice));
  for (const std::size_t place : {std::size_t{3}, std::size_t{60}, std::size_t{100'006}, whole.size() - 2}) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x15);
    EXPECT_FALSE(readable(damaged)) << place;
  }
  // A file that cannot be read is written again.
  write_nine_point_starts(folder_, *shared_starts());
  EXPECT_TRUE(read_nine_point_starts(folder_));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(NinePointStarts, AFolderThatCannotBeMadeIsNoError) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "no folder";
  write_nine_point_starts(folder_ / "file" / "below", *shared_starts());
  EXPECT_FALSE(read_nine_point_starts(folder_ / "file" / "below"));
}

}  // namespace
}  // namespace linkwright::planar
