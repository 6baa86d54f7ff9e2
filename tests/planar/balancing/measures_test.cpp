// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "linkwright/planar/balancing/four_bar.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

TEST(Measures, OfAFewSamples) {
  const std::vector<double> samples = {3, -4, 0, 12, 0};
  EXPECT_DOUBLE_EQ(rss_over_n(samples), 13.0 / 4);  // five samples, four intervals
  EXPECT_DOUBLE_EQ(rms(samples), 13 / std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(mean_abs(samples), 19.0 / 5);
  EXPECT_EQ(max_abs(samples), 12);
}

TEST(Measures, ByName) {
  const std::vector<double> samples = {3, -4, 0, 12, 0};
  EXPECT_EQ(measure(Measure::rss_over_n, samples), rss_over_n(samples));
  EXPECT_EQ(measure(Measure::rms, samples), rms(samples));
  EXPECT_EQ(measure(Measure::mean_abs, samples), mean_abs(samples));
  EXPECT_EQ(measure(Measure::max_abs, samples), 12);
  EXPECT_EQ(measure(Measure::maximum, samples), 12);
  EXPECT_EQ(measure(Measure::minimum, samples), -4);
  EXPECT_EQ(measure(Measure::range, samples), 16);
  const std::vector<double> missing = {3, NAN, 4};
  for (const auto& name : names(Measure()))
    EXPECT_TRUE(std::isnan(measure(name.value, missing))) << name.name;
}

TEST(Measures, KeepWhatIsMissing) {
  const std::vector<double> samples = {3, NAN, 4};
  for (auto of : {rss_over_n, rms, mean_abs, max_abs}) EXPECT_TRUE(std::isnan(of(samples)));
}

TEST(Measures, HaveTheirProperties) {
  const std::vector<double> x = {1, -2, 4}, y = {3, 1, -5}, minus = {-1, 2, -4}, ones = {1, 1, 1};
  const std::vector<double> sum = {4, -1, -1}, difference = {-2, -3, 9};
  for (const auto& name : names(Measure())) {
    const auto of = [&](const std::vector<double>& samples) { return measure(name.value, samples); };
    const bool norm = of(sum) <= of(x) + of(y) && of(x) == of(minus) && of(ones) > 0;
    EXPECT_EQ(properties(name.value).norm, norm) << name.name;
    const auto square = [&](const std::vector<double>& samples) { return of(samples) * of(samples); };
    const double both = 2 * (square(x) + square(y));
    EXPECT_EQ(properties(name.value).quadratic,
              std::abs(square(sum) + square(difference) - both) < 1e-12 * both)
        << name.name;
  }
}

TEST(Measures, NeedSamples) {
  EXPECT_THAT(test::message([] { rss_over_n(std::vector<double>{1}); }), HasSubstr("needs 2 samples, got 1"));
  for (auto of : {rms, mean_abs, max_abs})
    EXPECT_THAT(test::message([&] { of({}); }), HasSubstr("needs a sample"));
}

// A cosine over a turn: root mean square 1 / sqrt(2), mean size 2 (1 + 2 cos 30 + 2 cos 60) / 12, by hand.
TEST(Measures, MeansCountOneEndOfAPeriod) {
  std::vector<double> turn;
  for (int i = 0; i <= 12; ++i) turn.push_back(std::cos(i * std::acos(-1.0) / 6));
  EXPECT_NEAR(measure(Measure::rms, turn, true), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(measure(Measure::mean_abs, turn, true), (2 + std::sqrt(3)) / 6, 1e-15);
  EXPECT_EQ(measure(Measure::rss_over_n, turn, true), rss_over_n(turn));
  EXPECT_EQ(measure(Measure::range, turn, true), measure(Measure::range, turn));
  EXPECT_EQ(measure(Measure::rms, turn, false), rms(turn));
}

}  // namespace
}  // namespace linkwright::planar
