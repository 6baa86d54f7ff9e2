// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/planar/balancing/four_bar.h"

namespace linkwright::planar {
namespace {

double sum_of_squares(std::span<const double> samples) {
  double sum = 0;
  for (double x : samples) sum += x * x;
  return sum;
}

}  // namespace

double rss_over_n(std::span<const double> samples) {
  LINKWRIGHT_REQUIRE(samples.size() >= 2, "needs 2 samples, got {}", samples.size());
  return std::sqrt(sum_of_squares(samples)) / static_cast<double>(samples.size() - 1);
}

double rms(std::span<const double> samples) {
  LINKWRIGHT_REQUIRE(!samples.empty(), "needs a sample");
  return std::sqrt(sum_of_squares(samples) / static_cast<double>(samples.size()));
}

double mean_abs(std::span<const double> samples) {
  LINKWRIGHT_REQUIRE(!samples.empty(), "needs a sample");
  double sum = 0;
  for (double x : samples) sum += std::abs(x);
  return sum / static_cast<double>(samples.size());
}

double max_abs(std::span<const double> samples) {
  LINKWRIGHT_REQUIRE(!samples.empty(), "needs a sample");
  double most = 0;
  for (double x : samples) {
    if (std::isnan(x)) return x;
    most = std::max(most, std::abs(x));
  }
  return most;
}

double measure(Measure measure, std::span<const double> samples) {
  switch (measure) {
    case Measure::rss_over_n:
      return rss_over_n(samples);
    case Measure::rms:
      return rms(samples);
    case Measure::mean_abs:
      return mean_abs(samples);
    case Measure::max_abs:
      return max_abs(samples);
    case Measure::maximum:
    case Measure::minimum:
    case Measure::range:
      break;
  }
  LINKWRIGHT_REQUIRE(!samples.empty(), "needs a sample");
  double least = samples[0], most = samples[0];
  for (double x : samples) {
    if (std::isnan(x)) return x;
    least = std::min(least, x);
    most = std::max(most, x);
  }
  return measure == Measure::maximum ? most : measure == Measure::minimum ? least : most - least;
}

double measure(Measure kind, std::span<const double> samples, bool closes) {
  return measure(kind, samples.first(counted(kind, samples.size(), closes)));
}

}  // namespace linkwright::planar
