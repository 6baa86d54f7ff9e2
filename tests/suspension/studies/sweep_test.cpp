// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/sweep.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/core/looks.h"
#include "linkwright/core/memory.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/corner_columns.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::problems_of;
using test::racks;
using test::run_text;
using test::sample;
using test::sweep;
using test::table;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SweepStudy, TablesAGridAsTheLibrarySolvesIt) {
  const study::Result result = run_text(sample("5US", sweep + racks));
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  ASSERT_EQ(result.tables.at(0).rows(), 15U);
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const CornerPosition reference = reference_position(plan);
  for (std::size_t i = 0; i < 15; ++i) {
    const CornerInput input{column(result, "travel_m")[i], column(result, "rack_m")[i]};
    const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, input, reference);
    const WheelParameters wheel = wheel_parameters(plan, at);
    const CornerRow row{at, wheel, Driver::spring};
    // Another way to the same position: rounding.
    for (const CornerColumn& c : corner_columns()) {
      if (!why_missing(corner_sample("5US").suspension, c).empty()) {
        EXPECT_EQ(result.tables.at(0).find(c.key), nullptr) << c.key;
        continue;
      }
      EXPECT_NEAR(column(result, c.key)[i], value_of(c, row), 1e-9 * (1 + std::abs(value_of(c, row))))
          << c.key;
    }
    EXPECT_LE(column(result, "closure_residual_m")[i], 1e-11);
  }
  EXPECT_EQ(column(result, "rack_m").front(), -0.03);
  EXPECT_EQ(column(result, "travel_m")[1], -0.04);
}

TEST(SweepStudy, KeepsToTheQuantitiesThatAreAskedFor) {
  const study::Result result =
      run_text(sample("5US", sweep + "[output]\nquantities = [\"toe\", \"track\"]\n"));
  std::vector<std::string> keys;
  for (const Column& c : result.tables.at(0).columns) keys.push_back(c.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"travel_m", "rack_m", "toe_rad", "half_track_change_m", "track_m",
                                            "closure_residual_m"}));
}

TEST(SweepStudy, ToldLimitsAreWhereRowsEnd) {
  const study::Result whole = run_text(sample("SP-3US", sweep));
  const double highest = whole.tables.at(1).find("highest_travel_m")->values.at(0) * 1e3;
  const std::string to = fmt::format("{:.3f}", highest - 1), beyond = fmt::format("{:.3f}", highest + 1);
  const study::Result result =
      run_text(sample("SP-3US", "[sweep.travel]\nvalues_mm = [0, " + to + ", " + beyond + "]\n"));
  EXPECT_EQ(result.status, Status::no_assembly);
  EXPECT_EQ(result.tables.at(0).status, (std::vector<std::string>{"done", "done", "no_assembly"}));
  EXPECT_TRUE(std::isnan(column(result, "toe_rad").at(2)));
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_THAT(to_string(result.diagnostics[0]),
              AllOf(HasSubstr("rack 0 mm: no_assembly: the height of the wheel centre "),
                    HasSubstr("cannot pass"), HasSubstr("1.000 mm short of")));
}

TEST(SweepStudy, RowsThatAreNotReachedHaveNoExtremes) {
  const study::Result result = run_text(sample("SP-3US", "[sweep.travel]\nvalues_mm = [500, 600]\n"));
  EXPECT_EQ(result.status, Status::no_assembly);
  for (const study::Fact& f : result.facts)
    EXPECT_THAT(to_string(f.label), Not(HasSubstr("over the travel")));
}

TEST(SweepStudy, TellsToeAtTheRimAsALength) {
  const std::string wheel = R"(
[mechanism]
type = "suspension.corner"

[mechanism.wheel]
centre_m         = [0, 0.76, 0]
toe_deg          = 0.5
tyre_diameter_mm = 640
rim_diameter_mm  = 400

[[mechanism.link]]
name      = "arm"
type      = "R"
body_mm   = [[200, 300, 0], [-200, 320, 20]]
)";
  const std::string text = "schema = 1\nkind = \"analysis\"\n" + wheel + sweep;
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const std::vector<double>&toe = column(result, "toe_rad"), &at_rim = column(result, "toe_at_rim_m");
  const Table* bump = result.table("bump");
  ASSERT_NE(bump, nullptr);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(at_rim[i], 0.4 * std::sin(toe[i]));
    EXPECT_DOUBLE_EQ(bump->find("toe_change_at_rim_m")->values[i], at_rim[i] - at_rim[2]);
  }
  EXPECT_NEAR(at_rim[2], 0.4 * std::sin(pi / 360), 1e-12);
  EXPECT_EQ(problems_of(test::replaced(text, "rim_diameter_mm  = 400", "rim_diameter_mm = 700")),
            "study.toml:11:19: error: mechanism.wheel.rim_diameter_mm: is 700 mm, larger than the tyre with "
            "640 mm\n");
}

TEST(SweepStudy, TablesBumpSteerWithTheRackInItsMiddle) {
  const study::Result result = run_text(sample("5US", sweep + racks));
  const Table* bump = result.table("bump");
  ASSERT_NE(bump, nullptr);
  ASSERT_EQ(bump->rows(), 5U);
  const std::vector<double>&toe = column(result, "toe_rad"), &camber = column(result, "camber_rad"),
        &travel = column(result, "travel_m");
  for (std::size_t i = 0; i < 5; ++i) {  // the second of three racks is 0, the third of five travels, too
    EXPECT_EQ(bump->find("travel_m")->values[i], travel[5 + i]);
    EXPECT_EQ(bump->find("toe_change_rad")->values[i], toe[5 + i] - toe[7]);
    EXPECT_EQ(bump->find("camber_change_rad")->values[i], camber[5 + i] - camber[7]);
  }
  EXPECT_EQ(travel[7], 0);
  ASSERT_GE(result.plots.size(), 2U);
  EXPECT_EQ(result.plots[0].title, "Bump steer: change of toe from static, rack 0 mm");
  EXPECT_EQ(result.plots[1].title, "Change of camber from static, rack 0 mm");
  EXPECT_TRUE(result.plots[0].upright && result.plots[1].upright && !result.plots[2].upright);
  EXPECT_EQ(run_text(sample("5US", sweep + "[output]\nquantities = [\"track\"]\n")).table("bump"), nullptr);
}

TEST(SweepStudy, LaysAnotherCornerBehindTheCurves) {
  const std::string text = sample("2RS-US", sweep) + "[baseline.mechanism]\nsample = \"RS-SP-US\"\n";
  const study::Result result = run_text(text), other = run_text(sample("RS-SP-US", sweep));
  const auto baseline = std::find_if(result.tables.begin(), result.tables.end(),
                                     [](const Table& t) { return t.name == "baseline"; });
  ASSERT_NE(baseline, result.tables.end());
  EXPECT_EQ(baseline->find("toe_rad")->values, column(other, "toe_rad"));
  for (const study::Plot& plot : result.plots)
    EXPECT_EQ(plot.baseline, plot.table == "bump" ? "baseline bump" : "baseline") << plot.name;
  // From the study that it stands in, too.
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_sweep_study";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "before.toml") << sample("RS-SP-US", sweep);
  const study::Result read =
      run_text(sample("2RS-US", sweep) + "[baseline]\nfile = \"before.toml\"\n", folder);
  EXPECT_EQ(read.tables.at(0).find("toe_rad")->values, column(result, "toe_rad"));
  std::filesystem::remove_all(folder);
  EXPECT_THAT(problems_of(sample("2RS-US", sweep) + "[baseline]\nfile = \"nowhere.toml\"\n"),
              HasSubstr("baseline.file: ./nowhere.toml: there is no such file"));
  EXPECT_THAT(problems_of(sample("2RS-US", sweep) + "[baseline]\n"),
              HasSubstr("baseline.file: the baseline is missing"));
}

TEST(SweepStudy, ListsOtherAssemblies) {
  const study::Result result = run_text(sample("R", "[sweep]\nassemblies = true\n" + sweep));
  const auto table = std::find_if(result.tables.begin(), result.tables.end(),
                                  [](const Table& t) { return t.name == "assemblies"; });
  ASSERT_NE(table, result.tables.end());
  EXPECT_EQ(table->rows(), 2U);
}

TEST(SweepStudy, SteersAboutTheAxisThatIsAskedFor) {
  const auto caster = [&](const std::string& lock) {
    return run_text(sample("2RS-US", "[sweep]\n" + lock + "[sweep.travel]\nvalues_mm = [0]\n"))
        .tables.at(0)
        .find("caster_rad")
        ->values.at(0);
  };
  // Specified for this double wishbone: 4.970 deg through both ball joints, 4.715 deg with the height held.
  EXPECT_NEAR(caster("") * 180 / M_PI, 4.970, 6e-4);
  EXPECT_NEAR(caster("steering_lock = \"wheel_centre_z\"\n") * 180 / M_PI, 4.715, 6e-4);
}

TEST(SweepStudy, TellsOtherDefinitionsBesideItsOwn) {
  const study::Result result = run_text(sample("2RS-US", "[sweep.travel]\nvalues_mm = [0]\n"));
  EXPECT_NEAR(column(result, "geometric_caster_rad").at(0), column(result, "caster_rad").at(0), 1e-12);
  EXPECT_NEAR(column(result, "contact_held_caster_rad").at(0),
              run_text(sample("2RS-US",
                              "[sweep]\nsteering_lock = \"contact_z\"\n"
                              "[sweep.travel]\nvalues_mm = [0]\n"))
                  .tables.at(0)
                  .find("caster_rad")
                  ->values.at(0),
              1e-15);
  EXPECT_NEAR(column(result, "arm_roll_centre_height_m").at(0), 0.180847126051839, 1e-12);
  EXPECT_NE(column(result, "front_view_camber_rad").at(0), column(result, "camber_rad").at(0));
  EXPECT_TRUE(result.diagnostics.empty());
}

TEST(SweepStudy, TellsWhyAQuantityHasNoValues) {
  const std::string quantities = "[output]\nquantities = [\"geometric_axis\", \"arm_planes\", \"spring\"]\n";
  const study::Result result = run_text(sample("front_5US", sweep + quantities));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_TRUE(std::isnan(column(result, "geometric_caster_rad").at(0)));
  ASSERT_EQ(result.diagnostics.size(), 3U);
  EXPECT_EQ(result.diagnostics[0].key, "output.quantities");
  EXPECT_THAT(to_string(result.diagnostics[0]), HasSubstr("'spring' has no values: there is no spring"));
  EXPECT_THAT(to_string(result.diagnostics[1]),
              HasSubstr("'geometric_axis' has no values: no ball joint holds the carrier"));
  EXPECT_THAT(to_string(result.diagnostics[2]), HasSubstr("'arm_planes' has no values: no link is an arm"));
  EXPECT_THAT(
      problems_of(sample("front_5US", sweep + "[sensitivity]\nquantities = [\"geometric_caster\"]\n")),
      HasSubstr("sensitivity.quantities: this suspension has no 'geometric_caster': no ball joint"));
}

TEST(SweepStudyRead, NamesWhatIsWrongWithTheSweep) {
  EXPECT_THAT(problems_of(sample("front_5US", "[sweep.travel]\ncoordinate = \"spring\"\nvalues_mm = [0]\n")),
              HasSubstr("sweep.travel.coordinate: there is no spring"));
  EXPECT_THAT(problems_of(sample("R", sweep + racks)), HasSubstr("sweep.rack: no link is moved by the rack"));
}

TEST(SolveGrid, GoesOutwardsAndStopsWhenCancelled) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  const std::vector<double> travels{-0.05, 0, 0.05}, displacements{-0.02, 0.02};
  RunContext context;
  EXPECT_EQ(solve_grid(plan, Driver::wheel_centre_z, travels, displacements, &context).positions.size(), 6U);
  RunContext cancelled;
  cancelled.cancel();
  EXPECT_TRUE(solve_grid(plan, Driver::wheel_centre_z, travels, displacements, &cancelled).positions.empty());
}

TEST(SolveGrid, LooksWithinALongRowAndKeepsItsMiddle) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  std::vector<double> travels;
  for (int i = 0; i < 10000; ++i) travels.push_back(1e-5 * (i - 300));
  RunContext context;
  const LooksAllowed looks(2);  // one at the rack, one after 256 positions; the next one ends it
  const GridPositions some =
      solve_grid(plan, Driver::wheel_centre_z, travels, std::vector{0.0, 0.01}, &context);
  // Downwards from the middle, all 300, and then upwards.
  EXPECT_EQ(some.first_travel, 0U);
  ASSERT_EQ(some.travels, 512U);
  ASSERT_EQ(some.positions.size(), some.travels);
  ASSERT_EQ(some.wheels.size(), some.travels);
  for (std::size_t i = 0; i < some.travels; ++i) EXPECT_EQ(some.positions[i].input.value, travels[i]);
}

TEST(SolveGrid, ARackThatWasCutShortDoesNotCountBehindAWholeOne) {
  const CornerPlan plan = prepare_suspension(corner_sample("5US").suspension);
  std::vector<double> travels;
  for (int i = 0; i < 300; ++i) travels.push_back(1e-5 * i);
  RunContext context;
  const LooksAllowed looks(3);  // at both racks and after 256 positions: ended by that after 512
  const GridPositions some =
      solve_grid(plan, Driver::wheel_centre_z, travels, std::vector{0.0, 0.01}, &context);
  EXPECT_EQ(some.travels, 300U);
  EXPECT_EQ(some.positions.size(), 300U);
}

TEST(SweepStudy, InterruptedTellsThePositionsSoFar) {
  const std::string text = sample("2RS-US", "[sweep.travel]\nfrom_mm = -50\nto_mm = 50\nstep_mm = 0.05\n") +
                           "[axle.roll]\nfrom_deg = -3\nto_deg = 3\nstep_deg = 0.01\n";
  const auto run = [&](std::int64_t allowed) {
    const LooksAllowed looks(allowed);
    return run_text(text);
  };
  // In the row: what it has of it is consistent, and is what an undisturbed run has there.
  const study::Result whole = run_text(text), some = run(2);
  EXPECT_EQ(some.status, Status::cancelled);
  const std::vector<double>&travels = column(some, "travel_m"), &toe = column(some, "toe_rad");
  ASSERT_EQ(travels.size(), 512U);
  const std::vector<double>& all = column(whole, "travel_m");
  const auto first = std::find(all.begin(), all.end(), travels.front()) - all.begin();
  for (std::size_t i = 0; i < travels.size(); ++i)
    EXPECT_EQ(toe[i], column(whole, "toe_rad")[static_cast<std::size_t>(first) + i]);
  // In the roll of the axle: the sweep is whole, the roll is not.
  const study::Result rolled = run(12);
  EXPECT_EQ(rolled.status, Status::cancelled);
  EXPECT_EQ(column(rolled, "travel_m").size(), all.size());
  EXPECT_LT(table(rolled, "roll").rows(), table(whole, "roll").rows());
  EXPECT_EQ(table(rolled, "roll").rows() % 64, 0U);
}

TEST(SweepStudyRead, RefusesWhatHasNoRoom) {
  const MemoryLimit limit(10e6);
  EXPECT_THAT(problems_of(sample("2RS-US", "[sweep.travel]\nfrom_mm = -80\nto_mm = 80\nsamples = 50000\n")),
              AllOf(HasSubstr("sweep.travel: 50000 travels with 1 racks would take "),
                    HasSubstr("of memory, at most 10 MB may be taken; take fewer travels or racks")));
  const std::string short_sweep = "[sweep.travel]\nvalues_mm = [0]\n";
  EXPECT_THAT(problems_of(sample("2RS-US", short_sweep) +
                          "[axle.roll]\nfrom_deg = -3\nto_deg = 3\nsamples = 50000\n"),
              AllOf(HasSubstr("axle.roll: 50000 positions of the axle would take "),
                    HasSubstr("at most 10 MB may be taken; take fewer values")));
}

}  // namespace
}  // namespace linkwright::suspension
