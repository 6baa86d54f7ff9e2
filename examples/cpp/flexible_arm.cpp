// A flexible arm turned through 60 deg: how far its tip swings, with the energy that says whether to trust
// it.
#include <cmath>
#include <cstdio>

#include "linkwright/flexible.h"
#include "linkwright/math.h"

int main() {
  using namespace linkwright;
  flexible::Beam beam;
  beam.length = 1.8, beam.density = 2766, beam.area = 2.5e-4;
  beam.second_moment = 5.2e-9, beam.elastic_modulus = 69e9;
  beam.tip_mass = 0.085;
  const flexible::Chain chain = flexible::discretise(beam, 4);
  const math::MotionCurve turn(math::Polynomial345{.from = 0, .to = pi / 3, .duration = 1});
  const auto hub = [&](double t) {
    const math::Motion m = turn(t);
    return flexible::HubMotion{m.value, m.rate, m.acceleration};
  };
  const flexible::Simulation run =
      flexible::simulate_motion(chain, hub, {.end = 2, .output_interval = 0.01, .step = 0.001});
  if (run.status != Status::done) {
    std::printf("%s\n", run.message.c_str());
    return 1;
  }
  const auto least = flexible::smallest(run.samples, &flexible::Sample::tip_eta, 0, 2);
  const auto most = flexible::largest(run.samples, &flexible::Sample::tip_eta, 0, 2);
  const double drift = std::abs(run.samples.back().energy_balance() - run.samples.front().energy_balance());
  std::printf("tip: %.1f mm behind at %.2f s, %.1f mm ahead at %.2f s; energy audit %.0e J\n",
              -least.value * 1000, least.time, most.value * 1000, most.time, drift);
  return least.value < -1e-3 && most.value > 1e-3 && drift < 1e-2 ? 0 : 1;
}
