// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/program.h"

#include <gtest/gtest.h>

#include <set>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

// Machines in pair order with a traced link that needs every pair and does not move with a smaller chain
// behind one ground-hinged link: 1, 7 and 75 by the count of another program.
TEST(PointPrograms, AreEachTypeOnce) {
  EXPECT_EQ(programs_of(MachineFamily::four_bar).size(), 1U);
  EXPECT_EQ(programs_of(MachineFamily::watt_1).size() + programs_of(MachineFamily::stephenson_1).size() +
                programs_of(MachineFamily::stephenson_3).size(),
            7U);
  EXPECT_EQ(programs_of(MachineFamily::eight_bar).size(), 75U);
  EXPECT_EQ(programs_of(MachineFamily::geared_five_bar).size(), 6U);
  std::set<std::string> names;
  for (const PointProgram* p : test::all_programs()) EXPECT_TRUE(names.insert(p->name).second) << p->name;
}

TEST(PointPrograms, HaveTheUnknownsOfTheirType) {
  const auto parameters = [](const char* name) { return program_named(name)->parameters; };
  EXPECT_EQ(parameters("four_bar"), 9);
  EXPECT_EQ(parameters("slider_crank"), 8);
  EXPECT_EQ(parameters("inverted_slider"), 8);
  EXPECT_EQ(parameters("geared_five_bar:-2"), 12);
  EXPECT_EQ(parameters("stephenson_3:a"), 15);
  EXPECT_EQ(parameters("stephenson_2:a"), 16);
  EXPECT_EQ(parameters("eight_bar:1315b"), 21);
  EXPECT_EQ(parameters("ten_bar:131547b"), 27);
}

TEST(PointPrograms, AreFoundByName) {
  for (const PointProgram* p : test::all_programs()) EXPECT_EQ(program_named(p->name), p);
  EXPECT_EQ(program_named("eight_bar:1352b"),
            program_named("eight_bar:1352b"));  // an isomorph of another one
  for (const char* wrong : {"", "five_bar", "eight_bar:", "eight_bar:1", "eight_bar:13", "eight_bar:1315c",
                            "eight_bar:1919b", "eight_bar:1115b", "ten_bar:1315b"})
    EXPECT_EQ(program_named(wrong), nullptr) << wrong;
}

// A mirrored machine whose crank turns in the other sense traces the mirror image.
TEST(PointPrograms, MirrorTheirCurves) {
  for (const PointProgram* p : test::all_programs()) {
    const MachineShape shape = test::some_shape(*p, 3), mirror = mirrored(shape);
    std::vector<double> angles, opposite;
    for (int k = 0; k < 16; ++k) angles.push_back(0.4 * k), opposite.push_back(-0.4 * k);
    const auto one = test::traced(shape, angles), other = test::traced(mirror, opposite);
    for (std::size_t k = 0; k < one.size(); ++k)
      EXPECT_LT(std::abs(one[k] - std::conj(other[k])), 1e-9 * (1 + std::abs(one[k]))) << p->name;
  }
}

}  // namespace
}  // namespace linkwright::planar
