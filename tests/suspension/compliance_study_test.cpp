#include "linkwright/suspension/compliance_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using ::testing::HasSubstr;
using testing::problems_of;
using testing::replaced;
using testing::run_text;

std::string study(const std::string& rest) {
  return "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.wheel_guide\"\nsample = \"5KS\"\n"
         "[sweep.travel]\nvalues_mm = [0]\n[compliance]\n" +
         rest;
}
std::string rod(const std::string& name, int stiffness) {
  return fmt::format("[[compliance.joint]]\nlink = \"{}\"\nstiffness_N_per_mm = {}\n", name, stiffness);
}
std::string rods() {
  return rod("lower front rod", 18000) + rod("lower rear rod", 20000) + rod("tie rod", 15000) +
         rod("upper front rod", 12000) + rod("upper rear rod", 12000);
}
const Table& table(const study::Result& result, std::string_view name) {
  for (const Table& t : result.tables)
    if (t.name == name) return t;
  ADD_FAILURE() << name;
  return result.tables.front();
}
double named(const Table& t, std::string_view row, std::string_view column) {
  for (std::size_t i = 0; i < t.names.size(); ++i)
    if (t.names[i] == row) return t.find(column)->values.at(i);
  ADD_FAILURE() << row;
  return std::nan("");
}

TEST(ComplianceStudy, TellsWhatElasticRodsDo) {
  // Reference figures of five elastic rods and a spring of 30 N/mm, body fixed: a kilonewton to the left at
  // the contact, and the spring force of 4 kN there.
  const study::Result result =
      run_text(study("spring_stiffness_N_per_mm = 30\n" + rods() +
                     "[[compliance.load]]\nname = \"lateral\"\nforce_N = [0, 1000, 0]\n"
                     "[[compliance.load]]\nname = \"weight\"\nforce_N = [0, 0, 4000]\n"));
  ASSERT_EQ(result.status, Status::done);
  EXPECT_TRUE(result.diagnostics.empty());
  const Table& loads = table(result, "loads");
  EXPECT_NEAR(named(loads, "lateral", "toe_rad"), -0.0005945128820499071, 1e-9 * 6e-4);
  EXPECT_NEAR(named(loads, "lateral", "camber_rad"), -0.003929538567960345, 1e-9 * 4e-3);
  EXPECT_NEAR(named(loads, "lateral", "centre_z_m"), 0.00724337568465979, 1e-9 * 7e-3);
  EXPECT_NEAR(named(loads, "weight", "spring_N"), 4480.535826622259, 1e-9 * 4500);
  // The coefficients are the same figures, outboard on the left.
  EXPECT_NEAR(named(table(result, "compliance"), "lateral force steer, toe (deg/kN)", "value"),
              -0.0005945128820499071 * 180 / M_PI, 1e-9);
  const Table& forces = table(result, "load_forces-2");
  EXPECT_NEAR(named(forces, "lower front rod, body", "size_N"), 1337.7355480453393, 1e-6);
  const Table& matrix = table(result, "compliance_matrix");
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(matrix.columns[j].values[i], matrix.columns[i].values[j], 1e-15);
}

TEST(ComplianceStudyRead, NamesWhatIsWrong) {
  const std::string good = study(rods());
  EXPECT_THAT(problems_of(replaced(good, "link = \"tie rod\"", "link = \"tie rot\"")),
              HasSubstr("compliance.joint[2].link: no link is called 'tie rot'; did you mean 'tie rod'?"));
  EXPECT_THAT(problems_of(study("support = \"spring\"\n" + rods())),
              HasSubstr("compliance.spring_stiffness: is missing: the spring carries the wheel"));
  EXPECT_THAT(problems_of(study("preload_N = 4000\n" + rods())),
              HasSubstr("compliance.preload_N: needs the spring that carries it"));
  EXPECT_THAT(
      problems_of(study("[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\naxial_N_per_mm = 1\n")),
      HasSubstr("compliance.joint[0].radial: is missing; a bushing has both"));
  EXPECT_THAT(problems_of(replaced(good, "sample = \"5KS\"", "sample = \"2RS-KS\"")),
              HasSubstr("no link is called 'lower front rod'; there are: lower wishbone"));
  EXPECT_THAT(
      problems_of(replaced(study("[[compliance.joint]]\nlink = \"lower wishbone\"\nstiffness_N_per_mm = 1\n"),
                           "sample = \"5KS\"", "sample = \"2RS-KS\"")),
      HasSubstr("compliance.joint[0].end: is missing: 'lower wishbone' is no rod"));
}

TEST(ComplianceStudy, SaysWhatIsLeftFree) {
  const study::Result result =
      run_text(study("[[compliance.joint]]\nlink = \"tie rod\"\nend = \"body\"\nstiffness_N_per_mm = 0\n"));
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_THAT(to_string(result.diagnostics[0]), HasSubstr("compliance: no compliance: "));
}

}  // namespace
}  // namespace linkwright::suspension
