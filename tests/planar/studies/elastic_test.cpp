// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/elastic.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "linkwright/core/memory.h"
#include "linkwright/study/write.h"
#include "planar/elastic_bodies.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::column;
using test::fact;
using test::largest;
using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::string rod = R"([[elastic]]
body                = "rod"
segments            = 4
density_kg_per_m3   = 7850.0
area_mm2            = 80.0
second_moment_mm4   = 106.66666666666667
elastic_modulus_GPa = 210.0
fibre_distance_mm   = 2.0
)";
const std::string slider_crank = R"(schema = 1
kind   = "simulation"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name      = "crank"
points_mm = { O = [0, 0], A = [50, 0] }
mass_kg   = 0.5
[[mechanism.body]]
name      = "rod"
points_mm = { A = [0, 0], M = [150, 0], B = [300, 0] }
start     = { x_mm = 50.0 }
[[mechanism.body]]
name          = "slider"
points_mm     = { B = [0, 0] }
mass_kg       = 0.2
inertia_kg_m2 = 0.0
start         = { x_mm = 350.0 }
[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "crank.O"
[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "rod.A"
[[mechanism.joint]]
name   = "B"
first  = "rod.B"
second = "slider.B"
[[mechanism.joint]]
name   = "guide"
type   = "prismatic"
first  = "ground.O"
second = "slider.B"
[[drive]]
joint     = "O"
law       = "constant_speed"
speed_rpm = 600.0
[environment]
gravity_m_per_s2 = 0.0
[simulation]
to_s    = 0.1
samples = 101
[[trace]]
point = "rod.M"
)";
std::string with_rod(std::string_view what = {}, std::string_view by = {}) {
  const std::string text = slider_crank + rod;
  return what.empty() ? text : replaced(text, std::string(what), std::string(by));
}

TEST(LinkageElasticStudy, ReportsBendingBesideTheRigidLinkage) {
  const study::Result r = run_text(with_rod());
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  ASSERT_THAT(r.tables, SizeIs(3));
  const Table& motion = r.tables[0];
  EXPECT_EQ(motion.name, "motion");
  EXPECT_EQ(motion.rows(), 101u);
  EXPECT_THAT(motion.status, Each("done"));
  EXPECT_EQ(r.tables[1].name, "rigid");
  EXPECT_EQ(r.tables[2].name, "spectrum");
  for (const char* key :
       {"rod_middle_deflection_m", "rod_largest_deflection_m", "rod_bending_moment_N_m", "rod_normal_force_N",
        "rod_bending_stress_Pa", "rod_stress_Pa", "rod_stress_place_m", "guide_displacement_error_m",
        "rod_M_error_m", "energy_drift_J", "rod_angle_rad", "rod_M_x_m", "A_N", "O_drive_torque_N_m"})
    EXPECT_TRUE(motion.find(key)) << key;
  for (const Column& c : motion.columns) EXPECT_THAT(c.key, ::testing::Not(HasSubstr("piece"))) << c.key;
  EXPECT_FALSE(motion.find("crank_angle_error_rad")) << "its drive moves it";
  EXPECT_LE(largest(column(r, "motion", "energy_drift_J")),
            1e-6 * largest(column(r, "motion", "kinetic_energy_J")));
  // Bending and normal force, as they are in the row.
  const auto &moment = column(r, "motion", "rod_bending_moment_N_m"),
             &normal = column(r, "motion", "rod_normal_force_N"),
             &stress = column(r, "motion", "rod_stress_Pa");
  for (std::size_t i = 0; i < stress.size(); ++i)
    EXPECT_NEAR(stress[i], std::abs(moment[i]) * 2e-3 / test::second_moment + std::abs(normal[i]) / 80e-6,
                1e-9 * stress[i]);
  // The traced point sits in the middle: it leaves its rigid place by the deflection, and by what that lets
  // the slider move, a hundredth of it.
  const auto& error = column(r, "motion", "rod_M_error_m");
  const double bent = largest(column(r, "motion", "rod_middle_deflection_m"));
  EXPECT_NEAR(largest(error), bent, 0.01 * bent);
  EXPECT_LT(largest(column(r, "motion", "guide_displacement_error_m")), 0.01 * bent);
  // Beside it the rigid linkage has the mass of the beam.
  EXPECT_NEAR(largest(column(r, "rigid", "A_N")) / largest(column(r, "motion", "A_N")), 1, 0.3);
  EXPECT_EQ(column(r, "rigid", "time_s"), column(r, "motion", "time_s"));
  for (const study::Plot& p : r.plots) {
    const Table& t = p.table == "motion" ? motion : r.tables[2];
    for (const std::string& y : p.y) {
      EXPECT_TRUE(t.find(y)) << y;
      EXPECT_TRUE(p.baseline.empty() || r.tables[1].find(y)) << y;
    }
  }
  EXPECT_THAT(to_string(r.headline),
              AllOf(HasSubstr("Rod bends by up to "), HasSubstr(" mm and bears up to 15.1 MPa "),
                    HasSubstr(" mm from A; guide displacement error up to ")));
  EXPECT_THAT(fact(r, "rod: first frequency on two pins"),
              HasSubstr("104.2 Hz, 10.4 times the largest input speed; 4 segments"));
  EXPECT_THAT(fact(r, "integration"), HasSubstr("Runge-Kutta of order 8, as no body is damped; "));
  EXPECT_EQ(test::value_of_fact(r, "rod: largest deflection"),
            largest(column(r, "motion", "rod_largest_deflection_m")));
  EXPECT_THAT(fact(r, "joint force that grew most over the rigid linkage"),
              ::testing::MatchesRegex("[0-9.e-]+ N in [^,]+, [0-9.e-]+ times [0-9.e-]+ N"));
  EXPECT_THAT(fact(r, "largest drive torque at O"), HasSubstr(", of the rigid linkage "));
  EXPECT_THAT(r.diagnostics, IsEmpty());
}

TEST(LinkageElasticStudy, ShowsTheFirstFrequencyInItsSpectrum) {
  const study::Result r =
      run_text(replaced(with_rod(), "to_s    = 0.1\nsamples = 101", "to_s    = 0.5\nsamples = 1001"));
  const auto &frequency = column(r, "spectrum", "frequency_Hz"),
             &amplitude = column(r, "spectrum", "rod_middle_deflection_m");
  // Beyond what 10 turns a second force: 104.3 Hz on two pins, a few per cent off by the turning and the mass
  // of the slider, within the lines of 2 Hz.
  std::size_t most = 0;
  for (std::size_t i = 0; i < frequency.size(); ++i)
    if (frequency[i] > 60 && (frequency[most] <= 60 || amplitude[i] > amplitude[most])) most = i;
  EXPECT_NEAR(frequency[most], 104.3, 6);
}

TEST(LinkageElasticStudy, DrawsDeflectionsAsLargeAsTheyAreSeen) {
  const study::Result chosen = run_text(with_rod());
  ASSERT_THAT(chosen.scenes, SizeIs(1));
  const study::Scene& s = chosen.scenes[0];
  EXPECT_THAT(to_string(s.title), HasSubstr("deflections drawn "));
  const study::Result ten =
      run_text(replaced(with_rod(), "samples = 101", "samples = 101\ndeflection_scale = 10"));
  EXPECT_EQ(ten.scenes.at(0).title, "deflections drawn 10 x");
  EXPECT_EQ(run_text(replaced(with_rod(), "samples = 101", "samples = 101\ndeflection_scale = 1"))
                .scenes.at(0)
                .title,
            "simulation/planar.linkage");
  // The middle of the rod stands ten times its deflection off the line between the drawn ends.
  const study::Scene& t = ten.scenes[0];
  std::vector<int> bars;
  for (const study::Scene::Body& b : t.bodies)
    if (b.name == "rod" && b.style == study::Scene::BodyStyle::bar) bars.push_back(b.points[0]);
  ASSERT_THAT(bars, SizeIs(4));
  const auto& middle = column(ten, "motion", "rod_middle_deflection_m");
  for (const std::size_t row : {10u, 50u, 90u}) {
    const auto x = [&](int p) { return t.points[static_cast<std::size_t>(p)].x[row]; };
    const auto y = [&](int p) { return t.points[static_cast<std::size_t>(p)].y[row]; };
    const int a = bars[0], m = bars[2], b = bars[3] + 1;
    const double length = std::hypot(x(b) - x(a), y(b) - y(a));
    const double off = ((x(b) - x(a)) * (y(m) - y(a)) - (y(b) - y(a)) * (x(m) - x(a))) / length;
    EXPECT_NEAR(off, 10 * middle[row], 1e-12) << row;
  }
}

TEST(LinkageElasticStudy, TakesAMethodThatSuitsTheDamping) {
  const auto damped = [&](const char* seconds) {
    return with_rod("fibre_distance_mm   = 2.0",
                    std::string("fibre_distance_mm   = 2.0\nstiffness_damping_s = ") + seconds);
  };
  const study::Result swings = run_text(damped("1e-5")), dies = run_text(damped("1e-3"));
  EXPECT_THAT(fact(swings, "integration"),
              AllOf(HasSubstr("Runge-Kutta of order 8, as the fastest vibration of rod has 0."),
                    HasSubstr(" of its critical damping and swings on")));
  EXPECT_THAT(fact(dies, "integration"),
              AllOf(HasSubstr("backward differentiation, as the fastest vibration of rod has "),
                    HasSubstr("dies out at once")));
  EXPECT_EQ(dies.status, Status::done);
  EXPECT_THAT(fact(run_text(replaced(damped("1e-3"), "samples = 101",
                                     "samples = 101\nmethod = \"explicit_runge_kutta_5\"")),
                   "integration"),
              HasSubstr("Runge-Kutta of order 5, as the study says"));
}

TEST(LinkageElasticStudy, KeepsRowsWhenStepsAreUsedUp) {
  const study::Result r = run_text(replaced(with_rod("segments            = 4", "segments            = 16"),
                                            "samples = 101", "samples = 101\nmax_steps = 2000"));
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_GT(r.tables.at(0).rows(), 1u);
  EXPECT_LT(r.tables.at(0).rows(), 101u);
  EXPECT_THAT(to_string(r.headline), HasSubstr("It ends at "));
  ASSERT_THAT(r.diagnostics, SizeIs(1));
  EXPECT_THAT(
      to_string(r.diagnostics[0].hint),
      AllOf(HasSubstr("the fastest vibration of the pieces has "),
            HasSubstr("take fewer segments, more max_steps, or stiffness_damping with method = \"bdf\"")));
}

TEST(LinkageElasticStudy, SettlesBeforeItsFirstRow) {
  // 6.5 % of critical damping: half a second takes the start away to 1e-9. A turn takes 0.1 s.
  const std::string damped = with_rod("segments            = 4", "segments = 4\nstiffness_damping_s = 2e-4");
  const study::Result at_once = run_text(damped),
                      settled = run_text(replaced(damped, "samples = 101", "samples = 101\nsettle_s = 0.5"));
  ASSERT_EQ(settled.status, Status::done) << to_string(settled.headline);
  const auto &before = column(at_once, "motion", "rod_middle_deflection_m"),
             &after = column(settled, "motion", "rod_middle_deflection_m");
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(column(settled, "motion", "time_s").front(), 0);
  EXPECT_NEAR(after.front(), after.back(), 1e-4 * largest(after));  // rounding of tolerances of 1e-7 a step
  EXPECT_GT(std::abs(before.front() - before.back()), 0.01 * largest(before));
  EXPECT_THAT(fact(settled, "settled"), HasSubstr("0.5 s before the first row"));
  EXPECT_THAT(problems_of(replaced(slider_crank, "samples = 101", "samples = 101\nsettle_s = 0.5")),
              HasSubstr("settle_s: no body is flexible"));
  const std::string free = replaced(replaced(damped, "law       = \"constant_speed\"\nspeed_rpm = 600.0",
                                             "free = true\nstart_speed_rpm = 600.0"),
                                    "samples = 101", "samples = 101\nsettle_s = 0.5");
  EXPECT_THAT(problems_of(free),
              HasSubstr("a joint is free: it would not be where its drive says at `from`"));
}

TEST(LinkageElasticStudy, BendsInSliderCranksAndWithFreeJoints) {
  const std::string beam = replaced(rod, "segments            = 4", "segments            = 2");
  const study::Result r = run_text(
      replaced(slider_crank_simulation_kind().example, "to_s = 0.5", "to_s = 0.05\nsamples = 51") + beam);
  ASSERT_EQ(r.status, Status::done) << to_string(r.headline);
  EXPECT_FALSE(r.tables[0].find("O_drive_torque_N_m")) << "the joint is free";
  EXPECT_GT(largest(column(r, "motion", "rod_middle_deflection_m")), 1e-6);
  EXPECT_LE(largest(column(r, "motion", "energy_drift_J")),
            1e-6 * largest(column(r, "motion", "kinetic_energy_J")));
}

TEST(LinkageElasticStudy, WritesWhatItReads) {
  std::string messages;
  const auto first = prepare(with_rod(), messages);
  ASSERT_TRUE(first) << messages;
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(LinkageElasticStudy, WarnsOfAnotherMassThanThatOfTheBeam) {
  std::string messages;
  ASSERT_TRUE(
      prepare(with_rod("start     = { x_mm = 50.0 }", "start = { x_mm = 50.0 }\nmass_kg = 0.5"), messages));
  EXPECT_THAT(messages,
              HasSubstr("body 'rod' is given 0.5 kg, but its beam weighs 0.1884 kg, which takes the "
                        "place of it"));
}

// The places of the nodes count: the finest beam takes what four segments leave free.
TEST(LinkageElasticStudy, RefusesMoreNodesThanThereIsMemoryFor) {
  std::string messages;
  const std::string coarse = with_rod("samples = 101", "samples = 1000"),
                    fine = replaced(coarse, "segments            = 4", "segments = 64");
  const MemoryLimit limit(20e6);
  EXPECT_TRUE(prepare(coarse, messages)) << messages;
  EXPECT_THAT(problems_of(fine),
              AllOf(HasSubstr("simulation.samples: 1000 rows with 65 nodes of beams would take "),
                    HasSubstr("at most 20 MB may be taken; take fewer samples or segments")));
}

TEST(LinkageElasticStudy, NamesWhatIsWrong) {
  const auto wrong = [](std::string_view what, std::string_view by) {
    return problems_of(with_rod(what, by));
  };
  EXPECT_THAT(wrong("body                = \"rod\"", "body = \"rot\""),
              AllOf(HasSubstr("there is no body 'rot'"), HasSubstr("did you mean 'rod'?")));
  EXPECT_THAT(wrong("body                = \"rod\"", "body = \"ground\""),
              HasSubstr("'ground' the ground cannot be flexible"));
  EXPECT_THAT(wrong("body                = \"rod\"", "body = \"slider\""),
              HasSubstr("'slider' has its joints in one place"));
  EXPECT_THAT(wrong("segments            = 4", "segments = 0"),
              HasSubstr("elastic[0].segments: is 0, must be at least 1"));
  EXPECT_THAT(wrong("segments            = 4", "segments = 65"),
              HasSubstr("elastic[0].segments: is 65, must be at most 64"));
  EXPECT_THAT(wrong("elastic_modulus_GPa = 210.0", "elastic_modulus_GPa = 0.0"),
              HasSubstr("elastic_modulus_GPa: is 0 GPa, must be more than 0"));
  EXPECT_THAT(wrong("second_moment_mm4   = 106.66666666666667", "second_moment_mm4 = -1.0"),
              HasSubstr("second_moment_mm4: is -1 mm4, must be more than 0"));
  EXPECT_THAT(wrong("area_mm2            = 80.0", ""), HasSubstr("elastic[0].area_m2: this key is missing"));
  EXPECT_THAT(wrong("segments            = 4", "segments = 4\nfrom = \"Q\""),
              HasSubstr("body 'rod' has no point 'Q'"));
  EXPECT_THAT(wrong("segments            = 4", "segments = 4\nfrom = \"A\"\nto = \"A\""),
              HasSubstr("'rod' has no length: its ends lie in one point"));
  EXPECT_THAT(wrong("segments            = 4", "segments = 4\nfrom = \"A\"\nto = \"M\""),
              HasSubstr("joint 'B' sits away from the ends of the beam"));
  EXPECT_THAT(problems_of(with_rod() + rod), HasSubstr("'rod' is given twice"));
  EXPECT_THAT(problems_of(replaced(slider_crank, "samples = 101", "samples = 101\ndeflection_scale = 10")),
              HasSubstr("no body is flexible"));
  EXPECT_THAT(problems_of(replaced(with_rod(), "mass_kg   = 0.5", "")), HasSubstr("'crank' has none"));
}

TEST(LinkageElasticStudy, TellsWhyItDoesNotStart) {
  const study::Result r = run_text(replaced(
      with_rod("points_mm = { O = [0, 0] }\n[[mechanism.body]]\nname      = \"crank\"",
               "points_mm = { O = [0, 0], G = [0, 500] }\n[[mechanism.body]]\nname      = \"crank\""),
      "first  = \"ground.O\"\nsecond = \"slider.B\"", "first  = \"ground.G\"\nsecond = \"slider.B\""));
  EXPECT_EQ(r.status, Status::no_assembly);
  EXPECT_THAT(to_string(r.headline), HasSubstr("The linkage does not start: at 0 s: "));
}

}  // namespace
}  // namespace linkwright::planar
