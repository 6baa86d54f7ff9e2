#include "linkwright/planar/motion_law.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "linkwright/math/differences.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/read.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double pi = std::numbers::pi;

std::vector<MotionLaw> laws() {
  return {ConstantSpeed{0.3, -2},
          CycloidalMotion{0.2, 3.5, 0.5, 2},
          Polynomial345{0.2, -1.5, 0.5, 2, {}},
          Polynomial345{0, 1, 0.5, 2, {15, -3, 2}},
          EndConditions{.from = 1,
                        .to = 2,
                        .start = 0.5,
                        .duration = 2,
                        .start_rate = -0.3,
                        .end_rate = 2,
                        .end_acceleration = 1,
                        .end_jerk = -4},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0.7}, TableCurve::quintic, TableEnds::natural},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0.7}, TableCurve::cubic, TableEnds::rest},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0}, TableCurve::quintic, TableEnds::periodic},
          HarmonicMotion{0.1, 0.7, 0.4, 0.9}};
}

TEST(MotionLaw, DerivativesAreThoseOfTheValue) {
  for (const MotionLaw& law : laws()) {
    const MotionCurve curve(law);
    const auto function = [&](std::span<const double> t, std::span<double> r, std::span<double> jacobian) {
      const Motion m = curve(t[0]);
      r[0] = m.value, r[1] = m.rate, r[2] = m.acceleration;
      if (!jacobian.empty()) jacobian[0] = m.rate, jacobian[1] = m.acceleration, jacobian[2] = m.jerk;
      return true;
    };
    // Off the knots and ends, with room for the steps of the differences.
    for (double t : {-3.1, 0.31, 0.7, 1.1, 1.6, 2.24, 2.9, 11.4}) {
      const double x[1] = {t}, scale[1] = {0.3};
      const auto check = math::check_jacobian(function, 3, x, scale);
      EXPECT_TRUE(check.passed) << "law " << law.index() << " at " << t << ", row " << check.row << ": "
                                << check.analytic << " against " << check.numeric;
    }
  }
}

void expect_motion(const Motion& m, double value, double rate, double acceleration, double jerk) {
  // Coefficients of up to some hundreds cancel at the ends.
  constexpr double tolerance = 1e-12;
  EXPECT_NEAR(m.value, value, tolerance);
  EXPECT_NEAR(m.rate, rate, tolerance);
  EXPECT_NEAR(m.acceleration, acceleration, tolerance);
  if (!std::isnan(jerk)) {
    EXPECT_NEAR(m.jerk, jerk, 10 * tolerance);
  }
}

TEST(MotionLaw, RestToRestLawsRestOutside) {
  for (const MotionLaw& law :
       {MotionLaw(CycloidalMotion{0.2, 3.5, 0.5, 2}), MotionLaw(Polynomial345{0.2, 3.5, 0.5, 2, {}}),
        MotionLaw(Polynomial345{0.2, 3.5, 0.5, 2, {15.885, -2}})}) {
    const MotionCurve curve(law);
    expect_motion(curve(-1), 0.2, 0, 0, 0);
    expect_motion(curve(0.5), 0.2, 0, 0, NAN);
    expect_motion(curve(2.5), 3.5, 0, 0, NAN);
    expect_motion(curve(9), 3.5, 0, 0, 0);
  }
  EXPECT_NEAR(MotionCurve(CycloidalMotion{0, 1, 0, 4})(1).value, 0.25 - 1 / (2 * pi), 1e-15);
  EXPECT_NEAR(MotionCurve(CycloidalMotion{0, 1, 0, 4})(2).rate, 0.5, 1e-15);
  EXPECT_NEAR(MotionCurve(Polynomial345{0, 1, 0, 2, {}})(1).rate, 1.875 / 2, 1e-15);
}

// Boskovic 2018, Eqs. (2.42)-(2.47): a3 = 10 - a, a4 = -15 + 3 a, a5 = 6 - 3 a.
TEST(MotionLaw, FreeCoefficientLeavesTheOthersToTheEnds) {
  const double a = 15.885;
  const MotionCurve curve(Polynomial345{0, pi, 0, 10, {a}});
  for (double x : {0.1, 0.35, 0.8}) {
    const double s = x * x * x * (10 - a + (-15 + 3 * a) * x + (6 - 3 * a) * x * x + a * x * x * x);
    EXPECT_NEAR(curve(10 * x).value, pi * s, 1e-13);  // coefficients up to 40 pi
  }
}

// Boskovic 2018, Eqs. (2.42)-(2.47): a_3 = 10 - a, a_4 = -15 + 3 a, a_5 = 6 - 3 a.
TEST(MotionLaw, CoefficientsOfRestToRestLaws) {
  EXPECT_EQ(coefficients(Polynomial345{.from = 1, .to = 4, .higher = {2}}),
            (std::vector<double>{0, 0, 0, 8, -9, 0, 2}));
  const std::vector<double> c = coefficients(Polynomial345{.higher = {2, -3, 0.5}});
  double value = 0, rate = 0, acceleration = 0;
  for (std::size_t p = 0; p < c.size(); ++p) {
    const auto q = static_cast<double>(p);
    value += c[p], rate += q * c[p], acceleration += q * (q - 1) * c[p];
  }
  EXPECT_EQ(value, 1);
  EXPECT_EQ(rate, 0);
  EXPECT_EQ(acceleration, 0);
}

TEST(MotionLaw, MeetsItsEndConditionsAndNoOthers) {
  const MotionCurve all(EndConditions{.from = 1,
                                      .to = -2,
                                      .start = 0.5,
                                      .duration = 3,
                                      .start_rate = 0.4,
                                      .start_acceleration = -1,
                                      .start_jerk = 2,
                                      .end_rate = -0.7,
                                      .end_acceleration = 0.6,
                                      .end_jerk = -5});
  expect_motion(all(0.5), 1, 0.4, -1, 2);
  expect_motion(all(3.5), -2, -0.7, 0.6, -5);
  // Even motion before and after.
  expect_motion(all(0), 1 - 0.2, 0.4, 0, 0);
  expect_motion(all(4.5), -2.7, -0.7, 0, 0);
  // A parabola: from, to and the speed at the start.
  const MotionCurve parabola(EndConditions{.from = 0, .to = 3, .duration = 2, .start_rate = 0.5});
  expect_motion(parabola(1), 1, 1.5, 1, 0);
  // Without a position at the end.
  const MotionCurve open(EndConditions{.from = 1, .duration = 2, .start_acceleration = 3, .end_rate = 4});
  expect_motion(open(2), 1 - 2 * 2 + 6, 4, 3, 0);
}

TEST(MotionLaw, PeriodicTableIsContinuousAroundTheEnd) {
  for (TableCurve curve : {TableCurve::cubic, TableCurve::quintic})
    for (double turn : {0.0, 2 * pi}) {
      const MotionCurve law(
          MotionTable{{0, 0.5, 0.9, 1.4, 2}, {0, 1, 2.5, 2.6, turn}, curve, TableEnds::periodic});
      // Jerks reach some hundreds: over 2e-9 s they change acceleration by less than 1e-5.
      for (double end : {2.0, 4.0, -2.0}) {
        const Motion before = law(end - 1e-9), after = law(end + 1e-9);
        EXPECT_NEAR(before.value, after.value, 1e-7);
        EXPECT_NEAR(before.rate, after.rate, 1e-6);
        EXPECT_NEAR(before.acceleration, after.acceleration, 1e-5);
        if (curve == TableCurve::quintic) {
          EXPECT_NEAR(before.jerk, after.jerk, 1e-3);
        }
      }
      EXPECT_NEAR(law(0.9 + 6).value, 2.5 + 3 * turn, 1e-12);
      EXPECT_NEAR(law(0.9 - 4).value, 2.5 - 2 * turn, 1e-12);
      EXPECT_NEAR(law(1.1 - 4).acceleration, law(1.1).acceleration, 1e-10);
    }
}

TEST(MotionLaw, TableRestsOrGoesOnAtItsEnds) {
  const std::vector<double> t = {0, 1, 2, 3}, y = {0, 0.5, 2, 3};
  const Motion rest = MotionCurve(MotionTable{t, y, TableCurve::quintic, TableEnds::rest})(5);
  expect_motion(rest, 3, 0, 0, 0);
  const MotionCurve natural(MotionTable{t, y, TableCurve::cubic, TableEnds::natural});
  EXPECT_NEAR(natural(3).acceleration, 0, 1e-12);
  EXPECT_NEAR(natural(4).value, 3 + natural(3).rate, 1e-12);
}

TEST(MotionLaw, NamesWhatIsNoMotion) {
  const auto message = [](const MotionLaw& law) { return test::message([&] { MotionCurve curve(law); }); };
  EXPECT_THAT(message(CycloidalMotion{0, 1, 0, 0}), HasSubstr("duration is 0 s, must be more than 0 s"));
  EXPECT_THAT(message(ConstantSpeed{0, NAN}), HasSubstr("speed is nan, must be finite"));
  EXPECT_THAT(message(MotionTable{{0, 1, 2}, {0, 1}}), HasSubstr("values has 2 values for 3 times"));
  EXPECT_THAT(message(MotionTable{{0, 1, 1}, {0, 1, 2}}),
              HasSubstr("times must increase, but 1 s follows 1 s (row 3)"));
  EXPECT_THAT(message(MotionTable{{0, 1}, {0, 0}, TableCurve::cubic, TableEnds::periodic}),
              HasSubstr("times has 2 rows, must have at least 3"));
  EXPECT_THAT(message(EndConditions{.from = 1}), HasSubstr("a position at the start alone is no motion"));
  EXPECT_THAT(message(EndConditions{.from = 1, .start_acceleration = 1, .end_acceleration = 2}),
              HasSubstr("the conditions do not determine the motion: 1 of orders up to speeds is given"));
  EXPECT_FALSE(problem(MotionTable{{0, 1}, {0, 1}, TableCurve::cubic, TableEnds::natural}));
}

// Tables that hold the motion of one joint.
struct RotaryEntry {
  RotaryLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, RotaryEntry& e) {
  visit(Field{.key = "law", .summary = "motion", .required = true}, e.law);
}
struct LinearEntry {
  LinearLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, LinearEntry& e) {
  visit(Field{.key = "law", .summary = "motion", .required = true}, e.law);
}

template <class Entry>
Entry read(const std::string& text, std::string& messages) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "f", diagnostics);
  study::DocumentReader reader(document, "f", diagnostics);
  Entry entry;
  reader.root().read(entry);
  reader.finish();
  for (const Diagnostic& d : diagnostics) messages += to_string(d) + "\n";
  return entry;
}

TEST(MotionLaw, IsReadWithTheUnitsOfItsJoint) {
  std::string messages;
  const auto turn =
      read<RotaryEntry>("law = \"cycloidal\"\nfrom_deg = 90\nto_rad = 0\nduration_ms = 500\n", messages);
  const auto slide = read<LinearEntry>(
      "law = \"cycloidal\"\nfrom_mm = 90\nto_m = 0\nstart_s = 1\nduration_s = 0.5\n", messages);
  EXPECT_EQ(messages, "");
  const auto& a = std::get<CycloidalMotion>(motion_law(turn.law));
  EXPECT_EQ(a.from, pi / 2);
  EXPECT_EQ(a.duration, 0.5);
  EXPECT_EQ(std::get<CycloidalMotion>(motion_law(slide.law)).from, 0.09);
  const auto even = read<RotaryEntry>("law = \"constant_speed\"\nspeed_rpm = 30\n", messages);
  EXPECT_DOUBLE_EQ(MotionCurve(motion_law(even.law))(1).value, pi);
  const auto table = read<LinearEntry>(
      "law = \"table\"\ntimes_s = [0, 1, 2]\nvalues_mm = [0, 5, 0]\nends = \"periodic\"\n", messages);
  EXPECT_NEAR(MotionCurve(motion_law(table.law))(3).value, 0.005, 1e-17);
  const auto polynomial = read<RotaryEntry>(
      "law = \"polynomial\"\nfrom_deg = 0\nto_deg = 180\nduration_s = 1\nend_speed_rpm = 30\n"
      "start_jerk_deg_per_s3 = 180\n",
      messages);
  EXPECT_EQ(messages, "");
  EXPECT_EQ(std::get<EndConditions>(motion_law(polynomial.law)).start_jerk, pi);
  // What is written reads back to the same.
  const Value written = study::write_fields(polynomial);
  EXPECT_DOUBLE_EQ(written.find("end_speed_rad_per_s")->as_number(), pi);
  EXPECT_EQ(written.find("start_acceleration_rad_per_s2"), nullptr);
  EXPECT_EQ(study::schema_fields<LinearEntry>().find("anyOf") != nullptr ||
                study::schema_fields<LinearEntry>().find("oneOf") != nullptr,
            true);
}

TEST(MotionLaw, MessagesOfBadInput) {
  const auto message = [](const std::string& text) {
    std::string messages;
    read<RotaryEntry>(text, messages);
    return messages;
  };
  EXPECT_THAT(message("law = \"cyclodial\"\n"),
              HasSubstr("is 'cyclodial', must be one of: constant_speed, cycloidal, polynomial_345, "
                        "polynomial, table, harmonic; did you mean 'cycloidal'?"));
  EXPECT_THAT(message("law = \"constant_speed\"\nspeed_m_per_s = 2\n"),
              HasSubstr("is an angular speed, but 'm_per_s' is not a unit of it"));
  EXPECT_THAT(message("law = \"cycloidal\"\nfrom_deg = 0\nto_deg = 1\nduration_s = 0\n"),
              HasSubstr("duration_s: is 0 s, must be at least 1e-09 s"));
  EXPECT_THAT(message("law = \"harmonic\"\namplitude_deg = 3\nfrequency_Hz = -1\n"),
              HasSubstr("frequency_Hz: is -1 Hz, must be at least 0 Hz"));
}

}  // namespace
}  // namespace linkwright::planar
