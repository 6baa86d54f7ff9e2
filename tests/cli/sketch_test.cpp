// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/sketch.h"

#include <gmock/gmock.h>

#include <string>

#include "tests/cli/program_fixture.h"

namespace linkwright::cli {
namespace {
using ::testing::HasSubstr;

/// The program as users have it.
class SketchProgram : public test::ProgramFixture {
 protected:
  SketchProgram() : ProgramFixture(LINKWRIGHT_PROGRAM) {}
};

/// An entity of DXF: a line with its ends in mm.
std::string dxf_line(const std::string& layer, const std::string& from, const std::string& to) {
  const auto place = [](const std::string& at, int code) {
    const std::size_t comma = at.find(',');
    return " " + std::to_string(code) + "\n" + at.substr(0, comma) + "\n " + std::to_string(code + 10) +
           "\n" + at.substr(comma + 1) + "\n";
  };
  return "  0\nLINE\n  8\n" + layer + "\n" + place(from, 10) + place(to, 11);
}
std::string dxf(const std::string& entities) {
  return "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" +
         entities + "  0\nENDSEC\n  0\nEOF\n";
}
const std::string four_bar = dxf(dxf_line("0", "0,0", "40,90") + dxf_line("0", "40,90", "180,140") +
                                 dxf_line("0", "180,140", "220,0") + dxf_line("ground", "0,0", "220,0"));

TEST_F(SketchProgram, WritesAStudyThatRuns) {
  write("four-bar.dxf", four_bar);
  ASSERT_EQ(run({"sketch", "four-bar.dxf"}), 0) << err_;
  EXPECT_EQ(out_,
            "3 bars, 0 plates, 0 blocks, the ground; 4 pins, 0 slides, 0 welds\n"
            "mobility 1\n"
            "Question: no circle lies on a layer called drive: which pin is driven?\n"
            "  Assumed: A, the joint of the shortest bar at the ground.\n"
            "The options --ground, --drive and --ends answer otherwise.\n"
            "four-bar.toml written; run it with: linkwright run four-bar.toml\n");
  EXPECT_EQ(err_, "");
  EXPECT_EQ(run({"run", "four-bar.toml", "--quiet"}), 0) << err_;
  // What is here is left as it is, unless it is the same.
  EXPECT_EQ(run({"sketch", "four-bar.dxf"}), 0);
  EXPECT_THAT(out_, HasSubstr("is here already"));
  write("four-bar.toml", "mine");
  EXPECT_EQ(run({"sketch", "four-bar.dxf"}), 2);
  EXPECT_THAT(err_, HasSubstr("four-bar.toml"));
  EXPECT_EQ(text_of(folder_ / "four-bar.toml"), "mine");
}

TEST_F(SketchProgram, ReadsGroupsOfSvgInTheUnitOfThePage) {
  write("slider.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' width='300mm' height='100mm' viewBox='0 0 3000 1000'>"
        "<line x1='100' y1='500' x2='400' y2='100'/><line x1='400' y1='100' x2='2100' y2='500'/>"
        "<g id='ground'><circle cx='100' cy='500' r='20'/></g>"
        "<g id='slide'><line x1='1500' y1='500' x2='2600' y2='500'/></g></svg>");
  ASSERT_EQ(run({"sketch", "slider.svg", "-o", "-"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("name      = \"AB\"\npoints_mm = { A = [10, -50], B = [40, -10] }"));
  EXPECT_THAT(out_, HasSubstr("type   = \"prismatic\""));
}

TEST_F(SketchProgram, SaysWhatIsWrong) {
  write("four-bar.dxf", four_bar);
  write("ground.dxf", dxf(dxf_line("ground", "0,0", "40,90")));
  EXPECT_EQ(run({"sketch", "four-bar.dxf", "--tolerance", "wide"}), 2);
  EXPECT_THAT(err_, HasSubstr("--tolerance 'wide' is not a positive length"));
  EXPECT_EQ(run({"sketch", "four-bar.dxf", "--tolerance", "-1mm"}), 2);
  EXPECT_EQ(run({"sketch", "ground.dxf"}), 2);
  EXPECT_THAT(err_, HasSubstr("no line of the drawing is a link"));
  EXPECT_EQ(run({"sketch", "missing.dxf"}), 2);
  EXPECT_THAT(err_, HasSubstr("missing.dxf"));
  write("words.dxf", "a drawing");
  EXPECT_EQ(run({"sketch", "words.dxf"}), 2);
  EXPECT_THAT(err_, HasSubstr("this is neither an SVG file nor an ASCII DXF drawing"));
}

TEST_F(SketchProgram, TakesAnswers) {
  write("bars.dxf", dxf(dxf_line("0", "0,0", "40,90") + dxf_line("0", "40,90", "180,140") +
                        dxf_line("0", "180,140", "220,0") + dxf_line("0", "90,0", "110,115")));
  ASSERT_EQ(run({"sketch", "bars.dxf", "--ground", "A,F", "--drive", "F", "--ends", "weld", "-o", "a.toml"}),
            0)
      << err_;
  EXPECT_THAT(out_, HasSubstr("mobility 1"));
  EXPECT_EQ(out_.find("Question"), std::string::npos) << out_;
  EXPECT_THAT(text_of(folder_ / "a.toml"), HasSubstr("joint     = \"F\""));
  EXPECT_EQ(run({"sketch", "bars.dxf", "--drive", "Z"}), 2);
  EXPECT_THAT(
      err_, HasSubstr("the drawing has no point 'Z'; its points, from left to right, are A, B, C, D, E, F"));
  EXPECT_EQ(run({"sketch", "bars.dxf", "--ends", "glue"}), 2);
  EXPECT_THAT(err_, HasSubstr("--ends 'glue' is none of: weld, pin, nothing"));
  write("four-bar.dxf", four_bar);
  EXPECT_EQ(run({"sketch", "four-bar.dxf", "--ground", "A"}), 2);
  EXPECT_THAT(err_, HasSubstr("--ground names fixed points, and the drawing has a ground"));
}

}  // namespace
}  // namespace linkwright::cli
