// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const char* const four_bar_text = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_m = { O1 = [0, 0], O4 = [0.6, 0] }
[[mechanism.body]]
name = "crank"
points_m = { O1 = [0, 0], O2 = [0.1, 0] }
mass_kg = 0.36
inertia_kg_m2 = 4.13e-4
[[mechanism.body]]
name = "coupler"
points_m = { O2 = [0, 0], O3 = [0.4, 0], C = [0.2, 0.1] }
mass_kg = 1.296
inertia_kg_m2 = 1.87e-2
centre_m = [0.2, 0]
[[mechanism.body]]
name = "rocker"
points_m = { O4 = [0, 0], O3 = [0.32, 0] }
mass_kg = 1.046
inertia_kg_m2 = 9.85e-3
[[mechanism.joint]]
name = "O1"
first = "ground.O1"
second = "crank.O1"
[[mechanism.joint]]
name = "O2"
first = "crank.O2"
second = "coupler.O2"
[[mechanism.joint]]
name = "O3"
first = "rocker.O3"
second = "coupler.O3"
[[mechanism.joint]]
name = "O4"
first = "ground.O4"
second = "rocker.O4"
[[mechanism.assembly]]
bodies = ["coupler", "rocker"]
mode = "plus"
[[drive]]
joint = "O1"
speed_rpm = 300
[sweep]
type = "grid"
[[sweep.input]]
from_deg = 0
to_deg = 360
samples = 201
[[trace]]
point = "coupler.C"
)";

double peak(const study::Result& r, const char* column) {
  const Column* c = r.tables.at(0).find(column);
  EXPECT_TRUE(c) << column;
  double most = 0;
  if (c)
    for (double v : c->values) most = std::max(most, std::abs(v));
  return most;
}

TEST(LinkageStudy, GivesTheFiguresOfTheFourBarStudy) {
  const study::Result r = run_text(four_bar_text);
  EXPECT_EQ(r.status, Status::done);
  // Boskovic 2018, original mechanism of Table 2.2: largest values over 201 samples, as recomputed with more
  // digits; half a unit of the last one.
  EXPECT_NEAR(peak(r, "O1_drive_torque_N_m"), 14.7136372, 5e-8);
  EXPECT_NEAR(peak(r, "O1_x_N"), 416.148105, 5e-7);
  EXPECT_NEAR(peak(r, "O3_y_N"), 32.8136345, 5e-8);
  EXPECT_NEAR(peak(r, "shaking_force_x_N"), 191.941323, 5e-7);
  EXPECT_NEAR(peak(r, "shaking_moment_with_drive_N_m"), 54.9623514, 5e-8);
  EXPECT_NEAR(peak(r, "shaking_moment_N_m"), 65.7736707, 5e-8);
  EXPECT_LE(peak(r, "closure_residual_m"), 1e-15);
  EXPECT_THAT(r.tables[0].status, Each("done"));
  EXPECT_THAT(r.diagnostics, IsEmpty());
}

// -40 to 80 deg in steps of 1 deg: the sample at 0 is 0, whatever the rounding of the ends.
TEST(LinkageStudy, SamplesZeroExactly) {
  const study::Result r = run_text(replaced(four_bar_text, "from_deg = 0\nto_deg = 360\nsamples = 201",
                                            "from_deg = -40\nto_deg = 80\nsamples = 121"));
  EXPECT_EQ(table(r, "sweep").find("O1_angle_rad")->values[40], 0);
}

TEST(LinkageStudy, WritesAStudyThatGivesTheSameAgain) {
  std::string messages;
  const auto first = prepare(four_bar_text, messages);
  ASSERT_TRUE(first) << messages;
  const std::string text = study::to_toml(first->canonical);
  const auto second = prepare(text, messages);
  ASSERT_TRUE(second) << messages << text;
  EXPECT_EQ(study::to_toml(second->canonical), text);
}

TEST(LinkageStudy, EverySampleRunsByItsNameAloneAndIsWrittenOut) {
  for (const LinkageSample& sample : linkage_samples()) {
    SCOPED_TRACE(sample.name);
    if (sample.from.size() != 1) continue;  // several inputs need a sweep of their own
    const std::string text =
        "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = \"" + sample.name +
        "\"\n";
    std::string messages;
    const auto prepared = prepare(text, messages);
    ASSERT_TRUE(prepared) << messages;
    RunContext context;
    const study::Result r = study::run_study(*prepared, context);
    EXPECT_EQ(r.status, Status::done) << to_string(r.status);
    EXPECT_EQ(r.scenes.size(), 1u);
    const auto again = prepare(study::to_toml(prepared->canonical), messages);
    ASSERT_TRUE(again) << messages;
    const study::Result s = study::run_study(*again, context);
    EXPECT_EQ(s.status, Status::done);
    ASSERT_EQ(s.tables[0].columns.size(), r.tables[0].columns.size());
    for (std::size_t c = 0; c < r.tables[0].columns.size(); ++c)
      EXPECT_NEAR(s.tables[0].columns[c].values[17], r.tables[0].columns[c].values[17],
                  1e-9 * (1 + std::abs(r.tables[0].columns[c].values[17])))
          << r.tables[0].columns[c].key;
  }
}

TEST(LinkageStudy, FollowsMotionLawsOverTime) {
  std::string text = replaced(four_bar_text, "speed_rpm = 300",
                              "law = \"cycloidal\"\nfrom_deg = 0\nto_deg = 180\nduration_s = 0.5");
  text = text.substr(0, text.find("[sweep]")) +
         "[sweep]\ntype = \"time\"\n[sweep.time]\nto_s = 0.5\nsamples = 101\n";
  const study::Result r = run_text(text);
  EXPECT_EQ(r.status, Status::done);
  const Table& t = r.tables[0];
  EXPECT_NEAR(t.find("O1_angle_rad")->values[50], pi / 2, 1e-14);
  EXPECT_EQ(t.find("crank_speed_rad_per_s")->values[0], 0);
  // Highest speed of the cycloidal law: twice the mean.
  EXPECT_NEAR(t.find("crank_speed_rad_per_s")->values[50], 2 * pi / 0.5, 1e-12);
  EXPECT_EQ(r.scenes[0].input_key, "time_s");
}

TEST(LinkageStudy, TellsWhereALinkageAssembles) {
  const study::Result r = run_text(replaced(four_bar_text, "O3 = [0.32, 0]", "O3 = [0.22, 0]"));
  EXPECT_EQ(r.status, Status::no_assembly);
  ASSERT_FALSE(r.diagnostics.empty());
  // At angle a the crank pin is sqrt(0.37 - 0.12 cos a) from O4; coupler and rocker reach 0.62 m.
  const double limit = std::acos((0.37 - 0.62 * 0.62) / 0.12) * 180 / pi;
  EXPECT_NEAR(limit, 96.9, 0.05);
  EXPECT_THAT(to_string(r.diagnostics[0]),
              ::testing::AllOf(HasSubstr("do not assemble: coupler + rocker cannot close, the gap is up to"),
                               HasSubstr("it assembles from -96.9 to 96.9 deg")));
  const Table& t = r.tables[0];
  EXPECT_EQ(t.status[100], "no_assembly");
  EXPECT_TRUE(std::isnan(t.find("coupler_angle_rad")->values[100]));
  EXPECT_FALSE(std::isnan(t.find("coupler_angle_rad")->values[10]));
}

// Rods of a parallelogram: where they lie in line the branch is a choice.
TEST(LinkageStudy, GoesOnThroughChangePointsAsTheStudySays) {
  std::string text = replaced(four_bar_text, "O4 = [0.6, 0]", "O4 = [0.4, 0]");
  text = replaced(text, "O3 = [0.32, 0]", "O3 = [0.1, 0]");
  text = replaced(text, "from_deg = 0\nto_deg = 360\nsamples = 201",
                  "from_deg = 10\nto_deg = 350\nsamples = 171");
  const study::Result smooth = run_text(text);
  // A parallelogram stays one: the rocker is parallel to the crank, on both sides of 180 degrees.
  const Table& t = smooth.tables[0];
  std::size_t parallel = 0, singular = 0;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    if (t.status[i] == "singular") {
      ++singular;
      continue;
    }
    const double apart =
        std::remainder(t.find("rocker_angle_rad")->values[i] - t.find("crank_angle_rad")->values[i], 2 * pi);
    parallel += std::abs(apart) < 1e-6;  // near the flat position angles are known to the root of rounding
  }
  EXPECT_EQ(singular, 1u);  // 180 degrees is a row
  EXPECT_EQ(parallel, t.rows() - singular);
  EXPECT_THAT(
      to_string(smooth.diagnostics[1]),
      HasSubstr(
          "the assembly modes of coupler + rocker coincide there, and the linkage can continue in either; "
          "the rows continue smoothly"));
  const study::Result other =
      run_text(replaced(text, "type = \"grid\"", "type = \"grid\"\nat_change_point = \"keep_sign\""));
  const Table& u = other.tables[0];
  EXPECT_GT(std::abs(std::remainder(
                u.find("rocker_angle_rad")->values[150] - u.find("crank_angle_rad")->values[150], 2 * pi)),
            0.1);
}

// Over the full turn, its flat positions among the rows.
TEST(LinkageStudy, AParallelogramHasAllItsRows) {
  std::string text = replaced(four_bar_text, "O4 = [0.6, 0]", "O4 = [0.4, 0]");
  text = replaced(text, "O3 = [0.32, 0]", "O3 = [0.1, 0]");
  text = replaced(text, "samples = 201", "samples = 361");
  const study::Result r = run_text(text);
  EXPECT_EQ(r.status, Status::done);
  const Table& t = r.tables[0];
  for (std::size_t i = 0; i < t.rows(); ++i) {
    // The coupler only moves along: its speed is 0, the rocker's that of the crank.
    EXPECT_NEAR(t.find("rocker_speed_rad_per_s")->values[i], 10 * pi, 1e-5) << i;
    EXPECT_NEAR(t.find("coupler_C_x_m")->values[i],
                0.1 * std::cos(t.find("crank_angle_rad")->values[i]) + 0.2, 1e-6);
    EXPECT_NEAR(t.find("rocker_acceleration_rad_per_s2")->values[i], 0, 1e-3) << i;
    // The weight of the rocker has no answer where it is flat.
    EXPECT_EQ(t.status[i], i % 180 == 0 ? "singular" : "done") << i;
    EXPECT_EQ(std::isnan(t.find("O1_x_N")->values[i]), i % 180 == 0) << i;
  }
  const study::Result moved = run_text(text + "[output]\nquantities = [\"position\", \"rates\"]\n");
  EXPECT_EQ(moved.status, Status::done);
  EXPECT_THAT(moved.tables[0].status, Each("done"));
  // The rates are not known at a kink, but the position is.
  const study::Result kink =
      run_text(replaced(text, "type = \"grid\"", "type = \"grid\"\nat_change_point = \"keep_sign\""));
  EXPECT_NEAR(kink.tables[0].find("coupler_C_x_m")->values[180], 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(kink.tables[0].find("rocker_speed_rad_per_s")->values[180]));
}

// An arm raised by a cylinder, drawn, swept from 0 mm on: rows stand from the shortest length on, in both
// senses and whatever the spacing.
TEST(LinkageStudy, ACylinderRaisesAnArm) {
  const auto text = [](double from, double to, int samples) {
    return fmt::format(R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
drawn = true
[[mechanism.body]]
name = "ground"
points_mm = {{ O = [0, 0], C = [150, 0] }}
[[mechanism.body]]
name = "arm"
points_mm = {{ O = [0, 0], P = [100, 120], tip = [300, 350] }}
[[mechanism.body]]
name = "barrel"
points_mm = {{ C = [150, 0] }}
[[mechanism.body]]
name = "rod"
points_mm = {{ P = [100, 120] }}
[[mechanism.joint]]
name = "O"
first = "ground.O"
second = "arm.O"
[[mechanism.joint]]
name = "C"
first = "ground.C"
second = "barrel.C"
[[mechanism.joint]]
name = "P"
first = "rod.P"
second = "arm.P"
[[mechanism.joint]]
name = "cylinder"
type = "prismatic"
first = "barrel.C"
second = "rod.P"
direction_rad = {}
[[drive]]
joint = "cylinder"
[sweep]
type = "grid"
[[sweep.input]]
from_mm = {}
to_mm = {}
samples = {}
[[trace]]
point = "arm.tip"
[output]
quantities = ["position"]
)",
                       std::atan2(120, -50), from, to, samples);
  };
  const study::Result up = run_text(text(0, 130, 14)), down = run_text(text(130, 0, 14)),
                      fine = run_text(text(0, 130, 131));
  EXPECT_EQ(up.status, Status::no_assembly);
  const double arm = std::hypot(0.1, 0.12), least = std::abs(arm - 0.15);
  for (std::size_t i = 0; i < 14; ++i) {
    const double length = 0.01 * static_cast<double>(i);
    EXPECT_EQ(up.tables[0].status[i], length < least ? "no_assembly" : "done") << i;
    EXPECT_EQ(down.tables[0].status[13 - i], up.tables[0].status[i]);
    EXPECT_EQ(fine.tables[0].status[10 * i], up.tables[0].status[i]);
    if (length < least) continue;
    const double angle = up.tables[0].find("arm_angle_rad")->values[i];
    EXPECT_NEAR(angle, down.tables[0].find("arm_angle_rad")->values[13 - i], 1e-12);
    EXPECT_NEAR(angle, fine.tables[0].find("arm_angle_rad")->values[10 * i], 1e-12);
  }
  // The drawing stands as drawn: hypot(50, 120) = 130 mm.
  EXPECT_NEAR(up.tables[0].find("arm_angle_rad")->values[13], 0, 1e-12);
  EXPECT_THAT(to_string(up.diagnostics.at(0)), HasSubstr("it assembles from 6.205 to 130 mm"));
}

// A bicycle's rear linkage from the angle of its rocker alone: the four-bar by intersecting circles, the
// length of the shock as a distance.
struct RearLinkage {
  using Point = std::complex<double>;
  const Point main{0, 0.04}, dropout{-0.38, 0.01}, lower{0.03, 0.07}, axle{-0.435, 0.028},
      pivot{-0.012, 0.31}, seatstay{-0.1, 0.325}, upper{0.048, 0.296};

  struct Place {
    double shock;
    Point axle;
  };
  Place at(double rocker) const {
    const auto turned = [&](Point p) { return pivot + (p - pivot) * std::polar(1.0, rocker); };
    const Point way = turned(seatstay) - main;
    const double r = std::abs(way), a = std::abs(dropout - main), b = std::abs(seatstay - dropout),
                 along = (a * a - b * b + r * r) / (2 * r);
    // The dropout lies on the left of the line from the main pivot to the rocker.
    const Point tip = main + way / r * Point(along, std::sqrt(a * a - along * along));
    const Point lower_eye = main + (lower - main) * (tip - main) / (dropout - main);
    return {std::abs(turned(upper) - lower_eye),
            tip + (axle - dropout) * (turned(seatstay) - tip) / (seatstay - dropout)};
  }
  // The shock grows with the angle of the rocker from its dead point on.
  double rocker_at(double shock) const {
    double low = -1, high = 1;
    for (int i = 0; i < 100; ++i) (at((low + high) / 2).shock < shock ? low : high) = (low + high) / 2;
    return (low + high) / 2;
  }
};

TEST(LinkageStudy, AShockDrivesABicyclesRearLinkage) {
  const std::string text = test::example_text("bicycle-rear-linkage.toml");
  const RearLinkage by_hand;
  const double drawn = by_hand.at(0).shock, from = 0.2567, to = 0.1967;
  const auto rows_agree = [&](const study::Result& r) {
    const Table& sweep = r.tables[0];
    for (std::size_t i = 0; i < sweep.rows(); ++i) {
      if (sweep.status[i] != "done") continue;
      const double rocker = by_hand.rocker_at(sweep.find("shock_displacement_m")->values[i]);
      EXPECT_NEAR(sweep.find("rocker_angle_rad")->values[i], rocker, 1e-12) << i;
      const RearLinkage::Point axle = by_hand.at(rocker).axle;
      EXPECT_NEAR(sweep.find("seatstay_axle_x_m")->values[i], axle.real(), 1e-13) << i;
      EXPECT_NEAR(sweep.find("seatstay_axle_y_m")->values[i], axle.imag(), 1e-13) << i;
    }
  };
  const study::Result stroke = run_text(text);
  ASSERT_EQ(stroke.status, Status::done);
  EXPECT_EQ(stroke.tables[0].rows(), 61u);
  rows_agree(stroke);
  // The shock at 1 m/s gives the axle the leverage ratio as speed: differences of the route by hand.
  const auto height = [&](double shock) { return by_hand.at(by_hand.rocker_at(shock)).axle.imag(); };
  for (const std::size_t i : {0u, 30u, 60u}) {
    const double shock = from + (to - from) * static_cast<double>(i) / 60;
    EXPECT_NEAR(stroke.tables[0].find("seatstay_axle_speed_y_m_per_s")->values[i],
                (height(shock - 1e-6) - height(shock + 1e-6)) / 2e-6, 1e-6);
  }
  // Wherever a sweep comes from, at the drawing's own input the linkage stands as drawn.
  for (const double other : {from, to}) {
    const study::Result r =
        run_text(replaced(replaced(text, "from_mm = 256.7", fmt::format("from_mm = {}", other * 1e3)),
                          "to_mm   = 196.7", fmt::format("to_mm = {:.17g}", drawn * 1e3)));
    ASSERT_EQ(r.status, Status::done);
    EXPECT_NEAR(r.tables[0].find("rocker_angle_rad")->values[60], 0, 1e-13);
    rows_agree(r);
  }
  // The rocker's dead point, by hand: the shock is at its shortest, 194.3241 mm.
  const study::Result beyond = run_text(replaced(text, "to_mm   = 196.7", "to_mm = 190"));
  EXPECT_EQ(beyond.status, Status::no_assembly);
  EXPECT_THAT(to_string(beyond.diagnostics.at(0)), HasSubstr("it assembles from 194.3 to 256.7 mm"));
  rows_agree(beyond);
}

TEST(LinkageStudy, TellsRatiosCentresAndRanges) {
  const study::Result r = run_text(std::string(four_bar_text) +
                                   "[quality]\noutput_joint = \"O4\"\ncentrodes = "
                                   "[\"coupler\"]\ninstant_centres = true\nassembly_modes = true\n");
  // The ratio of the speeds is that of the table of the analysis.
  for (std::size_t i = 0; i < 201; i += 20)
    EXPECT_NEAR(table(r, "advantage").find("rate_ratio")->values[i],
                table(r, "sweep").find("rocker_speed_rad_per_s")->values[i] / (10 * pi), 1e-13);
  EXPECT_EQ(table(r, "ranges").rows(), 2u);  // both modes turn fully, each a circuit of its own
  EXPECT_EQ(table(r, "ranges").find("full_turn")->values, (std::vector<double>{1, 1}));
  EXPECT_EQ(table(r, "ranges").find("circuit")->values, (std::vector<double>{1, 2}));
  // The instant centre of the coupler lies on the lines of crank and rocker.
  const Table& centres = table(r, "instant_centres");
  const double x = centres.find("ground_coupler_x_m")->values[30],
               y = centres.find("ground_coupler_y_m")->values[30];
  const double crank = table(r, "sweep").find("crank_angle_rad")->values[30];
  EXPECT_NEAR(x * std::sin(crank) - y * std::cos(crank), 0, 1e-12);
  EXPECT_EQ(table(r, "centrodes-coupler").rows(), 201u);
  EXPECT_EQ(table(r, "assembly_modes").find("coupler_rocker_mode")->values, (std::vector<double>{1, -1}));
}

TEST(LinkageStudy, RemarksOnADrawingThatIsNotCalledOne) {
  const std::string body =
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nDRAWN"
      "[[mechanism.body]]\nname = \"ground\"\npoints_mm = { O = [0, 0], B0 = [600, 0] }\n"
      "[[mechanism.body]]\nname = \"crank\"\npoints_mm = { O = [0, 0], A = [100, 0] }\n"
      "[[mechanism.body]]\nname = \"coupler\"\npoints_mm = { A = [100, 0], B = [500, 300] }\n"
      "[[mechanism.body]]\nname = \"rocker\"\npoints_mm = { B0 = [600, 0], B = [500, 300] }\n"
      "[[mechanism.joint]]\nname = \"O\"\nfirst = \"ground.O\"\nsecond = \"crank.O\"\n"
      "[[mechanism.joint]]\nname = \"A\"\nfirst = \"crank.A\"\nsecond = \"coupler.A\"\n"
      "[[mechanism.joint]]\nname = \"B\"\nfirst = \"coupler.B\"\nsecond = \"rocker.B\"\n"
      "[[mechanism.joint]]\nname = \"B0\"\nfirst = \"ground.B0\"\nsecond = \"rocker.B0\"\n"
      "[[drive]]\njoint = \"O\"\nspeed_rpm = 10\n[sweep]\ntype = \"grid\"\n[[sweep.input]]\njoint = "
      "\"O\"\nfrom_deg = 0\n"
      "to_deg = 360\nsamples = 5\n";
  std::string said;
  EXPECT_TRUE(test::prepare(replaced(body, "DRAWN", ""), said)) << said;
  EXPECT_THAT(said, HasSubstr("the two points of every joint coincide as they are written, as in a drawing"));
  said.clear();
  EXPECT_TRUE(test::prepare(replaced(body, "DRAWN", "drawn = true\n"), said)) << said;
  EXPECT_THAT(said, ::testing::Not(HasSubstr("coincide")));
}

TEST(LinkageStudy, TellsTheInertiaThatItAssumesOfBodiesWithAMass) {
  const std::string assumed =
      replaced(replaced(four_bar_text, "inertia_kg_m2 = 4.13e-4\n", ""), "inertia_kg_m2 = 9.85e-3\n", "");
  constexpr const char* label = "inertia of uniform bars and plates, where left out";
  EXPECT_THAT(test::fact(run_text(assumed), label),
              AllOf(StartsWith("crank 0.0003 kg m²"), HasSubstr("; rocker 0.0089259 kg m²")));
  // A body without mass has no inertia to tell of.
  EXPECT_THAT(test::fact(run_text(replaced(assumed, "mass_kg = 0.36", "mass_kg = 0")), label),
              StartsWith("rocker"));
}

TEST(LinkageStudy, PlaysTheMotionAsTheDriveRuns) {
  const std::string text = four_bar_text;
  const std::size_t begin = text.find("speed_");
  const std::string speed = text.substr(begin, text.find('\n', begin) - begin);
  const study::Result forward = run_text(text),
                      back = run_text(replaced(text, speed, "speed_rad_per_s = -10"));
  const std::vector<double>& rising = forward.scenes[0].input;
  std::vector<double> falling = back.scenes[0].input;
  ASSERT_LT(rising.front(), rising.back());
  std::reverse(falling.begin(), falling.end());
  EXPECT_EQ(falling, rising);
  const auto path = [](const study::Result& r) { return r.scenes[0].points.back().x; };
  EXPECT_EQ(path(back).front(), path(forward).back());
  EXPECT_EQ(back.tables[0].find("O1_angle_rad")->values, forward.tables[0].find("O1_angle_rad")->values)
      << "the table keeps its order";
}

TEST(LinkageStudy, LetsABodyAndItsJointShareAName) {
  std::string same = four_bar_text;
  for (const auto& [from, to] :
       {std::pair{"name = \"O1\"", "name = \"crank\""}, std::pair{"joint = \"O1\"", "joint = \"crank\""}})
    for (std::size_t i = 0; (i = same.find(from, i)) != std::string::npos;)
      same.replace(i, std::string_view(from).size(), to);
  const study::Result r = run_text(same);
  const Table& sweep = r.tables.at(0);
  ASSERT_TRUE(sweep.find("crank_joint_angle_rad") && sweep.find("crank_angle_rad"));
  EXPECT_EQ(sweep.find("crank_joint_angle_rad")->values,
            run_text(four_bar_text).tables.at(0).columns.at(0).values);
}

// Two bodies that differ in a blank would write columns of one name.
TEST(LinkageStudy, RefusesTwoColumnsOfOneName) {
  std::string blank = four_bar_text;
  for (const auto& [from, to] : {std::pair{"coupler", "arm 1"}, std::pair{"rocker", "arm_1"}})
    for (std::size_t i = 0; (i = blank.find(from, i)) != std::string::npos;)
      blank.replace(i, std::string_view(from).size(), to);
  EXPECT_THAT(problems_of(blank), HasSubstr("would be called 'arm_1_"));
}

TEST(LinkageStudy, NamesWhatIsWrongWithALinkage) {
  EXPECT_THAT(problems_of(replaced(four_bar_text, "first = \"crank.O2\"", "first = \"crnk.O2\"")),
              HasSubstr("mechanism.joint[1].first: there is no body 'crnk'; did you mean 'crank'?"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "first = \"crank.O2\"", "first = \"crank.O5\"")),
              HasSubstr("body 'crank' has no point 'O5'"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "O2 = [0.1, 0]", "O2 = [0, 0]")),
              HasSubstr("has no length: its joints O1 and O2 lie in one point"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "joint = \"O1\"\nspeed_rpm", "joint = \"O9\"\nspeed_rpm")),
              HasSubstr("there is no joint 'O9'; did you mean 'O1'?"));
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = "
                          "\"hoeken\"\n[[drive]]\njoint = \"B0\"\n"),
              HasSubstr("drive[0].joint: this mechanism takes a drive at O, not at 'B0'; name that joint, or "
                        "give bodies and joints instead"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "mass_kg = 1.046", "#")),
              HasSubstr("forces and torques need the mass of every body: 'rocker' has none"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "[[drive]]\njoint = \"O1\"",
                                   "[[drive]]\njoint = \"O4\"\n[[drive]]\njoint = \"O1\"")),
              HasSubstr("two drives on one degree of freedom"));
  const std::string no_rocker_pin =
      replaced(four_bar_text,
               "[[mechanism.joint]]\nname = \"O4\"\nfirst = \"ground.O4\"\nsecond = \"rocker.O4\"\n", "");
  EXPECT_THAT(problems_of(replaced(
                  no_rocker_pin,
                  "[[mechanism.assembly]]\nbodies = [\"coupler\", \"rocker\"]\nmode = \"plus\"\n", "")),
              HasSubstr("keep 2 degrees of freedom without a drive"));
  const std::string strut = R"([[mechanism.body]]
name = "strut"
points_m = { P = [0, 0], Q = [0.3, 0] }
mass_kg = 1
[[mechanism.joint]]
name = "P"
first = "ground.O4"
second = "strut.P"
[[mechanism.joint]]
name = "Q"
first = "coupler.O3"
second = "strut.Q"
[[mechanism.assembly]]
)";
  EXPECT_THAT(problems_of(replaced(four_bar_text, "[[mechanism.assembly]]\n", strut)),
              HasSubstr("'strut' has 1 constraint too many: a rigid or overdetermined structure"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "bodies = [\"coupler\", \"rocker\"]",
                                   "bodies = [\"crank\", \"rocker\"]")),
              HasSubstr("are not a pair with two assembly modes; these are: coupler + rocker"));
  EXPECT_THAT(problems_of(replaced(four_bar_text, "from_deg = 0\nto_deg = 360", "from_deg = 9\nto_deg = 9")),
              HasSubstr("the sweep ends where it begins"));
}

TEST(SliderCrankStudy, AgreesWithTheClosedFormOfItsSlider) {
  const std::string text = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.slider_crank"
[mechanism.parameters]
crank_m = 0.4
rod_m = 1.1
offset_m = 0.2
guide_angle_deg = 25
pivot_x_m = 0.3
rod_u_m = 0.5
rod_v_m = 0.2
[[drive]]
speed_rad_per_s = 1
[sweep]
type = "grid"
[[sweep.input]]
from_deg = 0
to_deg = 360
samples = 37
[output]
quantities = ["position", "rates"]
)";
  // The point of the rod has its columns without a trace.
  const study::Result r = run_text(text);
  EXPECT_TRUE(r.tables[0].find("rod_C_speed_x_m_per_s"));
  EXPECT_TRUE(r.tables[0].find("rod_C_acceleration_y_m_per_s2"));
  EXPECT_EQ(r.status, Status::done);
  const double delta = 25 * pi / 180;
  for (int i = 0; i < 37; ++i) {
    // Boskovic 2018, Eqs. (4.9)-(4.11), the offset there counted against ours.
    const double angle = i * pi / 18, h = -0.2;
    const double rod = delta + std::asin(-(h + 0.4 * std::sin(angle - delta)) / 1.1);
    const double way = 0.4 * std::cos(angle - delta) + 1.1 * std::cos(rod - delta);
    const auto c = std::complex<double>(0.3, 0) + std::polar(0.4, angle) +
                   std::polar(1.0, rod) * std::complex<double>(0.5, 0.2);
    EXPECT_NEAR(r.tables[0].find("guide_displacement_m")->values[static_cast<std::size_t>(i)], way, 1e-14);
    EXPECT_NEAR(r.tables[0].find("rod_C_x_m")->values[static_cast<std::size_t>(i)], c.real(), 1e-14);
    EXPECT_NEAR(r.tables[0].find("rod_C_y_m")->values[static_cast<std::size_t>(i)], c.imag(), 1e-14);
  }
}

/// An engine of 50 and 150 mm with a bore of 80 mm, without masses and gravity, under 2 MPa at 30 degrees.
std::string engine(const std::string& gas, double guide = 0, const std::string& branch = "forward") {
  return fmt::format(R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.slider_crank"
branch = "{}"
[mechanism.parameters]
crank_mm = 50
rod_mm = 150
guide_angle_deg = {}
[mechanism.mass]
crank = {{ mass_kg = 0, inertia_kg_m2 = 0, centre_distance_mm = 0 }}
rod = {{ mass_kg = 0, inertia_kg_m2 = 0, centre_distance_mm = 0 }}
slider_kg = 0
[mechanism.gas_pressure]
{}
[[drive]]
speed_rpm = 3000
[sweep]
type = "grid"
[[sweep.input]]
from_deg = {}
to_deg = {}
samples = 2
)",
                     branch, guide, gas, 30 + guide + (branch == "forward" ? 0 : 180),
                     60 + guide + (branch == "forward" ? 0 : 180));
}

TEST(LinkageStudy, GasPushesThePistonOfAnEngine) {
  const std::string gas = "bore_mm = 80\ncrank_deg = [0, 30, 60, 720]\npressure_MPa = [3, 2, 1, 3]";
  // The torque of the drive holds the crank against the gas, whatever the direction of the guide.
  for (const auto& [guide, branch] : {std::pair{0.0, "forward"}, {90.0, "forward"}, {0.0, "backward"}}) {
    const study::Result r = run_text(engine(gas, guide, branch));
    ASSERT_EQ(r.status, Status::done);
    const Table& sweep = r.tables[0];
    EXPECT_NEAR(sweep.find("O_drive_torque_N_m")->values.at(0), -324.908544282692, 1e-9);
    EXPECT_NEAR(sweep.find("guide_N")->values.at(0), 1699.2834545953694, 1e-8);
  }
  // A table of two turns repeats after them: at 750 degrees it is where it was at 30.
  std::string later = engine(gas);
  later = replaced(replaced(later, "from_deg = 30", "from_deg = 750"), "to_deg = 60", "to_deg = 780");
  EXPECT_NEAR(run_text(later).tables[0].find("O_drive_torque_N_m")->values.at(0), -324.908544282692, 1e-9);
  EXPECT_THAT(problems_of(engine("bore_mm = 80\ncrank_deg = [0, 30, 20]\npressure_MPa = [1, 2, 3]")),
              HasSubstr("mechanism.gas_pressure.crank_deg: the angles do not rise behind the place 2"));
  EXPECT_THAT(problems_of(engine("bore_mm = 80\ncrank_deg = [0, 30]\npressure_MPa = [1]")),
              HasSubstr("there are 1 pressures for 2 angles of the crank"));
}

}  // namespace
}  // namespace linkwright::planar
