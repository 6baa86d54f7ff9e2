// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

FourBar with(double scale, double ground, double crank, double coupler, double rocker, Complex point,
             Complex pivot, double frame_angle, Branch branch) {
  return {.ground = scale * ground,
          .crank = scale * crank,
          .coupler = scale * coupler,
          .rocker = scale * rocker,
          .coupler_u = point.real(),
          .coupler_v = point.imag(),
          .pivot_x = pivot.real(),
          .pivot_y = pivot.imag(),
          .frame_angle = frame_angle,
          .branch = branch};
}

}  // namespace

std::vector<Cognate> cognates(const FourBar& l, double crank_angle) {
  const FourBarPosition pose = position(l, crank_angle);
  const Complex lambda = Complex(l.coupler_u, l.coupler_v) / l.coupler;
  const Complex third_pivot = crank_pivot(l) + lambda * std::polar(l.ground, l.frame_angle);
  const double degenerate = 1e-9;  // the tracing point lies on a pin: that cognate shrinks to a point
  std::vector<Cognate> out;
  if (const double scale = std::abs(lambda); scale > degenerate) {
    // Its coupler is parallel to the original's crank: B lies left of A->B0 when the crank turns left into
    // the rocker.
    const Branch branch = std::sin(pose.rocker_angle - crank_angle) >= 0 ? Branch::open : Branch::crossed;
    out.push_back({with(scale, l.ground, l.coupler, l.crank, l.rocker, scale * l.crank / lambda,
                        crank_pivot(l), l.frame_angle + std::arg(lambda), branch),
                   false});
  }
  if (const double scale = std::abs(1.0 - lambda); scale > degenerate)
    out.push_back(
        {with(scale, l.ground, l.crank, l.rocker, l.coupler, scale * l.rocker * lambda / (lambda - 1.0),
              third_pivot, l.frame_angle + std::arg(1.0 - lambda), other(l.branch)),
         true});
  return out;
}

}  // namespace linkwright::planar
