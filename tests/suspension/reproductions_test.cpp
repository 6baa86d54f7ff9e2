// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/reproductions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/reproduced.h"

namespace linkwright::suspension {
namespace {

std::vector<study::Comparison> rows(std::string_view id) { return test::rows_of(reproductions(), id); }

/// Verdicts of rows whose item begins so.
std::map<std::string, int> verdicts(const std::vector<study::Comparison>& rows, std::string_view beginning) {
  std::map<std::string, int> out;
  for (const study::Comparison& r : rows)
    if (r.item.starts_with(beginning)) ++out[r.verdict];
  return out;
}

using Counts = std::map<std::string, int>;

TEST(CornerReproductions, HaveIdsTitlesSourcesAndNotes) { test::expect_complete(reproductions()); }

const study::Comparison& row(const std::vector<study::Comparison>& rows, std::string_view item) {
  for (const study::Comparison& r : rows)
    if (r.item == item) return r;
  throw std::runtime_error("no row " + std::string(item));
}

TEST(CornerReproductions, FrontSuspension) {
  const auto table = rows("poznanovic-2016-example-1");
  EXPECT_EQ(verdicts(table, "position "), (Counts{{"reproduced", 75}}));
  EXPECT_EQ(row(table, "links found exactly from random boxes of 150 mm, %").ours, 100);
  EXPECT_LT(row(table, "mean error of coordinates, m").ours, 1e-6);
  EXPECT_EQ(row(table, "generations of differential evolution, all links").verdict, "reproduced");
  EXPECT_EQ(verdicts(table, "recommended method"), (Counts{{"improved", 10}}));
  EXPECT_EQ(row(table, "objective of the points found").verdict, "corrected");
  EXPECT_EQ(row(table, "objective of the quasi-Newton run").verdict, "not reproduced");
  EXPECT_EQ(verdicts(table, "largest error"), (Counts{{"reproduced", 4}}));
}

TEST(CornerReproductions, Strut) {
  const auto table = rows("poznanovic-2016-example-2");
  const Counts positions = verdicts(table, "position ");
  EXPECT_EQ(positions.at("reproduced") + positions.at("corrected"), 75);
  EXPECT_GT(positions.at("corrected"), 20);
  EXPECT_EQ(row(table, "links found exactly from random boxes of 150 mm, %").ours, 100);
  EXPECT_EQ(row(table, "generations of differential evolution, all links").verdict, "reproduced");
}

TEST(CornerReproductions, InterconnectedLinks) {
  const auto table = rows("poznanovic-2016-example-3");
  EXPECT_EQ(verdicts(table, "position "), (Counts{{"corrected", 2}, {"reproduced", 53}}));
  EXPECT_EQ(row(table, "position 9 (travel 0.06 m, rack 0 m): carrier pitch in deg").verdict, "corrected");
  EXPECT_EQ(row(table, "links found exactly from random boxes of 150 mm, %").ours, 100);
  EXPECT_LT(row(table, "mean error of coordinates, m").ours, 1e-5);
}

TEST(CornerReproductions, RearSuspension) {
  const auto table = rows("poznanovic-2016-example-4");
  EXPECT_EQ(verdicts(table, "position "), (Counts{{"reproduced", 52}}));
  EXPECT_EQ(row(table, "links found exactly from random boxes of 150 mm, %").ours, 100);
  EXPECT_EQ(row(table, "generations of differential evolution, all links").verdict, "reproduced");
  for (const char* technique : {"carrier pitch unknown, quadratic", "carrier pitch unknown, dyad"}) {
    const Counts counts = verdicts(table, technique);
    EXPECT_EQ(counts.count("not reproduced"), 0u) << technique;
  }
}

TEST(CornerReproductions, EndEarlyWhenTold) {
  RunContext context;
  context.cancel();
  const auto table = reproductions()[0].run(context);
  EXPECT_EQ(verdicts(table, "position "), (Counts{{"reproduced", 75}}));
  EXPECT_TRUE(verdicts(table, "recommended method").empty());
}

TEST(CornerReproductions, DirectSynthesis) {
  const auto table = rows("poznanovic-2016-example-5");
  // 0.9177826 is the smallest there is; the note says in how many boxes it was found.
  EXPECT_LE(row(table, "largest deviation of all in tolerances").ours, 0.91779);
  EXPECT_EQ(row(table, "largest deviation of all in tolerances").note,
            "the smallest there is, in 20 of 20 boxes");
  EXPECT_EQ(verdicts(table, "largest deviation of "), (Counts{{"improved", 3}, {"reproduced", 1}}));
  EXPECT_EQ(verdicts(table, "deviation of "), (Counts{{"reproduced", 26}, {"corrected", 1}}));
  EXPECT_EQ(row(table, "deviation of relative track at travel -50 mm").verdict, "corrected");
}

}  // namespace
}  // namespace linkwright::suspension
