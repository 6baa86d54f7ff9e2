// A DELTA picks and places: angles of its arms along the way, and the way back through direct kinematics.
#include <cstdio>

#include "linkwright/parallel.h"

int main() {
  using namespace linkwright;
  const parallel::Robot robot =
      parallel::delta({.base_radius = 0.2, .platform_radius = 0.045, .arm = 0.25, .rod = 0.5});
  parallel::ToolPath path;
  path.steps.push_back({parallel::PickAndPlace{.to = {0.15, 0.05, -0.5}, .height = 0.05}});
  const parallel::ToolLimits limits{.speed = 3, .acceleration = 60, .jerk = 6000};
  const parallel::Pose start{{-0.15, -0.05, -0.5}};
  if (const auto wrong = parallel::problem(path, limits, start)) {
    std::printf("%s\n", wrong->message.c_str());
    return 1;
  }
  const parallel::ToolMotion motion(path, limits, start);
  parallel::Pose last = start;
  double lowest = infinity, highest = -infinity, error = 0;
  for (const auto& [time, tool] : motion.samples(0.002)) {
    const parallel::Pose pose{tool.position, tool.rotation};
    const parallel::ArmAngles arms = parallel::inverse(robot, pose);
    if (arms.status != Status::done) {
      std::printf("%.3f s: %s\n", time, to_string(parallel::reason(arms)).c_str());
      return 1;
    }
    for (int leg = 0; leg < 3; ++leg) {
      lowest = std::min(lowest, arms.angle[leg]);
      highest = std::max(highest, arms.angle[leg]);
    }
    const parallel::Placed back = parallel::direct_near(robot, arms.angle, last);
    error = std::max(error, math::norm(back.pose.position - pose.position));
    last = pose;
  }
  std::printf("%.0f ms, arms from %.1f to %.1f deg, inverse and direct kinematics agree to %.0e m\n",
              motion.duration() * 1000, lowest * 180 / pi, highest * 180 / pi, error);
  return error < 1e-12 ? 0 : 1;
}
