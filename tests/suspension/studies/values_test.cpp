// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/values.h"

#include <gmock/gmock.h>

#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using ::testing::HasSubstr;

std::string travel(const std::string& keys) {
  return "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\nsample = \"5US\"\n"
         "[sweep.travel]\n" +
         keys;
}
std::vector<double> values(const std::string& keys) {
  return test::run_text(travel(keys)).tables.at(0).find("travel_m")->values;
}

TEST(InputValues, StepsEndAtTheLastValueAndPassZeroExactly) {
  EXPECT_EQ(values("from_mm = -9\nto_mm = 10\nstep_mm = 3\n"),
            (std::vector{-0.009, -0.006, -0.003, 0.0, 0.003, 0.006, 0.009, 0.01}));
  EXPECT_EQ(values("from_mm = -90\nto_mm = 90\nsamples = 3\n"), (std::vector{-0.09, 0.0, 0.09}));
  EXPECT_EQ(values("values_mm = [30, -10, 30]\n"), (std::vector{-0.01, 0.03}));
  EXPECT_EQ(values("from_mm = 10\nto_mm = 10\nsamples = 1\n"), (std::vector{0.01}));
}

TEST(InputValues, SayWhatTheyLack) {
  const auto told = [](const std::string& keys) { return test::problems_of(travel(keys)); };
  EXPECT_THAT(told("from_mm = -80\nto_mm = 80\n"),
              HasSubstr("sweep.travel.step: is missing; give step_mm or samples"));
  EXPECT_THAT(told("from_mm = -80\n"),
              HasSubstr("sweep.travel.to: is missing; write from_mm, to_mm and step_mm"));
  EXPECT_THAT(told("from_mm = 80\nto_mm = -80\nstep_mm = 1\n"), HasSubstr("exchange them"));
  EXPECT_THAT(told("values_mm = []\n"), HasSubstr("are none; write values_mm = [...]"));
  EXPECT_THAT(told("values_mm = [1]\nfrom_mm = 2\n"), HasSubstr("are given both as a list and as a range"));
  EXPECT_THAT(told("from_mm = 0\nto_mm = 80\nstep_mm = 1e-5\n"), HasSubstr("makes 8e+06 values"));
}

TEST(InputValues, TheOneNextToZeroIsTheFirstOfEqualOnes) {
  EXPECT_EQ(next_to_zero(std::vector{-0.03, -0.01, 0.01, 0.02}), 1u);
  EXPECT_EQ(next_to_zero(std::vector{0.5, 0.6}), 0u);
  EXPECT_EQ(next_to_zero(std::vector{-0.2, 0.0, 0.1}), 1u);
}

}  // namespace
}  // namespace linkwright::suspension
