// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/structure.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "linkwright/math/dense.h"

namespace linkwright::suspension {
namespace {

constexpr std::array order{LinkType::R,  LinkType::RR, LinkType::S, LinkType::RS,
                           LinkType::SR, LinkType::SP, LinkType::US};

/// Below this (metres a radian) a singular value is rounding.
constexpr double no_rank = 1e-9;

std::string allowed() {
  std::string out;
  for (const auto& entry : names(LinkType{})) out += (out.empty() ? "" : ", ") + std::string(entry.name);
  return out;
}

/// The motion of the carrier in words: "turning about y", "turning about x with the wheel centre moving along
/// y".
std::string in_words(const Vec3& shift, const Vec3& turn, double radius) {
  const auto largest = [](const Vec3& a) {
    const std::array<double, 3> size{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
    return "xyz"[std::max_element(size.begin(), size.end()) - size.begin()];
  };
  if (norm(turn) < 1e-3 * norm(shift) / radius) return fmt::format("moving along {}", largest(shift));
  std::string out = fmt::format("turning about {}", largest(turn));
  if (norm(shift) > 0.3 * radius * norm(turn))
    out += fmt::format(" with the wheel centre moving along {}", largest(shift));
  return out;
}

std::string count_of(const Structure& structure, int couplers) {
  std::string out;
  for (LinkType type : order) {
    const auto count = std::count_if(structure.begin(), structure.end(), [&](LinkType of) {
      return of == type || (type == LinkType::US && of == LinkType::SS);
    });
    if (count > 0)
      out += fmt::format("{}{} {}: {}", out.empty() ? "" : ", ", count, name_of(type),
                         count * constraints(type));
  }
  if (couplers > 0) out += fmt::format(", {} couplers: {}", couplers, couplers);
  return out;
}

/// The line that a joint or a link represents.
struct GeometricLine {
  std::string name;
  Vec3 at, along;  ///< unit
};

double off(const GeometricLine& line, const Vec3& point) { return norm(cross(point - line.at, line.along)); }

/// The reason why links do not constrain the carrier as their count would, as far as their points show it:
/// points, lines or planes that coincide within `near` (m). Empty if none is found.
std::string geometric_cause(const Suspension& suspension, double near) {
  struct BallJoint {
    std::string name;
    Vec3 at;
  };
  std::vector<BallJoint> joints;
  std::vector<GeometricLine> hinges, rods;
  std::vector<std::pair<std::string, std::vector<Vec3>>> links;
  const auto line = [](const std::string& name, const Vec3& from, const Vec3& to) {
    return GeometricLine{name, from, unit(to - from)};
  };
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    const CornerLink& link = suspension.links[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("'{}'", link_label(suspension, i));
    // The ball joint that the carrier turns about: that of an SR link or a strut is at the body.
    if (link.type == LinkType::S)
      joints.push_back({name, link.body[0]});
    else if (link.carrier.size() == 1 && link.type != LinkType::SP)
      joints.push_back({name, link.carrier[0]});
    if (link.body.size() == 2) hinges.push_back(line(name, link.body[0], link.body[1]));
    if (link.carrier.size() == 2) hinges.push_back(line(name, link.carrier[0], link.carrier[1]));
    if (link.type == LinkType::US || link.type == LinkType::SS)
      rods.push_back(line(name, link.body[0], link.carrier[0]));
    if (link.type == LinkType::US || link.type == LinkType::SS || link.type == LinkType::RS ||
        link.type == LinkType::SR) {
      std::vector<Vec3> points = link.body;
      points.insert(points.end(), link.carrier.begin(), link.carrier.end());
      links.emplace_back(name, std::move(points));
    }
  }
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = i + 1; j < joints.size(); ++j)
      if (norm(joints[i].at - joints[j].at) < near)
        return fmt::format("the ball joints of {} and {} at the carrier are in one place", joints[i].name,
                           joints[j].name);
  const auto in_line = [&](const std::vector<GeometricLine>& lines, const char* what) -> std::string {
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = i + 1; j < lines.size(); ++j)
        if (lines[i].name != lines[j].name && off(lines[i], lines[j].at) < near &&
            norm(cross(lines[i].along, lines[j].along)) < poor_rank)
          return fmt::format("the {} of {} and {} lie in one line", what, lines[i].name, lines[j].name);
    return {};
  };
  if (const std::string found = in_line(rods, "rods"); !found.empty()) return found;
  if (const std::string found = in_line(hinges, "hinges"); !found.empty()) return found;
  // Ball joints of all links in one line let the carrier turn about it.
  if (joints.size() >= 3 && joints.size() == suspension.links.size()) {
    const GeometricLine through = line({}, joints[0].at, joints[1].at);
    if (std::all_of(joints.begin(), joints.end(),
                    [&](const BallJoint& j) { return off(through, j.at) < near; }))
      return "the ball joints of all links at the carrier lie in one line";
  }
  // Three links in a plane.
  for (std::size_t i = 0; i < links.size(); ++i)
    for (std::size_t j = i + 1; j < links.size(); ++j) {
      std::vector<Vec3> points = links[i].second;
      points.insert(points.end(), links[j].second.begin(), links[j].second.end());
      Vec3 normal;
      for (std::size_t a = 1; a < points.size(); ++a)
        for (std::size_t b = a + 1; b < points.size(); ++b)
          if (const Vec3 n = cross(points[a] - points[0], points[b] - points[0]); norm(n) > norm(normal))
            normal = n;
      if (!(norm(normal) > near * near)) continue;
      const auto in_plane = [&](const std::vector<Vec3>& of) {
        return std::all_of(of.begin(), of.end(),
                           [&](const Vec3& p) { return std::abs(dot(unit(normal), p - points[0])) < near; });
      };
      if (!in_plane(points)) continue;
      std::string all = links[i].first + ", " + links[j].first;
      int count = 2;
      for (std::size_t k = j + 1; k < links.size(); ++k)
        if (in_plane(links[k].second)) all += ", " + links[k].first, ++count;
      if (count >= 3) return fmt::format("the links {} lie in one plane", all);
    }
  return {};
}

void check_rank(const Suspension& suspension, Diagnostics& found) {
  const WeakMotion weakest = weakest_motion(prepare_suspension(suspension),
                                            {{suspension.wheel.centre, {}}, 0}, 0, Driver::wheel_centre_z);
  const double least = weakest.singular_value;
  if (least >= poor_rank) return;
  const std::string motion = in_words(weakest.shift, weakest.turn, suspension.wheel.tyre_diameter / 2);
  Diagnostic& out = found.emplace_back();
  out.key = "links";
  const std::string cause = geometric_cause(suspension, poor_rank * suspension.wheel.tyre_diameter / 2);
  out.hint = cause.empty() ? "turn or move a link so that it resists this motion"
                           : "set them apart, so that one of them resists this motion";
  const std::string because = cause.empty() ? std::string() : cause + ": ";
  if (least < no_rank) {
    out.message = fmt::format(
        "{}the count is right, yet the links do not constrain the carrier when the height of the wheel "
        "centre is fixed: {}",
        because, motion);
  } else {
    out.severity = Diagnostic::Severity::warning;
    out.message = fmt::format(
        "{}the links hardly constrain the carrier when the height of the wheel centre is fixed: {} (smallest "
        "singular value {:.2g}, good ones are above {})",
        because, motion, least, poor_rank);
  }
}

}  // namespace

ParsedStructure parse_structure(std::string_view name) {
  ParsedStructure out;
  const auto fail = [&](std::string problem) { return ParsedStructure{{}, std::move(problem)}; };
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('-', at), name.size());
    const std::string_view part = name.substr(at, end - at);
    const bool counted = !part.empty() && part[0] >= '0' && part[0] <= '9';
    const std::string_view word = part.substr(counted ? 1 : 0);
    const int count = counted ? part[0] - '0' : 1;
    if (part.empty())
      return fail(fmt::format("'{}' has nothing between its '-': write link types such as SR-3US", name));
    const auto known = names(LinkType{});
    const auto entry =
        std::find_if(known.begin(), known.end(), [&](const auto& of) { return of.name == word; });
    if (entry == known.end())
      return fail(fmt::format("'{}' in '{}' is not a link type; there are {}", word, name, allowed()));
    if (count < 1 || count > 5)
      return fail(fmt::format("'{}' in '{}': a count lies between 1 and 5", part, name));
    out.structure.insert(out.structure.end(), count, entry->value);
    at = end + 1;
  }
  return out;
}

std::string structure_name(const Structure& structure) {
  std::string out;
  for (LinkType type : order) {
    const auto count = std::count_if(structure.begin(), structure.end(), [&](LinkType of) {
      return of == type || (type == LinkType::US && of == LinkType::SS);
    });
    if (count == 0) continue;
    if (!out.empty()) out += '-';
    if (count > 1) out += std::to_string(count);
    out += name_of(type);
  }
  return out;
}

Structure structure_of(const Suspension& suspension) {
  Structure out;
  for (const CornerLink& link : suspension.links) out.push_back(link.type);
  return out;
}

int constraints(LinkType type) {
  switch (type) {
    case LinkType::R:
      return 5;
    case LinkType::RR:
      return 4;
    case LinkType::S:
      return 3;
    case LinkType::RS:
    case LinkType::SR:
    case LinkType::SP:
      return 2;
    case LinkType::US:
    case LinkType::SS:
      return 1;
  }
  return 0;
}

int design_parameters(LinkType type) {
  switch (type) {
    case LinkType::R:
      return 4;
    case LinkType::RR:
      return 8;
    case LinkType::S:
      return 3;
    case LinkType::RS:
    case LinkType::SR:
      return 7;
    case LinkType::SP:
      return 5;
    case LinkType::US:
    case LinkType::SS:
      return 6;
  }
  return 0;
}

WeakMotion weakest_motion(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver) {
  CornerEquations equations;
  evaluate(plan, place, rack, driver, 0, equations);
  const double radius = plan.wheel.tyre_diameter / 2;
  const auto n = static_cast<std::size_t>(plan.unknowns);
  std::vector<double> scaled;
  for (int j = 0; j < plan.unknowns; ++j)
    for (int i = 0; i < plan.unknowns; ++i) scaled.push_back(equations.jacobian[i][j] / (j < 3 ? 1 : radius));
  const math::SingularVectors svd = math::singular_vectors(scaled, n);
  const double* free = &svd.right[(n - 1) * n];
  return {
      svd.values.back(), {free[0], free[1], free[2]}, {free[3] / radius, free[4] / radius, free[5] / radius}};
}

int mobility(const Structure& structure, int couplers) {
  int out = 6 - couplers;
  for (LinkType type : structure) out -= constraints(type);
  return out;
}

std::vector<Structure> basic_structures() {
  std::vector<Structure> out;
  const auto add = [&](auto& self, std::size_t from, int left, const Structure& chosen) -> void {
    if (left == 0) out.push_back(chosen);
    for (std::size_t i = from; i < order.size(); ++i) {
      const LinkType type = order[i];
      const auto has = [&](LinkType of) { return std::count(chosen.begin(), chosen.end(), of) > 0; };
      if (constraints(type) > left || (type == LinkType::SP && has(LinkType::SP)) ||
          (constraints(type) == 2 && has(LinkType::S)))
        continue;
      Structure with = chosen;
      with.push_back(type);
      self(self, i, left - constraints(type), with);
    }
  };
  add(add, 0, 5, {});
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return out;
}

Diagnostics check_structure(const Suspension& suspension) {
  Diagnostics found = check(suspension);
  if (has_errors(found)) return found;
  const Structure structure = structure_of(suspension);
  const int couplers = static_cast<int>(suspension.couplers.size()), freedoms = mobility(structure, couplers);
  if (freedoms != 1) {
    const int held = 6 - freedoms;
    Diagnostic& out = found.emplace_back();
    out.key = "links";
    out.message = fmt::format(
        "the links constrain {} of the carrier's 6 degrees of freedom ({}), 5 must be constrained", held,
        structure.empty() ? "there are none" : count_of(structure, couplers));
    out.hint = held < 5 ? fmt::format("the wheel would have {} degrees of freedom: add links", freedoms)
                        : "redundant links need elastic joints: rigid ones would lock, or close for special "
                          "dimensions only";
    return found;
  }
  check_rank(suspension, found);
  return found;
}

}  // namespace linkwright::suspension
