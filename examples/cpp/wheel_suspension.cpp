// Toe, camber and roll centre of a wheel over its travel.
#include <cmath>
#include <cstdio>

#include "linkwright/suspension.h"

int main() {
  using namespace linkwright;
  const suspension::CornerSample& sample = suspension::corner_samples().front();
  const suspension::CornerPlan plan = suspension::prepare_suspension(sample.suspension);
  const suspension::CornerPosition reference = suspension::reference_position(plan);
  if (reference.status != Status::done) return 1;
  std::printf("%s\n travel     toe  camber  roll centre\n", sample.summary.c_str());
  for (int mm = -60; mm <= 60; mm += 20) {
    const suspension::CornerPosition there =
        suspension::solve_position(plan, suspension::Driver::wheel_centre_z, {mm * 1e-3, 0}, reference);
    if (there.status != Status::done) return 1;
    const suspension::WheelParameters p = suspension::wheel_parameters(plan, there);
    std::printf("%4d mm %6.3f  %6.3f deg %7.1f mm\n", mm, p.angles.toe * 180 / pi, p.angles.camber * 180 / pi,
                p.roll_centre_height * 1000);
    // The height that was asked for is the height of the wheel centre.
    if (std::abs(there.place.carrier.centre.z - sample.suspension.wheel.centre.z - mm * 1e-3) > 1e-12)
      return 1;
  }
  return 0;
}
