// A four-bar whose coupler point draws eighteen given points (Kunjur and Krishnamurty 1997).
#include <cstdio>

#include "linkwright/planar.h"

int main() {
  using namespace linkwright;
  const planar::PathProblem problem = planar::eighteen_points();
  RunContext context;
  context.set_time_limit(std::chrono::seconds(30));
  const planar::PathSynthesis found = planar::synthesise_path(problem, {.seed = 1}, context);
  if (found.designs.empty()) return 1;
  const planar::PathDesign& best = found.designs.front();
  const planar::FourBar& l = best.linkage;
  std::printf("ground %.4f, crank %.4f, coupler %.4f, rocker %.4f m\n", l.ground, l.crank, l.coupler,
              l.rocker);
  std::printf("sum of squares %.3e m2 after %lld evaluations\n", best.error,
              static_cast<long long>(found.evaluations));
  return best.violations.empty() && best.error < 0.0092 ? 0 : 1;
}
