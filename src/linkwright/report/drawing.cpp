// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

// The extent of a wheel from its centre along each coordinate.
Place reach_of(const study::Scene& scene, const study::Scene::Disc& disc, std::size_t sample) {
  const Place centre = place(scene, disc.centre, sample), end = place(scene, disc.axis, sample);
  const double x = end.x - centre.x, y = end.y - centre.y, z = end.z - centre.z, length = std::hypot(x, y, z);
  const auto reach = [&](double along) {
    const double share = along / length;
    return disc.radius * std::sqrt(std::max(0.0, 1 - share * share)) + disc.width / 2 * std::abs(share);
  };
  return {reach(x), reach(y), reach(z)};
}

struct RoleName {
  std::string_view name, leg;  // the name without side and number, and the number
};

RoleName role_name(std::string_view name) {
  for (const std::string_view side : {"left ", "right "})
    if (name.starts_with(side)) name.remove_prefix(side.size());
  const std::size_t space = name.rfind(' ');
  if (space == 0 || space == std::string_view::npos || space + 1 == name.size() ||
      name.find_first_not_of("0123456789", space + 1) != std::string_view::npos)
    return {name, {}};
  return {name.substr(0, space), name.substr(space)};
}

std::size_t middle_sample(const study::Scene& scene) {
  const auto share = [](const std::vector<double>& values, std::size_t i) {
    if (values.empty()) return 0.0;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high > *low ? std::abs(values[i]) / (*high - *low) : 0.0;
  };
  std::size_t best = 0;
  double least = infinity;
  for (std::size_t i = 0; i < scene.samples(); ++i) {
    const double far =
        share(scene.input, i % scene.input.size()) + share(scene.second, i / scene.input.size());
    if (far < least && assembled(scene, i)) best = i, least = far;
  }
  return best;
}

}  // namespace

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
  for (const auto& circle : scene.circles)
    for (std::size_t i = 0; i < scene.samples(); ++i) {
      const Place centre = place(scene, circle.centre, i);
      const double r = radius(scene, circle, i);
      box.add(centre.x - r, centre.y - r);
      box.add(centre.x + r, centre.y + r);
    }
  for (const auto& disc : scene.discs)
    for (std::size_t i = 0; i < scene.samples(); ++i) {
      const Place centre = place(scene, disc.centre, i), reach = reach_of(scene, disc, i);
      box.add(centre.x - reach.x, centre.y - reach.y);
      box.add(centre.x + reach.x, centre.y + reach.y);
    }
  return box;
}

double extent(const study::Scene& scene) {
  const Box box = bounds(scene);
  if (box.empty()) return 0;
  Box height;  // in y
  if (scene.spatial()) {
    for (const auto& point : scene.points)
      for (const double z : point.z) height.add(0, z);
    for (const auto& disc : scene.discs)
      for (std::size_t i = 0; i < scene.samples(); ++i) {
        const Place centre = place(scene, disc.centre, i), reach = reach_of(scene, disc, i);
        height.add(0, centre.z - reach.z);
        height.add(0, centre.z + reach.z);
      }
  }
  return std::max({box.width(), box.height(), height.empty() ? 0 : height.height()});
}

bool Place::finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(z); }

Place place(const study::Scene& scene, int point, std::size_t sample) {
  if (point < 0 || static_cast<std::size_t>(point) >= scene.points.size()) return {nan, nan};
  const auto& p = scene.points[static_cast<std::size_t>(point)];
  const auto at = [sample](const std::vector<double>& values) {
    if (values.size() == 1) return values.front();
    return sample < values.size() ? values[sample] : nan;
  };
  return {at(p.x), at(p.y), p.z.empty() ? 0 : at(p.z)};
}

double radius(const study::Scene& scene, const study::Scene::Circle& circle, std::size_t sample) {
  const Place centre = place(scene, circle.centre, sample), rim = place(scene, circle.rim, sample);
  return std::hypot(rim.x - centre.x, rim.y - centre.y);
}

CurveLook curve_look(std::size_t curve) {
  // Okabe and Ito's colours; dashes distinguish the curves without them, and those of one colour, too.
  constexpr std::array<std::string_view, 6> colours = {"#0072B2", "#D55E00", "#009E73",
                                                       "#CC79A7", "#E69F00", "#56B4E9"};
  constexpr std::array<std::string_view, 6> dashes = {"none", "8 4", "2 3", "10 3 2 3", "5 2", "1 2"};
  return {colours[curve % colours.size()], dashes[(curve + curve / colours.size()) % dashes.size()]};
}

bool is_symbol(study::Scene::BodyStyle style) {
  using Style = study::Scene::BodyStyle;
  return style == Style::spring || style == Style::damper || style == Style::guide;
}

std::vector<std::vector<Place>> symbol_lines(study::Scene::BodyStyle style, const Place& a, const Place& b,
                                             double width) {
  using Style = study::Scene::BodyStyle;
  const std::complex<double> from(a.x, a.y), way = std::complex<double>(b.x, b.y) - from;
  const double length = std::abs(way);
  if (!is_symbol(style) || !(length > 0) || !std::isfinite(length)) return {};
  const std::complex<double> along = way / length;
  const auto at = [&](double share, double across) {
    const std::complex<double> p = from + share * way + std::complex<double>(0, across * width) * along;
    return Place{p.real(), p.imag()};
  };
  if (style == Style::spring) {
    constexpr int strokes = 12;  // half coils
    constexpr double lead = 0.12;
    std::vector<Place> line = {at(0, 0), at(lead, 0)};
    for (int i = 0; i < strokes; ++i)
      line.push_back(at(lead + (1 - 2 * lead) * (i + 0.5) / strokes, i % 2 == 0 ? 0.5 : -0.5));
    line.insert(line.end(), {at(1 - lead, 0), at(1, 0)});
    return {line};
  }
  if (style == Style::damper)
    return {{at(0, 0), at(0.35, 0)},
            {at(0.7, -0.5), at(0.35, -0.5), at(0.35, 0.5), at(0.7, 0.5)},
            {at(0.55, -0.35), at(0.55, 0.35)},
            {at(0.55, 0), at(1, 0)}};
  std::vector<std::vector<Place>> lines = {{at(0, 0), at(1, 0)}};
  const int marks = static_cast<int>(std::clamp(length / width, 2.0, 60.0));
  for (int i = 1; i <= marks; ++i) {
    const double share = static_cast<double>(i) / marks;
    lines.push_back({at(share, 0), at(share - std::min(0.7 * width / length, share), -0.7)});
  }
  return lines;
}

bool assembled(const study::Scene& scene, std::size_t sample) {
  if (sample < scene.status.size() && scene.status[sample] != "done") return false;
  // A mark such as a roll centre or a gap may be without a place while the mechanism has a position.
  if (!scene.status.empty()) return true;
  for (int i = 0; i < static_cast<int>(scene.points.size()); ++i)
    if (!place(scene, i, sample).finite()) return false;
  return true;
}

std::size_t reference_sample(const study::Scene& scene) {
  if (scene.spatial() || !scene.second.empty()) return middle_sample(scene);
  for (std::size_t i = 0; i < scene.samples(); ++i)
    if (assembled(scene, i)) return i;
  return 0;
}

std::vector<Place> simplified(const std::vector<Place>& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size());
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, line.size() - 1}};
  while (!parts.empty()) {
    const auto [from, to] = parts.back();
    parts.pop_back();
    const std::complex<double> start(line[from].x, line[from].y);
    const std::complex<double> way = std::complex<double>(line[to].x, line[to].y) - start;
    std::size_t farthest = from;
    double most = tolerance;
    for (std::size_t i = from + 1; i < to; ++i) {
      // Seen from the start, along and across the path; without a path all is across.
      const std::complex<double> p = std::complex<double>(line[i].x, line[i].y) - start;
      const double length = std::abs(way);
      const std::complex<double> seen = length > 0 ? p * std::conj(way) / length : p;
      const double beyond = std::max({0.0, -seen.real(), seen.real() - length});
      const double off = length > 0 ? std::hypot(seen.imag(), beyond) : std::abs(p);
      if (off > most) most = off, farthest = i;
    }
    if (farthest == from) continue;
    kept[farthest] = true;
    parts.emplace_back(from, farthest);
    parts.emplace_back(farthest, to);
  }
  std::vector<Place> out;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) out.push_back(line[i]);
  return out;
}

double nice_step(double span, double divisions) {
  const double raw = span / divisions;
  if (!(raw > 0) || !std::isfinite(raw)) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / decade;
  return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * decade;
}

double degree_step(double span, double divisions) {
  constexpr std::array steps{10.,  15.,   30.,   45.,   90.,    180.,   360.,
                             720., 1800., 3600., 7200., 18000., 36000., 72000.};
  const double least = span / divisions * (1 - 1e-12);
  if (!(least > 5) || least > steps.back())
    return nice_step(span, divisions) < least ? nice_step(2.5 * span, divisions) : nice_step(span, divisions);
  return *std::lower_bound(steps.begin(), steps.end(), least);
}

std::vector<double> ticks(double low, double high, double step) {
  constexpr int most = 40;
  std::vector<double> out;
  const double first = std::ceil(low / step);
  for (int k = 0; k < most; ++k) {
    const double i = first + k;
    if (!(i * step <= high)) break;
    out.push_back(i == 0 ? 0 : i * step);
  }
  return out;
}

std::vector<std::size_t> role_numbers(const study::Scene& scene) {
  std::vector<RoleName> names;
  for (const auto& body : scene.bodies) names.push_back(role_name(body.name));
  std::map<std::string, std::size_t> known;
  std::size_t used = 0;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    using Style = study::Scene::BodyStyle;
    const Style style = scene.bodies[i].style;
    if (style == Style::ground || style == Style::axis || style == Style::gap || is_symbol(style)) {
      out.push_back(0);
      continue;
    }
    const bool of_leg =
        !names[i].leg.empty() && std::any_of(names.begin(), names.end(), [&](const RoleName& n) {
          return n.leg == names[i].leg && n.name != names[i].name;
        });
    const std::string role = std::string(names[i].name) + (of_leg ? "" : std::string(names[i].leg));
    const auto before = role.empty() ? known.end() : known.find(role);
    out.push_back(before != known.end() ? before->second : used++);
    known.emplace(role, out.back());
  }
  return out;
}

LengthUnit length_unit(double size) {
  if (size < 1) return {1000, "mm"};
  return {1, "m"};
}

std::optional<LengthUnit> chosen_length(const study::DisplayUnits& units) {
  if (!units.chosen(Dimension::length)) return {};
  const Unit& unit = units.of(Dimension::length);
  return LengthUnit{unit.from_si(1), std::string(unit.suffix)};
}

study::Extreme worst(const study::Scene::Target& target) {
  study::Extreme result;
  const std::size_t n =
      std::min({target.x.size(), target.y.size(), target.achieved_x.size(), target.achieved_y.size()});
  for (std::size_t i = 0; i < n; ++i)
    result.greatest(std::hypot(target.achieved_x[i] - target.x[i], target.achieved_y[i] - target.y[i]), i);
  return result;
}

}  // namespace linkwright::report
