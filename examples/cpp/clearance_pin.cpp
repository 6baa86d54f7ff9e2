// A four-bar whose crank pin has 1 mm of clearance: the motion that repeats with every turn, and the path
// error.
#include <cmath>
#include <cstdio>

#include "linkwright/clearance.h"

int main() {
  using namespace linkwright;
  const clearance::ClearanceFourBar model = clearance::published_design_2();
  const clearance::UniformCrank crank{.speed = 10};
  const clearance::ClearanceOrbit orbit = clearance::find_orbit(model, crank);
  if (orbit.status != Status::done) {
    std::printf("%s\n", orbit.message.c_str());
    return 1;
  }
  clearance::ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  std::vector<double> times;
  for (int i = 0; i <= 360; ++i) times.push_back(i / 360.0 * full_turn / crank.speed);
  double error = 0, least = infinity;
  clearance::simulate_clearance(model, math::ConstantSpeed{crank.angle, crank.speed}, orbit.start(crank),
                                times, {}, [&](const clearance::ClearanceRow& row) {
                                  const auto there = clearance::clearance_position(ideal, row.crank.value, 0);
                                  error =
                                      std::max(error, std::abs(row.instant->position.point - there.point));
                                  least = std::min(least, row.instant->tension);
                                  return true;
                                });
  std::printf("the pin starts %.2f deg ahead of the crank; the tracing point deviates by up to %.2f mm\n",
              orbit.phase * 180 / pi, error * 1e3);
  std::printf("pin and bush are pressed together by at least %.2f N%s\n", least,
              least > 0 ? "" : ": they part");
  return error > 0 && error < 5 * model.clearance ? 0 : 1;
}
