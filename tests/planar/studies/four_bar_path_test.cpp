// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/four_bar_path.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::column;
using test::prepare;
using test::problems_of;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* head = R"(schema = 1
kind = "synthesis"
title = "test"
[mechanism]
type = "planar.four_bar"
)";
constexpr const char* square = "points_m = [[0, 0], [1, 0], [1, 1], [0, 1]]\n";

std::string target(const std::string& lines) {
  return std::string(head) + "[target]\ntype = \"path_points\"\n" + lines;
}

// The schema lists the keys of all methods; that of another method is in the right table already.
TEST(PathStudyRead, AKeyOfAnotherMethodIsUnknown) {
  EXPECT_THAT(problems_of(target(square) + "[optimiser]\nmethod = \"grey_wolf\"\ncrossover = 0.5\n"),
              HasSubstr("optimiser.crossover: unknown key; allowed here: seeds, seed, method, population"));
}

TEST(PathStudyRead, NamesWhatIsWrongWithThePoints) {
  EXPECT_THAT(problems_of(target("")),
              HasSubstr("the target has no points; write points_m = [[x, y], ...] or points_file"));
  EXPECT_THAT(problems_of(target("points_m = []\n")),
              HasSubstr("there are no points; give at least 3 points"));
  EXPECT_THAT(
      problems_of(target("points_m = [[0, 0], [1, 0]]\n")),
      HasSubstr("study.toml:8:12: error: target.points_m: 2 points make no path, at least 3 are needed"));
  EXPECT_THAT(problems_of(target("points_m = [[0, 0], [1, 0], [1, 0], [2, 1]]\n")),
              HasSubstr("point 3 repeats point 2: (1, 0)"));
  EXPECT_THAT(problems_of(target("points_m = [[0, 0], [1, 0], [1, nan]]\n")),
              HasSubstr("target.points_m[2][1]: is nan, must be a finite number"));
  EXPECT_THAT(problems_of(target("points_m = [[0, 0], [1, 0], [1]]\n")),
              HasSubstr("target.points_m[2]: has 1 numbers, must have 2"));
  EXPECT_THAT(problems_of(target(std::string(square) + "points_file = \"p.csv\"\n")),
              HasSubstr("both points and points_file"));
  EXPECT_THAT(problems_of(target("points_file = \"nowhere.csv\"\n")),
              HasSubstr("cannot read './nowhere.csv'"));
}

TEST(PathStudyRead, TimingMustFit) {
  EXPECT_THAT(problems_of(target(std::string(square) + "timing = { mode = \"increments\" }\n")),
              HasSubstr("increments needs increments_deg, one from each point to the next"));
  EXPECT_THAT(problems_of(target(std::string(square) +
                                 "timing = { mode = \"increments\", increments_deg = [1, 2, 3, 4] }\n")),
              HasSubstr("4 increments for 4 points; give 3: the crank rotation from each point to the next"));
  EXPECT_THAT(problems_of(target(std::string(square) +
                                 "timing = { mode = \"given\", increments_deg = [1, 2, 3] }\n")),
              HasSubstr("increments go with mode increments, the mode is given"));
  std::string messages;
  EXPECT_TRUE(prepare(
      target(std::string(square) + "timing = { mode = \"increments\", increments_deg = [80, 90, 100] }\n"),
      messages))
      << messages;
  EXPECT_THAT(problems_of(target(std::string(square) + "timing = { mode = \"equal_steps\" }\n")),
              HasSubstr("equal_steps needs step_deg"));
  EXPECT_THAT(
      problems_of(target(std::string(square) + "timing = { mode = \"given\", angles_deg = [1, 2, 3] }\n")),
      HasSubstr("3 angles for 4 points"));
  EXPECT_THAT(problems_of(target(std::string(square) + "timing = { mode = \"free\", step_deg = 10 }\n")),
              HasSubstr("step is for mode equal_steps, the mode is free"));
  EXPECT_THAT(
      problems_of(target(std::string(square) + "timing = { mode = \"equal_step\", step_deg = 10 }\n")),
      HasSubstr("target.timing.mode: is 'equal_step', must be one of: free, "));
  EXPECT_THAT(
      problems_of(target(std::string(square) + "timing = { mode = \"equal_steps\", step_deg = 400 }\n")),
      HasSubstr("the step is 400 deg, it must not be zero nor more than a turn"));
}

TEST(PathStudyRead, TellsAtOnceWhatCannotBeRead) {
  const std::string text = target("points_m = [[0, 0], [1, 0]]\ntimming = { mode = \"free\" }\n") +
                           "[optimiser]\nmethod = \"grey_wulf\"\n";
  const std::string messages = problems_of(text);
  // What the points mean may follow from that.
  EXPECT_THAT(messages, Not(HasSubstr("2 points make no path")));
  EXPECT_THAT(messages, HasSubstr("target.timming: unknown key; did you mean 'timing'?"));
  EXPECT_THAT(messages, HasSubstr("is 'grey_wulf', must be one of: recommended, "));
  EXPECT_THAT(messages, HasSubstr("did you mean 'grey_wolf'?"));
}

TEST(PathStudyRead, ParametersNeedUnitsAndOrder) {
  const std::string parameters = "[mechanism.parameters]\n";
  const std::string rest = std::string("[target]\ntype = \"path_points\"\n") + square;
  EXPECT_THAT(problems_of(head + parameters + "crank = 1.0\n" + rest),
              HasSubstr("mechanism.parameters.crank: the unit is missing; write crank_m"));
  EXPECT_THAT(problems_of(head + parameters + "crank_m = 1.0\ncrank_mm = 10\n" + rest),
              HasSubstr("mechanism.parameters.crank_mm: is given twice, as crank_m and"));
  EXPECT_THAT(problems_of(head + parameters + "crank_m = { min = 2, max = 1 }\n" + rest),
              HasSubstr("crank_m: min is 2 m, larger than max, which is 1 m"));
  EXPECT_THAT(problems_of(head + parameters + "crank_m = { min = 0, max = inf }\n" + rest),
              HasSubstr("crank_m.max: is inf, must be a finite number"));
  EXPECT_THAT(problems_of(head + parameters + "crnk_m = 1\n" + rest), HasSubstr("did you mean 'crank_m'"));
  EXPECT_THAT(problems_of(head + parameters + "crank_m = -1\n" + rest),
              HasSubstr("crank_m: is -1 m, must be at least 0 m"));
}

TEST(PathStudyRead, ConstraintsAreReadByType) {
  const std::string path = target(std::string("closed = true\n") + square);
  std::string messages;
  EXPECT_TRUE(prepare(path + "[[constraint]]\ntype = \"order\"\n[[constraint]]\ntype = \"packaging\"\n"
                             "x_mm = { min = -500, max = 500 }\ny_m = { min = 0, max = 1 }\n",
                      messages))
      << messages;
  EXPECT_THAT(problems_of(path + "[[constraint]]\ntype = \"order\"\nenabled = false\n"),
              HasSubstr("the order of the points cannot be given up"));
  EXPECT_THAT(problems_of(path + "[[constraint]]\ntype = \"transmission_angle\"\n"),
              HasSubstr("constraint[0].min_rad: this key is missing"));
  EXPECT_THAT(problems_of(path + "[[constraint]]\ntype = \"transmission_angle\"\nmin_deg = 100\n"),
              HasSubstr("constraint[0].min_deg: is 100 deg, must be at most 90 deg"));
  EXPECT_THAT(
      problems_of(path + "[[constraint]]\ntype = \"packaging\"\nx_m = 1.0\ny_m = { min = 0, max = 1 }\n"),
      HasSubstr("the packaging box has no width"));
}

TEST(PathStudyRead, ReadsPointsFromCsvInAnyLengthUnit) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "linkwright_path_study_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "path.csv") << "x_mm,y_mm\n0,0\n100,0\n100,50\n0,50\n";
  std::ofstream(folder / "bad.csv") << "x_mm,z_mm\n0,0\n";
  std::string messages;
  const auto study = prepare(target("points_file = \"path.csv\"\n"), messages, folder);
  ASSERT_TRUE(study) << messages;
  EXPECT_EQ(study->canonical.find("target")->find("points_m")->as_array()[2].as_array()[1].as_number(), 0.05);
  EXPECT_EQ(study->canonical.find("target")->find("points_file"), nullptr);
  EXPECT_FALSE(prepare(target("points_file = \"bad.csv\"\n"), messages, folder));
  EXPECT_THAT(
      messages,
      HasSubstr("'bad.csv' has the columns x_mm, z_mm, but needs x, y, each with a unit of length; name them "
                "x_mm,y_mm; a heading like X [mm] will do, too"));
  std::filesystem::remove_all(folder);
}

TEST(PathStudyRead, DerivesBoundsFromThePath) {
  std::string messages;
  const auto study = prepare(target(square), messages);
  ASSERT_TRUE(study) << messages;
  const Value& crank = *study->canonical.find("mechanism")->find("parameters")->find("crank_m");
  EXPECT_NEAR(crank.find("max")->as_number(), 50 * std::sqrt(2.0), 1e-9);
}

TEST(PathStudyRead, ItsExampleReads) {
  std::string messages;
  EXPECT_TRUE(prepare(four_bar_path_kind().example, messages)) << messages;
}

TEST(PathStudyRun, AnswersWithEvidence) {
  std::string messages;
  const auto study = prepare(
      target(std::string("closed = true\ntiming = { mode = \"equal_steps\", step_deg = 90 }\n") + square) +
          "[optimiser]\nmethod = \"recommended\"\nseeds = { first = 3, count = 2 }\n",
      messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::done);
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_NEAR(result.solutions[0].objectives.find("path_error_sum_sq_m2")->as_number(), 0,
              1e-9);  // four points can be met
  EXPECT_EQ(result.scenes.size(), result.solutions.size());
  EXPECT_EQ(result.statistics.find("seeds")->as_integer(), 2);
  EXPECT_EQ(result.log.as_array().size(), 2u);
  EXPECT_TRUE(result.comparisons.empty());
}

TEST(PathStudyRun, PopulationMethodsReportWhatTheyReach) {
  for (const char* method : {"grey_wolf", "differential_evolution", "self_adaptive_differential_evolution",
                             "jade", "particle_swarm", "firefly", "cuckoo_search", "hybrid_cuckoo_firefly",
                             "subpopulation_firefly", "cma_es"}) {
    std::string messages;
    const auto study = prepare(
        target(std::string("closed = true\ntiming = { mode = \"equal_steps\", step_deg = 90 }\n") + square) +
            "[optimiser]\nmethod = \"" + method +
            "\"\npopulation = 20\ngenerations = 30\nseeds = { first = 1, count = 3 }\n",
        messages);
    ASSERT_TRUE(study) << messages;
    RunContext context;
    const study::Result result = study::run_study(*study, context);
    // Generations of fireflies and cuckoos are larger than their population.
    const std::string_view name = method;
    const bool swarm = name.ends_with("firefly") || name == "cuckoo_search";
    EXPECT_EQ(result.statistics.find("evaluations")->as_integer() > 3 * 20 * 30, swarm) << method;
    EXPECT_GE(result.statistics.find("evaluations")->as_integer(), 3 * 20 * 30) << method;
    EXPECT_EQ(result.statistics.find("method")->as_string(), method);
  }
}

// The published setting (30 wolves, 50 generations, bounds of Eq. (4.30)) never comes near the published
// 0.00908: 200 seeds of an independent implementation gave best 0.203 and median 2.77. The median of 60 seeds
// scatters by about a quarter.
TEST(PathStudyRun, GreyWolfAsPublishedDoesNotReachThePublishedError) {
  const std::filesystem::path file = test::example_path("fourbar-18-points-grey-wolf.toml");
  Diagnostics diagnostics;
  Value document = study::read_file(file, diagnostics);
  document["optimiser"]["seeds"]["count"] = 60;
  const std::vector<study::Kind> kinds = studies();
  const auto study = study::prepare(document, file.string(), file.parent_path(), kinds, diagnostics);
  ASSERT_TRUE(study);
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.statistics.find("evaluations")->as_integer(), 60 * 30 * 50);
  EXPECT_GT(result.statistics.find("best")->as_number(), 0.0092);
  EXPECT_GT(result.statistics.find("median")->as_number(), 1.4);
  EXPECT_LT(result.statistics.find("median")->as_number(), 5.5);
  bool told = false;
  for (const study::Comparison& c : result.comparisons) told = told || c.verdict == "not reached";
  EXPECT_TRUE(told);
}

TEST(PathStudyRun, CancelledRunKeepsWhatItHas) {
  std::string messages;
  const auto study = prepare(
      target(std::string("closed = true\n") + square) + "[optimiser]\nseeds = { first = 1, count = 4 }\n",
      messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  context.set_time_limit(std::chrono::milliseconds(1));
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::deadline);
  EXPECT_FALSE(result.headline.empty());
}

// ---- Closing points, gates, tolerances, the rocker pivot

TEST(PathStudyRead, APathThatEndsWhereItBeginsIsClosed) {
  const std::string points = "points_m = [[0, 0], [1, 0], [1, 1], [0, 0]]\n";
  std::string messages;
  const auto read = [&](const std::string& lines) { return prepare(target(lines), messages)->canonical; };
  const auto closed = [&](const Value& study) { return study.find("target")->find("closed")->as_bool(); };
  const auto count = [&](const Value& study) {
    return study.find("target")->find("points_m")->as_array().size();
  };
  const Value said_nothing = read(points);
  EXPECT_TRUE(closed(said_nothing));
  EXPECT_EQ(count(said_nothing), 3u);
  EXPECT_THAT(messages,
              HasSubstr("the last of 4 points repeats the first: taken once, and the path as closed"));
  const Value said_closed = read("closed = true\n" + points);
  EXPECT_TRUE(closed(said_closed));
  EXPECT_EQ(count(said_closed), 3u);
  const Value said_open = read("closed = false\n" + points);
  EXPECT_FALSE(closed(said_open));
  EXPECT_EQ(count(said_open), 4u);
  // Prescribed angles that come round close the path, others do not.
  const Value round = read("timing = { mode = \"given\", angles_deg = [10, 130, 250, 370] }\n" + points);
  EXPECT_TRUE(closed(round));
  EXPECT_EQ(round.find("target")->find("timing")->find("angles_rad")->as_array().size(), 3u);
  EXPECT_FALSE(closed(read("timing = { mode = \"equal_steps\", step_deg = 30 }\n" + points)));
  EXPECT_TRUE(closed(read("timing = { mode = \"equal_steps\", step_deg = -120 }\n" + points)));
}

TEST(PathStudyRead, GatesAndTolerancesSayWhatIsWrong) {
  const std::string gates =
      "gates_mm = [{ from = [0, 0], to = [0, 10] }, { from = [5, 0], to = [5, 10] }, "
      "{ from = [9, 5], to = [9, 5] }]\n";
  std::string messages;
  const auto study = prepare(target(gates + "tolerances_mm = [0, 1, 2]\n"), messages);
  ASSERT_TRUE(study) << messages;
  const Value& gate = study->canonical.find("target")->find("gates_m")->as_array()[1];
  EXPECT_NEAR(gate.find("to")->as_array()[1].as_number(), 0.01, 1e-15);
  EXPECT_THAT(problems_of(target(gates + square)), HasSubstr("the target has both gates and points"));
  EXPECT_THAT(problems_of(target("gates_mm = [{ from = [0, 0] }]\n")),
              HasSubstr("target.gates_mm[0].to: this key is missing"));
  EXPECT_THAT(problems_of(target(gates + "tolerances_mm = [1, 2]\n")),
              HasSubstr("2 tolerances for 3 targets; give one for each, or tolerance for all"));
  EXPECT_THAT(problems_of(target(gates + "tolerance_mm = 1\ntolerances_mm = [1, 2, 3]\n")),
              HasSubstr("the target has both tolerance and tolerances"));
  EXPECT_THAT(problems_of(target(gates + "tolerance_mm = -1\n")),
              HasSubstr("target.tolerance_mm: is -1 mm, must be at least 0 mm"));
  EXPECT_THAT(problems_of(target("gates_mm = [{ from = [0, 0], to = [0, 1] }]\n")),
              HasSubstr("1 point makes no path"));
}

// Gates and tolerances as columns of the points file: the same study as with keys.
TEST(PathStudyRead, ReadsGatesAndTolerancesFromCsv) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "linkwright_path_bands_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "gates.csv") << "from_x_mm,from_y_mm,to_x_mm,to_y_mm,tolerance_mm\n"
                                         "0,0,0,10,0\n5,0,5,10,1\n9,5,9,5,2\n0,0,0,10,0\n";
  std::ofstream(folder / "bands.csv") << "x_mm,y_mm,tolerance_mm\n0,0,1\n5,0,2\n9,5,3\n";
  std::ofstream(folder / "half.csv") << "from_x_mm,from_y_mm,to_x_mm\n0,0,0\n5,0,5\n9,5,9\n";
  std::ofstream(folder / "both.csv") << "x_mm,y_mm,from_x_mm,from_y_mm,to_x_mm,to_y_mm\n0,0,0,0,0,1\n";
  std::ofstream(folder / "negative.csv") << "x_mm,y_mm,tolerance_mm\n0,0,1\n5,0,-2\n9,5,3\n";
  std::ofstream(folder / "gap.csv") << "x_mm,y_mm,tolerance_mm\n0,0,1\n5,,2\n9,5,3\n";
  const auto read = [&](const std::string& lines) {
    std::string messages;
    const auto study = prepare(target(lines), messages, folder);
    return std::pair(study ? *study->canonical.find("target") : Value(), messages);
  };
  const auto [gates, gate_messages] = read("points_file = \"gates.csv\"\n");
  ASSERT_TRUE(gates.is_object()) << gate_messages;
  // The closing gate is left out, with its tolerance.
  std::string ignored;
  EXPECT_THAT(gate_messages,
              HasSubstr("target.points_file: the last of 4 gates repeats the first: taken once"));
  const Value same =
      *prepare(target("closed = true\ngates_mm = [{ from = [0, 0], to = [0, 10] }, { from = [5, 0], "
                      "to = [5, 10] }, { from = [9, 5], to = [9, 5] }]\n"
                      "tolerances_mm = [0, 1, 2]\n"),
               ignored)
           ->canonical.find("target");
  ASSERT_EQ(gates.find("gates_m")->as_array().size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    for (const char* post : {"from", "to"})
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(gates.find("gates_m")->as_array()[k].find(post)->as_array()[i].as_number(),
                    same.find("gates_m")->as_array()[k].find(post)->as_array()[i].as_number(), 1e-15);
  EXPECT_EQ(*gates.find("tolerances_m"), *same.find("tolerances_m"));
  EXPECT_EQ(gates.find("points_m"), nullptr);
  EXPECT_EQ(read("points_file = \"bands.csv\"\n").first.find("tolerances_m")->as_array()[2].as_number(),
            0.003);
  EXPECT_THAT(
      read("points_file = \"bands.csv\"\ntolerance_mm = 1\n").second,
      HasSubstr("target.tolerance_mm: the points file also has tolerances; keep the key or the column"));
  EXPECT_THAT(read("points_file = \"half.csv\"\n").second,
              HasSubstr("'half.csv' has the columns from_x_mm, from_y_mm, to_x_mm, but needs from_x, from_y, "
                        "to_x, to_y, each with "
                        "a unit of length; name them from_x_mm,from_y_mm,to_x_mm,to_y_mm"));
  EXPECT_THAT(read("points_file = \"both.csv\"\n").second, HasSubstr("'both.csv' has both points and gates"));
  EXPECT_THAT(read("points_file = \"negative.csv\"\n").second,
              HasSubstr("the tolerance of point 2 is negative"));
  EXPECT_THAT(read("points_file = \"gap.csv\"\n").second,
              HasSubstr("'gap.csv': point 2 is incomplete; give it a number in column y_mm"));
  // A slider-crank reads the same targets.
  std::string messages;
  for (const char* file : {"gates.csv", "bands.csv"}) {
    const std::string lines = std::string("points_file = \"") + file + "\"\n";
    std::string slider = target(lines);
    slider.replace(slider.find("planar.four_bar"), 15, "planar.slider_crank");
    const auto study = prepare(slider, messages, folder);
    ASSERT_TRUE(study) << messages;
    const Value four_bar = read(lines).first;
    for (const char* key : {"points_m", "gates_m", "tolerances_m"}) {
      const Value *ours = four_bar.find(key), *its = study->canonical.find("target")->find(key);
      ASSERT_EQ(ours == nullptr, its == nullptr) << key;
      if (ours) {
        EXPECT_EQ(*ours, *its) << key;
      }
    }
  }
  std::filesystem::remove_all(folder);
}

// Five points of a four-bar's curve (crank-rocker, one arc), in mm.
constexpr const char* arc = "points_mm = [[0, 0], [100, 50], [200, 80], [300, 50], [400, 0]]\n";

TEST(PathStudyRun, MeetsGatesTolerancesAndTheRegionOfTheRockerPivot) {
  const std::string text =
      std::string(head) +
      "[mechanism.parameters]\nrocker_pivot_x_mm = { min = 100, max = 150 }\nrocker_pivot_y_mm = 300\n"
      "[target]\ntype = \"path_points\"\ntolerance_mm = 0.5\n"
      "gates_mm = [{ from = [0, -5], to = [0, 5] }, { from = [100, 40], to = [100, 60] }, "
      "{ from = [200, 60], to = [200, 90] }, { from = [300, 40], to = [300, 60] }, { from = [400, -5], to = "
      "[400, "
      "5] }]\n[optimiser]\nstarts = 20\n";
  std::string messages;
  const auto study = prepare(text, messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  ASSERT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr("passes the 5 gates within their tolerance"));
  EXPECT_EQ(test::fact(result, "worst point"), "none is beyond its tolerance");
  const auto value = [&](const char* key) {
    for (const study::Parameter& p : result.solutions[0].parameters)
      if (p.key == key) return p.value;
    return std::nan("");
  };
  const double x = value("pivot_x_m") + value("ground_m") * std::cos(value("frame_angle_rad"));
  const double y = value("pivot_y_m") + value("ground_m") * std::sin(value("frame_angle_rad"));
  EXPECT_GE(x, 0.1 - 1e-8);
  EXPECT_LE(x, 0.15 + 1e-8);
  EXPECT_NEAR(y, 0.3, 1e-8);
  // Independently of the search: where the tracing point is, against the gates and half a millimetre.
  const auto &found_x = column(result, "points", "x_m"), &found_y = column(result, "points", "y_m");
  ASSERT_GE(found_x.size(), 5u);
  const double middle_x[] = {0, 0.1, 0.2, 0.3, 0.4}, low[] = {-0.005, 0.04, 0.06, 0.04, -0.005},
               high[] = {0.005, 0.06, 0.09, 0.06, 0.005};
  for (std::size_t k = 0; k < 5; ++k) {
    const double px = found_x[k], py = found_y[k];
    const double beyond = std::max({0.0, low[k] - py, py - high[k]});
    EXPECT_LE(std::hypot(px - middle_x[k], beyond), 0.0005 + 1e-9) << k;
  }
}

// An open path uses part of the motion only; the limit holds there, and the report says both.
TEST(PathStudyRun, TheTransmissionAngleOfAnOpenPathIsThatOfThePath) {
  std::string messages;
  const auto study =
      prepare(target(arc) + "[[constraint]]\ntype = \"transmission_angle\"\nmin_deg = 30\n", messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  ASSERT_EQ(result.status, Status::done);
  for (const study::Solution& solution : result.solutions)
    EXPECT_GE(solution.classification.find("min_transmission_angle_rad")->as_number(), 0.5235987755 - 1e-6);
  const Value& objectives = result.solutions[0].objectives;
  EXPECT_EQ(test::value_of_fact(result, "path error (sum of squares)"),
            objectives.find("path_error_sum_sq_m2")->as_number());
  EXPECT_THAT(test::fact(result, "minimum transmission angle"), HasSubstr("° over the path ("));
  EXPECT_THAT(test::fact(result, "minimum transmission angle"), HasSubstr("° over the whole motion)"));
  for (const Diagnostic& d : result.diagnostics)
    EXPECT_THAT(to_string(d.message), ::testing::Not(HasSubstr("falls to")));
}

// A linkage that locks at both ends of its motion is an answer, but no good news: the headline says so, and
// the best one that does not lock stands beside it.
TEST(PathStudyRun, AUsableDesignStandsBesideADegenerateOne) {
  std::string messages;
  const auto study = prepare(target(arc), messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  ASSERT_EQ(result.status, Status::done);
  const auto usable = [](const study::Solution& s) { return s.classification.find("usable")->as_bool(); };
  EXPECT_TRUE(std::any_of(result.solutions.begin(), result.solutions.end(), usable));
  if (!usable(result.solutions[0])) {
    EXPECT_THAT(to_string(result.headline), HasSubstr(". But its transmission angle falls to "));
    EXPECT_THAT(to_string(result.headline), HasSubstr("The best one without such drawbacks is solution"));
    EXPECT_TRUE(result.facts[0].verdict == study::Fact::Verdict::plain);
  }
}

}  // namespace
}  // namespace linkwright::planar
