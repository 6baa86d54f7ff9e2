// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/sensitivity.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::named;
using test::problems_of;
using test::run_text;
using test::table;
using ::testing::HasSubstr;

std::string study(const std::string& rest) {
  return "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\nsample = "
         "\"2RS-US\"\n"
         "[sweep.travel]\nfrom_mm = -60\nto_mm = 60\nstep_mm = 30\n" +
         rest;
}
// The double wishbone of the sample with the height of the inner end of its tie rod.
double toe(double travel, double shift) {
  const std::string text = R"(schema = 1
kind = "analysis"
[mechanism]
type = "suspension.corner"
[mechanism.wheel]
centre_m = [0, 0.76, 0]
toe_deg = 0.1
camber_deg = -0.5
tyre_diameter_m = 0.64
[[mechanism.link]]
type = "RS"
body_m = [[0.18, 0.37, -0.11], [-0.17, 0.37, -0.1]]
carrier_m = [0.008, 0.715, -0.13]
[[mechanism.link]]
type = "RS"
body_m = [[0.12, 0.44, 0.165], [-0.14, 0.44, 0.15]]
carrier_m = [-0.022, 0.665, 0.215]
[[mechanism.link]]
type = "US"
body_m = [-0.125, 0.415, )" +
                           fmt::format("{}", -0.047 + shift) +
                           R"(]
carrier_m = [-0.14, 0.7, -0.042]
moved_by = "rack"
[sweep.travel]
values_m = [)" + fmt::format("{}", travel) +
                           "]\n";
  return run_text(text).tables.at(0).find("toe_rad")->values.at(0);
}

TEST(SensitivityStudy, TellsDerivativesByHardPoints) {
  const study::Result result =
      run_text(study("[sensitivity]\nquantities = [\"toe\", \"roll_centre_height\"]\n"));
  ASSERT_EQ(result.status, Status::done);
  const Table& here = table(result, "sensitivity");
  // At the reference the tie rod's length follows its points: its toe does not change.
  EXPECT_NEAR(named(here, "tie rod.body_z", "toe_by_point_rad_per_m"), 0, 1e-9);
  const Table& curve = table(result, "sensitivity-toe");
  const double h = 1e-5;
  for (std::size_t i = 0; i < 5; ++i) {
    const double travel = curve.find("travel_m")->values.at(i);
    EXPECT_NEAR(curve.find("tie_rod_body_z_rad_per_m")->values.at(i),
                (toe(travel, h) - toe(travel, -h)) / (2 * h), 1e-7)
        << travel;
  }
}

TEST(SensitivityStudy, DrawsBandsOfTolerances) {
  const study::Result result =
      run_text(study("[tolerances]\ntolerance_mm = 0.5\nquantities = [\"toe\"]\nsamples = 200\nseed = 3\n"
                     "[[tolerances.point]]\ncoordinate = \"tie rod.body\"\ntolerance_mm = 1.0\n"));
  const Table& band = table(result, "band-toe");
  ASSERT_EQ(band.rows(), 5U);
  const auto at = [&](const char* key, std::size_t i) { return band.find(key)->values.at(i); };
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LE(at("worst_lower_toe_rad", i), at("rss_lower_toe_rad", i));
    EXPECT_LE(at("rss_lower_toe_rad", i), at("toe_rad", i));
    EXPECT_GE(at("greatest_toe_rad", i), at("toe_rad", i));
    // Three standard deviations are the tolerance: 200 designs stay within the worst case.
    EXPECT_LE(at("greatest_toe_rad", i), at("worst_upper_toe_rad", i) + 1e-12);
  }
  const Table& shares = table(result, "tolerance_shares");
  EXPECT_GT(named(shares, "tie rod.body_z", "toe_rad"), named(shares, "spring.moving_x", "toe_rad"));
  const auto plot = std::find_if(result.plots.begin(), result.plots.end(),
                                 [](const study::Plot& p) { return p.name == "band-toe"; });
  ASSERT_NE(plot, result.plots.end());
  EXPECT_EQ(plot->bands.size(), 2U);
}

// A rod that keeps its length turns the wheel when its bracket moves, by the part of that shift along the
// rod.
TEST(SensitivityStudy, PartsAsBuiltKeepTheirLengths) {
  const auto worst = [](const std::string& parts, const std::string& coordinate) {
    const study::Result result =
        run_text(study("[tolerances]\nparts = \"" + parts +
                       "\"\nquantities = [\"toe\"]\n[[tolerances.point]]\ncoordinate = \"" + coordinate +
                       "\"\ntolerance_mm = 1.0\n"));
    const Table& band = table(result, "band-toe");
    for (std::size_t i = 0; i < band.rows(); ++i)
      if (std::abs(band.find("travel_m")->values[i]) < 1e-12)
        return band.find("worst_upper_toe_rad")->values[i] - band.find("toe_rad")->values[i];
    ADD_FAILURE();
    return 0.0;
  };
  const double by_length = worst("as_built", "tie rod.length");
  EXPECT_GT(by_length, 1e-3);
  double along = 0;
  for (const char* axis : {"x", "y", "z"}) {
    const double by_body = worst("as_built", std::string("tie rod.body_") + axis);
    along += std::pow(by_body / by_length, 2);
    EXPECT_NEAR(worst("as_drawn", std::string("tie rod.body_") + axis), 0, 1e-12);
  }
  EXPECT_NEAR(along, 1, 1e-9);  // direction cosines of the rod
  EXPECT_NEAR(
      worst("as_built", "tie rod.body"),
      [&] {
        double sum = 0;
        for (const char* axis : {"x", "y", "z"})
          sum += worst("as_built", std::string("tie rod.body_") + axis);
        return sum;
      }(),
      1e-12);
}

TEST(SensitivityStudyRead, NamesWhatIsWrong) {
  EXPECT_THAT(problems_of(study("[sensitivity]\nquantities = [\"tow\"]\n")),
              HasSubstr("sensitivity.quantities: there is no quantity 'tow'; there are: toe, camber"));
  EXPECT_THAT(problems_of(study("[tolerances]\nsamples = 10\n")),
              HasSubstr("tolerances.tolerance: no point has a tolerance; write tolerance_mm = 0.5"));
  EXPECT_THAT(problems_of(study("[[tolerances.point]]\ncoordinate = \"tie rot.body\"\ntolerance_mm = 1\n")),
              HasSubstr("tolerances.point[0].coordinate: no point or coordinate is called 'tie rot.body'"));
}

}  // namespace
}  // namespace linkwright::suspension
