// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/flat_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

using study::Scene;

double cross(const Place& o, const Place& a, const Place& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// The corners of the convex hull, counter-clockwise.
std::vector<Place> hull_of(std::vector<Place> places) {
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  places.erase(std::unique(places.begin(), places.end(),
                           [](const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; }),
               places.end());
  if (places.size() < 3) return places;
  double size = 0;
  for (const Place& p : places) size = std::max(size, std::hypot(p.x - places[0].x, p.y - places[0].y));
  const double least = 1e-9 * size * size;  // corners on a straight line are left out
  std::vector<Place> out;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = out.size();
    for (const Place& p : places) {
      while (out.size() >= start + 2 && cross(out[out.size() - 2], out.back(), p) <= least) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(places.begin(), places.end());
  }
  return out;
}

double distance_to(const Place& p, const Place& a, const Place& b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double share = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - share * x, p.y - a.y - share * y);
}

bool inside(const Place& p, const std::vector<Place>& hull) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (cross(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
  return true;
}

double distance_to(const Place& p, const std::vector<Place>& hull) {
  if (inside(p, hull)) return 0;
  double least = infinity;
  for (std::size_t i = 0; i < hull.size(); ++i)
    least = std::min(least, distance_to(p, hull[i], hull[(i + 1) % hull.size()]));
  return least;
}

bool cut_each_other(const Place& a, const Place& b, const Place& c, const Place& d) {
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

/// The distance of two convex outlines; 0 where they overlap.
double distance_of(const std::vector<Place>& a, const std::vector<Place>& b) {
  double least = infinity;
  for (const Place& p : a) least = std::min(least, distance_to(p, b));
  for (const Place& p : b) least = std::min(least, distance_to(p, a));
  for (std::size_t i = 0; i < a.size() && least > 0; ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      if (cut_each_other(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return 0;
  return least;
}

/// Parts by the points of their outlines and of their holes.
struct Outline {
  std::string name;
  std::vector<int> points;
  std::set<int> pins;
};

/// The first point that lies where each point lies, at all samples: bodies that meet at a pin may each have
/// a point of their own there.
std::vector<int> merged_points(const Scene& scene) {
  const double near = 1e-7 * extent(scene);
  const auto together = [&](int a, int b) {
    for (std::size_t sample = 0; sample < scene.samples(); ++sample) {
      if (!assembled(scene, sample)) continue;
      const Place p = place(scene, a, sample), q = place(scene, b, sample);
      if (!(std::hypot(p.x - q.x, p.y - q.y) <= near)) return false;
    }
    return true;
  };
  std::vector<int> out;
  for (int point = 0; point < static_cast<int>(scene.points.size()); ++point) {
    int first = 0;
    while (first < point && !(out[static_cast<std::size_t>(first)] == first && together(first, point)))
      ++first;
    out.push_back(first);
  }
  return out;
}

/// True if a point keeps its distances from two others while these move, so that it lies on their body.
bool moves_with(const Scene& scene, int point, int first, int second) {
  const double near = 1e-7 * extent(scene);
  const auto apart = [&](int a, int b, std::size_t sample) {
    const Place p = place(scene, a, sample), q = place(scene, b, sample);
    return std::hypot(p.x - q.x, p.y - q.y);
  };
  std::optional<std::size_t> start;
  bool has_moved = false;
  for (std::size_t sample = 0; sample < scene.samples(); ++sample) {
    if (!assembled(scene, sample)) continue;
    if (!start) start = sample;
    for (const int corner : {first, second})
      if (!(std::abs(apart(point, corner, sample) - apart(point, corner, *start)) <= near)) return false;
    const Place now = place(scene, second, sample), then = place(scene, second, *start);
    has_moved = has_moved || std::hypot(now.x - then.x, now.y - then.y) > 1e-3 * extent(scene);
  }
  return has_moved;
}

std::vector<Outline> outlines_of(const Scene& scene, const std::vector<int>& merged) {
  std::set<int> pins, fixed;
  const auto at = [&](int point) { return merged[static_cast<std::size_t>(point)]; };
  for (const Scene::Joint& joint : scene.joints) {
    if (joint.style != Scene::JointStyle::tracer) pins.insert(at(joint.point));
    if (joint.style == Scene::JointStyle::ground_pivot) fixed.insert(at(joint.point));
  }
  std::vector<Outline> out;
  if (!fixed.empty()) out.push_back({"ground", {fixed.begin(), fixed.end()}, fixed});
  for (const Scene::Body& body : scene.bodies) {
    const bool is_part = body.style == Scene::BodyStyle::bar || body.style == Scene::BodyStyle::plate;
    if (!is_part || body.run > 0 || body.points.size() < 2) continue;
    // The corners of cams, blocks and faces have no names: they are drawn, and are no points of links.
    if (std::any_of(body.points.begin(), body.points.end(),
                    [&](int point) { return scene.points[static_cast<std::size_t>(point)].name.empty(); }))
      continue;
    Outline part{body.name, body.points, {}};
    for (const int point : body.points)
      if (pins.count(at(point)) > 0) part.pins.insert(at(point));
    for (const int pin : pins)  // within a plate
      if (moves_with(scene, pin, body.points[0], body.points[1])) part.pins.insert(pin);
    out.push_back(std::move(part));
  }
  return out;
}

std::vector<Place> places_of(const Scene& scene, const std::vector<int>& points, std::size_t sample) {
  std::vector<Place> out;
  for (const int point : points) out.push_back(place(scene, point, sample));
  return out;
}

/// Chooses layers from below, part by part.
class Stacking {
 public:
  Stacking(const Scene& scene, const std::vector<Outline>& outlines, double radius, double pin_radius)
      : outlines_(outlines), pin_radius_(pin_radius), radius_(radius), layers_(outlines.size(), -1) {
    for (std::size_t sample = 0; sample < scene.samples(); ++sample) {
      if (!assembled(scene, sample)) continue;
      std::vector<std::vector<Place>> pose;
      for (const Outline& outline : outlines)
        pose.push_back(hull_of(places_of(scene, outline.points, sample)));
      std::vector<Place> all;
      for (std::size_t point = 0; point < scene.points.size(); ++point)
        all.push_back(place(scene, static_cast<int>(point), sample));
      poses_.push_back(std::move(pose));
      points_.push_back(std::move(all));
    }
  }

  std::vector<int> layers() {
    for (std::size_t part = 0; part < outlines_.size(); ++part) layers_[part] = layer_for(part);
    return layers_;
  }

  /// True if a pin meets a part at some sample.
  bool meets(int pin, std::size_t part) const {
    for (std::size_t i = 0; i < poses_.size(); ++i)
      if (distance_to(points_[i][static_cast<std::size_t>(pin)], poses_[i][part]) < radius_ + pin_radius_)
        return true;
    return false;
  }

 private:
  int layer_for(std::size_t part) const {
    int top = 0;
    for (std::size_t other = 0; other < part; ++other) top = std::max(top, layers_[other] + 1);
    int without_touching = top;
    for (int layer = top; layer >= 0; --layer) {
      if (touches(part, layer)) continue;
      without_touching = layer;
    }
    for (int layer = 0; layer <= top; ++layer)
      if (!touches(part, layer) && !crosses(part, layer)) return layer;
    return without_touching;
  }

  bool touches(std::size_t part, int layer) const {
    for (std::size_t other = 0; other < part; ++other) {
      if (layers_[other] != layer) continue;
      for (const auto& pose : poses_)
        if (distance_of(pose[part], pose[other]) < 2 * radius_) return true;
    }
    return false;
  }

  /// True if in that layer a pin between parts on both sides passes through the part, or a pin of the part
  /// passes through another one.
  bool crosses(std::size_t part, int layer) const {
    std::set<int> pins;
    for (std::size_t other = 0; other < part; ++other)
      pins.insert(outlines_[other].pins.begin(), outlines_[other].pins.end());
    for (const int pin : pins) {
      int low = layer, high = layer;
      const bool joins = outlines_[part].pins.count(pin) > 0;
      bool first = !joins;
      for (std::size_t other = 0; other < part; ++other) {
        if (outlines_[other].pins.count(pin) == 0) continue;
        low = first ? layers_[other] : std::min(low, layers_[other]);
        high = first ? layers_[other] : std::max(high, layers_[other]);
        first = false;
      }
      if (!joins && low < layer && layer < high && meets(pin, part)) return true;
      for (std::size_t other = 0; joins && other < part; ++other)
        if (outlines_[other].pins.count(pin) == 0 && low < layers_[other] && layers_[other] < high &&
            meets(pin, other))
          return true;
    }
    return false;
  }

  const std::vector<Outline>& outlines_;
  double pin_radius_, radius_;
  std::vector<int> layers_;
  std::vector<std::vector<std::vector<Place>>> poses_;  ///< outlines by samples and parts
  std::vector<std::vector<Place>> points_;              ///< by samples
};

}  // namespace

FlatMechanism flat_parts(const Scene& scene, std::size_t sample, const study::PartSizes& sizes) {
  FlatMechanism out;
  if (scene.spatial()) return out;
  const std::vector<int> merged = merged_points(scene);
  std::vector<Outline> outlines = outlines_of(scene, merged);
  std::erase_if(outlines, [&](const Outline& outline) {
    const std::vector<Place> places = places_of(scene, outline.points, sample);
    return !std::all_of(places.begin(), places.end(), [](const Place& p) { return p.finite(); });
  });
  const double size = extent(scene);
  out.thickness = sizes.thickness.value_or(0.02 * size);
  out.pin_radius = sizes.pin_diameter.value_or(0.02 * size) / 2;
  const double radius = sizes.width.value_or(std::max(0.05 * size, 4 * out.pin_radius)) / 2;
  Stacking stacking(scene, outlines, radius, out.pin_radius);
  const std::vector<int> layers = stacking.layers();
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    FlatPart part{
        outlines[i].name, hull_of(places_of(scene, outlines[i].points, sample)), radius, {}, layers[i]};
    for (const int pin : outlines[i].pins) part.holes.push_back(place(scene, pin, sample));
    out.parts.push_back(std::move(part));
  }
  std::set<int> done;
  for (const Scene::Joint& joint : scene.joints) {
    const int point = merged[static_cast<std::size_t>(joint.point)];
    if (joint.style == Scene::JointStyle::tracer || !done.insert(point).second) continue;
    FlatPin pin{joint.name, place(scene, point, sample), 0, -1};
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if (outlines[i].pins.count(point) == 0) continue;
      pin.first = pin.last < 0 ? layers[i] : std::min(pin.first, layers[i]);
      pin.last = std::max(pin.last, layers[i]);
    }
    if (pin.last < 0) continue;
    for (std::size_t i = 0; i < outlines.size(); ++i)
      if (outlines[i].pins.count(point) == 0 && pin.first < layers[i] && layers[i] < pin.last &&
          stacking.meets(point, i))
        out.crossed.push_back(fmt::format("{} through {}", pin.name, outlines[i].name));
    out.pins.push_back(std::move(pin));
  }
  return out;
}

}  // namespace linkwright::report
