// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/spectrum.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<double> sines(std::size_t n, double step) {
  std::vector<double> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * pi * step * static_cast<double>(i);
    out.push_back(7 + 3 * std::sin(20 * t + 0.4) + 0.5 * std::cos(45 * t));
  }
  return out;
}

TEST(Spectrum, ReadsTheAmplitudesOfSines) {
  const Spectrum s = spectrum(sines(1000, 1e-3), 1e-3);
  ASSERT_EQ(s.frequency.size(), 499u);
  EXPECT_NEAR(s.frequency[0], 1, 1e-12);
  EXPECT_NEAR(s.frequency.back(), 499, 1e-9);
  EXPECT_NEAR(s.amplitude[19], 3, 1e-12);
  EXPECT_NEAR(s.amplitude[44], 0.5, 1e-12);
  // Hann's window: half as much in the lines beside, nothing beyond, nothing of the mean but rounding.
  EXPECT_NEAR(s.amplitude[18], 1.5, 1e-12);
  EXPECT_NEAR(s.amplitude[30], 0, 1e-12);
  EXPECT_NEAR(s.amplitude[0], 0, 1e-12);
}

TEST(Spectrum, TransformsAsTheSumSays) {
  const std::vector<double> values{3, -1, 4, 1, -5, 9, 2};
  const std::vector<std::complex<double>> lines = fourier_transform(values);
  ASSERT_EQ(lines.size(), values.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < values.size(); ++j)
      sum += std::polar(values[j], -2 * pi * static_cast<double>(j * k) / static_cast<double>(values.size()));
    EXPECT_NEAR(std::abs(lines[k] - sum), 0, 1e-13) << k;
  }
  EXPECT_THAT(linkwright::test::message([] { fourier_transform(std::vector<double>{1}); }),
              HasSubstr("1 values, at least 2 are needed"));
}

TEST(Spectrum, LosesLittleBetweenItsLines) {
  // 20.5 lines in the interval: the worst case reads 8 / (3 pi) of the amplitude.
  const Spectrum s = spectrum(sines(1024, 1.025 / 1024), 1.025 / 1024);
  EXPECT_NEAR(*std::max_element(s.amplitude.begin(), s.amplitude.end()), 3 * 8 / (3 * pi), 0.01);
}

TEST(Spectrum, LeavesValuesOutForTheSakeOfSpeed) {
  const std::vector<double> values = sines(1009, 1e-3);  // a prime number
  const Spectrum s = spectrum(values, 1e-3), of_1000 = spectrum(std::span(values).first(1000), 1e-3);
  EXPECT_EQ(s.frequency, of_1000.frequency);
  EXPECT_EQ(s.amplitude, of_1000.amplitude);
}

TEST(Spectrum, IsEmptyWithoutValues) {
  EXPECT_THAT(spectrum(sines(7, 1), 1).frequency, IsEmpty());
  std::vector<double> holed = sines(100, 1);
  holed[3] = nan;
  EXPECT_THAT(spectrum(holed, 1).frequency, IsEmpty());
  EXPECT_THAT(linkwright::test::message([] { spectrum(sines(100, 1), 0); }), HasSubstr("values 0 s apart"));
}

}  // namespace
}  // namespace linkwright::math
