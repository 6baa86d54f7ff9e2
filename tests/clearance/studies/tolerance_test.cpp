// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/studies/tolerance.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "clearance/studies.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/memory.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"

namespace linkwright::clearance {
namespace {

using test::column;
using test::example_text;
using test::fact;
using test::largest;
using test::lines_of;
using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string four_bar() { return tolerance_kind().example; }

// Errors of rod and pins reach the slider by one over the cosine of the rod's angle, those of the crank along
// the rod; the drive stays.
TEST(ToleranceStudy, WayOfASliderInClosedForm) {
  const study::Result r = run_text(example_text("tolerances-slider-crank.toml"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  const std::vector<double>&crank = column(r, "errors", "O_angle_rad"),
        &worst = column(r, "errors", "guide_displacement_worst_m"),
        &rms = column(r, "errors", "guide_displacement_rms_m"),
        &drawn = column(r, "errors", "guide_displacement_drawn_m");
  for (std::size_t i = 0; i < crank.size(); ++i) {
    const double rod = -std::asin(50 * std::sin(crank[i]) / 150),  // its angle
        by_rod = 1 / std::cos(rod), by_crank = std::abs(std::cos(crank[i] - rod) / std::cos(rod));
    // Central differences: 1e-10 of the size of the linkage by the clearances.
    EXPECT_NEAR(worst[i], (0.05e-3 + 0.05e-3) * by_rod + 0.03e-3 * by_crank, 1e-12) << i;
    EXPECT_NEAR(rms[i] * rms[i],
                std::pow(by_rod, 2) * (0.05e-3 * 0.05e-3 / 3 + (2 * 0.02e-3 * 0.02e-3 + 1e-10) / 2) +
                    std::pow(by_crank * 0.03e-3, 2) / 3,
                1e-15)
        << i;
    EXPECT_LT(drawn[i], worst[i] * 1.001) << i;
    EXPECT_GT(drawn[i], worst[i] * 0.7) << i;
  }
  // Half of the nominal stroke beyond the crank pivot at 90 degrees and the like: values and their bands.
  const std::vector<double>&way = column(r, "values", "guide_displacement_m"),
        &upper = column(r, "values", "guide_displacement_upper_m");
  EXPECT_NEAR(way[0], 0.2, 1e-15);
  EXPECT_NEAR(upper[0], 0.20013, 1e-12);
  EXPECT_THAT(fact(r, "error of force at A"), HasSubstr("of the largest there is, 1.38e+03 N"));
  EXPECT_THAT(table(r, "errors").status, Each("done"));
  EXPECT_THAT(r.diagnostics, IsEmpty()) << lines_of(r.diagnostics);
  for (const study::Check& check : r.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value;
  for (const study::Plot& p : r.plots)
    for (const std::string& key : p.y) EXPECT_TRUE(table(r, p.table).find(key)) << p.name << " " << key;
}

TEST(ToleranceStudy, BudgetsAddUpAndTellWhatToTighten) {
  const study::Result r = run_text(four_bar());
  const Table& budget = table(r, "budget_coupler_P");
  EXPECT_THAT(budget.names, ElementsAre("pin A", "pin B", "length A-B of coupler"));
  double parts = 0, shares = 0, squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    parts += column(r, "budget_coupler_P", "worst_m")[k];
    shares += column(r, "budget_coupler_P", "worst_share")[k];
    squares += column(r, "budget_coupler_P", "mean_square_share")[k];
  }
  EXPECT_NEAR(parts, largest(column(r, "errors", "coupler_P_worst_m")), 1e-15);
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_NEAR(squares, 1, 1e-12);
  EXPECT_NEAR(r.statistics.find("coupler_P_worst_m")->as_number(), parts, 1e-15);
  // The first remedy, tried: a tenth less clearance takes off 0.00655 mm, or nearly so: the worst direction
  // turns a little.
  EXPECT_THAT(
      fact(r, "tighten first for coupler.P"),
      HasSubstr("pin A (46 % of the worst case), pin B (28 %), length A-B of coupler (26 %); 0.005 mm "
                "less for pin A takes off 0.00655 mm"));
  const study::Result tighter =
      run_text(replaced(four_bar(), "clearance_mm = 0.05  ", "clearance_mm = 0.045"));
  EXPECT_NEAR(parts - tighter.statistics.find("coupler_P_worst_m")->as_number(), 6.55e-6, 5e-8);
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("coupler.P deviates by at most 0.143 mm (worst case, at 0°); 99 % of 2000 random "
                        "linkages stay within 0.129 mm; 46 % of the worst case comes from pin A."));
}

// Every displacement of the point within the band that is reported.
TEST(ToleranceStudy, BandOfAPath) {
  const study::Result r = run_text(four_bar());
  const std::vector<double>&x = column(r, "band", "coupler_P_x_m"), &y = column(r, "band", "coupler_P_y_m"),
        &left_x = column(r, "band", "coupler_P_left_x_m"), &left_y = column(r, "band", "coupler_P_left_y_m"),
        &across = column(r, "errors", "coupler_P_across_m"),
        &worst = column(r, "errors", "coupler_P_worst_m");
  ASSERT_EQ(r.scenes.size(), 1u);
  EXPECT_THAT(to_string(r.scenes[0].title), "clearances and bands drawn 50 x");
  EXPECT_EQ(r.scenes[0].traces.size(), 3u);
  EXPECT_EQ(r.scenes[0].circles.size(), 2u);
  bool narrower = false;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    EXPECT_LE(across[i], worst[i] * (1 + 1e-9)) << i;
    narrower = narrower || across[i] < 0.7 * worst[i];
    const double dx = left_x[i] - x[i], dy = left_y[i] - y[i];
    EXPECT_NEAR(std::hypot(dx, dy), 50 * across[i], 1e-12) << i;
    const double ahead_x = x[i + 1] - x[i - 1], ahead_y = y[i + 1] - y[i - 1];
    EXPECT_NEAR(dx * ahead_x + dy * ahead_y, 0, 1e-12) << i;
    EXPECT_GT(ahead_x * dy - ahead_y * dx, 0) << i;
  }
  EXPECT_TRUE(narrower);
}

// The share that keeps to a limit is that of the table of draws, with Wilson's interval.
TEST(ToleranceStudy, YieldOfALimit) {
  const study::Result r = run_text(
      replaced(four_bar(), "point    = \"coupler.P\"\nerror_mm = 0.15", "joint = \"B0\"\nerror_deg = 0.07"));
  const std::vector<double>& all = column(r, "draws", "B0_angle_rad");
  ASSERT_EQ(all.size(), 2000u);
  const double limit = 0.07 * pi / 180;
  const auto within =
      static_cast<double>(std::count_if(all.begin(), all.end(), [&](double e) { return e <= limit; }));
  const double share = r.statistics.find("B0_angle_yield")->as_number(),
               lower = r.statistics.find("B0_angle_yield_least")->as_number(),
               upper = r.statistics.find("B0_angle_yield_most")->as_number();
  EXPECT_EQ(share, within / 2000);
  // The ends of the interval are where the share is 1.96 standard deviations away.
  for (const double end : {lower, upper})
    EXPECT_NEAR(std::abs(share - end) / std::sqrt(end * (1 - end) / 2000), 1.959964, 1e-5);
  EXPECT_LT(lower, share);
  EXPECT_THAT(fact(r, "angle of B0 within 0.07°"),
              HasSubstr("with 95 % confidence); with all tolerances 0.59 times "
                        "as large the worst case would, too"));
  EXPECT_THAT(to_string(r.headline), HasSubstr("% keep angle of B0 within 0.07°."));
  // The same seed, the same numbers; another one, others.
  EXPECT_EQ(column(run_text(four_bar()), "draws", "B0_angle_rad"), all);
  EXPECT_NE(column(run_text(replaced(four_bar(), "seed  = 1", "seed  = 2")), "draws", "B0_angle_rad"), all);
}

// Over time, with forces that loads make then.
TEST(ToleranceStudy, OverTimeWithForces) {
  std::string text = example_text("tolerances-slider-crank.toml");
  text = replaced(text, "speed_rpm = 1500.0", "law = \"constant_speed\"\nspeed_rpm = 1500.0");
  text = replaced(text,
                  "type = \"grid\"\n\n[[sweep.input]]\njoint    = \"O\"\nfrom_deg = 0.0\nto_deg   = "
                  "360.0\nsamples  = 181",
                  "type = \"time\"\ntime = { from_s = 0.0, to_s = 0.04, samples = 181 }");
  text = replaced(text, "[[mechanism.assembly]]",
                  "[[mechanism.force]]\nname = \"gas\"\npoint = \"slider.B\"\nforce_N = [-1000, 0]\nagainst "
                  "= \"time\"\nargument = [0.0, "
                  "0.04]\nfactor = [0.0, 1.0]\n\n[[mechanism.assembly]]");
  text.erase(text.find("# In the dead centres"));
  const study::Result grid = run_text(example_text("tolerances-slider-crank.toml")), r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_EQ(column(r, "errors", "time_s").back(), 0.04);
  // At 0.02 s, half a turn, the load is 500 N: it goes through the rod.
  EXPECT_NEAR(column(r, "values", "A_force_x_N")[90] - column(grid, "values", "A_force_x_N")[90], 500, 1e-9);
  EXPECT_NEAR(column(r, "errors", "guide_displacement_worst_m")[90],
              column(grid, "errors", "guide_displacement_worst_m")[90], 1e-13);
  EXPECT_THAT(to_string(r.headline), HasSubstr("(worst case, at 0.01"));
}

// Up to a dead point: where the linear theory ends, and random linkages that do not assemble.
TEST(ToleranceStudy, WarnsNearDeadPoints) {
  // The rocker drives; coupler and crank come into line at the outer end of its swing, where
  // cos(rocker) = -(L1^2 + L4^2 - (L2 + L3)^2) / (2 L1 L4) of the angle at B0.
  std::string text = replaced(four_bar(), "joint     = \"O\"\nspeed", "joint = \"B0\"\nspeed");
  const double dead = 180 - std::acos((200.0 * 200 + 120 * 120 - 210 * 210) / (2.0 * 200 * 120)) * 180 / pi;
  text = replaced(text, "bodies = [\"coupler\", \"rocker\"]\nmode   = \"plus\"",
                  "bodies = [\"crank\", \"coupler\"]\nmode   = \"plus\"");
  text = replaced(text, "coordinates = [\"B0\"]", "coordinates = [\"O\"]");
  const auto swing = [&](double end) {
    return replaced(text, "joint    = \"O\"\nfrom_deg = 0.0\nto_deg   = 360.0\nsamples  = 181",
                    "joint = \"B0\"\nfrom_deg = " + std::to_string(dead + 30) +
                        "\nto_deg = " + std::to_string(end) + "\nsamples = 31");
  };
  const study::Result r = run_text(swing(dead + 0.02));
  EXPECT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_THAT(lines_of(r.diagnostics), HasSubstr("the transmission angle of crank + coupler falls to"));
  EXPECT_THAT(lines_of(r.diagnostics), HasSubstr("of 2000 random linkages do not assemble everywhere; at "));
  EXPECT_THAT(lines_of(r.diagnostics),
              HasSubstr("coupler.P: the errors of the random linkages differ from the linear theory at "));
  EXPECT_LT(column(r, "errors", "assembled").back(), 2000);
  EXPECT_EQ(column(r, "errors", "assembled").front(), 2000);
  // Linkages that do not assemble everywhere are beyond every limit, and no share of 99 % is reported.
  EXPECT_THAT(to_string(r.headline), ::testing::Not(HasSubstr("99 %")));
  EXPECT_EQ(r.statistics.find("coupler_P_99_percent_m"), nullptr);
  // Beyond it there is nothing, and the rest is kept.
  const study::Result beyond = run_text(swing(dead - 2));
  EXPECT_EQ(beyond.status, Status::no_assembly);
  EXPECT_THAT(lines_of(beyond.diagnostics), HasSubstr("have no answer: the linkage does not assemble there"));
  EXPECT_TRUE(std::isnan(column(beyond, "errors", "coupler_P_worst_m").back()));
  EXPECT_FALSE(std::isnan(column(beyond, "errors", "coupler_P_worst_m").front()));
  EXPECT_EQ(table(beyond, "errors").status.back(), "no_assembly");
}

TEST(ToleranceStudy, KeepsTheLinearTheoryWhenItIsStopped) {
  std::string text;
  const auto prepared = prepare(four_bar(), text);
  ASSERT_TRUE(prepared) << text;
  RunContext context;
  context.cancel();
  const study::Result r = study::run_study(*prepared, context);
  EXPECT_EQ(r.status, Status::cancelled);
  EXPECT_THAT(lines_of(r.diagnostics), HasSubstr("only 0 of 2000 random linkages were drawn (cancelled)"));
  EXPECT_THAT(to_string(r.headline),
              "coupler.P deviates by at most 0.143 mm (worst case, at 0°); 46 % of the worst case comes from "
              "pin A.");
  EXPECT_TRUE(std::isnan(column(r, "errors", "coupler_P_drawn_m")[0]));
}

TEST(ToleranceStudy, InterruptedTellsTheSamplesSoFar) {
  const LooksAllowed looks(1);
  const study::Result r = run_text(replaced(four_bar(), "samples  = 181", "samples  = 20000"));
  EXPECT_EQ(r.status, Status::cancelled);
  const Table& errors = table(r, "errors");
  EXPECT_GT(errors.rows(), 100U);
  EXPECT_LE(errors.rows(), 2048U);
  EXPECT_TRUE(std::isfinite(column(r, "errors", "coupler_P_worst_m").back()));
  EXPECT_EQ(table(r, "band").rows(), errors.rows());
}

TEST(ToleranceStudy, RefusesWhatHasNoRoom) {
  const MemoryLimit limit(20e6);
  EXPECT_THAT(problems_of(replaced(four_bar(), "samples  = 181", "samples  = 100000")),
              ::testing::AllOf(
                  HasSubstr("sweep.samples: 100000 samples of 3 tolerances and 2 quantities would take "),
                  HasSubstr("at most 20 MB may be taken; take fewer samples, or watch less")));
  EXPECT_THAT(problems_of(replaced(four_bar(), "draws = 2000", "draws = 100000")),
              ::testing::AllOf(HasSubstr("monte_carlo.draws: 100000 draws of 2 quantities would take "),
                               HasSubstr("at most 20 MB may be taken; take fewer draws, or watch less")));
}

// Several inputs, and a canned linkage with its traces.
TEST(ToleranceStudy, GridsOfSeveralInputs) {
  const study::Result r = run_text(R"(schema = 1
kind = "analysis"
[mechanism]
type = "clearance.linkage"
sample = "geared_five_bar"
[sweep]
type = "grid"
[[sweep.input]]
from_deg = 0.0
to_deg = 90.0
samples = 4
[[clearance]]
joint = "P"
clearance_mm = 0.1
[monte_carlo]
draws = 100
)");
  EXPECT_EQ(r.status, Status::done) << lines_of(r.diagnostics);
  EXPECT_EQ(table(r, "errors").rows(), 4u);
  const study::Result arm = run_text(R"(schema = 1
kind = "analysis"
[mechanism]
type = "clearance.linkage"
sample = "arm"
sample_count = 2
[sweep]
type = "grid"
[[sweep.input]]
joint = "joint 1"
from_deg = 0.0
to_deg = 90.0
samples = 3
[[sweep.input]]
joint = "joint 2"
from_deg = 10.0
to_deg = 100.0
samples = 4
[[clearance]]
joint = "joint 2"
clearance_mm = 0.1
[monte_carlo]
draws = 100
)");
  EXPECT_EQ(arm.status, Status::done) << lines_of(arm.diagnostics);
  EXPECT_EQ(table(arm, "errors").rows(), 12u);
  EXPECT_EQ(arm.scenes[0].input.size(), 4u);
  // A clearance at the elbow shifts the hand by as much.
  EXPECT_THAT(table(arm, "errors").columns[2].values, Each(::testing::DoubleNear(1e-4, 1e-12)));
}

TEST(ToleranceStudy, WritesWhatItReads) {
  for (const std::string& text : {four_bar(), example_text("tolerances-slider-crank.toml")}) {
    std::string problems;
    const auto first = prepare(text, problems);
    ASSERT_TRUE(first) << problems;
    const std::string written = study::to_toml(first->canonical);
    const auto again = prepare(written, problems);
    ASSERT_TRUE(again) << problems << written;
    EXPECT_EQ(study::to_toml(again->canonical), written);
  }
}

TEST(ToleranceStudy, NamesWhatIsWrong) {
  const auto problem = [](const std::string& what, const std::string& by) {
    return problems_of(replaced(four_bar(), what, by));
  };
  EXPECT_THAT(problem("clearance_mm = 0.05  ", "clearance_mm = -0.05"),
              HasSubstr("clearance[0].clearance_mm: is -0.05 mm, must be more than 0 mm"));
  EXPECT_THAT(problem("clearance_mm = 0.05  ", "clearance_mm = 30.0"),
              HasSubstr("clearance_mm: 30 mm is more than half of the link 'crank', 50 mm"));
  EXPECT_THAT(problem("joint        = \"A\"", "joint = \"AA\""), HasSubstr("there is no joint 'AA'"));
  EXPECT_THAT(problem("joint        = \"A\"", "joint = \"B\""), HasSubstr("joint 'B' is given twice"));
  EXPECT_THAT(problem("body         = \"coupler\"", "body = \"couple\""),
              HasSubstr("there is no body 'couple'; did you mean 'coupler'?"));
  EXPECT_THAT(problem("to           = \"B\"", "to = \"C\""), HasSubstr("body 'coupler' has no point 'C'"));
  EXPECT_THAT(problem("to           = \"B\"", "to = \"A\""),
              HasSubstr("are at one place: they have no distance"));
  EXPECT_THAT(problem("tolerance_mm = 0.1", "tolerance_mm = 90.0"),
              HasSubstr("90 mm is more than half of the length, 160 mm"));
  EXPECT_THAT(problem("tolerance_mm = 0.1",
                      "tolerance_mm = 0.1\n[[tolerance]]\nbody = \"coupler\"\nfrom = \"B\"\nto = "
                      "\"A\"\ntolerance_mm = 0.1"),
              HasSubstr("the length from 'B' to 'A' of body 'coupler' is given twice"));
  EXPECT_THAT(problem("point = \"coupler.P\"", "point = \"coupler.Q\""),
              HasSubstr("there is no point 'coupler.Q'"));
  EXPECT_THAT(problem("coordinates = [\"B0\"]", "coordinates = [\"O\"]"),
              HasSubstr("joint 'O' is driven: its coordinate is given"));
  EXPECT_THAT(problem("coordinates = [\"B0\"]", "coordinates = [\"BO\"]"),
              HasSubstr("watch.coordinates: there is no joint 'BO'"));
  EXPECT_THAT(
      problem("coordinates = [\"B0\"]", "forces = [\"A\"]"),
      HasSubstr("watch.forces: forces and torques need the mass of every body: 'crank', 'coupler', 'rocker' "
                "have none; give mass_kg, or watch coordinates and traced points only"));
  EXPECT_THAT(problem("draws = 2000", "draws = 0"),
              HasSubstr("monte_carlo.draws: is 0, must be at least 100"));
  EXPECT_THAT(problem("point    = \"coupler.P\"", "point = \"coupler.B\""),
              HasSubstr("'coupler.B' is not traced; add it as a [[trace]]"));
  EXPECT_THAT(problem("point    = \"coupler.P\"", "joint = \"A\""),
              HasSubstr("the coordinate of joint 'A' is not watched; add it to watch.coordinates"));
  EXPECT_THAT(problem("error_mm = 0.15", "error_deg = 0.15"),
              HasSubstr("limit[0].error_deg: is a length, but 'deg' is not a unit of it"));
  EXPECT_THAT(problem("type = \"grid\"", "type = \"grid\"\nat_change_point = \"smooth\""),
              HasSubstr("a linkage whose lengths deviate has no change points"));
  EXPECT_THAT(problem("[monte_carlo]", "[quality]\noutput_joint = \"B0\"\n[monte_carlo]"),
              HasSubstr("quality: belongs to the analysis of planar.linkage"));
  const std::string slider = example_text("tolerances-slider-crank.toml");
  EXPECT_THAT(problems_of(replaced(slider, "joint        = \"B\"", "joint = \"guide\"")),
              HasSubstr("joint 'guide' is prismatic; only revolute joints have clearance"));
  // Nothing deviates, nothing is looked at.
  std::string rigid = four_bar(), blind = four_bar();
  const auto from = rigid.find("# Clearance joints"), to = rigid.find("# What is reported");
  rigid.erase(from, to - from);
  EXPECT_THAT(problems_of(rigid),
              HasSubstr("no errors are given; add [[clearance]] tables for joint clearances"));
  const auto watched = blind.find("# What is reported");
  blind.erase(watched, blind.find("[monte_carlo]") - watched);
  EXPECT_THAT(problems_of(blind), HasSubstr("nothing is watched; add [[trace]] with a point"));
  // A file cut off behind the ground has no inputs, and so no sweep.
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"clearance.linkage\"\n"
                          "[[mechanism.body]]\nname = \"ground\"\npoints_mm = { O = [0, 0] }\n"),
              HasSubstr("sweep: this key is missing"));
}

}  // namespace
}  // namespace linkwright::clearance
