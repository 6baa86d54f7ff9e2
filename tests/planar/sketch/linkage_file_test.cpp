// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/sketch/sketch.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

Sketch sketch_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_TRUE(is_linkage_file(text));
  std::optional<Sketch> sketch = read_linkage_file(text, "test.linkage2", diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics.front());
  EXPECT_TRUE(sketch.has_value());
  return sketch.value_or(Sketch{});
}

std::string fault_of_file(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_linkage_file(text, "test.linkage2", diagnostics).has_value());
  return diagnostics.empty() ? "" : to_string(diagnostics.front());
}

study::Result run_completed(Sketch sketch) {
  complete(sketch);
  return test::run_text(sketch_study(sketch, "test"));
}

std::string linkage_file(const std::string& elements) {
  return "<linkage2>\n<program zoom=\"1\" scalefactor=\"1\" units=\"Millimeters\"/>\n" + elements +
         "</linkage2>\n";
}

const std::string four_bar_file = linkage_file(
    "<connector anchor=\"true\" input=\"true\" rpm=\"30\" x=\"0\" y=\"0\" id=\"0\"/>\n"
    "<connector x=\"0\" y=\"35\" id=\"1\"/>\n<connector x=\"100\" y=\"0\" id=\"2\"/>\n"
    "<connector anchor=\"true\" x=\"100\" y=\"-200\" id=\"3\"/>\n"
    "<connector draw=\"true\" x=\"50\" y=\"60\" id=\"9\"/>\n"
    "<Link id=\"0\"><connector id=\"0\"/><connector id=\"1\"/></Link>\n"
    "<Link id=\"1\"><connector id=\"1\"/><connector id=\"2\"/><connector id=\"9\"/></Link>\n"
    "<Link id=\"2\"><connector id=\"2\"/><connector id=\"3\"/></Link>\n"
    "<Link id=\"7\"><connector id=\"0\"/><connector id=\"3\"/></Link>\n");

TEST(LinkageFiles, FourBar) {
  const Sketch sketch = sketch_of(four_bar_file);
  EXPECT_EQ(sketch.bodies.size(), 4U);  // the link between both anchors is the ground
  EXPECT_EQ(count(sketch, JointType::revolute), 4U);
  EXPECT_EQ(mobility(sketch), 1);
  ASSERT_EQ(sketch.drives.size(), 1U);
  EXPECT_DOUBLE_EQ(sketch.drives[0].speed, pi);
  ASSERT_EQ(sketch.traced.size(), 1U);
  EXPECT_TRUE(sketch.questions.empty());
  const study::Result result = run_completed(sketch);
  ASSERT_EQ(result.status, Status::done);
  // The crank of 35 mm turns by 30 revolutions a minute.
  EXPECT_NEAR(test::column(result, "sweep", "AB_speed_rad_per_s").at(3), pi, 1e-12);
}

TEST(LinkageFiles, SlidersHaveBlocks) {
  const Sketch sketch = sketch_of(linkage_file(
      "<connector anchor=\"true\" input=\"true\" rpm=\"15\" x=\"0\" y=\"0\" id=\"0\"/>\n"
      "<connector x=\"0\" y=\"50\" id=\"1\"/>\n"
      "<connector x=\"150\" y=\"0\" id=\"2\" slider=\"true\"><slidelimit id=\"3\"/><slidelimit "
      "id=\"4\"/></connector>\n"
      "<connector anchor=\"true\" x=\"80\" y=\"0\" id=\"3\"/><connector anchor=\"true\" x=\"260\" y=\"0\" "
      "id=\"4\"/>\n"
      "<Link id=\"0\"><connector id=\"0\"/><connector id=\"1\"/></Link>\n"
      "<Link id=\"1\"><connector id=\"1\"/><connector id=\"2\"/></Link>\n"));
  EXPECT_EQ(count(sketch, JointType::prismatic), 1U);
  EXPECT_EQ(mobility(sketch), 1);
  EXPECT_EQ(run_completed(sketch).status, Status::done);
}

TEST(LinkageFiles, ActuatorsAreBarrelsWithRods) {
  const Sketch sketch = sketch_of(linkage_file(
      "<connector anchor=\"true\" x=\"0\" y=\"0\" id=\"0\"/><connector anchor=\"true\" x=\"100\" y=\"0\" "
      "id=\"1\"/>\n<connector x=\"60\" y=\"80\" id=\"2\"/>\n"
      "<Link id=\"0\"><connector id=\"0\"/><connector id=\"2\"/></Link>\n"
      "<Link id=\"3\" actuator=\"true\" throw=\"20\" cpm=\"15\"><connector id=\"1\"/><connector "
      "id=\"2\"/></Link>\n"));
  EXPECT_EQ(mobility(sketch), 1);
  ASSERT_EQ(sketch.drives.size(), 1U);
  EXPECT_DOUBLE_EQ(sketch.drives[0].speed, 0.01);  // 2 strokes of 20 mm, 15 times a minute
  EXPECT_EQ(sketch.joints[sketch.drives[0].joint].type, JointType::prismatic);
  EXPECT_EQ(run_completed(sketch).status, Status::done);
}

TEST(LinkageFiles, RatiosAreGears) {
  const std::string wheels =
      "<connector anchor=\"true\" input=\"true\" rpm=\"10\" x=\"0\" y=\"0\" id=\"0\"/><connector "
      "anchor=\"true\" x=\"90\" y=\"0\" id=\"1\"/>\n"
      "<Link id=\"10\" layer=\"16\" gear=\"true\"><connector id=\"0\"/></Link>\n"
      "<Link id=\"11\" layer=\"16\" gear=\"true\"><connector id=\"1\"/></Link>\n"
      "<Link id=\"12\" layer=\"1\"><connector id=\"1\"/></Link>\n";  // a drawing
  for (const auto& [type, ratio] : {std::pair("gears", -2.0), std::pair("chain", 2.0)}) {
    const Sketch sketch = sketch_of(
        linkage_file(wheels + "<ratios><ratio type=\"" + type +
                     "\"><link id=\"10\" size=\"2\"/><link id=\"11\" size=\"1\"/></ratio></ratios>\n"));
    ASSERT_EQ(sketch.gears.size(), 1U);
    EXPECT_DOUBLE_EQ(sketch.gears[0].ratio, ratio);
    EXPECT_EQ(mobility(sketch), 1);
    const study::Result result = run_completed(sketch);
    ASSERT_EQ(result.status, Status::done);
    EXPECT_NEAR(test::column(result, "sweep", "wheel_B_speed_rad_per_s").at(1) /
                    test::column(result, "sweep", "wheel_A_speed_rad_per_s").at(1),
                ratio, 1e-12);
  }
  EXPECT_THAT(
      sketch_of(linkage_file(wheels +
                             "<ratios><ratio type=\"gears\"><link id=\"10\" size=\"2\"/></ratio></ratios>"))
          .left_out.at(0),
      HasSubstr("names no two wheels"));
}

TEST(LinkageFiles, FastenedLinksAreOneBody) {
  std::string text = four_bar_file;
  const std::string link = "<Link id=\"2\">";
  text.insert(text.find(link), "<Link id=\"5\" fastenlink=\"2\"><connector id=\"2\"/></Link>\n");
  EXPECT_EQ(sketch_of(text).bodies.size(), 4U);
}

TEST(LinkageFiles, SayWhatIsWrong) {
  EXPECT_THAT(fault_of_file(linkage_file("<connector x=\"abc\" id=\"0\"/>")),
              HasSubstr("x = 'abc' of <connector> is not a number"));
  EXPECT_THAT(fault_of_file(linkage_file("<connector x=\"1\"/>")), HasSubstr("<connector> has no id"));
  EXPECT_THAT(fault_of_file(linkage_file("<connector id=\"1\"/><connector id=\"1\"/>")),
              HasSubstr("two connectors have the id 1"));
  EXPECT_THAT(fault_of_file(linkage_file("<Link id=\"1\"><connector id=\"4\"/></Link>")),
              HasSubstr("no connector has the id 4"));
  EXPECT_THAT(fault_of_file(linkage_file("")), HasSubstr("no link that moves"));
  EXPECT_THAT(fault_of_file("<linkage2><connector id=\"1\""), HasSubstr("test.linkage2"));
  EXPECT_FALSE(is_linkage_file("<svg/>"));
  std::string inches = four_bar_file;
  inches.replace(inches.find("Millimeters"), 11, "Inches");
  EXPECT_THAT(sketch_of(inches).questions.at(0).text, HasSubstr("the file shows its lengths in Inches"));
}

}  // namespace
}  // namespace linkwright::planar
