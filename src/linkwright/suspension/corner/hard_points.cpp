// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/hard_points.h"

#include <fmt/core.h>

#include <array>
#include <cctype>

namespace linkwright::suspension {
namespace {

/// Axis of the vehicle (0 x, 1 y, 2 z) and its sign.
struct Along {
  int axis;
  double sign;
};
Along along(Direction direction) {
  switch (direction) {
    case Direction::forward:
      return {0, 1};
    case Direction::rearward:
      return {0, -1};
    case Direction::left:
      return {1, 1};
    case Direction::right:
      return {1, -1};
    case Direction::up:
      return {2, 1};
    case Direction::down:
      break;
  }
  return {2, -1};
}

}  // namespace

std::string problem(const PointFrame& frame) {
  constexpr std::array<std::string_view, 3> lines{"forward and rearward", "left and right", "up and down"};
  const std::array<std::pair<char, Along>, 3> all{
      {{'x', along(frame.x)}, {'y', along(frame.y)}, {'z', along(frame.z)}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      if (all[i].second.axis == all[j].second.axis)
        return fmt::format("{} and {} both lie along {}", all[i].first, all[j].first,
                           lines[static_cast<std::size_t>(all[i].second.axis)]);
  return {};
}

Vec3 to_vehicle(const PointFrame& frame, const Vec3& at) {
  std::array<double, 3> out{frame.origin.x, frame.origin.y, frame.origin.z};
  const auto add = [&](Direction direction, double value) {
    const auto [axis, sign] = along(direction);
    out[static_cast<std::size_t>(axis)] += sign * value;
  };
  add(frame.x, at.x);
  add(frame.y, at.y);
  add(frame.z, at.z);
  return {out[0], out[1], out[2]};
}

Vec3 from_vehicle(const PointFrame& frame, const Vec3& at) {
  const Vec3 d = at - frame.origin;
  const std::array<double, 3> from{d.x, d.y, d.z};
  const auto take = [&](Direction direction) {
    const auto [axis, sign] = along(direction);
    return sign * from[static_cast<std::size_t>(axis)];
  };
  return {take(frame.x), take(frame.y), take(frame.z)};
}

std::vector<HardPoint> points_of(const Suspension& suspension) {
  std::vector<HardPoint> out;
  const auto add = [&](const std::string& link, std::string_view end, const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      out.push_back({plain_name(fmt::format("{} {}{}", link, end,
                                            points.size() > 1 ? fmt::format(" {}", i + 1) : std::string())),
                     points[i]});
  };
  for (std::size_t i = 0; i < suspension.links.size(); ++i) {
    const std::string name = link_label(suspension, static_cast<int>(i));
    add(name, "body", suspension.links[i].body);
    add(name, "carrier", suspension.links[i].carrier);
  }
  for (std::size_t i = 0; i < suspension.couplers.size(); ++i) {
    const std::string& name = suspension.couplers[i].name;
    add(name.empty() ? fmt::format("coupler {}", i + 1) : name, "point", {suspension.couplers[i].point});
    if (suspension.couplers[i].begin)
      add(name.empty() ? fmt::format("coupler {}", i + 1) : name, "first point",
          {*suspension.couplers[i].begin});
  }
  for (std::size_t i = 0; i < suspension.rockers.size(); ++i) {
    const Rocker& rocker = suspension.rockers[i];
    const std::string name = rocker_label(suspension, static_cast<int>(i));
    add(name, "axis", {rocker.axis[0], rocker.axis[1]});
    add(name, "rod", {rocker.driven_by.at, rocker.rod});
  }
  for (const CornerElement& element : suspension.elements)
    if (element.across)
      add(element.name, "moving", {element.second.at});
    else if (!element.turn)
      add(element.name, "end", {element.first.at, element.second.at});
  if (suspension.spring) {
    add("spring", "body", {suspension.spring->body});
    add("spring", "moving", {suspension.spring->moving});
  }
  add("wheel", "centre", {suspension.wheel.centre});
  return out;
}

std::string plain_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter))
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

Table hard_point_table(const std::vector<HardPoint>& points) {
  Table table{.name = "hard_points"};
  table.add("x_m", "x (m)");
  table.add("y_m", "y (m)");
  table.add("z_m", "z (m)");
  for (const HardPoint& point : points) {
    table.names.push_back(point.name);
    table.columns[0].values.push_back(point.at.x);
    table.columns[1].values.push_back(point.at.y);
    table.columns[2].values.push_back(point.at.z);
  }
  return table;
}

}  // namespace linkwright::suspension
