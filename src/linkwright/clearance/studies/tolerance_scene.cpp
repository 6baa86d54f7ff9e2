// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/tolerance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/study/extremes.h"

namespace linkwright::clearance {
double tolerance_scale(const ToleranceStudy& s, const std::vector<PathBand>& bands) {
  double largest = 0;
  for (const PathBand& band : bands) largest = std::max(largest, study::largest_size(band.across));
  for (const PinTolerance& p : s.tolerances.pins) largest = std::max(largest, p.clearance);
  // 1, 2, 5, 10, ...: the largest that is not more.
  const double scale = 0.05 * s.motion.plan.size / largest;
  if (!(scale > 1) || !std::isfinite(scale)) return 1;
  const double tens = std::pow(10, std::floor(std::log10(scale) * (1 + 1e-12)));
  for (const double digit : {5.0, 2.0})
    if (digit * tens <= scale) return digit * tens;
  return tens;
}

study::Scene tolerance_scene(const ToleranceStudy& s, const ToleranceRecording& r,
                             const std::vector<PathBand>& bands, double scale) {
  const planar::Linkage& l = s.motion.linkage;
  const bool time = std::holds_alternative<study::TimeSamples>(s.motion.sweep);
  const std::size_t axis = s.motion.plan.inputs() - 1;
  const std::string& driven = planar::input_joint(l, axis).name;
  study::Scene scene = planar::linkage_scene(
      l, s.motion.plan, r.records, s.outputs.points, tolerance_input_key(s),
      time ? "time" : driven + (s.motion.plan.rotary[axis] ? " angle" : " displacement"));
  scene.title = fmt::format("clearances and bands drawn {:g} x", scale);
  // The two edges of each band, as far as the worst error across the path carries the point.
  for (std::size_t p = 0; p < bands.size(); ++p) {
    const std::size_t i = r.quantities[p].first;
    for (const double side : {1.0, -1.0}) {
      study::Scene::Point edge;
      for (std::size_t row = 0; row < r.run_length; ++row) {
        const double by = side * scale * bands[p].across[row];
        edge.x.push_back(r.linear[row].values[i] + by * bands[p].normal[row].x);
        edge.y.push_back(r.linear[row].values[i + 1] + by * bands[p].normal[row].y);
      }
      const std::string name =
          fmt::format("worst case of {}, to the {}", r.quantities[p].name, side > 0 ? "left" : "right");
      const auto point = static_cast<int>(scene.points.size());
      bool closed = false;
      for (const study::Scene::Trace& t : scene.traces)
        closed = closed || (t.closed && t.name == "path of " + r.quantities[p].name);
      scene.points.push_back(std::move(edge));
      scene.traces.push_back({point, name, closed});
    }
  }
  // A circle at each clearance joint, as large as its clearance.
  for (const PinTolerance& pin : s.tolerances.pins) {
    const planar::LinkageJoint& joint = l.joints[at(pin.joint)];
    int centre = joint.first.point;
    for (int b = 0; b < joint.first.body; ++b) centre += static_cast<int>(l.bodies[at(b)].points.size());
    const study::Scene::Point& middle = scene.points[at(centre)];
    study::Scene::Point rim;
    for (std::size_t i = 0; i < r.records.size(); ++i) {
      const std::size_t k = middle.x.size() == 1 ? 0 : i;
      const planar::LinkageRecord& record = r.records[i];
      const math::Vec2 along =
          record.bodies.empty() ? math::Vec2{nan, nan} : record.bodies[at(joint.first.body)].direction;
      rim.x.push_back(middle.x.empty() ? nan : middle.x[k] + scale * pin.clearance * along.x);
      rim.y.push_back(middle.y.empty() ? nan : middle.y[k] + scale * pin.clearance * along.y);
    }
    scene.points.push_back(std::move(rim));
    scene.circles.push_back({fmt::format("clearance of {}, {:.4g} mm", joint.name, 1e3 * pin.clearance),
                             centre, static_cast<int>(scene.points.size()) - 1});
  }
  return scene;
}

}  // namespace linkwright::clearance
