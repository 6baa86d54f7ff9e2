// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/drawn_scale.h"

namespace linkwright::clearance {
study::Scene clearance_scene(const ClearanceStudy& s, const ClearanceRecording& recording,
                             std::string input_key, std::string input_label) {
  // Few enough rows for an animation.
  std::vector<const RecordedRow*> rows;
  const std::size_t stride = std::max<std::size_t>(
      1, (recording.rows.size() + at(s.scene_samples) - 2) / at(std::max(s.scene_samples - 1, 1)));
  for (std::size_t i = 0; i < recording.rows.size(); i += stride) rows.push_back(&recording.rows[i]);
  if (!rows.empty() && rows.back() != &recording.rows.back()) rows.push_back(&recording.rows.back());
  std::vector<planar::LinkageRecord> records;
  for (const RecordedRow* row : rows) records.push_back(row->record);
  study::Scene scene = planar::linkage_scene(s.linkage, s.plan, records, s.traces, std::move(input_key),
                                             std::move(input_label));
  double largest = 0;
  for (std::size_t k = 0; k < s.pins(); ++k) largest = std::max(largest, s.clearance_of(k));
  const double scale = study::drawn_scale(largest, 0.05 * s.plan.size);
  scene.title = fmt::format("clearance drawn {:g} x", scale);
  // Pins are drawn further from their bushes than they are: these places are no numbers of the study.
  scene.handles.clear();

  const auto point = [&](const planar::BodyPoint& p) {
    int out = p.point;
    for (int b = 0; b < p.body; ++b) out += static_cast<int>(s.linkage.bodies[at(b)].points.size());
    return out;
  };
  const auto coordinate = [](const std::vector<double>& values, std::size_t i) {
    return values.size() == 1 ? values[0] : values[i];
  };
  for (std::size_t k = 0; k < s.pins(); ++k) {
    const planar::LinkageJoint& joint = s.linkage.joints[at(s.joint_of(k))];
    const bool pin_first = s.pin_side(k) == PinSide::first;
    const planar::BodyPoint pin = pin_first ? joint.first : joint.second,
                            bush = pin_first ? joint.second : joint.first;
    // The pin is moved away from the middle of its bush; a pin on the ground stays, and its bush moves.
    const bool pin_moves = s.plan.bodies[at(pin.body)].part != 0;
    study::Scene::Point &moved = scene.points[at(point(pin_moves ? pin : bush))],
                        &fixed = scene.points[at(point(pin_moves ? bush : pin))];
    study::Scene::Point rim{joint.name + " bush", {}, {}};
    std::vector<double> x, y;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::complex<double> stays{coordinate(fixed.x, i), coordinate(fixed.y, i)},
          away = (pin_moves ? scale : -scale) * rows[i]->pins[k].eccentricity;
      x.push_back((stays + away).real());
      y.push_back((stays + away).imag());
      const std::complex<double> middle = pin_moves ? stays : stays + away;
      const math::Vec2 along = rows[i]->record.bodies[at(bush.body)].direction;
      const std::complex<double> edge = middle + scale * s.clearance_of(k) * number(along);
      rim.x.push_back(edge.real());
      rim.y.push_back(edge.imag());
    }
    moved.x = std::move(x);
    moved.y = std::move(y);
    // A circle as large as the clearance of the pin in its bush.
    scene.points.push_back(std::move(rim));
    scene.circles.push_back({fmt::format("clearance of {}, {:.4g} mm", joint.name, 1e3 * s.clearance_of(k)),
                             point(bush), static_cast<int>(scene.points.size()) - 1});
    for (study::Scene::Joint& drawn : scene.joints)
      if (drawn.name == joint.name && drawn.style != study::Scene::JointStyle::tracer)
        drawn = {joint.name, point(pin), study::Scene::JointStyle::pivot};
    for (study::Scene::Vector& arrow : scene.vectors)
      if (arrow.quantity == study::Scene::Quantity::force && arrow.symbol == joint.name)
        arrow.point = point(pin);
  }
  return scene;
}

}  // namespace linkwright::clearance
