// Counterweights that keep the mass centre of a four-bar still: the shaking force is its weight alone.
#include <cmath>
#include <cstdio>

#include "linkwright/planar.h"

int main() {
  using namespace linkwright;
  const planar::FourBarMachine machine = planar::balancing_original();
  const double speed = 300 * 2 * pi / 60;
  const auto shaking = [&](const planar::FourBarMasses& masses) {
    double largest = 0;
    for (int degree = 0; degree < 360; ++degree) {
      const planar::FourBarRates rates = planar::rates(machine.linkage, degree * pi / 180, speed);
      const planar::FourBarReactions r = planar::reactions(machine.linkage, masses, rates, 0);
      largest = std::max(largest, std::abs(r.shaking_force));
    }
    return largest;
  };
  const planar::Counterweights weights =
      planar::balancing_counterweights(machine.linkage, machine.masses, 0.03, 0.08);
  const double before = shaking(machine.masses);
  const double after = shaking(planar::with_counterweights(machine.masses, weights));
  std::printf("crank: %.3f kg at %.0f deg; rocker: %.3f kg at %.0f deg\n", weights.crank.mass,
              weights.crank.angle * 180 / pi, weights.rocker.mass, weights.rocker.angle * 180 / pi);
  std::printf("shaking force besides the weight: %.2f N before, %.1e N after\n", before, after);
  return before > 1 && after < 1e-9 * before ? 0 : 1;
}
