// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::fact;
using test::keys;
using test::prepare;
using test::problems_of;
using test::run_text;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Parts of a good study, any of which a test may replace.
std::string study_text(const std::map<std::string, std::string>& changed = {}) {
  std::map<std::string, std::string> parts = {
      {"1 head", "schema = 1\nkind = \"analysis\"\n"},
      {"2 mechanism", "[mechanism]\ntype = \"planar.four_bar\"\nbranch = \"open\"\n"},
      {"3 parameters",
       "[mechanism.parameters]\nground_m = 0.6\ncrank_m = 0.1\ncoupler_m = 0.4\nrocker_m = 0.32\n"},
      {"4 mass",
       "[mechanism.mass]\n"
       "crank = { mass_kg = 0.36, inertia_kg_m2 = 4.13e-4, centre_distance_m = 0.05 }\n"
       "coupler = { mass_kg = 1.296, inertia_kg_m2 = 1.87e-2, centre_distance_m = 0.2 }\n"
       "rocker = { mass_kg = 1.046, inertia_kg_m2 = 9.85e-3, centre_distance_m = 0.16 }\n"},
      {"5 drive", "[drive]\ninput = \"crank\"\nspeed_rpm = 300.0\n"},
      {"6 sweep", "[sweep]\ntype = \"grid\"\ncrank_angle = { from_deg = 0, to_deg = 360, samples = 9 }\n"}};
  return test::text_of(std::move(parts), changed);
}

std::string problems(const std::map<std::string, std::string>& changed) {
  return problems_of(study_text(changed));
}

study::Result run(const std::map<std::string, std::string>& changed = {}) {
  return run_text(study_text(changed));
}

// The crank points away from the ground where 450 mm of links are to span 700: in the unit of the study.
TEST(FourBarStudyRun, TellsTheGapInTheUnitsOfTheStudy) {
  const study::Result r =
      run({{"3 parameters",
            "[mechanism.parameters]\nground_mm = 600\ncrank_mm = 100\ncoupler_mm = 400\nrocker_mm = 50\n"}});
  ASSERT_FALSE(r.diagnostics.empty());
  EXPECT_THAT(to_string(r.diagnostics[0]),
              HasSubstr("do not assemble: coupler + rocker cannot close, the gap is up to 250 mm"));
}

TEST(FourBarStudyRead, NamesWhatIsWrongWithTheLinkage) {
  const auto parameters = [](const std::string& text) {
    return problems({{"3 parameters", "[mechanism.parameters]\n" + text}});
  };
  EXPECT_THAT(parameters("ground_m = 0.6\ncrank_m = 0\ncoupler_m = 0.4\nrocker_m = 0.32\n"),
              HasSubstr("mechanism.parameters.crank_m: is 0 m, must be more than 0 m"));
  EXPECT_THAT(parameters("ground_m = 0.6\ncrank_m = 1e-30\ncoupler_m = 0.4\nrocker_m = 0.32\n"),
              HasSubstr("is 1e-30 m, a link must be at least 1e-09 m long; check the unit"));
  EXPECT_THAT(parameters("ground_mm = 600\ncrank_mm = 1e-8\ncoupler_mm = 400\nrocker_mm = 320\n"),
              HasSubstr("crank_mm: is 1e-08 mm, a link must be at least 1e-06 mm long; check the unit"));
  EXPECT_THAT(parameters("ground_m = 0.6\ncrank_m = 0.1\ncoupler_m = 0.4\n"),
              HasSubstr("mechanism.parameters.rocker_m: this key is missing"));
  EXPECT_THAT(problems({{"3 parameters", ""}}), HasSubstr("mechanism.parameters: this key is missing"));
  EXPECT_THAT(problems({{"2 mechanism", "[mechanism]\ntype = \"planar.four_bar\"\nbranch = \"any\"\n"}}),
              HasSubstr("is 'any', must be one of: open, crossed"));
}

TEST(FourBarStudyRead, SendsLengthsToTheirTable) {
  const std::string all = problems_of(
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.four_bar\"\n"
      "ground_mm = 100\ncrank_mm = 40\ncoupler_mm = 120\nrocker_mm = 90\n");
  EXPECT_THAT(all,
              HasSubstr("5:1: error: mechanism.ground_mm: unknown key; it belongs in [mechanism.parameters], "
                        "with crank_mm, coupler_mm, rocker_mm\n"));
  // The table is missing because they are elsewhere.
  EXPECT_THAT(all, ::testing::Not(HasSubstr("this key is missing")));
}

TEST(FourBarStudyRead, NamesWhatIsWrongWithTheMasses) {
  EXPECT_THAT(problems({{"4 mass",
                         "[mechanism.mass]\n"
                         "crank = { mass_kg = -0.36, inertia_kg_m2 = 4.13e-4, centre_distance_m = 0.05 }\n"
                         "coupler = { mass_kg = 1, inertia_kg_m2 = 1.87e-2 }\n"}}),
              ::testing::AllOf(HasSubstr("mechanism.mass.crank.mass_kg: is -0.36 kg, must be at least 0 kg"),
                               HasSubstr("mechanism.mass.coupler.centre_distance_m: this key is missing"),
                               HasSubstr("mechanism.mass.rocker: this key is missing")));
  EXPECT_THAT(problems({{"4 mass", ""}, {"7 output", "[output]\nquantities = [\"drive\"]\n"}}),
              HasSubstr("mechanism.mass: forces and torques need the mass of every "
                        "body: 'crank', 'coupler', 'rocker' have none; give the "
                        "masses of its links there, or list quantities"));
  std::string messages;
  EXPECT_TRUE(
      prepare(study_text({{"4 mass", ""}, {"7 output", "[output]\nquantities = [\"rates\"]\n"}}), messages))
      << messages;
}

TEST(FourBarStudyRead, OfLengthsAloneShowsHowItMoves) {
  const std::map<std::string, std::string> nothing_but_lengths = {
      {"4 mass", ""}, {"5 drive", ""}, {"6 sweep", ""}};
  std::string messages;
  const auto study = prepare(study_text(nothing_but_lengths), messages);
  ASSERT_TRUE(study);
  EXPECT_EQ(messages,
            "study.toml:3:1: warning: mechanism: masses are not given, so forces and torques, velocities and "
            "accelerations are left out; for them add [mechanism.mass] and the speed, [drive]\n");
  const study::Result r = run(nothing_but_lengths);
  EXPECT_EQ(r.status, Status::done);
  const Table& sweep = r.tables.at(0);
  EXPECT_EQ(sweep.rows(), 361u);  // a turn
  const std::vector<std::string> columns = keys(sweep);
  EXPECT_THAT(columns, ::testing::Contains("rocker_angle_rad"));
  EXPECT_THAT(columns, ::testing::Contains("coupler_rocker_transmission_angle_rad"));
  for (const std::string& key : columns) EXPECT_EQ(key.find("_per_s"), std::string::npos) << key;
  // Quantities that were left out stay so when the study is run as it is kept.
  const auto again = prepare(study::to_toml(study->canonical), messages);
  ASSERT_TRUE(again) << messages;
  RunContext context;
  EXPECT_EQ(keys(study::run_study(*again, context).tables.at(0)), columns);

  // A speed gives rates, masses give all. Half of the masses are a mistake, and so are springs without any.
  messages.clear();
  EXPECT_TRUE(prepare(study_text({{"4 mass", ""}}), messages));
  EXPECT_THAT(messages, HasSubstr("so forces and torques are left out; for them add [mechanism.mass]\n"));
  EXPECT_THAT(keys(run({{"4 mass", ""}}).tables.at(0)), ::testing::Contains("rocker_speed_rad_per_s"));
  EXPECT_THAT(problems({{"5 drive", ""}}), HasSubstr("drive: this key is missing"));
}

TEST(FourBarStudyRead, NamesWhatIsWrongWithDriveSweepAndOutput) {
  EXPECT_THAT(problems({{"5 drive", "[drive]\ninput = \"rocker\"\nspeed_rpm = 300.0\n"}}),
              HasSubstr("is 'rocker', must be one of: crank"));
  EXPECT_THAT(problems({{"5 drive", "[drive]\nspeed = 300.0\n"}}),
              HasSubstr("drive.speed: the unit is missing; write speed_rad_per_s"));
  EXPECT_THAT(problems({{"5 drive", ""}}), HasSubstr("drive: this key is missing"));
  const auto sweep = [](const std::string& text) {
    return problems({{"6 sweep", "[sweep.crank_angle]\n" + text}});
  };
  EXPECT_THAT(sweep("from_deg = 0\nto_deg = 360\nsamples = 1\n"),
              HasSubstr("sweep.crank_angle.samples: is 1, must be at least 2"));
  EXPECT_THAT(sweep("from_deg = 90\nto_deg = 90\nsamples = 5\n"),
              HasSubstr("sweep.crank_angle.to_deg: the sweep ends where it begins, at 90 deg"));
  EXPECT_THAT(sweep("from_deg = 90\nsamples = 5\n"),
              HasSubstr("sweep.crank_angle.to_rad: this key is missing"));
  EXPECT_THAT(problems({{"6 sweep", "[sweep]\ntype = \"grid\"\n"}}),
              HasSubstr("sweep.crank_angle: this key is missing"));
  EXPECT_THAT(problems({{"7 output", "[output]\nquantities = [\"position\", \"reaction\"]\n"}}),
              HasSubstr("'reaction' is none of: position, rates, reactions, drive, shaking, "
                        "transmission_angle, power; did you mean 'reactions'?"));
  EXPECT_THAT(problems({{"7 gravity", "[environment]\ngravity_m_per_s2 = -9.81\n"}}),
              HasSubstr("must be at least 0 m/s2"));
}

TEST(FourBarStudyRead, CanonicalStudyReadsBackToItself) {
  std::string messages;
  const auto first = prepare(study_text({{"7 output", "[output]\nquantities = [\"shaking\"]\n"}}), messages);
  ASSERT_TRUE(first) << messages;
  EXPECT_NEAR(first->canonical.find("drive")->as_array()[0].find("speed_rad_per_s")->as_number(), 10 * pi,
              1e-13);
  EXPECT_EQ(first->canonical.find("environment")->find("gravity_m_per_s2")->as_number(), 9.81);
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

// Over the full turn, the flat positions among the rows, as `planar.linkage` has them.
TEST(FourBarStudyRun, AParallelogramHasAllItsRows) {
  const std::map<std::string, std::string> parts = {
      {"3 parameters",
       "[mechanism.parameters]\nground_m = 0.4\ncrank_m = 0.1\ncoupler_m = 0.4\nrocker_m = 0.1\n"
       "coupler_u_m = 0.2\n"},
      {"6 sweep", "[sweep]\ntype = \"grid\"\ncrank_angle = { from_deg = 0, to_deg = 360, samples = 361 }\n"}};
  const study::Result r = run(parts);
  EXPECT_EQ(r.status, Status::done);
  const Table& t = r.tables[0];
  for (std::size_t i = 0; i < t.rows(); ++i) {
    EXPECT_NEAR(t.find("rocker_speed_rad_per_s")->values[i], 10 * pi, 1e-5) << i;
    EXPECT_NEAR(t.find("rocker_acceleration_rad_per_s2")->values[i], 0, 1e-3) << i;
    EXPECT_NEAR(t.find("rocker_angle_rad")->values[i], t.find("O1_angle_rad")->values[i], 1e-6) << i;
    EXPECT_NEAR(t.find("coupler_C_y_m")->values[i], 0.1 * std::sin(t.find("O1_angle_rad")->values[i]), 1e-7)
        << i;
    // The weight of the coupler has no answer where it is flat.
    EXPECT_EQ(t.status[i], i % 180 == 0 ? "singular" : "done") << i;
    EXPECT_EQ(std::isnan(t.find("O1_x_N")->values[i]), i % 180 == 0) << i;
    EXPECT_FALSE(std::isnan(t.find("O1_drive_torque_N_m")->values[i])) << i;
    EXPECT_NEAR(r.scenes[0].points[3].y[i], 0.1 * std::sin(t.find("O1_angle_rad")->values[i]), 1e-7) << i;
  }
  const std::string messages = test::lines_of(r.diagnostics);
  EXPECT_THAT(messages, HasSubstr("at 0° the joint forces grow without bound: the row holds "
                                  "what stays finite"));
  EXPECT_THAT(
      messages,
      HasSubstr("change point at 180°: the assembly modes of coupler + rocker coincide there, and the "
                "linkage can continue in either; the rows continue smoothly"));
  EXPECT_THAT(messages, ::testing::Not(HasSubstr("dead point:")));
  // Without forces every row is complete; with a kink the speeds are not known there, but the position is.
  const std::string motion = "[output]\nquantities = [\"position\", \"rates\"]\n";
  auto moved = parts;
  moved["7 output"] = motion;
  EXPECT_THAT(run(moved).tables[0].status, ::testing::Each("done"));
  moved["6 sweep"] += "at_change_point = \"keep_sign\"\n";
  const study::Result kink = run(moved);
  EXPECT_EQ(kink.status, Status::done);
  EXPECT_NEAR(kink.tables[0].find("coupler_C_x_m")->values[180], 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(kink.tables[0].find("rocker_speed_rad_per_s")->values[180]));
  EXPECT_GT(std::abs(kink.tables[0].find("coupler_angle_rad")->values[270]), 0.1);
  moved["6 sweep"].replace(moved["6 sweep"].find("keep_sign"), 9, "stop");
  const study::Result stop = run(moved);
  EXPECT_EQ(stop.status, Status::limit_reached);
  EXPECT_EQ(stop.tables[0].status[179], "done");
  EXPECT_EQ(stop.tables[0].status[181], "limit_reached");
  EXPECT_TRUE(std::isnan(stop.tables[0].find("coupler_O3_x_m")->values[181]));
}

// A kite's crank pin comes onto the rocker's pivot.
TEST(FourBarStudyRun, AKiteHasAllItsRows) {
  for (const char* lengths : {"ground_m = 0.4\ncrank_m = 0.4\ncoupler_m = 0.6\nrocker_m = 0.6\n",
                              "ground_m = 0.6\ncrank_m = 0.2\ncoupler_m = 0.2\nrocker_m = 0.6\n"}) {
    const study::Result r =
        run({{"3 parameters", "[mechanism.parameters]\n" + std::string(lengths)},
             {"6 sweep",
              "[sweep]\ntype = \"grid\"\ncrank_angle = { from_deg = 0, to_deg = 360, samples = 361 }\n"},
             {"7 output", "[output]\nquantities = [\"position\", \"rates\"]\n"}});
    EXPECT_EQ(r.status, Status::done) << lengths;
    EXPECT_THAT(r.tables[0].status, ::testing::Each("done")) << lengths;
    // Smooth: second differences of the pin are those of its acceleration.
    const auto& x = r.tables[0].find("coupler_O3_x_m")->values;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      EXPECT_LT(std::abs(x[i - 1] - 2 * x[i] + x[i + 1]), 1e-3) << lengths << i;
  }
}

TEST(FourBarStudyRun, OfThePublishedMechanismPassesItsCheck) {
  const auto study = test::prepare_example(test::kinds(), "fourbar-reactions.toml");
  ASSERT_TRUE(study);
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(result.diagnostics, IsEmpty());
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_TRUE(result.checks[0].passed) << result.checks[0].value;
  EXPECT_NEAR(result.checks[0].value, 14.7136372, 1e-7);

  ASSERT_EQ(result.tables.size(), 2u);
  const Table& sweep = result.tables[0];
  EXPECT_EQ(sweep.name, "sweep");
  EXPECT_EQ(sweep.rows(), 201u);
  EXPECT_THAT(keys(sweep), ElementsAreArray({"O1_angle_rad",
                                             "crank_angle_rad",
                                             "crank_x_m",
                                             "crank_y_m",
                                             "coupler_angle_rad",
                                             "coupler_x_m",
                                             "coupler_y_m",
                                             "rocker_angle_rad",
                                             "rocker_x_m",
                                             "rocker_y_m",
                                             "coupler_O3_x_m",
                                             "coupler_O3_y_m",
                                             "crank_speed_rad_per_s",
                                             "crank_acceleration_rad_per_s2",
                                             "coupler_speed_rad_per_s",
                                             "coupler_acceleration_rad_per_s2",
                                             "rocker_speed_rad_per_s",
                                             "rocker_acceleration_rad_per_s2",
                                             "coupler_O3_speed_x_m_per_s",
                                             "coupler_O3_speed_y_m_per_s",
                                             "coupler_O3_acceleration_x_m_per_s2",
                                             "coupler_O3_acceleration_y_m_per_s2",
                                             "O1_x_N",
                                             "O1_y_N",
                                             "O1_N",
                                             "O2_x_N",
                                             "O2_y_N",
                                             "O2_N",
                                             "O3_x_N",
                                             "O3_y_N",
                                             "O3_N",
                                             "O4_x_N",
                                             "O4_y_N",
                                             "O4_N",
                                             "O1_drive_torque_N_m",
                                             "shaking_force_x_N",
                                             "shaking_force_y_N",
                                             "shaking_force_N",
                                             "shaking_moment_N_m",
                                             "shaking_moment_with_drive_N_m",
                                             "coupler_rocker_transmission_angle_rad",
                                             "closure_residual_m"}));
  EXPECT_EQ(result.tables[1].name, "ranges");
  // Largest values of 201 samples, independently computed.
  const auto largest = [&](std::string_view key) {
    double most = 0;
    for (double v : sweep.find(key)->values) most = std::max(most, std::abs(v));
    return most;
  };
  EXPECT_NEAR(largest("O1_x_N"), 416.148105, 1e-6);
  EXPECT_NEAR(largest("O3_y_N"), 32.8136345, 1e-7);
  EXPECT_NEAR(largest("shaking_moment_N_m"), 65.7736707, 1e-7);
  EXPECT_NEAR(largest("shaking_moment_with_drive_N_m"), 54.9623514, 1e-7);
  EXPECT_LT(largest("closure_residual_m"), 1e-15);

  EXPECT_EQ(fact(result, "largest drive torque at O1"), "-14.714 N m at 169.2°");
  // The numbers of a fact are numbers: the torque with all its digits, and the crank angle, which says where.
  const Sentence drive = test::sentence(result, "largest drive torque at O1");
  ASSERT_TRUE(drive.value());
  EXPECT_EQ(std::abs(drive.value()->si), largest("O1_drive_torque_N_m"));
  EXPECT_EQ(drive.value()->unit_words(), "N m");
  EXPECT_EQ(std::get<Measured>(drive.parts()[2]).place_key(), "O1_angle_deg");
  EXPECT_EQ(fact(result, "drive torque, root mean square"), "5.9465 N m");
  EXPECT_EQ(fact(result, "net work of the drive per revolution"), "0 J (31.17 J absolute)");
  EXPECT_THAT(fact(result, "type"), "crank-rocker, open");
  EXPECT_THAT(to_string(result.headline), HasSubstr("The drive torque reaches -14.714 N m at 169.2°"));
  // Every plot finds its columns, and those over the crank angle follow the scene.
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].input, sweep.columns[0].values);
  for (const study::Plot& plot : result.plots) {
    EXPECT_NE(sweep.find(plot.x), nullptr) << plot.name;
    for (const std::string& y : plot.y) EXPECT_NE(sweep.find(y), nullptr) << plot.name << " " << y;
    EXPECT_EQ(plot.scene, "motion") << plot.name;
  }
  // The arrows are the columns of the table.
  const study::Scene& scene = result.scenes[0];
  const auto arrow = [&](std::string_view name) {
    const auto found = std::find_if(scene.vectors.begin(), scene.vectors.end(),
                                    [&](const auto& v) { return v.name == name; });
    return found == scene.vectors.end() ? study::Scene::Vector() : *found;
  };
  const std::pair<const char*, const char*> forces[] = {{"O1", "force at O1, ground on crank"},
                                                        {"O2", "force at O2, crank on coupler"},
                                                        {"O3", "force at O3, rocker on coupler"},
                                                        {"O4", "force at O4, ground on rocker"},
                                                        {"shaking_force", "shaking force on the ground"}};
  for (const auto& [key, name] : forces) {
    EXPECT_EQ(arrow(name).x, sweep.find(std::string(key) + "_x_N")->values) << name;
    EXPECT_EQ(arrow(name).y, sweep.find(std::string(key) + "_y_N")->values) << name;
  }
  ASSERT_EQ(scene.moments.size(), 1u);
  EXPECT_EQ(scene.moments[0].value, sweep.find("O1_drive_torque_N_m")->values);
  ASSERT_EQ(scene.circles.size(), 3u);
  EXPECT_EQ(scene.circles[2].name, "mass centre of rocker, 1.046 kg");
}

// Names of before, with a warning each that gives today's.
TEST(FourBarStudyRead, ReadsTheNamesOfBefore) {
  std::string messages;
  const std::string checks =
      "[[check]]\nquantity = \"sweep.drive_torque_N_m.max_abs\"\nat_most = 100\n"
      "[[check]]\nquantity = \"sweep.O3_x_m.max\"\nat_most = 1\n"
      "[[check]]\nquantity = \"sweep.O3_x_N.max\"\nat_most = 1e4\n";
  const auto study = prepare(
      study_text({{"7 output", "[output]\nquantities = [\"position\", \"drive_torque\", \"reactions\"]\n"},
                  {"8 check", checks}}),
      messages);
  ASSERT_TRUE(study) << messages;
  EXPECT_THAT(messages,
              ::testing::AllOf(HasSubstr("'drive_torque' is now called 'drive'"),
                               HasSubstr("'sweep.drive_torque_N_m.max_abs' is now called "
                                         "'sweep.O1_drive_torque_N_m.max_abs'"),
                               HasSubstr("'sweep.O3_x_m.max' is now called 'sweep.coupler_O3_x_m.max'"),
                               ::testing::Not(HasSubstr("O3_x_N"))));
  RunContext context;
  for (const auto& check : study::run_study(*study, context).checks) EXPECT_TRUE(check.passed);
}

TEST(FourBarStudyRun, HoldsWhatWasAskedFor) {
  const study::Result result =
      run({{"4 mass", ""}, {"7 output", "[output]\nquantities = [\"transmission_angle\", \"position\"]\n"}});
  EXPECT_THAT(keys(result.tables[0]),
              ElementsAreArray({"O1_angle_rad", "crank_angle_rad", "crank_x_m", "crank_y_m",
                                "coupler_angle_rad", "coupler_x_m", "coupler_y_m", "rocker_angle_rad",
                                "rocker_x_m", "rocker_y_m", "coupler_O3_x_m", "coupler_O3_y_m",
                                "coupler_rocker_transmission_angle_rad", "closure_residual_m"}));
  EXPECT_EQ(to_string(result.headline), "9 of 9 positions computed.");
  EXPECT_TRUE(result.scenes[0].moments.empty());
}

// The tracing point given with the mechanism has speed and acceleration as other traces: those of its places.
TEST(FourBarStudyRun, TracesTheCouplerPoint) {
  const study::Result result =
      run({{"3 parameters",
            "[mechanism.parameters]\nground_m = 0.6\ncrank_m = 0.1\ncoupler_m = 0.4\nrocker_m = 0.32\n"
            "coupler_u_m = 0.2\ncoupler_v_m = 0.1\nframe_angle_deg = 20\n"},
           {"6 sweep",
            "[sweep]\ntype = \"grid\"\ncrank_angle = { from_deg = 0, to_deg = 360, samples = 3601 }\n"}});
  const Table& t = result.tables[0];
  const double step = 2 * pi / 3600 / (10 * pi);  // s from row to row
  for (const char* axis : {"x", "y"}) {
    const auto& place = t.find(std::string("coupler_C_") + axis + "_m")->values;
    const auto& speed = t.find(std::string("coupler_C_speed_") + axis + "_m_per_s")->values;
    const auto& acceleration = t.find(std::string("coupler_C_acceleration_") + axis + "_m_per_s2")->values;
    // Central differences are off by step^2 / 6 and / 12 of the next derivatives, about 1e5 m/s3 and 1e7
    // m/s4.
    for (std::size_t i = 1; i + 1 < place.size(); i += 7) {
      EXPECT_NEAR(speed[i], (place[i + 1] - place[i - 1]) / (2 * step), 1e-3);
      EXPECT_NEAR(acceleration[i], (place[i + 1] - 2 * place[i] + place[i - 1]) / (step * step), 0.1);
    }
  }
}

// A turn of the whole mechanism turns the forces, without gravity.
TEST(FourBarStudyRun, ForcesTurnWithTheFrame) {
  const std::string still = "[environment]\ngravity_m_per_s2 = 0\n";
  const study::Result straight = run({{"7 gravity", still}});
  const study::Result turned = run({{"3 parameters",
                                     "[mechanism.parameters]\nground_m = 0.6\ncrank_m = 0.1\ncoupler_m = "
                                     "0.4\nrocker_m = 0.32\npivot_x_m = 3\n"
                                     "frame_angle_deg = 90\n"},
                                    {"7 gravity", still}});
  const Table &a = straight.tables[0], &b = turned.tables[0];
  for (std::size_t i = 0; i < a.rows(); ++i) {
    EXPECT_NEAR(b.find("O3_y_N")->values[i], a.find("O3_x_N")->values[i], 1e-10);
    EXPECT_NEAR(b.find("O3_x_N")->values[i], -a.find("O3_y_N")->values[i], 1e-10);
    EXPECT_NEAR(b.find("shaking_moment_N_m")->values[i], a.find("shaking_moment_N_m")->values[i], 1e-10);
    EXPECT_NEAR(b.find("coupler_y_m")->values[i], a.find("coupler_x_m")->values[i], 1e-15);
  }
}

TEST(FourBarStudyRun, TellsWhereTheLinkageDoesNotAssemble) {
  const study::Result result =
      run({{"3 parameters",
            "[mechanism.parameters]\nground_m = 0.6\ncrank_m = 0.5\ncoupler_m = 0.4\nrocker_m = 0.32\n"}});
  EXPECT_EQ(result.status, Status::no_assembly);
  const Table& sweep = result.tables[0];
  EXPECT_EQ(sweep.rows(), 9u);
  EXPECT_EQ(sweep.status[4], "no_assembly");
  EXPECT_TRUE(std::isnan(sweep.find("O1_x_N")->values[4]));
  EXPECT_TRUE(std::isnan(sweep.find("closure_residual_m")->values[4]));
  EXPECT_EQ(sweep.status[1], "done");
  EXPECT_FALSE(std::isnan(sweep.find("O1_x_N")->values[1]));
  ASSERT_EQ(result.diagnostics.size(), 1u);
  EXPECT_THAT(to_string(result.diagnostics[0]),
              ::testing::AllOf(HasSubstr("5 of 9 positions, the first at 90° do not assemble"),
                               HasSubstr("it assembles from -81.2 to 81.2 deg")));
  EXPECT_THAT(to_string(result.headline), HasSubstr("positions have no answer."));

  const study::Result nowhere =
      run({{"3 parameters",
            "[mechanism.parameters]\nground_m = 6\ncrank_m = 0.5\ncoupler_m = 0.4\nrocker_m = 0.32\n"}});
  EXPECT_EQ(nowhere.status, Status::no_assembly);
  EXPECT_THAT(to_string(nowhere.headline),
              HasSubstr("coupler + rocker cannot close, a gap of 4.78 m is left at 0°."));
  EXPECT_THAT(to_string(nowhere.diagnostics[0]), HasSubstr("assembles nowhere"));
}

TEST(FourBarStudyRun, KeepsThePositionAtADeadPoint) {
  // Coupler and rocker stretched at 90 degrees: the hypotenuse of 3, 4 and 5.
  const study::Result result = run(
      {{"3 parameters", "[mechanism.parameters]\nground_m = 3\ncrank_m = 4\ncoupler_m = 2\nrocker_m = 3\n"},
       {"6 sweep", "[sweep.crank_angle]\nfrom_deg = 90\nto_deg = 30\nsamples = 3\n"}});
  EXPECT_EQ(result.status, Status::singular);
  const Table& sweep = result.tables[0];
  EXPECT_EQ(sweep.status[0], "singular");
  EXPECT_NEAR(sweep.find("coupler_O3_x_m")->values[0], 1.2, 1e-7);
  EXPECT_NEAR(sweep.find("coupler_O3_y_m")->values[0], 2.4, 1e-7);
  EXPECT_TRUE(std::isnan(sweep.find("O1_drive_torque_N_m")->values[0]));
  EXPECT_EQ(sweep.status[2], "done");
  ASSERT_EQ(result.diagnostics.size(), 1u);
  EXPECT_THAT(to_string(result.diagnostics[0]),
              HasSubstr("1 of 3 positions, the first at 90° are at a dead point of coupler + rocker"));
}

TEST(FourBarStudyRun, AtRestIsStatics) {
  const study::Result result = run({{"5 drive", "[drive]\nspeed_rpm = 0\n"}});
  EXPECT_EQ(result.status, Status::done);
  const Table& sweep = result.tables[0];
  for (double v : sweep.find("shaking_force_y_N")->values) EXPECT_NEAR(v, -9.81 * 2.702, 1e-12);
  EXPECT_EQ(fact(result, "power balance"), "no fact");
}

TEST(FourBarStudyRun, CancelledRunKeepsItsFirstRows) {
  std::string messages;
  const auto study = prepare(
      study_text({{"6 sweep", "[sweep.crank_angle]\nfrom_deg = 0\nto_deg = 360\nsamples = 100000\n"}}),
      messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  context.cancel();
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::cancelled);
  EXPECT_EQ(result.tables[0].rows(), 256u);
}

}  // namespace
}  // namespace linkwright::planar
