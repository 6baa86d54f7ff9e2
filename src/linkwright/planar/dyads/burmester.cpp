// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/burmester.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Links of the compatibility linkage below this, relative to the greatest, are none.
constexpr double no_compatibility_link = 1e-12;

struct Compatibility {
  // Displacement and rotation of poses 2 to 4 from the first: delta, epsilon.
  std::array<Complex, 3> displacement, turn;
  std::array<Complex, 4> link;  // Delta
  BodyPose first;

  explicit Compatibility(std::span<const BodyPose> poses) : first(poses[0]) {
    for (std::size_t j = 0; j < 3; ++j) {
      displacement[j] = poses[j + 1].origin - first.origin;
      turn[j] = std::polar(1.0, poses[j + 1].angle - first.angle) - 1.0;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
      link[j + 1] = turn[k] * displacement[l] - turn[l] * displacement[k];
    }
    link[0] = -(link[1] + link[2] + link[3]);
  }

  // The dyad whose link turns by beta to the second pose, on a branch.
  BurmesterPoint point(double beta, double branch) const {
    const Complex v = -link[0] - link[1] * std::polar(1.0, beta);
    const double r = std::abs(v), a = std::abs(link[2]), b = std::abs(link[3]);
    // The sine from the sides, which keeps its digits where the branches meet.
    const double cosine = (r * r + a * a - b * b) / (2 * r * a);
    const double square = ((a + b) * (a + b) - r * r) * (r * r - (a - b) * (a - b));
    const double sine = std::sqrt(std::max(0.0, square)) / (2 * r * a);
    const Complex third = a * (v / r) * Complex(cosine, branch * sine) / link[2];
    // w (e^(i beta_j) - 1) + z epsilon_j = delta_j for the second and third pose.
    const Complex p = std::polar(1.0, beta) - 1.0, q = third - 1.0;
    const Complex det = p * turn[1] - q * turn[0];
    const Complex w = (displacement[0] * turn[1] - displacement[1] * turn[0]) / det;
    const Complex z = (p * displacement[1] - q * displacement[0]) / det;
    return {first.origin - z - w, -std::polar(1.0, -first.angle) * z, beta, 0};
  }
};

bool finite(const BurmesterPoint& p) {
  return std::isfinite(p.fixed.real()) && std::isfinite(p.fixed.imag()) && std::isfinite(p.moving.real()) &&
         std::isfinite(p.moving.imag());
}

}  // namespace

std::vector<BurmesterPoint> burmester_curves(std::span<const BodyPose> poses, int samples) {
  LINKWRIGHT_REQUIRE(poses.size() == 4 && samples >= 2, "{} poses, {} samples", poses.size(), samples);
  const Compatibility c(poses);
  double most = 0;
  for (const Complex& link : c.link) most = std::max(most, std::abs(link));
  if (!(most > 0)) return {};
  for (const Complex& link : c.link)
    if (std::abs(link) <= no_compatibility_link * most) return {};
  // |Delta_1 + Delta_2 e^(i beta)| is between the difference and the sum of the other two.
  const double base = std::abs(c.link[0]), crank = std::abs(c.link[1]);
  const double reference = std::arg(c.link[0] / c.link[1]), scale = 2 * base * crank;
  const double least = std::abs(c.link[2]) - std::abs(c.link[3]),
               reach = std::abs(c.link[2]) + std::abs(c.link[3]);
  const double low = (least * least - base * base - crank * crank) / scale;
  const double high = (reach * reach - base * base - crank * crank) / scale;
  if (low > 1 || high < -1) return {};
  const double inner = high >= 1 ? 0 : std::acos(high), outer = low <= -1 ? pi : std::acos(low);
  std::vector<BurmesterPoint> out;
  int piece = 0;
  const auto add = [&](double beta, double branch) {
    BurmesterPoint point = c.point(beta, branch);
    if (!finite(point)) return;
    point.piece = piece;
    out.push_back(point);
  };
  if (inner == 0 && outer == pi) {
    for (const double branch : {1.0, -1.0}) {
      // beta = 0 is a link that does not turn, at infinity: a turn is sampled on both sides of it.
      for (int k = 0; k <= samples; ++k) add(2 * pi * (k + 0.5) / (samples + 1), branch);
      ++piece;
    }
    return out;
  }
  // From one end of beta to the other on one branch and back on the other; denser at the ends, where they
  // meet.
  const auto round = [&](double from, double to) {
    for (const double branch : {1.0, -1.0})
      for (int k = 0; k < samples; ++k) {
        const double t = 0.5 * (1 - std::cos(pi * k / samples));
        add(branch > 0 ? from + t * (to - from) : to - t * (to - from), branch);
      }
    add(from, 1);
    ++piece;
  };
  if (inner == 0)
    round(reference - outer, reference + outer);
  else if (outer == pi)
    round(reference + inner, reference + 2 * pi - inner);
  else {
    round(reference + inner, reference + outer);
    round(reference - outer, reference - inner);
  }
  return out;
}

}  // namespace linkwright::planar
