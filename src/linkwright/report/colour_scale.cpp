// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/colour_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace linkwright::report {
namespace {

// Nine colours that are evenly spaced in Oklab's lightness (0.30 to 0.91) and hue (288 to 103 degrees), with
// as much chroma as the smoothness of the scale and the sRGB gamut allow. web/src/cells.ts has the same.
constexpr std::array<std::array<double, 3>, 9> anchors = {{{46, 27, 103},
                                                           {32, 60, 129},
                                                           {16, 91, 136},
                                                           {26, 119, 142},
                                                           {35, 147, 148},
                                                           {60, 175, 145},
                                                           {111, 199, 129},
                                                           {176, 218, 103},
                                                           {246, 229, 79}}};

}  // namespace

int colour_class(double value, double low, double high) {
  if (!(high > low)) return colour_classes - 1;
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return std::min(colour_classes - 1, static_cast<int>(share * colour_classes));
}

std::string class_colour(int colour_class) {
  const double at = (colour_class + 0.5) / colour_classes * static_cast<double>(anchors.size() - 1);
  const std::size_t k = std::min(anchors.size() - 2, static_cast<std::size_t>(at));
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i)
    mixed[i] = static_cast<int>(
        std::lround(std::lerp(anchors[k][i], anchors[k + 1][i], at - static_cast<double>(k))));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

}  // namespace linkwright::report
