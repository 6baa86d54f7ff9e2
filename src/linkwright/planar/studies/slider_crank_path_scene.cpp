#include "linkwright/planar/studies/slider_crank_path_scene.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/path_reached.h"

namespace linkwright::planar {

std::vector<double> shown_angles(const SliderPathDesign& design, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "needs at least 2 samples, got {}", samples);
  double from = design.angles[0], to = from + design.sense * 2 * pi;
  if (std::isnan(stroke(design.linkage.parameters)))
    if (const auto reach = SliderCrankPath::reach(design.linkage, from)) {
      from = design.sense > 0 ? reach->from : reach->to;
      to = design.sense > 0 ? reach->to : reach->from;
    }
  std::vector<double> out(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) out[static_cast<std::size_t>(i)] = from + (to - from) * i / (samples - 1);
  return out;
}

study::Scene slider_path_scene(const SliderPathProblem& problem, const SliderPathDesign& design,
                               std::string name, Sentence title, int samples) {
  // A crank that a search has shrunk to nothing leaves its pins apart by what nobody sees.
  constexpr double visible = 1e-6;
  auto mechanism = design.linkage;
  mechanism.parameters.crank = std::max(mechanism.parameters.crank, visible * mechanism.parameters.rod);
  const Linkage linkage = slider_crank(mechanism);
  const PlanResult planned = plan_linkage(linkage);
  LINKWRIGHT_REQUIRE(planned.problems.empty(), "a slider-crank of crank {} and rod {} has no plan",
                     design.linkage.parameters.crank, design.linkage.parameters.rod);
  LinkageMotion motion(planned.plan);
  std::vector<LinkageRecord> records;
  for (const double angle : shown_angles(design, samples)) {
    const InputMotion input{angle, 0, 0};
    solve_motion(planned.plan, std::span(&input, 1), motion);
    records.push_back(record_of(linkage, planned.plan, motion, nullptr, angle));
  }
  // The tracing point is the last one of the rod; on the crank pin it is the first.
  const int rod = 2, points = static_cast<int>(linkage.bodies[rod].points.size());
  const BodyPoint tracing{rod, points > 2 ? 2 : 0};
  study::Scene scene =
      linkage_scene(linkage, planned.plan, records, {tracing}, "crank_angle_rad", "crank angle");
  scene.name = std::move(name);
  scene.title = std::move(title);
  add_targets(scene, problem, design.angles, path_errors(problem, design));
  return scene;
}

Table slider_motion_table(const SliderPathDesign& design, std::string name, int samples) {
  Table table;
  table.name = std::move(name);
  const std::vector<double> angles = shown_angles(design, samples);
  std::vector<double> rod, way, pressure, x, y;
  for (const double angle : angles) {
    const SliderCrankPose pose = slider_crank_pose(design.linkage, angle);
    rod.push_back(pose.rod_angle);
    way.push_back(pose.displacement);
    pressure.push_back(pose.pressure_angle);
    x.push_back(pose.point.real());
    y.push_back(pose.point.imag());
    table.status.emplace_back(to_string(pose.status));
  }
  math::unwrap_angles(rod);
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("rod_angle_rad", "rod angle (rad)", std::move(rod));
  table.add("slider_m", "displacement of the slider along the guide (m)", std::move(way));
  table.add("pressure_angle_rad", "pressure angle between rod and guide (rad)", std::move(pressure));
  table.add("point_x_m", "tracing point x (m)", std::move(x));
  table.add("point_y_m", "tracing point y (m)", std::move(y));
  return table;
}

}  // namespace linkwright::planar
