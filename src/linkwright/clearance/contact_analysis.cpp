// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_analysis.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/spectrum.h"

namespace linkwright::clearance {

Spectrum amplitude_spectrum(std::span<const double> samples, double interval, bool window) {
  const std::size_t n = samples.size();
  LINKWRIGHT_REQUIRE(n >= 2, "needs 2 samples at least, got {}", n);
  LINKWRIGHT_REQUIRE(interval > 0 && std::isfinite(interval), "interval {} s must be positive", interval);
  std::vector<double> signal(samples.begin(), samples.end());
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    LINKWRIGHT_REQUIRE(std::isfinite(signal[k]), "sample {} is {}", k, signal[k]);
    sum += signal[k];
  }
  // The mean would leak through a window.
  const double mean = sum / static_cast<double>(n);
  double weight = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    const double w = window ? 0.5 - 0.5 * std::cos(2 * pi * share) : 1;
    signal[k] = w * (signal[k] - mean);
    weight += w;
  }
  const std::vector<std::complex<double>> transformed = math::fourier_transform(signal);
  Spectrum out;
  for (std::size_t k = 0; k <= n / 2; ++k) {
    out.frequency.push_back(static_cast<double>(k) / (static_cast<double>(n) * interval));
    const bool edge = 2 * k == n;  // has no mirror image
    out.amplitude.push_back((edge ? 1 : 2) * std::abs(transformed[k]) / weight);
  }
  out.amplitude[0] = mean;
  return out;
}

PoincareSection poincare_section(const planar::Linkage& linkage, std::span<const ContactJoint> joints,
                                 std::span<const planar::InputDrive> drives, double start, double period,
                                 int from, int to, const ContactOptions& options, const RunContext* context) {
  LINKWRIGHT_REQUIRE(period > 0 && std::isfinite(period), "period {} s must be positive", period);
  LINKWRIGHT_REQUIRE(from >= 0 && from < to, "periods from {} to {}", from, to);
  std::vector<double> times{start};
  for (int k = std::max(from, 1); k <= to; ++k) times.push_back(start + k * period);
  PoincareSection out;
  out.joints.resize(joints.size());
  out.run = simulate_contact(
      linkage, joints, drives, times, options,
      [&](const ContactRow& row) {
        if (row.time < start + (from - 0.5) * period) return true;  // the start, when it is not asked for
        for (std::size_t k = 0; k < joints.size(); ++k)
          out.joints[k].push_back({row.time, row.joints[k].eccentricity, row.joints[k].rate});
        return true;
      },
      context);
  return out;
}

}  // namespace linkwright::clearance
