// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/spatial.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

using study::Scene;
using Triple = std::array<double, 3>;

Triple operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Triple scaled(const Triple& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

Place sum(const Place& p, const Triple& a, double by) {
  return {p.x + by * a[0], p.y + by * a[1], p.z + by * a[2]};
}

/// Two directions of unit length across a unit vector.
std::array<Triple, 2> across(const Triple& axis) {
  // The coordinate axis that is least along it.
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(axis[k]) < std::abs(axis[least])) least = k;
  Triple other{};
  other[least] = 1;
  const Triple first = cross(axis, other), u = scaled(first, 1 / std::sqrt(dot(first, first)));
  return {u, cross(axis, u)};
}

std::vector<double> part(const std::vector<double>& values, std::size_t from, std::size_t count) {
  if (values.size() <= 1) return values;  // holds at all samples
  const auto end = [&](std::size_t i) {
    return values.begin() + static_cast<std::ptrdiff_t>(std::min(i, values.size()));
  };
  return {end(from), end(from + count)};
}

// Components in the frame of the sheet; each list has one entry, one a sample, or none for 0.
void turn(std::vector<double>& x, std::vector<double>& y, std::vector<double>& z, const Viewpoint& view) {
  const std::size_t count = std::max({x.size(), y.size(), z.size()});
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    if (values.empty()) return 0.0;
    if (values.size() == 1) return values.front();
    return i < values.size() ? values[i] : nan;
  };
  std::vector<double> right(count), up(count), back(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Triple p = {at(x, i), at(y, i), at(z, i)};
    right[i] = dot(view.right, p);
    up[i] = dot(view.up, p);
    back[i] = dot(view.back, p);
  }
  x = std::move(right);
  y = std::move(up);
  z = std::move(back);
}

}  // namespace

const std::array<Viewpoint, 3> viewpoints = {{
    {"rear view", {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}},
    {"side view from the left", {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {"top view", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
}};

Scene row_of(const Scene& scene, std::size_t row) {
  Scene out = scene;
  if (scene.second.empty()) return out;
  const std::size_t count = scene.input.size(), from = row * count;
  out.second.clear();
  out.second_key.clear();
  out.second_label.clear();
  const std::size_t end = std::min(from + count, scene.status.size());
  out.status.assign(scene.status.begin() + static_cast<std::ptrdiff_t>(std::min(from, end)),
                    scene.status.begin() + static_cast<std::ptrdiff_t>(end));
  const auto cut = [&](std::vector<double>& values) { values = part(values, from, count); };
  for (auto& point : out.points)
    for (auto* values : {&point.x, &point.y, &point.z}) cut(*values);
  for (auto& vector : out.vectors)
    for (auto* values : {&vector.x, &vector.y, &vector.z}) cut(*values);
  for (auto& moment : out.moments) cut(moment.value);
  return out;
}

Scene seen_from(const Scene& scene, const Viewpoint& view) {
  Scene out = scene;
  for (auto& point : out.points) turn(point.x, point.y, point.z, view);
  for (auto& vector : out.vectors) turn(vector.x, vector.y, vector.z, view);
  out.targets.clear();
  out.circles.clear();
  out.moments.clear();
  return out;
}

std::vector<Place> wheel_circle(const Scene& scene, const Scene::Disc& disc, std::size_t sample, double share,
                                double aside, int count) {
  const Place centre = place(scene, disc.centre, sample), end = place(scene, disc.axis, sample);
  const Triple way = end - centre;
  const double length = std::sqrt(dot(way, way));
  if (!(length > 0) || !std::isfinite(length)) return {};
  const Triple axis = scaled(way, 1 / length);
  const auto [u, v] = across(axis);
  const Place middle = sum(centre, axis, aside);
  std::vector<Place> out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count, r = share * disc.radius;
    out.push_back(sum(sum(middle, u, r * std::cos(angle)), v, r * std::sin(angle)));
  }
  return out;
}

std::vector<Place> wheel_outline(const Scene& scene, const Scene::Disc& disc, std::size_t sample) {
  std::vector<Place> places;
  for (const double side : {-0.5, 0.5})
    for (const Place& p : wheel_circle(scene, disc, sample, 1, side * disc.width, 48)) places.push_back(p);
  if (places.empty()) return {};
  // Andrew's monotone chain.
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Place> hull;
  const auto chain = [&hull](auto first, auto last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= start + 2) {
        const Place &a = hull[hull.size() - 2], &b = hull.back();
        if ((b.x - a.x) * (first->y - a.y) - (b.y - a.y) * (first->x - a.x) > 0) break;
        hull.pop_back();
      }
      hull.push_back(*first);
    }
    hull.pop_back();
  };
  chain(places.begin(), places.end());
  chain(places.rbegin(), places.rend());
  return hull;
}

std::vector<Place> helix(const Place& a, const Place& b, double width) {
  const Triple way = b - a;
  const double length = std::sqrt(dot(way, way));
  if (!(length > 0) || !std::isfinite(length)) return {};
  const auto [u, v] = across(scaled(way, 1 / length));
  constexpr int turns = 7, pieces = 24;  // a turn
  std::vector<Place> out = {a};
  for (int i = 0; i <= turns * pieces; ++i) {
    const double angle = 2 * pi * i / pieces, share = static_cast<double>(i) / (turns * pieces);
    out.push_back(
        sum(sum(sum(a, way, share), u, width / 2 * std::cos(angle)), v, width / 2 * std::sin(angle)));
  }
  out.push_back(b);
  return out;
}

std::vector<Place> beyond(std::vector<Place> places) {
  constexpr double more = 0.15;
  if (places.size() < 2) return places;
  const Place first = sum(places.front(), places.front() - places[1], more);
  places.back() = sum(places.back(), places.back() - places[places.size() - 2], more);
  places.front() = first;
  return places;
}

}  // namespace linkwright::report
