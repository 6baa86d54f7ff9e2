// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/studies/design.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "clearance/studies.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"
#include "support/resumed.h"

namespace linkwright::clearance {
namespace {

using test::column;
using test::fact;
using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string example(const std::string& name) {
  std::string out = test::example_text(name + ".toml");
  // File names are relative to the study, which tests read from elsewhere.
  const std::string csv = "clearance-four-bar-path.csv";
  const auto found = out.find("\"" + csv + "\"");
  if (found != std::string::npos) out.replace(found + 1, csv.size(), test::example_path(csv).string());
  return out;
}
const std::string& kind_example(DesignTarget target) {
  static const std::vector<study::Kind> kinds = clearance_design_kinds();
  return kinds[static_cast<std::size_t>(target)].example;
}
double objective(const study::Result& r, const char* key) {
  const Value* v = r.solutions.at(0).objectives.find(key);
  return v && v->is_number() ? v->as_number() : std::nan("");
}
void expect_plots_have_columns(const study::Result& r) {
  for (const study::Plot& p : r.plots) {
    for (const std::string& key : p.y) EXPECT_TRUE(table(r, p.table).find(key)) << p.name << " " << key;
    if (!p.baseline.empty()) {
      EXPECT_TRUE(table(r, p.baseline).find(p.y[0])) << p.name;
    }
  }
}

TEST(ClearanceDesignStudy, LengthsAreThoseOfTheLeastSquares) {
  const study::Result r = run_text(replaced(example("clearance-four-bar-lengths"), "count = 5", "count = 1"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  // The global optimum, to the digits of the reference.
  EXPECT_NEAR(objective(r, "path_objective_m"), 0.0152133e-3, 1e-10);
  EXPECT_NEAR(objective(r, "path_error_rms_m"), 6 * objective(r, "path_objective_m"), 1e-12);  // sqrt(36)
  EXPECT_GT(objective(r, "path_error_anywhere_m"), objective(r, "path_error_max_m"));
  ASSERT_EQ(column(r, "points", "distance_m").size(), 36u);
  // Design 2 beside it: 6.548915e-5 m times 6.
  ASSERT_EQ(r.changes.size(), 2u);
  EXPECT_NEAR(r.changes[0].before, 3.929349e-4, 1e-10);
  EXPECT_EQ(column(r, "design", "reference")[0], 0.2027109);
  EXPECT_THAT(to_string(r.headline), HasSubstr("if the clearance link leads the crank by 10°"));
  EXPECT_EQ(fact(r, "crank rotates fully wherever the pin lies"), "yes");
  ASSERT_EQ(r.diagnostics.size(), 1u);
  EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("a constant phase of 10° is impossible"));
  expect_plots_have_columns(r);
}

TEST(ClearanceDesignStudy, TheSwarmOfTheSourceSpreads) {
  const study::Result r =
      run_text(replaced(example("clearance-four-bar-lengths-swarm"), "count = 10", "count = 2"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_GT(objective(r, "path_objective_m"), 0.0152133e-3);
  EXPECT_LT(objective(r, "path_objective_m"), 0.4e-3);
  EXPECT_FALSE(r.log.as_array().at(0).find("history")->as_array().empty());
  EXPECT_EQ(column(r, "seeds", "path_objective_m").size(), 2u);
}

TEST(ClearanceDesignStudy, MassesFollowTheCrank) {
  const study::Result r = run_text(replaced(example("clearance-four-bar-masses"), "count = 3", "count = 1"));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_THAT(r.diagnostics, IsEmpty());
  EXPECT_THAT(to_string(r.headline), HasSubstr("pin and bush stay in contact, with 2.0"));
  EXPECT_LT(objective(r, "orbit_error_rad"), 4.3e-5);
  const std::vector<double>&phase = column(r, "turn", "phase_rad"), &tension = column(r, "turn", "tension_N"),
        &before = column(r, "reference", "phase_rad");
  ASSERT_EQ(phase.size(), 361u);
  for (std::size_t i = 0; i < phase.size(); ++i)
    EXPECT_NEAR(phase[i], 0, 1.5e-3) << i;  // a twelfth of a degree
  EXPECT_NEAR(phase.front(), phase.back(), 1e-6);
  EXPECT_NEAR(*std::min_element(tension.begin(), tension.end()), objective(r, "least_tension_N"), 1e-3);
  // The periodic orbit of Table 3: 17 degrees either way.
  EXPECT_NEAR(*std::max_element(before.begin(), before.end()), 17.8 * full_turn / 360, 1e-2);
  EXPECT_THAT(fact(r, "contact"), HasSubstr("kept: minimum tension 2.0"));
  EXPECT_THAT(fact(r, "mean sine of the phase, by tension"), HasSubstr("the work of the pin over a turn"));
  expect_plots_have_columns(r);
}

// A simulation of the design needs what its tables say: the same motion, by other equations.
TEST(ClearanceDesignStudy, TheDesignCanBeTakenOn) {
  std::string text = replaced(example("clearance-four-bar-masses"), "count = 3", "count = 1");
  text = replaced(text, "gravity_m_per_s2 = 0.0", "gravity_m_per_s2 = 9.81");
  text = replaced(text, "speed_rad_per_s = 10.0", "speed_rad_per_s = 50.0\nstart_angle_deg = 30.0");
  text.erase(text.find("[[check]]"));
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);

  const Table &points = table(r, "linkage-points"), &masses = table(r, "linkage-masses");
  std::string sim = "schema = 1\nkind = \"simulation\"\n[mechanism]\ntype = \"clearance.linkage\"\n";
  for (const std::string body : {"ground", "crank", "coupler", "rocker"}) {
    sim += fmt::format("[[mechanism.body]]\nname = \"{}\"\npoints_m = {{", body);
    const char* comma = "";
    for (std::size_t i = 0; i < points.names.size(); ++i) {
      if (!points.names[i].starts_with(body + ".")) continue;
      sim += fmt::format("{} {} = [{}, {}]", comma, points.names[i].substr(body.size() + 1),
                         column(r, "linkage-points", "x_m")[i], column(r, "linkage-points", "y_m")[i]);
      comma = ",";
    }
    sim += " }\n";
    for (std::size_t i = 0; i < masses.names.size(); ++i)
      if (masses.names[i] == body)
        sim += fmt::format(
            "mass_kg = {}\ncentre_m = [{}, {}]\ninertia_kg_m2 = {}\n",
            column(r, "linkage-masses", "mass_kg")[i], column(r, "linkage-masses", "centre_x_m")[i],
            column(r, "linkage-masses", "centre_y_m")[i], column(r, "linkage-masses", "inertia_kg_m2")[i]);
  }
  for (const auto& [name, first, second] :
       {std::array{"O2", "ground", "crank"}, std::array{"A", "crank", "coupler"},
        std::array{"B", "coupler", "rocker"}, std::array{"O4", "ground", "rocker"}})
    sim += fmt::format("[[mechanism.joint]]\nname = \"{0}\"\nfirst = \"{1}.{0}\"\nsecond = \"{2}.{0}\"\n",
                       name, first, second);
  const auto start = [&](const char* key) { return column(r, "linkage-start", key)[0]; };
  sim += fmt::format(
      "[[mechanism.assembly]]\nbodies = [\"coupler\", \"rocker\"]\nmode = \"plus\"\n[[drive]]\njoint = "
      "\"O2\"\nlaw = \"constant_speed\"\nfrom_rad = {}\nspeed_rad_per_s = {}\n[[clearance]]\njoint = "
      "\"A\"\nmodel = \"continuous\"\nclearance_m = {}\nstart_angle_rad = {}\nstart_rate_rad_per_s = "
      "{}\n[simulation]\nto_s = {}\nsamples = 361\nrtol = 1e-10\n",
      start("crank_angle_rad"), start("speed_rad_per_s"), start("clearance_m"), start("start_angle_rad"),
      start("start_rate_rad_per_s"), start("turn_s"));
  const study::Result taken = run_text(sim);
  ASSERT_EQ(taken.status, Status::done) << to_string(taken.headline);
  // Both integrate to about 1e-8; a turn of ten swings of the link lets that grow.
  const std::vector<double>&tension = column(taken, "pins", "A_tension_N"),
        &angle = column(taken, "pins", "A_link_angle_rad");
  ASSERT_EQ(tension.size(), 361u);
  for (std::size_t i = 0; i < tension.size(); ++i) {
    EXPECT_NEAR(tension[i], column(r, "turn", "tension_N")[i], 1e-4 * tension[i]) << i;
    EXPECT_NEAR(angle[i], column(r, "turn", "contact_angle_rad")[i], 1e-5) << i;
  }
}

// Both stages with free crank angles, by the swarm of the source, and what is reported when a phase is asked
// for.
TEST(ClearanceDesignStudy, BothStagesInTurn) {
  std::string text = replaced(kind_example(DesignTarget::both), "at_once", "in_turn");
  text = replaced(text, "phase_deg = 0.0", "phase_deg = 10.0");
  text = replaced(text, "step_deg = 30.0", "step_deg = 30.0, free_within_deg = 5.0");
  text = replaced(text, "method = \"recommended\"\nstarts = 6\nseeds  = { first = 1, count = 2 }",
                  "method = \"particle_swarm\"\npopulation = 20\ngenerations = 30");
  const study::Result r = run_text(text);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_THAT(to_string(r.headline), HasSubstr("on the periodic motion"));
  EXPECT_LT(objective(r, "first_turn_error_rad"), 0.03);
  ASSERT_FALSE(r.diagnostics.empty());
  EXPECT_THAT(to_string(r.diagnostics[0]),
              HasSubstr("no masses come far below F2 = phase / sqrt(72) = 0.02057 rad"));
}

TEST(ClearanceDesignStudy, BothAtOnceMeetThePathOnTheMotion) {
  const study::Result r = run_text(kind_example(DesignTarget::both));
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_LT(objective(r, "path_error_rms_m"), 5e-6);  // rounding of the points, 5 um
  EXPECT_GT(objective(r, "least_tension_N"), 0);
  EXPECT_THAT(r.diagnostics, IsEmpty());
  ASSERT_EQ(r.scenes.size(), 1u);
  const study::Scene& scene = r.scenes[0];
  EXPECT_EQ(scene.input_key, "crank_angle_rad");
  EXPECT_THAT(to_string(scene.title), HasSubstr("clearance drawn"));
  ASSERT_EQ(scene.targets.size(), 1u);
  EXPECT_TRUE(scene.targets[0].closed);
  ASSERT_EQ(scene.circles.size(), 1u);
  EXPECT_EQ(scene.circles[0].name, "clearance of A, 1 mm");
  expect_plots_have_columns(r);
}

// Uniform bars, as linkages are built: pin and bush separate, and the report says where.
TEST(ClearanceDesignStudy, TellsWhereContactIsLost) {
  std::string text = kind_example(DesignTarget::masses);
  const auto set = [&](const std::string& from, const std::string& to) { text = replaced(text, from, to); };
  set("mass_kg       = { min = 0.02, max = 0.2 }\ncentre_u_mm   = { min = -50.0, max = 200.0 }",
      "mass_kg = 0.0737\ncentre_u_mm = 90.0");
  set("centre_v_mm   = { min = -50.0, max = 50.0 }\ninertia_kg_m2 = { min = 1e-6, max = 5e-4 }",
      "centre_v_mm = 0.0\ninertia_kg_m2 = 0.000202");
  set("mass_kg       = { min = 0.02, max = 0.2 }\ncentre_u_mm   = { min = -50.0, max = 250.0 }",
      "mass_kg = 0.049\ncentre_u_mm = 60.0");
  set("centre_v_mm   = { min = -50.0, max = 50.0 }\ninertia_kg_m2 = { min = 1e-6, max = 5e-4 }",
      "centre_v_mm = 0.0\ninertia_kg_m2 = 0.0000619");
  set("method = \"recommended\"\nstarts = 6\nseeds  = { first = 1, count = 2 }",
      "method = \"particle_swarm\"\npopulation = 4\ngenerations = 2");
  const study::Result r = run_text(text);
  ASSERT_FALSE(r.solutions.empty()) << to_string(r.headline);
  EXPECT_LT(objective(r, "least_tension_N"), 0);
  EXPECT_THAT(fact(r, "contact"), HasSubstr("lost at a crank angle of"));
  EXPECT_THAT(to_string(r.headline), HasSubstr("but pin and bush separate at a crank angle of"));
  const std::string told = test::lines_of(r.diagnostics);
  EXPECT_THAT(told, HasSubstr("what follows is outside of the model"));
  EXPECT_THAT(told, HasSubstr("simulate it with model = \"contact\""));
}

TEST(ClearanceDesignStudy, SaysWhenNothingAssembles) {
  const study::Result far = run_text(replaced(kind_example(DesignTarget::lengths),
                                              "ground_mm         = { min = 150.0, max = 250.0 }",
                                              "ground_mm = { min = 2000.0, max = 2100.0 }"));
  EXPECT_EQ(far.status, Status::infeasible);
  EXPECT_THAT(to_string(far.headline),
              HasSubstr("No design found: no start of the search assembles at every point"));
}

TEST(ClearanceDesignStudy, KeepsTheBestWhenItIsInterrupted) {
  for (const DesignTarget target : {DesignTarget::lengths, DesignTarget::masses, DesignTarget::both}) {
    std::string messages;
    const auto prepared = prepare(kind_example(target), messages);
    ASSERT_TRUE(prepared) << messages;
    RunContext context;
    context.set_threads(1);
    context.cancel();
    const study::Result r = study::run_study(*prepared, context);
    EXPECT_EQ(r.status, Status::cancelled) << to_string(r.headline);
    EXPECT_FALSE(r.headline.empty());
    ASSERT_FALSE(r.diagnostics.empty());
    EXPECT_THAT(to_string(r.diagnostics[0]), HasSubstr("interrupted: 1 of 2 seeds ran"));
  }
}

TEST(ClearanceDesignStudy, GoesOnFromACheckpointWithTheSameBits) {
  for (const DesignTarget target : {DesignTarget::lengths, DesignTarget::masses, DesignTarget::both})
    ::linkwright::test::expect_resumed_alike(std::vector<study::Kind>(clearance_design_kinds()),
                                             kind_example(target), 2);
  std::string swarm = replaced(example("clearance-four-bar-lengths-swarm"), "count = 10", "count = 2");
  ::linkwright::test::expect_resumed_alike(std::vector<study::Kind>(clearance_design_kinds()), swarm, 2);
}

TEST(ClearanceDesignStudy, WritesWhatItReads) {
  for (const DesignTarget target : {DesignTarget::lengths, DesignTarget::masses, DesignTarget::both}) {
    std::string messages;
    const auto first = prepare(kind_example(target), messages);
    ASSERT_TRUE(first) << messages;
    const auto second = prepare(study::to_toml(first->canonical), messages);
    ASSERT_TRUE(second) << messages;
    EXPECT_EQ(first->canonical, second->canonical);
  }
}

TEST(ClearanceDesignStudy, BoundsFollowFromThePath) {
  std::string text = kind_example(DesignTarget::lengths);
  const auto from = text.find("[mechanism.parameters]");
  text.erase(from, text.find("[target]") - from);
  std::string messages;
  const auto study = prepare(text, messages);
  ASSERT_TRUE(study) << messages;
  const Value* crank = study->canonical.find("mechanism")->find("parameters")->find("crank_m");
  ASSERT_TRUE(crank);
  // Extent of the points: 162.45 mm by 250.42 mm.
  EXPECT_NEAR(crank->find("max")->as_number(), 4 * std::hypot(0.16245, 0.25042), 1e-9);
}

TEST(ClearanceDesignStudy, NamesWhatIsWrong) {
  const auto problems = [](DesignTarget target, const std::string& what, const std::string& by) {
    return problems_of(replaced(kind_example(target), what, by));
  };
  using enum DesignTarget;
  EXPECT_THAT(problems(lengths, "clearance_mm = 1.0", "clearance_mm = 0.0"),
              HasSubstr("must be more than 0"));
  EXPECT_THAT(problems(lengths, "clearance_mm = 1.0", "clearance_mm = 40.0"),
              HasSubstr("40 mm is more than half of the shortest crank, 60 mm"));
  EXPECT_THAT(problems(masses, "clearance_mm = 1.0", "clearance_mm = 60.0"),
              HasSubstr("60 mm is more than half of the shortest link, 100 mm"));
  EXPECT_THAT(problems(masses, "ground_mm         = 200.0", "ground_mm = 140.0"),
              HasSubstr("the crank does not rotate fully wherever the pin lies in its bush"));
  EXPECT_THAT(problems(masses, "crank_mm          = 100.0", "crank_mm = { min = 90.0, max = 110.0 }"),
              HasSubstr("crank is a range, but masses are designed here, not lengths; write a number"));
  EXPECT_THAT(problems(masses, "rocker_mm         = 250.0\n", ""),
              HasSubstr("there is no rocker; all nine are needed"));
  EXPECT_THAT(problems(masses, "speed_rpm = 100.0", "speed_rpm = 0.0"), HasSubstr("the crank stands still"));
  EXPECT_THAT(problems(masses, "centre_v_mm   = { min = -50.0, max = 50.0 }\n", ""),
              HasSubstr("the coupler has no centre_v_mm"));
  const std::string timing = "timing    = { start_deg = 0.0, step_deg = 30.0 }";
  EXPECT_THAT(problems(lengths, timing, "timing = { start_deg = 0.0 }"),
              HasSubstr("the crank angles of the points are missing"));
  EXPECT_THAT(problems(lengths, timing, "timing = { step_deg = 30.0, angles_deg = [1.0] }"),
              HasSubstr("there are both step and angles"));
  EXPECT_THAT(problems(lengths, timing, "timing = { angles_deg = [1.0, 2.0] }"),
              HasSubstr("2 angles for 12 points"));
  EXPECT_THAT(problems(lengths, timing, "timing = { step_deg = 0.0 }"),
              HasSubstr("the step is 0 deg, it must not be zero nor more than a turn"));
  EXPECT_THAT(problems(lengths, timing, "timing = { step_deg = -30.0, free_within_deg = 5.0 }"),
              HasSubstr("the crank angle of point 2 is not more than that of point 1"));
  EXPECT_THAT(problems(both, timing, "timing = { step_deg = 30.0, free_within_deg = 5.0 }"),
              HasSubstr("at_once needs prescribed crank angles"));
  EXPECT_THAT(
      problems(lengths, "[optimiser]", "[reference]\n[reference.parameters]\ncrank_mm = 1.0\n[optimiser]"),
      HasSubstr("there is no ground; all nine are needed"));
  EXPECT_THAT(problems(lengths, "[optimiser]", "[drive]\nspeed_rpm = 1.0\n[optimiser]"),
              HasSubstr(": drive: unknown key; allowed here: "));
}

}  // namespace
}  // namespace linkwright::clearance
