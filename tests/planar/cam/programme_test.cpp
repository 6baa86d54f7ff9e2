// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/programme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/check.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using math::Motion;
using test::at;
using test::number_at;
using test::numbers;
using test::published_case;

constexpr double degree = pi / 180;
constexpr CamLaw moving_laws[] = {CamLaw::harmonic,        CamLaw::cycloidal,     CamLaw::polynomial_345,
                                  CamLaw::polynomial_4567, CamLaw::modified_sine, CamLaw::modified_trapezoid,
                                  CamLaw::constant_speed};

const Value& computed(const char* id) { return at(published_case("planar-machines.json", id), "computed"); }

CamProgramme rise_and_return(CamLaw rise, CamLaw fall) {
  return {.segments = {{rise, 120 * degree, 0.02, {}},
                       {CamLaw::dwell, 60 * degree, 0, {}},
                       {fall, 120 * degree, 0, {}},
                       {CamLaw::dwell, 60 * degree, 0, {}}}};
}

void expect_motion(const Motion& m, const std::vector<double>& wanted, const std::string& what) {
  const double found[] = {m.value, m.rate, m.acceleration, m.jerk};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(found[k], wanted[k], 1e-12 * std::max(1.0, std::abs(wanted[k]))) << what << ", order " << k;
}

TEST(CamLaws, HaveThePublishedValues) {
  const Value& laws = computed("motion-laws");
  for (const CamLaw law : moving_laws) {
    if (law == CamLaw::constant_speed) continue;
    const std::string name(name_of(law));
    expect_motion(normalised_motion(law, 0.3), numbers(at(laws, name + ".at_0_30")), name);
    expect_motion(normalised_motion(law, 0.65), numbers(at(laws, name + ".at_0_65")), name);
    // Ten thousand samples meet the peak of a smooth curve to 1e-7 of its curvature.
    double speed = 0, acceleration = 0, jerk = 0;
    for (int k = 0; k <= 10000; ++k) {
      const Motion m = normalised_motion(law, k / 10000.0);
      speed = std::max(speed, std::abs(m.rate));
      acceleration = std::max(acceleration, std::abs(m.acceleration));
      jerk = std::max(jerk, std::abs(m.jerk));
    }
    EXPECT_NEAR(speed, number_at(laws, name + ".peak_speed"), 1e-6) << name;
    EXPECT_NEAR(acceleration, number_at(laws, name + ".peak_acceleration"), 1e-6) << name;
    EXPECT_NEAR(jerk, number_at(laws, name + ".peak_jerk"), 1e-5) << name;
  }
  EXPECT_NEAR(normalised_motion(CamLaw::modified_sine, 0.5).jerk,
              number_at(laws, "modified_sine.jerk_at_the_middle"), 1e-12 * 24);
}

TEST(CamLaws, ModifiedTrapezoidHasConstantPartsOfAQuarter) {
  for (const double x : {0.126, 0.374, 0.626, 0.874})
    EXPECT_EQ(normalised_motion(CamLaw::modified_trapezoid, x).jerk, 0) << x;
  for (const double x : {0.124, 0.376, 0.624, 0.876})
    EXPECT_NE(normalised_motion(CamLaw::modified_trapezoid, x).jerk, 0) << x;
}

// A second route: differences of each derivative give the next one.
TEST(CamLaws, DerivativesAreThoseOfTheValues) {
  for (const CamLaw law : moving_laws) {
    EXPECT_NEAR(normalised_motion(law, 0).value, 0, 1e-15);
    EXPECT_NEAR(normalised_motion(law, 1).value, 1, 1e-14);
    for (const double x : {0.06, 0.2, 0.31, 0.44, 0.52, 0.7, 0.81, 0.93}) {
      const double h = 1e-5;
      const Motion low = normalised_motion(law, x - h), high = normalised_motion(law, x + h),
                   m = normalised_motion(law, x);
      EXPECT_NEAR((high.value - low.value) / (2 * h), m.rate, 1e-7) << name_of(law);
      EXPECT_NEAR((high.rate - low.rate) / (2 * h), m.acceleration, 1e-7) << name_of(law);
      EXPECT_NEAR((high.acceleration - low.acceleration) / (2 * h), m.jerk, 2e-6) << name_of(law);
    }
  }
  EXPECT_THROW(normalised_motion(CamLaw::polynomial, 0.5), ContractError);
  EXPECT_THROW(normalised_motion(CamLaw::cycloidal, 1.5), ContractError);
}

TEST(CamProgramme, TellsJumpsOfTheAcceleration) {
  const CamProgramme programme = {.segments = {{CamLaw::harmonic, 90 * degree, 0.02, {}},
                                               {CamLaw::dwell, 90 * degree, 0, {}},
                                               {CamLaw::polynomial_345, 180 * degree, 0, {}}}};
  const Value& wanted = at(computed("cam-programme-jumps"), "acceleration_jump_m_per_rad2");
  std::vector<ProgrammeFinding> jumps = findings(programme);
  std::erase_if(jumps, [](const ProgrammeFinding& f) { return f.severity == ProgrammeSeverity::note; });
  ASSERT_EQ(jumps.size(), 2u);
  for (const ProgrammeFinding& f : jumps) {
    EXPECT_EQ(f.issue, ProgrammeIssue::jump_of_acceleration);
    EXPECT_EQ(f.severity, ProgrammeSeverity::warning);
  }
  EXPECT_NEAR(jumps[0].angle, 0, 1e-15);
  EXPECT_NEAR(jumps[0].size, number_at(wanted, "at_0_deg"), 1e-14);
  EXPECT_NEAR(jumps[1].angle, 90 * degree, 1e-15);
  EXPECT_NEAR(jumps[1].size, number_at(wanted, "at_90_deg"), 1e-14);
}

TEST(CamProgramme, TellsWhatDoesNotFillOrClose) {
  CamProgramme programme = rise_and_return(CamLaw::polynomial_4567, CamLaw::polynomial_4567);
  EXPECT_TRUE(findings(programme).empty());
  programme.segments[3].over -= 10 * degree;
  std::vector<ProgrammeFinding> found = findings(programme);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].issue, ProgrammeIssue::segments_do_not_fill);
  EXPECT_NEAR(found[0].size, 10 * degree, 1e-15);
  programme.segments[3].over += 10 * degree;
  programme.segments[2].to = 0.012;
  found = findings(programme);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].issue, ProgrammeIssue::does_not_close);
  EXPECT_NEAR(found[0].size, 0.012, 1e-15);
  programme.is_sector = true;
  EXPECT_TRUE(findings(programme).empty());
  programme.segments[0].over = 0;
  ASSERT_EQ(findings(programme).size(), 1u);
  EXPECT_EQ(findings(programme)[0].issue, ProgrammeIssue::no_motion);
  EXPECT_THROW(ProgrammeCurve{programme}, ContractError);
}

TEST(CamProgramme, TellsJumpsOfTheSpeedAsErrors) {
  const std::vector<ProgrammeFinding> found =
      findings(rise_and_return(CamLaw::constant_speed, CamLaw::polynomial_4567));
  ASSERT_EQ(found.size(), 2u);
  for (const ProgrammeFinding& f : found) {
    EXPECT_EQ(f.issue, ProgrammeIssue::jump_of_rate);
    EXPECT_EQ(f.severity, ProgrammeSeverity::error);
  }
  EXPECT_NEAR(found[0].size, 0.02 / (120 * degree), 1e-15);
  EXPECT_NEAR(found[1].size, -0.02 / (120 * degree), 1e-15);
}

TEST(CamProgramme, RepeatsOverTurnsAndRestsBeyondASector) {
  CamProgramme programme = rise_and_return(CamLaw::cycloidal, CamLaw::modified_sine);
  const ProgrammeCurve turning(programme);
  EXPECT_NEAR(turning(60 * degree).value, 0.01, 1e-16);
  EXPECT_NEAR(turning(150 * degree).value, 0.02, 1e-16);
  for (const double angle : {20.0, 70.0, 200.0, 290.0, 350.0}) {
    const Motion m = turning(angle * degree);
    for (const int turns : {-2, 1}) {
      const Motion other = turning(angle * degree + 2 * pi * turns);
      EXPECT_NEAR(other.value, m.value, 1e-15);
      EXPECT_NEAR(other.acceleration, m.acceleration, 1e-14);
    }
  }
  programme.is_sector = true;
  programme.segments.resize(1);
  programme.angle = 120 * degree;
  EXPECT_TRUE(findings(programme).empty());
  const ProgrammeCurve sector(programme);
  EXPECT_EQ(sector(-1).value, 0);
  EXPECT_NEAR(sector(3).value, 0.02, 1e-16);
  EXPECT_EQ(sector(3).rate, 0);
}

// The polynomial of rest, acceleration and jerk at both ends is the 4-5-6-7 one.
TEST(CamProgramme, PolynomialsMeetTheirConditions) {
  const SegmentConditions rest{0, 0, 0, 0, 0, 0};
  CamProgramme given = rise_and_return(CamLaw::polynomial_4567, CamLaw::polynomial_4567), free = given;
  for (const std::size_t i : {0u, 2u})
    free.segments[i].law = CamLaw::polynomial, free.segments[i].conditions = rest;
  const ProgrammeCurve one(given), other(free);
  for (int k = 0; k < 72; ++k) {
    EXPECT_NEAR(other(k * 5 * degree).value, one(k * 5 * degree).value, 1e-14);
    EXPECT_NEAR(other(k * 5 * degree).acceleration, one(k * 5 * degree).acceleration, 1e-12);
  }
}

// A spline through 72 rows of 1 - cos and of its first harmonic comes near them, across the seam as well.
TEST(CamProgramme, TablesAreSmoothAcrossTheTurn) {
  CamProgramme programme;
  programme.table.emplace();
  const auto lift = [](double angle) { return 0.01 * (1 - std::cos(angle)) + 0.002 * std::sin(2 * angle); };
  for (int k = 0; k <= 72; ++k) {
    programme.table->angles.push_back(k * 5 * degree);
    programme.table->values.push_back(lift(k % 72 * 5 * degree));
  }
  EXPECT_TRUE(findings(programme).empty());
  const ProgrammeCurve curve(programme);
  for (const double angle : {-0.01, 0.01, 1.234, 4.321}) {
    EXPECT_NEAR(curve(angle).value, lift(angle), 1e-9);
    EXPECT_NEAR(curve(angle).acceleration, 0.01 * std::cos(angle) - 0.008 * std::sin(2 * angle), 1e-6);
  }
  programme.table->values.back() = 0.003;
  ASSERT_FALSE(findings(programme).empty());
  EXPECT_EQ(findings(programme)[0].issue, ProgrammeIssue::does_not_close);
}

}  // namespace
}  // namespace linkwright::planar
