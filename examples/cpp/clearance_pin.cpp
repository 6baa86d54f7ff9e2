// A four-bar whose crank pin has 0.1 mm of clearance: the steady motion of the pin in its bush, and the path
// error.
#include <cmath>
#include <cstdio>

#include "linkwright/clearance.h"

int main() {
  using namespace linkwright;
  clearance::ClearanceFourBar model;
  model.linkage = {
      .ground = 0.4, .crank = 0.1, .coupler = 0.35, .rocker = 0.25, .coupler_u = 0.2, .coupler_v = 0.1};
  model.clearance = 1e-4;
  model.coupler = {.mass = 0.9, .inertia = 9.2e-3, .centre = 0.175};
  model.rocker = {.mass = 0.6, .inertia = 3.1e-3, .centre = 0.125};
  const clearance::EvenCrank crank{.speed = 30};
  const double start = clearance::force_direction(model, crank.angle, crank.speed, 0);
  const clearance::ClearanceOrbit orbit = clearance::find_orbit(model, crank, start - crank.angle);
  if (orbit.status != Status::done) {
    std::printf("%s\n", orbit.message.c_str());
    return 1;
  }
  clearance::ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  double error = 0, least = infinity;
  const std::vector<double> times = [] {
    std::vector<double> out;
    for (int i = 0; i <= 360; ++i) out.push_back(i / 360.0 * 2 * pi / 30);
    return out;
  }();
  clearance::simulate_clearance(model, math::ConstantSpeed{crank.angle, crank.speed}, orbit.start(crank),
                                times, {}, [&](const clearance::ClearanceRow& row) {
                                  const auto there = clearance::clearance_position(ideal, row.crank.value, 0);
                                  error =
                                      std::max(error, std::abs(row.instant->position.point - there.point));
                                  least = std::min(least, row.instant->tension);
                                  return true;
                                });
  std::printf("the tracing point deviates by up to %.0f um; the pin presses with at least %.1f N%s\n",
              error * 1e6, least, least > 0 ? "" : " (contact is lost)");
  return error > 0 && error < 1e-3 ? 0 : 1;
}
