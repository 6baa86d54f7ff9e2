// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/design_variables.h"

#include <gmock/gmock.h>

#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view keys[] = {"mechanism", "drive"};

struct Taken {
  DesignedTables designed;
  std::string messages;
};

Taken take(const std::string& text) {
  Taken out;
  Diagnostics diagnostics;
  const Value document = read_text(text, Syntax::toml, "study.toml", diagnostics);
  DocumentReader reader(document, "study.toml", diagnostics);
  ObjectReader root = reader.root();
  out.designed = take_designed(root, keys);
  reader.finish();
  out.messages = test::lines_of(diagnostics);
  return out;
}

const std::string study = R"([mechanism]
type = "arm"
length_mm = { min = 100, max = 300.0, initial = 200 }

[[mechanism.link]]
name = "upper"
points_mm = { A = [0, { min = -1.5, max = 2.5, initial = 9 }] }

[[drive]]
higher = [{ min = 0, max = 1, initial = 0.5 }, 7]
)";

TEST(Designed, NumbersAreFoundWhereverANumberMayStand) {
  const Taken taken = take(study);
  EXPECT_EQ(taken.messages, "");
  const auto& n = taken.designed.numbers;
  ASSERT_EQ(n.size(), 3u);
  EXPECT_EQ(n[0].key, "length_mm");
  EXPECT_EQ(n[0].lower, 100);
  EXPECT_EQ(n[0].upper, 300);
  EXPECT_EQ(n[0].initial, 200);
  ASSERT_TRUE(n[0].unit.unit);
  EXPECT_EQ(n[0].unit.unit->suffix, "mm");
  EXPECT_EQ(n[1].key, "link.upper.points_mm.A.2");
  EXPECT_EQ(n[1].initial, 9);  // outside its bounds, as published designs may be
  EXPECT_EQ(n[1].unit.unit->suffix, "mm");
  EXPECT_EQ(n[2].key, "drive.1.higher.1");
  EXPECT_FALSE(n[2].unit.unit);
}

TEST(Designed, TheTablesHoldTheInitialNumbersAndTakeOthers) {
  Taken taken = take(study);
  Value& tables = taken.designed.tables;
  EXPECT_EQ(tables.find("mechanism")->find("length_mm")->as_number(), 200);
  put(tables, taken.designed.numbers, std::vector<double>{150, -1, 0.25});
  EXPECT_EQ(tables.find("mechanism")->find("length_mm")->as_number(), 150);
  const Value& link = tables.find("mechanism")->find("link")->as_array()[0];
  EXPECT_EQ(link.find("points_mm")->find("A")->as_array()[1].as_number(), -1);
  EXPECT_EQ(tables.find("drive")->as_array()[0].find("higher")->as_array()[0].as_number(), 0.25);
  EXPECT_EQ(tables.find("drive")->as_array()[0].find("higher")->as_array()[1].as_number(), 7);
}

TEST(Designed, OnlyTheTablesAskedForAreTaken) {
  EXPECT_THAT(take("[mechanism]\nx = 1\n[other]\ny = { min = 0, max = 1, initial = 0 }\n").messages,
              HasSubstr("study.toml:3:2: error: other: unknown key"));
}

TEST(Designed, ProblemsTellWhereAndHow) {
  EXPECT_THAT(take("[mechanism]\nx_m = { min = 0, max = 1 }\n").messages,
              HasSubstr("study.toml:2:7: error: mechanism.x_m: the design variable lacks `initial`"));
  EXPECT_THAT(take("[mechanism]\nx_m = { min = 2, max = 1, initial = 1 }\n").messages,
              HasSubstr("mechanism.x_m: min is 2, more than max, which is 1"));
  EXPECT_THAT(take("[mechanism]\nx_m = { min = 0, max = \"1\", initial = 1 }\n").messages,
              HasSubstr("mechanism.x_m: max must be a number"));
}

}  // namespace
}  // namespace linkwright::study
