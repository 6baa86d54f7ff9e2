// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/sketch/detail/sketch_points.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace linkwright::planar::sketching {
namespace {

void name_bodies(Sketch& sketch) {
  std::map<std::string, int> seen;
  for (SketchBody& body : sketch.bodies) {
    std::string name = body.type == SketchBodyType::ground  ? "ground"
                       : body.type == SketchBodyType::block ? "block "
                       : body.type == SketchBodyType::wheel ? "wheel "
                                                            : "";
    if (body.type != SketchBodyType::ground)
      for (const std::size_t point : body.points) name += sketch.points[point].name;
    const int times = ++seen[name];
    body.name = times > 1 ? fmt::format("{} {}", name, times) : name;
  }
}
void name_joints(Sketch& sketch) {
  std::map<std::string, int> seen;
  for (SketchJoint& joint : sketch.joints) {
    std::string name = joint.type == JointType::prismatic ? "slide "
                       : joint.type == JointType::fixed   ? "weld "
                                                          : "";
    name += sketch.points[joint.point].name;
    const int times = ++seen[name];
    joint.name = times > 1 ? fmt::format("{} {}", name, times) : name;
  }
}

void name_gears_and_belts(Sketch& sketch) {
  std::map<std::string, int> seen;
  for (SketchGear& gear : sketch.gears) {
    std::string name = "gear ";
    for (const std::size_t point : gear.points) name += sketch.points[point].name;
    const int times = ++seen[name];
    gear.name = times > 1 ? fmt::format("{} {}", name, times) : name;
  }
  for (SketchBelt& belt : sketch.belts) {
    std::string name = "belt ";
    for (const SketchPulley& pulley : belt.pulleys) name += sketch.points[pulley.point].name;
    const int times = ++seen[name];
    belt.name = times > 1 ? fmt::format("{} {}", name, times) : name;
  }
}

}  // namespace

std::string shown_place(Place at) {
  // Adding 0 after rounding to 1e-6 mm leaves no negative zero.
  const auto mm = [](double x) { return std::round(x * 1e9) / 1e6 + 0.0; };
  return fmt::format("({:.6g}, {:.6g}) mm", mm(at.real()), mm(at.imag()));
}

double distance(Place p, Place a, Place b) {
  const Place u = b - a;
  const double share =
      std::norm(u) > 0 ? std::clamp(std::real(std::conj(u) * (p - a)) / std::norm(u), 0.0, 1.0) : 0;
  return std::abs(p - (a + share * u));
}

double turn_at(Place before, Place at, Place after) {
  return std::abs(std::arg((after - at) / (at - before)));
}

std::vector<Segment> pieces_of(const DrawnShape& shape) {
  const auto& p = shape.points;
  std::vector<Segment> out;
  for (std::size_t from = 0, i = 1; i < p.size(); ++i) {
    const bool last = i + 1 == p.size();
    const bool corner = !last && turn_at(p[i - 1], p[i], p[i + 1]) > least_corner;
    if (!last && !corner) continue;
    out.push_back({p[from], p[i], i == from + 1});
    from = i;
  }
  return out;
}

std::size_t Nodes::root(std::size_t i) {
  while (group_[i] != i) i = group_[i] = group_[group_[i]];
  return i;
}

/// Calls `meet` for pairs of points up to a distance; they are sorted by x.
template <class Meet>
void Nodes::near(double distance, Meet meet) {
  for (std::size_t i = 0; i < raw_.size(); ++i)
    for (std::size_t k = i + 1; k < raw_.size() && raw_[k].real() - raw_[i].real() <= distance; ++k)
      if (std::abs(raw_[k] - raw_[i]) <= distance && root(i) != root(k)) meet(i, k);
}

void Nodes::unite(double tolerance) {
  near(tolerance, [&](std::size_t i, std::size_t k) { group_[root(k)] = root(i); });
}

void Nodes::unite_asked(double tolerance, std::vector<SketchQuestion>& questions) {
  near(10 * tolerance, [&](std::size_t i, std::size_t k) {
    questions.push_back(
        {fmt::format("the ends at {} and {} are {:.3g} mm apart: are they one point?", shown_place(raw_[i]),
                     shown_place(raw_[k]), std::abs(raw_[k] - raw_[i]) * 1000),
         "they are"});
    group_[root(k)] = root(i);
  });
}

void Nodes::join(double tolerance, std::vector<SketchQuestion>& questions) {
  std::sort(raw_.begin(), raw_.end(), left_below);
  raw_.erase(std::unique(raw_.begin(), raw_.end()), raw_.end());
  group_.resize(raw_.size());
  std::iota(group_.begin(), group_.end(), std::size_t{0});
  unite(tolerance);
  unite_asked(tolerance, questions);
  // A point lies in the middle of what meets there.
  std::map<std::size_t, std::pair<Place, double>> sums;
  for (std::size_t i = 0; i < raw_.size(); ++i) {
    auto& [sum, count] = sums[root(i)];
    sum += raw_[i];
    count += 1;
  }
  std::map<std::size_t, std::size_t> index;
  for (const auto& [group, sum] : sums) {
    index[group] = places_.size();
    places_.push_back(sum.first / sum.second);
  }
  for (std::size_t i = 0; i < raw_.size(); ++i) group_of_raw_.push_back(index[root(i)]);
}

std::size_t Nodes::at(Place place) const {
  const auto found = std::lower_bound(raw_.begin(), raw_.end(), place, left_below);
  return group_of_raw_[static_cast<std::size_t>(found - raw_.begin())];
}

std::string letter_of(std::size_t index) {
  std::string name(1, static_cast<char>('A' + index % 26));
  if (index >= 26) name += std::to_string(index / 26 + 1);
  return name;
}

std::optional<std::size_t> point_named(const Sketch& sketch, std::string_view name) {
  for (std::size_t point = 0; point < sketch.points.size(); ++point)
    if (sketch.points[point].name == name) return point;
  return std::nullopt;
}

void name_sketch(Sketch& sketch) {
  name_bodies(sketch);
  name_joints(sketch);
  name_gears_and_belts(sketch);
}

}  // namespace linkwright::planar::sketching
