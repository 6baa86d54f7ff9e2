// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/arrows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

using study::Scene;

constexpr double share_of_scene = 0.25;
constexpr double outstanding = 3;  // times the median

double at(const std::vector<double>& values, std::size_t sample) {
  if (values.size() == 1) return values.front();
  return sample < values.size() ? values[sample] : nan;
}

}  // namespace

double Components::size() const { return std::hypot(x, y, z); }

Components components(const Scene::Vector& vector, std::size_t sample) {
  return {at(vector.x, sample), at(vector.y, sample), vector.z.empty() ? 0 : at(vector.z, sample)};
}

double value(const Scene::Moment& moment, std::size_t sample) { return at(moment.value, sample); }

double largest_moment(const Scene& scene) {
  double out = 0;
  for (const auto& moment : scene.moments)
    for (const double v : moment.value)
      if (std::isfinite(v)) out = std::max(out, std::abs(v));
  return out;
}

double arc_turn(double share) {
  return share == 0
             ? 0
             : std::copysign(full_turn / 12 + full_turn * 3 / 4 * std::min(1.0, std::abs(share)), share);
}

ArrowScale arrow_scale(const Scene& scene, Scene::Quantity quantity) {
  ArrowScale out;
  std::vector<double> sizes;  // size of the largest arrow of each sample
  for (const auto& vector : scene.vectors)
    if (vector.quantity == quantity && out.unit.empty()) out.unit = vector.unit;
  for (std::size_t i = 0; i < scene.samples(); ++i) {
    double size = 0;
    for (const auto& vector : scene.vectors) {
      if (vector.quantity != quantity) continue;
      const double v = components(vector, i).size();
      if (std::isfinite(v)) size = std::max(size, v);
    }
    if (size > 0) sizes.push_back(size);
  }
  const double size = extent(scene);
  if (sizes.empty() || !(size > 0)) return out;
  std::sort(sizes.begin(), sizes.end());
  const double reference = std::min(sizes.back(), outstanding * sizes[sizes.size() / 2]);
  out.metres_per_unit = share_of_scene * size / reference;
  out.key_value = nice_step(reference, 1);
  return out;
}

Place tip(const Scene& scene, const Scene::Vector& vector, std::size_t sample, const ArrowScale& scale) {
  const Place from = place(scene, vector.point, sample);
  const Components v = components(vector, sample);
  return {from.x + scale.metres_per_unit * v.x, from.y + scale.metres_per_unit * v.y,
          from.z + scale.metres_per_unit * v.z};
}

}  // namespace linkwright::report
