// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/colour_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace linkwright::report {
namespace {

using Colour = std::array<double, 3>;

// Linear light of an sRGB colour (IEC 61966-2-1).
Colour linear(const std::string& hex) {
  Colour out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(hex.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    out[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return out;
}

using Matrix = std::array<Colour, 3>;

Colour times(const Matrix& m, const Colour& v) {
  Colour out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

// Oklab (Ottosson 2020): equal distances look equally large.
Colour oklab(const Colour& rgb) {
  Colour lms = times({{{0.4122214708, 0.5363325363, 0.0514459929},
                       {0.2119034982, 0.6806995451, 0.1073969566},
                       {0.0883024619, 0.2817188376, 0.6299787005}}},
                     rgb);
  for (double& c : lms) c = std::cbrt(c);
  return times({{{0.2104542553, 0.7936177850, -0.0040720468},
                 {1.9779984951, -2.4285922050, 0.4505937099},
                 {0.0259040371, 0.7827717662, -0.8086757660}}},
               lms);
}

// The colour as a person without M cones sees it (Machado, Oliveira, Fernandes 2009, Table 1, deuteranomaly
// 1.0).
Colour deuteranope(const Colour& rgb) {
  Colour out = times(
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
      rgb);
  for (double& c : out) c = std::clamp(c, 0.0, 1.0);
  return out;
}

double distance(const Colour& a, const Colour& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(ColourScale, StepsLookEquallyLargeAndGrowLighter) {
  for (int k = 1; k < colour_classes; ++k) {
    const Colour before = linear(class_colour(k - 1)), now = linear(class_colour(k));
    // 0.02 is about the least difference that is seen side by side. Within a fifth of each other they are
    // even.
    EXPECT_NEAR(distance(oklab(before), oklab(now)), 0.031, 0.006) << k;
    EXPECT_GT(distance(oklab(deuteranope(before)), oklab(deuteranope(now))), 0.02) << k;
    EXPECT_GT(oklab(now)[0] - oklab(before)[0], 0.02) << k;  // grey print
  }
}

TEST(ColourScale, ClassesOfValues) {
  EXPECT_EQ(colour_class(0, 0, 1), 0);
  EXPECT_EQ(colour_class(0.4999, 0, 1), colour_classes / 2 - 1);
  EXPECT_EQ(colour_class(0.5001, 0, 1), colour_classes / 2);
  EXPECT_EQ(colour_class(1, 0, 1), colour_classes - 1);
  EXPECT_EQ(colour_class(-5, 0, 1), 0);
  EXPECT_EQ(colour_class(5, 0, 1), colour_classes - 1);
  EXPECT_EQ(colour_class(3, 3, 3), colour_classes - 1);
}

// web/tests/cells.test.ts expects the same.
TEST(ColourScale, ColoursOfTheEndsAndTheMiddle) {
  EXPECT_EQ(class_colour(0), "#2c216b");
  EXPECT_EQ(class_colour(11), "#228e93");
  EXPECT_EQ(class_colour(23), "#eae353");
}

}  // namespace
}  // namespace linkwright::report
