#include "linkwright/report/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkwright::report {

void Box::add(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  if (empty()) {
    x_min = x_max = x;
    y_min = y_max = y;
    return;
  }
  x_min = std::min(x_min, x);
  x_max = std::max(x_max, x);
  y_min = std::min(y_min, y);
  y_max = std::max(y_max, y);
}

Box bounds(const study::Scene& scene) {
  Box box;
  const auto add_all = [&box](const std::vector<double>& x, const std::vector<double>& y) {
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) box.add(x[i], y[i]);
  };
  for (const auto& point : scene.points) add_all(point.x, point.y);
  for (const auto& target : scene.targets) {
    add_all(target.x, target.y);
    add_all(target.achieved_x, target.achieved_y);
  }
  return box;
}

bool Place::finite() const { return std::isfinite(x) && std::isfinite(y); }

Place place(const study::Scene& scene, int point, std::size_t sample) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (point < 0 || static_cast<std::size_t>(point) >= scene.points.size()) return {nan, nan};
  const auto& p = scene.points[static_cast<std::size_t>(point)];
  const auto at = [sample](const std::vector<double>& values) {
    if (values.size() == 1) return values.front();
    return sample < values.size() ? values[sample] : nan;
  };
  return {at(p.x), at(p.y)};
}

bool assembled(const study::Scene& scene, std::size_t sample) {
  if (sample < scene.status.size() && scene.status[sample] != "done") return false;
  for (int i = 0; i < static_cast<int>(scene.points.size()); ++i)
    if (!place(scene, i, sample).finite()) return false;
  return true;
}

std::size_t reference_sample(const study::Scene& scene) {
  for (std::size_t i = 0; i < scene.samples(); ++i)
    if (assembled(scene, i)) return i;
  return 0;
}

double nice_step(double span, double divisions) {
  const double raw = span / divisions;
  if (!(raw > 0) || !std::isfinite(raw)) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / decade;
  return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * decade;
}

LengthUnit length_unit(double size) {
  if (size < 1) return {1000, "mm"};
  return {1, "m"};
}

Worst worst(const study::Scene::Target& target) {
  Worst result;
  const std::size_t n =
      std::min({target.x.size(), target.y.size(), target.achieved_x.size(), target.achieved_y.size()});
  for (std::size_t i = 0; i < n; ++i) {
    const double distance =
        std::hypot(target.achieved_x[i] - target.x[i], target.achieved_y[i] - target.y[i]);
    if (distance > result.distance) result = {i, distance};
  }
  return result;
}

}  // namespace linkwright::report
