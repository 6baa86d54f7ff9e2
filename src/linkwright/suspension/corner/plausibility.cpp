// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/plausibility.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace linkwright::suspension {
namespace {

/// Factors beyond which something is unlikely, and beyond which it cannot be meant. A tyre's radius is about
/// half as long as the farthest joint is away from the wheel centre; a slip of a unit is a factor of 10 (cm,
/// mm), 25.4 (in, mm) or 1000 (mm, m).
constexpr double unlikely = 8, absurd = 50;
/// m: the farthest joint of a suspension lies within these from the wheel centre, from a model car to a dump
/// truck.
constexpr double smallest = 0.02, largest = 10;
/// A wheel centre nearer to the middle plane than this share of the distance of its joints has no track.
constexpr double no_half_track = 3e-3;
/// A link whose end at the body lies further outboard than the other by this share of the distance of the
/// joints has its ends swapped; trailing arms stand within it.
constexpr double swapped_ends = 0.1;
constexpr const char* units = "check the unit in the key: _mm, _cm, _m or _in";

class Findings {
 public:
  void add(bool error, std::string key, std::string message, std::string hint = {}) {
    list_.push_back({.severity = error ? Diagnostic::Severity::error : Diagnostic::Severity::warning,
                     .key = std::move(key),
                     .message = std::move(message),
                     .hint = std::move(hint)});
  }
  Diagnostics take() { return std::move(list_); }

 private:
  Diagnostics list_;
};

/// A length as people read it.
std::string length(double metres) {
  const double size = std::abs(metres);
  if (size >= 1) return fmt::format("{:.4g} m", metres);
  return fmt::format("{:.4g} mm", metres * 1e3);
}

struct Point {
  std::string key, what;
  Vec3 at;
  bool at_body = false;
};

std::vector<Point> points_of_links(const Suspension& suspension) {
  std::vector<Point> out;
  const auto add = [&](const std::string& key, const std::string& what, const std::vector<Vec3>& at,
                       bool at_body) {
    for (std::size_t i = 0; i < at.size(); ++i)
      out.push_back({key, at.size() > 1 ? fmt::format("{} {}", what, i + 1) : what, at[i], at_body});
  };
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const std::string label = link_label(suspension, i);
    add("link." + label, "body point", suspension.links[i].body, true);
    add("link." + label, "carrier point", suspension.links[i].carrier, false);
  }
  for (std::size_t i = 0; i < suspension.couplers.size(); ++i) {
    const std::string& name = suspension.couplers[i].name;
    add("coupler." + (name.empty() ? std::to_string(i + 1) : name), "point", {suspension.couplers[i].point},
        false);
  }
  if (suspension.spring) {
    add("spring", "its end at the body", {suspension.spring->body}, true);
    add("spring", "its moving end", {suspension.spring->moving}, false);
  }
  return out;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The wheel against the middle plane: y = 0, and axes that seem to have changed places.
void check_side(const Suspension& suspension, double typical, Findings& found) {
  const Vec3& c = suspension.wheel.centre;
  if (!(std::abs(c.y) < no_half_track * typical)) return;
  const char across = std::abs(c.x) >= std::abs(c.z) ? 'x' : 'z';
  const double other = across == 'x' ? c.x : c.z;
  if (std::abs(other) > suspension.wheel.tyre_diameter / 2)
    found.add(
        false, "wheel",
        fmt::format("the wheel centre lies at y = {}, in the middle of the vehicle, but at {} = {}: do the "
                    "axes change places?",
                    length(c.y), across, length(other)),
        "y points to the left; give hard points in their own axes by [mechanism.hard_points] x = \"...\", y "
        "= "
        "\"...\", z = \"...\"");
  else
    found.add(
        false, "wheel",
        fmt::format(
            "the wheel centre lies at y = {}, in the middle of the vehicle: the wheel has no track, and "
            "the roll centre no height",
            length(c.y)),
        "give y of the wheel centre, or the place of the list's origin by [mechanism.hard_points] origin_mm "
        "= "
        "[x, y, z]");
}

/// Links whose ends have changed places: the end at the body lies outboard of the end at the carrier.
void check_ends(const Suspension& suspension, double typical, Findings& found) {
  const double side = suspension.side == Side::right ? -1 : 1;
  // On the other side everything is the wrong way round, which is reported for the wheel.
  if (side * suspension.wheel.centre.y < no_half_track * typical) return;
  const auto outboard = [&](const std::vector<Vec3>& points) {
    double sum = 0;
    for (const Vec3& p : points) sum += side * p.y;
    return sum / static_cast<double>(points.size());
  };
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const CornerLink& link = suspension.links[static_cast<std::size_t>(i)];
    if (link.body.empty() || link.carrier.empty()) continue;
    const double body = outboard(link.body), carrier = outboard(link.carrier);
    if (!(body - carrier > swapped_ends * typical)) continue;
    found.add(
        false, "link." + link_label(suspension, i),
        fmt::format(
            "its end at the body lies {} outboard of its end at the carrier{}: are the ends swapped?",
            length(body - carrier),
            link.body.size() == 1 && link.carrier.size() == 2 ? ", and its ball joint is at the body" : ""),
        "body is the end at the vehicle's body, carrier the end at the wheel; names of hard points go in "
        "the same order");
  }
}

}  // namespace

Diagnostics implausible(const Suspension& suspension) {
  Findings found;
  const Vec3& centre = suspension.wheel.centre;
  const std::vector<Point> points = points_of_links(suspension);
  if (points.empty()) return {};
  std::vector<double> away;
  for (const Point& p : points) away.push_back(norm(p.at - centre));
  const double typical = median(away);

  // Single points of another unit: a thousand times too far from the others, or all but at the origin.
  bool strays = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (away[i] > unlikely * typical && away[i] > 1) {
      strays = true;
      found.add(away[i] > absurd * typical, p.key,
                fmt::format("{} lies {} from the wheel centre, the points of the suspension {} in the middle",
                            p.what, length(away[i]), length(typical)),
                units);
      continue;
    }
    const double from_origin = norm(p.at);
    const double enlarged = norm(1e3 * p.at - centre);
    if (from_origin > 0 && norm(centre) > absurd * from_origin && from_origin < 2e-3 &&
        enlarged < 3 * typical) {
      strays = true;
      found.add(false, p.key,
                fmt::format("{} lies {} from the origin, the wheel centre {}", p.what, length(from_origin),
                            length(norm(centre))),
                units);
    }
  }
  check_side(suspension, typical, found);
  if (!strays) check_ends(suspension, typical, found);

  const double farthest = *std::max_element(away.begin(), away.end()),
               radius = suspension.wheel.tyre_diameter / 2;
  if (!strays && (farthest < smallest || farthest > largest))
    found.add(
        farthest < smallest / 10 || farthest > largest * 10, "hard_points",
        fmt::format("the farthest point of the suspension lies {} from the wheel centre", length(farthest)),
        farthest < smallest ? "are these metres in keys of millimetres? " + std::string(units)
                            : "are these millimetres in keys of metres? " + std::string(units));
  const double ratio = radius / typical;
  if (!strays && (ratio > unlikely || ratio < 1 / (3 * unlikely)))
    found.add(ratio > absurd || ratio < 1 / (3 * absurd), "wheel",
              fmt::format("the tyre's radius is {}, the joints lie {} from the wheel centre in the middle{}",
                          length(radius), length(typical),
                          std::abs(centre.y) > no_half_track * typical
                              ? fmt::format(", and the track is {}", length(2 * std::abs(centre.y)))
                              : std::string()),
              "check tyre_diameter and the points: _mm, _cm, _m or _in");

  // The body lies inboard of its wheel.
  if (!strays && std::abs(centre.y) > no_half_track * typical) {
    double outboard = 0;
    int count = 0;
    for (const Point& p : points)
      if (p.at_body) outboard += std::abs(p.at.y) - std::abs(centre.y), ++count;
    if (count > 0 && outboard / count > 0.5 * typical)
      found.add(
          false, "hard_points",
          fmt::format("the joints at the body lie outboard of the wheel centre, by {} in the middle",
                      length(outboard / count)),
          "y points to the left and is 0 in the middle of the vehicle; is the origin that of the list?");
  }
  return found.take();
}

Diagnostics implausible(const CarrierTargets& targets) {
  Findings found;
  const double diameter = targets.wheel.tyre_diameter;
  if (!(diameter > 0) || targets.poses.empty()) return {};
  const Vec3& reference = targets.wheel.centre;
  std::size_t farthest = 0, nearest = 0, max_rack = 0;
  std::array<double, 3> least{0, 0, 0}, most{0, 0, 0};
  for (std::size_t i = 0; i < targets.poses.size(); ++i) {
    const CarrierTarget& pose = targets.poses[i];
    if (norm(pose.centre - reference) > norm(targets.poses[farthest].centre - reference)) farthest = i;
    if (norm(pose.centre - reference) < norm(targets.poses[nearest].centre - reference)) nearest = i;
    if (std::abs(pose.rack) > std::abs(targets.poses[max_rack].rack)) max_rack = i;
    const Vec3 d = pose.centre - reference;
    const std::array<double, 3> along{d.x, d.y, d.z};
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], along[k]);
      most[k] = std::max(most[k], along[k]);
    }
  }
  const double way = norm(targets.poses[farthest].centre - reference);
  const std::string row = fmt::format("position {}", farthest + 1);
  if (way > 2 * diameter)
    found.add(
        way > absurd * diameter, "pose",
        fmt::format(
            "{}: the wheel centre lies {} from its reference at ({}, {}, {}), the tyre's diameter is {}", row,
            length(way), length(reference.x), length(reference.y), length(reference.z), length(diameter)),
        "give positions and mechanism in one frame and with the units of their keys: centre_m, centre_mm");
  else if (const double gap = norm(targets.poses[nearest].centre - reference); gap > diameter / 4)
    found.add(
        false, "pose",
        fmt::format(
            "no position comes nearer than {} to the reference at ({}, {}, {}), which is a position itself",
            length(gap), length(reference.x), length(reference.y), length(reference.z)),
        "give positions and mechanism in one frame and with the units of their keys: centre_m, centre_mm");
  else if (way < diameter / 2000 && std::abs(targets.poses[max_rack].rack) < diameter / 2000)
    found.add(false, "pose",
              fmt::format("no position is farther than {} from the reference, and the tyre's diameter is {}",
                          length(way), length(diameter)),
              "are these metres in keys of millimetres? centre_m, centre_mm");
  const double rack = std::abs(targets.poses[max_rack].rack);
  if (rack > diameter)
    found.add(rack > absurd * diameter, "pose",
              fmt::format("position {}: the rack goes {}, the tyre's diameter is {}", max_rack + 1,
                          length(rack), length(diameter)),
              "check the unit of rack: rack_m, rack_mm");
  // A wheel travels upright more than it moves across.
  const double up = most[2] - least[2];
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const double across = most[k] - least[k];
    if (across > diameter / 10 && across > 3 * up && way <= 2 * diameter)
      found.add(false, "pose",
                fmt::format("the wheel centre moves {} along {} and {} along z: do the axes change places?",
                            length(across), "xy"[k], length(up)),
                "x points forward, y to the left, z up: travel is centre_z");
  }
  return found.take();
}

}  // namespace linkwright::suspension
