// Joint forces and drive torque of a four-bar over one turn of its crank, checked by the power of the motor.
#include <cmath>
#include <cstdio>

#include "linkwright/planar.h"

int main() {
  using namespace linkwright;
  const planar::FourBar linkage{.ground = 0.4, .crank = 0.1, .coupler = 0.35, .rocker = 0.25};
  const planar::FourBarMasses masses{.crank = {.mass = 0.3, .inertia = 2.5e-4, .centre_distance = 0.05},
                                     .coupler = {.mass = 0.9, .inertia = 9.2e-3, .centre_distance = 0.175},
                                     .rocker = {.mass = 0.6, .inertia = 3.1e-3, .centre_distance = 0.125}};
  const double speed = 300 * 2 * pi / 60, gravity = 9.81;

  double largest_force = 0, largest_torque = 0, worst_balance = 0;
  for (int degree = 0; degree < 360; ++degree) {
    const planar::FourBarRates rates = planar::rates(linkage, degree * pi / 180, speed);
    const planar::FourBarReactions r = planar::reactions(linkage, masses, rates, gravity);
    if (r.status != Status::done) return 1;
    largest_force = std::max(largest_force, std::abs(r.ground_on_crank));
    largest_torque = std::max(largest_torque, std::abs(r.drive_torque));
    // What the motor puts in is what kinetic and potential energy gain.
    const double gained = planar::energy_rate(linkage, masses, rates, gravity);
    worst_balance = std::max(worst_balance, std::abs(r.drive_torque * speed - gained));
  }
  std::printf("300 rpm: %.1f N in the crank pivot, %.2f N m on the crank; power balances to %.0e W\n",
              largest_force, largest_torque, worst_balance);
  return worst_balance < 1e-8 ? 0 : 1;
}
