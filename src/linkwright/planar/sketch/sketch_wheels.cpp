// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "linkwright/planar/sketch/detail/sketch_draft.h"

namespace linkwright::planar::sketching {
namespace {

/// Two wheels whose circles touch, by their indices.
struct MeshingWheels {
  std::size_t first = 0, second = 0;
  bool internal = false;
};

/// The bodies that have points at both nodes.
std::vector<std::size_t> carriers(const SketchDraft& d, std::size_t first, std::size_t second) {
  std::vector<std::size_t> out;
  for (const std::size_t body : d.members[first])
    if (d.has(second, body)) out.push_back(body);
  return out;
}

std::vector<MeshingWheels> meshing_wheels(SketchDraft& d) {
  std::vector<MeshingWheels> out;
  std::vector<bool> meshes(d.wheels.size());
  for (std::size_t i = 0; i < d.wheels.size(); ++i)
    for (std::size_t k = i + 1; k < d.wheels.size(); ++k) {
      const DrawnWheel &a = d.wheels[i], &b = d.wheels[k];
      const double apart = std::abs(a.centre - b.centre);
      const double outside = std::abs(apart - a.radius - b.radius);
      const double inside = std::abs(apart - std::abs(a.radius - b.radius));
      if (a.node == b.node || std::min(outside, inside) > 10 * d.tolerance) continue;
      const std::string where =
          fmt::format("the wheels around {} and {}", shown_place(a.centre), shown_place(b.centre));
      meshes[i] = meshes[k] = true;
      if (carriers(d, a.node, b.node).empty()) {
        d.out.left_out.push_back(where + " touch, but no link or ground has points at both centres");
        continue;
      }
      if (std::min(outside, inside) > d.tolerance)
        d.out.questions.push_back({fmt::format("{} miss each other by {:.3g} mm: do they mesh?", where,
                                               std::min(outside, inside) * 1000),
                                   "they do"});
      out.push_back({i, k, inside < outside});
    }
  for (std::size_t i = 0; i < d.wheels.size(); ++i)
    if (!meshes[i])
      d.out.left_out.push_back(fmt::format("the wheel around {} touches no other wheel, and is left out",
                                           shown_place(d.wheels[i].centre)));
  return out;
}

/// The body that turns with a wheel which others carry: on a layer such as "gear ground" the ground, with
/// wheels about one point on one layer of their own the same body, else the bar or plate at its centre.
std::size_t body_of_wheel(SketchDraft& d, std::vector<DrawnWheel>& wheels, std::size_t index,
                          const std::set<std::size_t>& carrying) {
  const DrawnWheel& wheel = wheels[index];
  if (wheel.layer.find("ground") != std::string::npos) return d.ground();
  for (std::size_t i = 0; i < index; ++i)
    if (wheels[i].node == wheel.node && wheels[i].layer == wheel.layer &&
        wheel.layer.size() > std::string_view("gear").size())
      return wheels[i].body;
  std::vector<std::size_t> at;
  for (const std::size_t body : d.members[wheel.node])
    if (carrying.count(body) == 0 &&
        (d.out.bodies[body].type == SketchBodyType::bar || d.out.bodies[body].type == SketchBodyType::plate))
      at.push_back(body);
  if (at.size() > 1)
    d.out.questions.push_back({fmt::format("{} links meet at the centre {} of a wheel: which turns with it?",
                                           at.size(), shown_place(wheel.centre)),
                               "the first by its place"});
  return at.empty() ? d.add_body(SketchBodyType::wheel, {}) : at.front();
}

void give_body(SketchDraft& d, std::vector<DrawnWheel>& wheels, std::size_t index,
               const std::set<std::size_t>& carrying) {
  wheels[index].body = body_of_wheel(d, wheels, index, carrying);
  d.join(wheels[index].body, wheels[index].node);
}

/// Sorts wheels by their places, so that the order of the drawing does not matter, and finds their nodes.
void order_wheels(const SketchDraft& d, std::vector<DrawnWheel>& wheels) {
  std::sort(wheels.begin(), wheels.end(), [](const DrawnWheel& a, const DrawnWheel& b) {
    return std::tuple(a.centre.real(), a.centre.imag(), a.radius) <
           std::tuple(b.centre.real(), b.centre.imag(), b.radius);
  });
  for (DrawnWheel& wheel : wheels) wheel.node = d.nodes.at(wheel.centre);
}

/// A strand between two pulleys, from the place where it leaves the first.
struct DrawnStrand {
  std::size_t first = 0, second = 0;
  Place from, to;
};

/// The pulley that a line touches with its end.
std::optional<std::size_t> touched(const SketchDraft& d, Place end, Place along) {
  for (std::size_t i = 0; i < d.pulleys.size(); ++i) {
    const DrawnWheel& pulley = d.pulleys[i];
    const Place out = end - pulley.centre;
    const double off = std::abs(std::abs(out) - pulley.radius),
                 askew = std::abs(std::real(std::conj(along) * out)) / std::abs(along);
    if (off <= 10 * d.tolerance && askew <= 10 * d.tolerance) return i;
  }
  return std::nullopt;
}

std::vector<DrawnStrand> strands_of(SketchDraft& d) {
  std::vector<DrawnStrand> out;
  for (const Segment& line : d.strands) {
    const Place along = line.to - line.from;
    const auto first = touched(d, line.from, along), second = touched(d, line.to, along);
    if (first && second && *first != *second)
      out.push_back({*first, *second, line.from, line.to});
    else
      d.out.left_out.push_back(
          fmt::format("the line from {} to {} on the layer belt does not touch two circles",
                      shown_place(line.from), shown_place(line.to)));
  }
  return out;
}

/// A ring of strands from one pulley on, each turned as the belt runs. Empty where it does not close.
std::vector<DrawnStrand> ring_from(std::size_t start, const std::vector<DrawnStrand>& strands) {
  std::vector<DrawnStrand> out;
  std::vector<bool> used(strands.size());
  for (std::size_t at = start; out.empty() || at != start;) {
    std::size_t next = 0;
    while (next < strands.size() && (used[next] || (strands[next].first != at && strands[next].second != at)))
      ++next;
    if (next == strands.size()) return {};
    used[next] = true;
    DrawnStrand strand = strands[next];
    if (strand.first != at) strand = {strand.second, strand.first, strand.to, strand.from};
    out.push_back(strand);
    at = strand.second;
  }
  return out;
}

/// True if the pulley that a strand leaves lies to the left of the running belt.
bool is_left(const SketchDraft& d, const DrawnStrand& strand) {
  return std::imag(std::conj(strand.to - strand.from) * (d.pulleys[strand.first].centre - strand.from)) > 0;
}

void add_belt(SketchDraft& d, std::vector<DrawnStrand> ring) {
  const auto left =
      std::count_if(ring.begin(), ring.end(), [&](const DrawnStrand& s) { return is_left(d, s); });
  std::vector<std::pair<std::size_t, bool>> pulleys;  // and whether it lies to the left
  for (const DrawnStrand& strand : ring) pulleys.emplace_back(strand.first, is_left(d, strand));
  // Most pulleys lie within the belt, to the left of it as it runs.
  if (2 * left < static_cast<std::ptrdiff_t>(ring.size())) {
    std::reverse(pulleys.begin(), pulleys.end());
    for (auto& [pulley, side] : pulleys) side = !side;
  }
  // A ground that is made later would renumber the bodies that carry.
  if (std::any_of(pulleys.begin(), pulleys.end(), [&](const auto& p) {
        return d.pulleys[p.first].layer.find("ground") != std::string::npos;
      }))
    d.ground();
  std::set<std::size_t> carrying;
  for (std::size_t body = 0; body < d.out.bodies.size(); ++body)
    if (std::all_of(pulleys.begin(), pulleys.end(),
                    [&](const auto& p) { return d.has(d.pulleys[p.first].node, body); }))
      carrying.insert(body);
  if (carrying.empty()) {
    d.out.left_out.push_back(fmt::format(
        "no link or ground has points at all centres of the belt around {}; add the belt to the study",
        shown_place(d.pulleys[pulleys[0].first].centre)));
    return;
  }
  std::vector<std::size_t> order;
  for (const auto& [pulley, side] : pulleys) order.push_back(pulley);
  std::sort(order.begin(), order.end());
  for (const std::size_t pulley : order) give_body(d, d.pulleys, pulley, carrying);
  SketchBelt belt;
  for (const auto& [pulley, side] : pulleys) {
    const DrawnWheel& p = d.pulleys[pulley];
    belt.pulleys.push_back({p.body, p.node, p.radius, !side});
  }
  d.out.belts.push_back(std::move(belt));
}

}  // namespace

std::size_t SketchDraft::add_body(SketchBodyType type, std::vector<Segment> edges_of_body) {
  out.bodies.push_back({type, {}, {}});
  edges.push_back(std::move(edges_of_body));
  return out.bodies.size() - 1;
}

void SketchDraft::join(std::size_t body, std::size_t node) {
  auto& here = members[node];
  if (std::find(here.begin(), here.end(), body) == here.end()) here.push_back(body);
}
bool SketchDraft::has(std::size_t node, std::size_t body) const {
  const auto& here = members[node];
  return std::find(here.begin(), here.end(), body) != here.end();
}

std::size_t SketchDraft::ground() {
  if (out.bodies.empty() || out.bodies[0].type != SketchBodyType::ground) {
    // The ground is the first body: all others move up by one.
    out.bodies.insert(out.bodies.begin(), {SketchBodyType::ground, {}, {}});
    edges.insert(edges.begin(), std::vector<Segment>{});
    for (auto& here : members)
      for (std::size_t& body : here) ++body;
    for (auto* of_points : {&slide_owners, &welded})
      for (auto& [node, bodies] : *of_points)
        for (std::size_t& body : bodies) ++body;
    for (auto* joints : {&out.joints, &welds})
      for (SketchJoint& joint : *joints) ++joint.first, ++joint.second;
    for (auto* list : {&wheels, &pulleys})
      for (DrawnWheel& wheel : *list) ++wheel.body;
    for (SketchGear& gear : out.gears)
      for (std::size_t& body : gear.bodies) ++body;
    for (SketchBelt& belt : out.belts)
      for (SketchPulley& pulley : belt.pulleys) ++pulley.body;
  }
  return 0;
}

void add_gears(SketchDraft& d) {
  order_wheels(d, d.wheels);
  const std::vector<MeshingWheels> pairs = meshing_wheels(d);
  for (std::size_t i = 0; i < d.wheels.size(); ++i) {
    std::set<std::size_t> carrying;
    for (const MeshingWheels& pair : pairs) {
      if (pair.first != i && pair.second != i) continue;
      for (const std::size_t body : carriers(d, d.wheels[pair.first].node, d.wheels[pair.second].node))
        carrying.insert(body);
    }
    if (!carrying.empty()) give_body(d, d.wheels, i, carrying);
  }
  for (const auto& [first, second, internal] : pairs) {
    const DrawnWheel &a = d.wheels[first], &b = d.wheels[second];
    if (a.body != b.body)
      d.out.gears.push_back({{},
                             {a.body, b.body},
                             {a.node, b.node},
                             {a.radius, b.radius},
                             (internal ? 1 : -1) * a.radius / b.radius});
  }
}

void add_belts(SketchDraft& d) {
  order_wheels(d, d.pulleys);
  const std::vector<DrawnStrand> strands = strands_of(d);
  std::vector<int> ends(d.pulleys.size());
  for (const DrawnStrand& strand : strands) ++ends[strand.first], ++ends[strand.second];
  std::vector<bool> done(d.pulleys.size());
  for (std::size_t i = 0; i < d.pulleys.size(); ++i) {
    if (done[i]) continue;
    std::vector<DrawnStrand> ring = ends[i] == 2 ? ring_from(i, strands) : std::vector<DrawnStrand>();
    bool is_ring = !ring.empty();
    for (const DrawnStrand& strand : ring)
      done[strand.first] = true, is_ring = is_ring && ends[strand.first] == 2;
    if (is_ring)
      add_belt(d, std::move(ring));
    else
      d.out.left_out.push_back(fmt::format("no closed belt runs around {}; add a rope to the study",
                                           shown_place(d.pulleys[i].centre)));
  }
}

}  // namespace linkwright::planar::sketching
