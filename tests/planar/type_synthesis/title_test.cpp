// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/title.h"

#include <gtest/gtest.h>

#include <set>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(MachineTitles, SayTheTypeAndTheTracedBar) {
  EXPECT_EQ(title_of(*program_named("four_bar")), "Four-bar linkage, traced point on the coupler");
  EXPECT_EQ(title_of(*program_named("watt_1:b'")),
            "Watt I six-bar linkage with a ternary crank, traced point on the second bar of the second pair");
  EXPECT_EQ(title_of(*program_named("stephenson_1:a")),
            "Stephenson I six-bar linkage, traced point on the first bar of the second pair");
  EXPECT_EQ(title_of(*program_named("geared_five_bar:-2")),
            "Five-bar linkage with cranks geared 1 to -2, traced point on the bar at the first crank");
  EXPECT_EQ(title_of(*program_named("eight_bar:1315b")),
            "Eight-bar linkage 13-15, traced point on the second bar of the last pair");
  EXPECT_EQ(title_of(*program_named("watt_2:angle")),
            "Watt II six-bar linkage, output by its last link on the ground");
  EXPECT_EQ(title_of(*program_named("eight_bar:134:slide")),
            "Eight-bar linkage 13, output by a slider on the first bar of the last pair");
}

TEST(MachineTitles, HaveShortForms) {
  EXPECT_EQ(short_name_of(*program_named("eight_bar:1315b")), "eight-bar 13-15 b");
  EXPECT_EQ(short_name_of(*program_named("watt_1:a")), "Watt I 23 a");
  EXPECT_EQ(short_name_of(*program_named("geared_five_bar:3")), "geared five-bar 1:3");
}

TEST(MachineTitles, DifferFromTypeToType) {
  std::set<std::string> titles, names;
  for (const PointProgram* p : test::all_programs()) {
    EXPECT_TRUE(titles.insert(title_of(*p)).second) << p->name;
    EXPECT_TRUE(names.insert(short_name_of(*p)).second) << p->name;
  }
  names.clear();
  for (const PointProgram* p : test::function_programs()) {
    EXPECT_TRUE(titles.insert(title_of(*p)).second) << p->name;
    EXPECT_TRUE(names
                    .insert(std::string(name_of(p->family)) + short_name_of(*p) +
                            (p->output == MachineOutput::slide ? "s" : ""))
                    .second)
        << p->name << ": " << short_name_of(*p);
  }
}

}  // namespace
}  // namespace linkwright::planar
