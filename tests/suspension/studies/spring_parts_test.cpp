// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/spring_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::problems_of;
using test::pushrod_study;
using test::replaced;
using ::testing::HasSubstr;

/// The only problem of the study in which a text is replaced, without its place.
std::string problem(const std::string& from, const std::string& to) {
  const std::string all = problems_of(replaced(pushrod_study, from, to));
  const std::size_t at = all.find("error: ");
  return at == std::string::npos ? all : all.substr(at + 7, all.find('\n', at) - at - 7);
}

TEST(SpringParts, CanonicalStudiesAreReadAlike) {
  std::string messages;
  const auto study = test::prepare(pushrod_study, messages);
  ASSERT_TRUE(study) << messages;
  const Value& mechanism = *study->canonical.find("mechanism");
  const Value& rocker = mechanism.find("rocker")->as_array().at(0);
  EXPECT_EQ(rocker.find("driven_by")->as_string(), "upper wishbone");
  EXPECT_EQ(rocker.find("points"), nullptr);
  EXPECT_EQ(mechanism.find("spring")->find("attached_to")->as_string(), "rocker");
  EXPECT_EQ(mechanism.find("spring")->find("body_attached_to"), nullptr);
  EXPECT_EQ(mechanism.find("anti_roll_bar")->find("attached_to")->as_string(), "rocker");
  EXPECT_EQ(mechanism.find("rocker")->as_array().size(), 1U);
}

TEST(SpringParts, WrongNames) {
  EXPECT_EQ(problem("driven_by = \"upper wishbone\"", "driven_by = \"uper wishbone\""),
            "mechanism.rocker[0].driven_by: there is no link or rocker 'uper wishbone'; did you mean 'upper "
            "wishbone'?");
  EXPECT_EQ(problem("driven_by = \"upper wishbone\"", "driven_by = \"rocker\""),
            "mechanism.rocker[0].driven_by: rocker 'rocker' does not stand before this one; put the rockers "
            "into the "
            "order in which they drive each other");
  EXPECT_EQ(problem("name      = \"rocker\"", "name = \"tie rod\""),
            "mechanism.rocker[0].name: 'tie rod' is also the name of another part");
}

TEST(SpringParts, RockersThatCannotWork) {
  EXPECT_EQ(
      problem("axis_mm   = [[40, 200, 430], [-40, 200, 430]]", "axis_mm = [[40, 200, 430], [40, 200, 430]]"),
      "mechanism.rocker[0].name: the two points of its axis are the same; set them apart along the axis");
  EXPECT_EQ(problem("axis_mm   = [[40, 200, 430], [-40, 200, 430]]", "axis_mm = [40, 200, 430]"),
            "mechanism.rocker[0].axis_mm: has 1 points, needs 2; write axis_mm = [[x, y, z], [x, y, z]]");
  EXPECT_EQ(problem("driven_by = \"upper wishbone\"", "driven_by = \"upper wishbone\"\nrod_length_mm = 200"),
            "mechanism.rocker[0].name: its rod of 200 mm does not reach: its ends are between 268.345 and "
            "402.503 mm "
            "apart as the rocker turns; as drawn it is 300.015 mm long");
  EXPECT_THAT(
      problem("axis_mm     = [[120, 0, 250], [120, 100, 250]]", "axis_mm = [[120, 0, 250], [120, 0, 250]]"),
      HasSubstr("mechanism.anti_roll_bar: the two points of its axis are the same"));
}

TEST(SpringParts, LawsOfTheSpring) {
  EXPECT_EQ(problem("preload_N          = 900", "preload_N = 900\nfree_length_mm = 221"),
            "mechanism.spring.free_length_mm: the preload is given, which follows from the free length; keep "
            "preload "
            "or free_length");
  EXPECT_EQ(problem("stiffness_N_per_mm = 35", ""),
            "mechanism.spring.preload_N: needs the stiffness as well; write stiffness_N_per_mm");
  EXPECT_EQ(problem("preload_N          = 900", "curve = { compression_mm = [0, 50], force_N = [0, 1750] }"),
            "mechanism.spring.curve: the spring has a stiffness already; keep stiffness or curve");
  EXPECT_EQ(problem("stiffness_N_per_mm = 35",
                    "curve = { compression_mm = [0, 50, 50], force_N = [0, 1750, 1800] }"),
            "mechanism.spring.curve.compression_mm: the compressions do not ascend at point 3");
  EXPECT_EQ(
      problem("stiffness_N_per_mm = 35", "curve = { compression_mm = [0, 50], force_N = [0, 800] }"),
      "mechanism.spring.preload_N: the curve does not reach this force, or does not rise throughout; write "
      "free_length_mm instead");
  EXPECT_EQ(
      problem("attached_to        = \"rocker\"", "attached_to = \"body\""),
      "mechanism.spring.attached_to: holds the moving end, which the body cannot; name a link or a rocker");
}

TEST(SpringParts, DampersBarsAndStops) {
  EXPECT_EQ(problem("[mechanism.bump_stop]",
                    "[mechanism.torsion_bar]\nattached_to = \"tie rod\"\n"
                    "stiffness_N_m_per_rad = 100\n[mechanism.bump_stop]"),
            "mechanism.torsion_bar: it is twisted by no part that turns about an axis of the body; take a "
            "rocker, or "
            "a link of type RS, RR or R");
  EXPECT_EQ(problem("clearance_mm       = 20",
                    "clearance_mm = 20\non = \"spring\"\ncurve = { compression_mm = [0, 1], "
                    "force_N = [0, 1] }"),
            "mechanism.bump_stop.stiffness_N_per_mm: needs stiffness or a curve, one of them");
  const auto heave = [&](const std::string& lines) {
    return problem("[mechanism.bump_stop]", "[mechanism.heave_spring]\n" + lines + "[mechanism.bump_stop]");
  };
  EXPECT_EQ(
      heave("moving_mm = [0, 0, 500]\nattached_to = \"rocker\"\nstiffness_N_per_mm = 9\n"),
      "mechanism.heave_spring.moving_mm: lies in the middle of the vehicle: both ends are the same point; "
      "give the end on the side of this wheel");
  EXPECT_EQ(heave("moving_mm = [0, 190, 500]\nattached_to = \"rocker\"\n"),
            "mechanism.heave_spring.stiffness: is missing; write stiffness_N_per_mm, or a curve");
  EXPECT_EQ(heave("attached_to = \"rocker\"\nstiffness_N_per_mm = 9\n"),
            "mechanism.heave_spring.moving: its end is missing; write moving_m = [x, y, z], or points with "
            "one name");
  const std::string bare = "[mechanism.damper]\ndamping_N_s_per_m = 3000\n";
  EXPECT_EQ(
      problem(bare, "[mechanism.damper]\nattached_to = \"rocker\"\n"),
      "mechanism.damper.attached_to: the damper has no ends of its own; write body_m and moving_m as well");
}

TEST(SpringParts, CurvesOfDampers) {
  const auto with = [](const std::string& lines) { return problem("damping_N_s_per_m = 3000", lines); };
  EXPECT_EQ(with("damping_N_s_per_m = 3000\ncurve = { speed_m_per_s = [-1, 1], force_N = [-1, 1] }"),
            "mechanism.damper.curve: the damper has a damping already; keep damping or curve");
  EXPECT_EQ(
      with("curve = { speed_m_per_s = [0, 1], force_N = [0, 1] }"),
      "mechanism.damper.curve.speed_m_per_s: speeds of extension (< 0) and of compression (> 0) are both "
      "needed");
  EXPECT_EQ(with("curve = { speed_m_per_s = [-1, 1], force_N = [1, 1] }"),
            "mechanism.damper.curve.speed_m_per_s: the force at point 1 has another sign than the speed: it "
            "would drive the motion");
  EXPECT_EQ(with("curve = { speed_m_per_s = [-1, 1], force_N = [-1] }"),
            "mechanism.damper.curve.speed_m_per_s: 2 speeds and 1 forces");
}

TEST(SpringParts, PostsOfTBars) {
  const auto with = [](const std::string& axis) {
    return problem("axis_mm     = [[120, 0, 250], [120, 100, 250]]", "shape = \"T\"\naxis_mm = " + axis);
  };
  EXPECT_EQ(
      with("[[120, 0, 250], [120, 100, 250]]"),
      "mechanism.anti_roll_bar.axis_mm: the post of a T bar is not in the middle of the vehicle; give its "
      "foot and its top with y = 0");
  EXPECT_EQ(
      with("[[120, 0, 250], [120, 0, 250]]"),
      "mechanism.anti_roll_bar.axis_mm: foot and top of the post are the same point; set them apart along "
      "the post");
  EXPECT_THAT(problem("axis_mm     = [[120, 0, 250], [120, 100, 250]]", "shape = \"V\""),
              HasSubstr("mechanism.anti_roll_bar.shape: is 'V'"));
}

TEST(SpringParts, CurveOfAFile) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_spring_parts_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "spring.csv") << "compression_mm,force_N\n0,0\n50,1750\n";
  std::ofstream(folder / "other.csv") << "way_mm,force_N\n0,0\n50,1750\n";
  const std::string by_file =
      replaced(pushrod_study, "stiffness_N_per_mm = 35", "curve = { file = \"spring.csv\" }");
  const auto rate = [&](const std::string& text) {
    return test::column(test::run_text(text, folder), "wheel_rate_N_per_m");
  };
  const std::vector<double> found = rate(by_file), wanted = rate(pushrod_study);
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found.at(i), wanted[i], 1e-6);
  EXPECT_THAT(
      problems_of(replaced(by_file, "spring.csv", "other.csv"), folder),
      HasSubstr(
          "mechanism.spring.curve.file: 'other.csv' needs the columns compression and force, each with its "
          "unit"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace linkwright::suspension
