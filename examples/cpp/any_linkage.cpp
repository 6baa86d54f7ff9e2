// A slider-crank written down by names: its motion, and what its joints carry.
#include <cmath>
#include <cstdio>

#include "linkwright/planar.h"

int main() {
  using namespace linkwright;
  planar::Linkage engine = planar::grounded({{"O", {0, 0}}, {"bore", {0, 0}}});
  planar::add_bar(engine, "crank", "O", "A", 0.05);
  planar::add_bar(engine, "rod", "A", "B", 0.15);
  planar::add_body(engine, "piston", {{"B", {0, 0}}});
  planar::add_pin(engine, "main", "ground.O", "crank.O");
  planar::add_pin(engine, "big end", "crank.A", "rod.A");
  planar::add_pin(engine, "small end", "rod.B", "piston.B");
  planar::add_slide(engine, "cylinder", "ground.bore", "piston.B");
  planar::add_drive(engine, "main");
  planar::set_mode(engine, "rod", "piston", planar::AssemblyMode::plus);
  planar::set_uniform(engine, "crank", 0.8);
  planar::set_uniform(engine, "rod", 0.5);
  planar::set_uniform(engine, "piston", 0.4);

  const planar::PlanResult planned = planar::plan_linkage(engine);
  for (const Diagnostic& problem : planned.problems) std::printf("%s\n", to_string(problem).c_str());
  planar::LinkageMotion motion(planned.plan);
  planar::LinkageForces forces;
  double lowest = infinity, highest = -infinity, side = 0;
  for (int degree = 0; degree <= 360; degree += 5) {
    const planar::InputMotion input{degree * pi / 180, 3000 * 2 * pi / 60, 0};
    planar::solve_motion(planned.plan, {&input, 1}, motion);
    planar::solve_forces(engine, planned.plan, motion, 0, input.value, forces);
    if (forces.status != Status::done) return 1;
    const planar::PointMotion pin = planar::point_motion(engine, planned.plan, motion, "piston.B");
    lowest = std::min(lowest, pin.position.x), highest = std::max(highest, pin.position.x);
    side = std::max(side, std::abs(planar::joint_reaction(engine, forces, "cylinder").force.y));
  }
  std::printf("stroke %.1f mm, side force on the cylinder %.1f N\n", (highest - lowest) * 1000, side);
  return std::abs(highest - lowest - 0.1) < 1e-12 ? 0 : 1;
}
