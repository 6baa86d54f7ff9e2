// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_reached.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "linkwright/core/sentence.h"

namespace linkwright::planar {

Sentence how_near(const PathTargets& p, const PathErrors& errors, double error) {
  const double worst = *std::max_element(errors.excess.begin(), errors.excess.end());
  const Sentence what = say("{} {}", p.x.size(), p.gate_x.empty() ? "points" : "gates");
  const char* allowed = p.tolerance.empty() ? "" : " of their tolerance";
  if (worst <= exact_share * path_size(p))
    return p.tolerance.empty() ? say("passes the {} exactly", what)
                               : say("passes the {} within their tolerance", what);
  return say("passes the {} within {}{} (root mean square {})", what, length_by_size(worst), allowed,
             length_by_size(std::sqrt(error / static_cast<double>(p.x.size()))));
}

study::Fact worst_fact(const PathTargets& p, const PathErrors& errors) {
  const auto worst = std::max_element(errors.excess.begin(), errors.excess.end());
  const bool exact = *worst <= exact_share * path_size(p);
  if (exact && !p.tolerance.empty()) return {"worst point", "none is beyond its tolerance"};
  if (exact) return {"worst point", "none, to rounding"};
  const std::string what = p.gate_x.empty() ? "point" : "gate";
  const auto number = static_cast<double>(worst - errors.excess.begin() + 1);
  return {"worst point", say("{} at {} {}", length_by_size(*worst), what, at_place(what, count_of(number)))};
}

Table point_table(const PathTargets& targets, const std::vector<double>& angles, const PathErrors& errors,
                  std::string name) {
  Table table;
  table.name = std::move(name);
  std::vector<double> number;
  for (std::size_t k = 0; k < targets.x.size(); ++k) {
    number.push_back(static_cast<double>(k + 1));
    table.status.emplace_back(std::isfinite(errors.distance[k]) ? "done" : "no_assembly");
  }
  table.add("point", "point", std::move(number));
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("target_x_m", "target x (m)", targets.x);
  table.add("target_y_m", "target y (m)", targets.y);
  table.add("x_m", "reached x (m)", errors.x);
  table.add("y_m", "reached y (m)", errors.y);
  table.add("distance_m", "distance (m)", errors.distance);
  if (!targets.tolerance.empty()) {
    table.add("tolerance_m", "tolerance (m)", targets.tolerance);
    table.add("excess_m", "distance beyond the tolerance (m)", errors.excess);
  }
  return table;
}

void add_targets(study::Scene& scene, const PathTargets& p, const std::vector<double>& angles,
                 const PathErrors& errors) {
  if (p.gate_x.empty()) {
    scene.targets = {{"target points", p.x, p.y, errors.x, errors.y, angles, p.closed}};
    for (int k = 0; k < static_cast<int>(p.x.size()); ++k)
      scene.handles.push_back({.key = fmt::format("target.points_m[{}]", k), .target = 0, .index = k});
    return;
  }
  // Whiskers run to the nearest place of each gate; its posts are marked.
  study::Scene::Target gates{"gates", {}, {}, errors.x, errors.y, angles, p.closed};
  study::Scene::Target posts{"gate posts", {}, {}, {}, {}, {}, false};
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const TargetMiss miss = target_offset(p, k, errors.x[k], errors.y[k]);
    gates.x.push_back(std::isfinite(miss.x) ? errors.x[k] - miss.x : p.x[k]);
    gates.y.push_back(std::isfinite(miss.y) ? errors.y[k] - miss.y : p.y[k]);
    for (double side : {-1.0, 1.0}) {
      posts.x.push_back(p.x[k] + side * p.gate_x[k]);
      posts.y.push_back(p.y[k] + side * p.gate_y[k]);
      posts.achieved_input.push_back(angles[k]);
    }
  }
  posts.achieved_x = posts.x;
  posts.achieved_y = posts.y;
  scene.targets = {std::move(gates), std::move(posts)};
}

}  // namespace linkwright::planar
