// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

const std::vector<FormulaName> strut_names{
    {"time", Dimension::time}, {"s", Dimension::length}, {"v", Dimension::speed}, {"a", Dimension::angle}};

Formula formula(std::string_view text, Dimension dimension = Dimension::force) {
  FormulaError error;
  const auto found = Formula::read(text, dimension, strut_names, error);
  EXPECT_TRUE(found) << text << ": column " << error.column << ": " << error.message;
  return found.value_or(Formula());
}
double value(std::string_view text, const std::vector<double>& at = {0, 0, 0, 0},
             Dimension dimension = Dimension::force) {
  return formula(text, dimension)(at);
}
std::string problem(std::string_view text, Dimension dimension = Dimension::force) {
  FormulaError error;
  EXPECT_FALSE(Formula::read(text, dimension, strut_names, error)) << text;
  return "column " + std::to_string(error.column) + ": " + error.message;
}

TEST(Formulas, HaveTheValuesOfTheirQuantities) {
  EXPECT_NEAR(value("200 N + 15 N/mm * (s - 20 mm)", {0, 0.035, 0, 0}), 425.0, 1e-10);
  EXPECT_NEAR(value("if(v > 0, 4 N, -4 N) + 3 N*s/m * v", {0, 0, -0.5, 0}), -5.5, 1e-14);
  EXPECT_NEAR(value("2 MPa * pi/4 * (80 mm)^2"), 10053.09649148734, 1e-9);
  EXPECT_NEAR(value("min(1 kN, 50 N/deg * abs(a - 10 deg))", {0, 0, 0, 0.3}), 359.4366926962348, 1e-10);
  EXPECT_NEAR(value("3 N*m * sin(2*pi*time / (0.5 s))", {0.1, 0, 0, 0}, Dimension::torque),
              2.8531695488854605, 1e-14);
}

TEST(Formulas, SignsAndFunctions) {
  const auto number = [](std::string_view text) { return value(text, {2, 3, 5, 7}, Dimension::none); };
  EXPECT_EQ(number("1 + 2 * 3 - 4 / 2"), 5);
  EXPECT_EQ(number("2 - 3 - 4"), -5);
  EXPECT_EQ(number("-2 ^ 2"), -4);
  EXPECT_EQ(number("2 ^ -1"), 0.5);
  EXPECT_EQ(number("--3"), 3);
  EXPECT_EQ(number("mod(-1, 3) + floor(2.5) + sign(-4) + abs(-6)"), 2 + 2 - 1 + 6);
  EXPECT_EQ(number("max(1, 4, 2) - min(3, 2, 5)"), 2);
  EXPECT_NEAR(number("exp(log(3)) + sqrt(16) + atan2(1, 1) - pi / 4"), 7, 1e-14);
  EXPECT_NEAR(number("asin(0.5) + acos(0.5) + atan(1) + tan(0) + cos(0)"), pi / 2 + pi / 4 + 1, 1e-14);
  EXPECT_EQ(number("if(1 < 2 and not 3 <= 2, 1, 0) + if(2 == 2 or 1 > 2, 10, 0)"), 11);
  EXPECT_EQ(number("if((1 < 2 and 2 < 3), 1, 0)"), 1);
  EXPECT_EQ(number("if(s > 1 m and s >= 3 m, 1, 0)"), 1);
  EXPECT_NEAR(number("sqrt(s * s) / (1 m) + (s / (1 m)) ^ 0.5"), 3 + std::sqrt(3.0), 1e-14);
  EXPECT_EQ(number("180 deg"), pi);
  EXPECT_EQ(number("60 rpm * (1 s)"), 2 * pi);
  EXPECT_NEAR(number("s ^ 2 / (2.5 mm2)"), 9 / 2.5e-6, 1e-6);
  EXPECT_NEAR(number("9.81 m/s^2 * time^2 / s"), 9.81 * 4 / 3, 1e-14);
  EXPECT_TRUE(std::isinf(number("1 / (s - 3 m) * (1 m)")));
}

// Zero is of any dimension, other numbers are not.
TEST(Formulas, ZeroNeedsNoUnit) {
  EXPECT_EQ(value("max(0, 5 N - 1 N/m * s)", {0, 7, 0, 0}), 0);
  EXPECT_EQ(value("0"), 0);
  EXPECT_EQ(problem("max(1, 5 N)"), "column 8: a force does not go with a number");
}

TEST(Formulas, SayWhereTheyAreWrong) {
  EXPECT_EQ(problem("200 N + 15 mm"), "column 9: cannot add a length to a force");
  EXPECT_EQ(problem("200 N - 15 mm"), "column 9: cannot subtract a length from a force");
  EXPECT_EQ(problem("sin(3 m)"), "column 5: sin takes an angle or a number, found a length");
  EXPECT_EQ(problem("log(3 m)"), "column 5: log takes a number, found a length");
  EXPECT_EQ(problem("2 N * (3"), "column 9: ')' is missing");
  EXPECT_EQ(problem("F + 1 N"), "column 1: nothing is called 'F' here; there are time, s, v, a and pi");
  EXPECT_EQ(problem("2 ^ 3 s"), "column 5: an exponent is a number without unit");
  EXPECT_EQ(problem("2 ^ s"), "column 5: an exponent is a number without unit");
  EXPECT_EQ(problem("3 N * s"), "column 1: is a torque, and must be a force");
  EXPECT_EQ(problem("1/0 N"), "column 1: is a quantity in m^-1 kg^-1 s^2, and must be a force");
  EXPECT_EQ(problem("s ^ 0.3"), "column 5: a length has exponents that are whole or half, up to 8");
  EXPECT_EQ(problem("if(s, 1 N, 2 N)"), "column 4: a value stands where a condition is needed");
  EXPECT_EQ(problem("1 N + (v > 0)"), "column 7: a condition stands where a value is needed");
  EXPECT_EQ(problem("v > 0"), "column 1: is a condition, and must be a value");
  EXPECT_EQ(problem("if(v > 1 m, 1 N, 2 N)"), "column 8: cannot compare a length with a speed");
  EXPECT_EQ(problem("if(v > 0, 1 N)"), "column 14: ',' is missing: if(condition, value, other value)");
  EXPECT_EQ(problem("sine(1)"), "column 1: there is no function 'sine'; did you mean 'sin'?");
  EXPECT_EQ(problem("atan2(1)"), "column 1: atan2 takes two values, found 1");
  EXPECT_EQ(problem("3 foo"), "column 3: 'foo' is not a unit; a product needs *");
  EXPECT_EQ(problem("3 N m"), "column 5: 'm' is not expected here");
  EXPECT_EQ(problem(""), "column 1: a value is missing");
  EXPECT_EQ(problem("3 N +"), "column 6: a value is missing");
  EXPECT_EQ(problem("3 N; x"), "column 4: ';' is not expected here");
  EXPECT_EQ(problem(std::string("3 N \x01")), "column 5: '\\x01' is not expected here");
  EXPECT_EQ(problem("sqrt(sqrt(1 N))"), "column 1: a quantity in m^(1/2) kg^(1/2) s^-1 has no root");
}

TEST(Formulas, AreBounded) {
  std::string deep, chain = "1";
  for (int i = 0; i < 300; ++i) deep += "(", chain += "+1";
  EXPECT_EQ(problem(deep + "1 N"), "column 65: is nested more than 64 deep");
  EXPECT_EQ(problem(std::string(300, '-') + "1 N"), "column 66: is nested more than 64 deep");
  EXPECT_EQ(value(chain, {0, 0, 0, 0}, Dimension::none), 301);
  EXPECT_EQ(problem(std::string(2001, ' ')), "column 1: has 2001 characters, 2000 are allowed");
  // What a level may keep, at every level.
  std::string nested;
  for (int i = 0; i < 25; ++i) nested += "if(1<2 and 1<3 or 1<2, 1, 1 + 2 * max(1, ";
  nested += "1";
  for (int i = 0; i < 25; ++i) nested += "))";
  EXPECT_EQ(value(nested, {0, 0, 0, 0}, Dimension::none), 1);
}

TEST(Formulas, HaveTables) {
  const std::string text = "table(s, 0 mm, -10 N, 20 mm, 30 N, 40 mm, 0)";
  EXPECT_EQ(value(text, {0, -1, 0, 0}), -10);
  EXPECT_NEAR(value(text, {0, 0.005, 0, 0}), 0, 1e-14);
  EXPECT_NEAR(value(text, {0, 0.030, 0, 0}), 15, 1e-13);
  EXPECT_EQ(value(text, {0, 1, 0, 0}), 0);
  EXPECT_TRUE(std::isnan(value(text, {0, nan, 0, 0})));
  EXPECT_EQ(problem("table(s, 0 mm, 1 N)"),
            "column 1: a table has two rows at least: table(argument, 0 mm, 10 N, 20 mm, 30 N)");
  EXPECT_EQ(problem("table(s, 1 mm, 1 N, 1 mm, 2 N)"), "column 21: the arguments of a table rise");
  EXPECT_EQ(problem("table(s, 0 s, 1 N, 1 s, 2 N)"), "column 10: a time does not go with a length");
  EXPECT_EQ(problem("table(s, 0 mm, 1 N, 1 mm, 2 mm)"), "column 27: a length does not go with a force");
  EXPECT_EQ(problem("table(s, 0 mm, 1 N, 1 mm)"), "column 25: a row of a table has an argument and a value");
  EXPECT_EQ(problem("table(s, 0 mm, v, 1 mm, 2 N)"), "column 16: a table has numbers behind its argument");
}

// Signs of the numbers of kinks differ on both sides of each, and nowhere else.
TEST(Formulas, KnowWhereTheyJumpOrBend) {
  const auto kinks = [](std::string_view text, double v) {
    const Formula f = formula(text, Dimension::none);
    std::vector<double> out(f.kinks());
    f.find_kinks(std::vector<double>{0, 0, v, 0}, out);
    return out;
  };
  struct Case {
    const char* text;
    std::vector<double> at;
  };
  for (const Case& c : {Case{"abs(v / (1 m/s) - 2)", {2}}, Case{"sign(v / (1 m/s) + 1)", {-1}},
                        Case{"max(v / (1 m/s), 2 - v / (1 m/s))", {1}}, Case{"if(v > 3 m/s, 1, 2)", {3}},
                        Case{"floor(v / (1 m/s))", {0, 1, 2}}, Case{"mod(v / (1 m/s), 2)", {0, 2, 4}},
                        Case{"table(v, -1 m/s, 0, 1 m/s, 3, 2 m/s, 5)", {-1, 1, 2}}}) {
    for (const double place : c.at) {
      const std::vector<double> before = kinks(c.text, place - 1e-3), after = kinks(c.text, place + 1e-3),
                                later = kinks(c.text, place + 2e-3);
      ASSERT_EQ(before.size(), 1u) << c.text;
      EXPECT_LT(before[0] * after[0], 0) << c.text << " at " << place;
      EXPECT_GT(later[0] * after[0], 0) << c.text << " at " << place;
    }
  }
  EXPECT_EQ(kinks("sin(v / (1 m/s)) + 2", 0).size(), 0u);
}

TEST(Formulas, LookUpNamesInQuotes) {
  FormulaLookup lookup{.functions = {"q", "rate"}};
  lookup.find = [](std::string_view function, std::string_view name,
                   std::string& problem) -> std::optional<FormulaLookup::Found> {
    if (name == "O") return FormulaLookup::Found{4, function == "q" ? Dimension::length : Dimension::speed};
    problem = "there is no joint";
    return std::nullopt;
  };
  FormulaError error;
  const auto f =
      Formula::read("2 N/m * q(\"O\") + 1 N*s/m * rate( 'O' )", Dimension::force, strut_names, error, lookup);
  ASSERT_TRUE(f) << error.message;
  EXPECT_EQ((*f)(std::vector<double>{0, 0, 0, 0, 7}), 21);
  const auto wrong = [&](std::string_view text) {
    EXPECT_FALSE(Formula::read(text, Dimension::force, strut_names, error, lookup)) << text;
    return "column " + std::to_string(error.column) + ": " + error.message;
  };
  EXPECT_EQ(wrong("1 N/m * q(\"P\")"), "column 11: there is no joint");
  EXPECT_EQ(wrong("1 N/m * q(O)"), "column 11: q takes a name in quotes");
  EXPECT_EQ(wrong("1 N/m * q('O)"), "column 11: the name has no closing quote");
  EXPECT_EQ(wrong("1 N/m * rate('O')"), "column 1: is a quantity in m kg s^-3, and must be a force");
  EXPECT_EQ(
      wrong("F"),
      "column 1: nothing is called 'F' here; there are time, s, v, a, q(\"...\"), rate(\"...\") and pi");
}

TEST(Formulas, KnowTheirNamesAndText) {
  const Formula f = formula("2 N + 1 N/m * s");
  EXPECT_TRUE(f.uses(1));
  EXPECT_FALSE(f.uses(0));
  EXPECT_EQ(f.text(), "2 N + 1 N/m * s");
}

}  // namespace
}  // namespace linkwright::math
