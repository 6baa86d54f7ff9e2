// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/sketch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/embedding.h"

namespace linkwright::planar {
namespace {

using Point = math::Vec2;
using Side = std::array<int, 2>;  // two joints of a link, neighbours around it

double length(const Point& a) { return std::hypot(a.x, a.y); }
double turn_of(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

bool cross_each_other(const Point& a, const Point& b, const Point& c, const Point& d) {
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

double square(const Point& a) { return dot(a, a); }
// The square of the distance from a point to a side.
double square_to_side(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double share = std::clamp(dot(p - a, along) / square(along), 0.0, 1.0);
  return square(p - a - share * along);
}

int joint_of(const ChainGraph& graph, int a, int b) {
  const std::vector<JointEnds> joints = joints_of(graph);
  const JointEnds ends{std::min(a, b), std::max(a, b)};
  return static_cast<int>(std::lower_bound(joints.begin(), joints.end(), ends) - joints.begin());
}

std::vector<int> joints_around(const ChainGraph& graph, const LinkCycle& cycle) {
  std::vector<int> out;
  for (std::size_t k = 0; k < cycle.size(); ++k)
    out.push_back(joint_of(graph, cycle[k], cycle[(k + 1) % cycle.size()]));
  return out;
}

// The joints of each link counter-clockwise, from the links before and after it in the meshes. On the border
// the first joint is that to the next link of the border.
std::vector<std::vector<int>> joints_of_links(const ChainGraph& graph, const ChainEmbedding& drawn) {
  const std::size_t joints = joints_of(graph).size();
  std::vector<std::vector<int>> next(at(graph.links), std::vector<int>(joints, -1));
  for (const LinkCycle& mesh : drawn.meshes)
    for (std::size_t k = 0, n = mesh.size(); k < n; ++k) {
      const int link = mesh[(k + 1) % n];
      next[at(link)][at(joint_of(graph, link, mesh[(k + 2) % n]))] = joint_of(graph, mesh[k], link);
    }
  std::vector<std::vector<int>> out;
  for (int link = 0; link < graph.links; ++link) {
    int start = joint_of(graph, link, std::countr_zero(graph.neighbours[at(link)]));
    if (const auto k = std::find(drawn.border.begin(), drawn.border.end(), link); k != drawn.border.end())
      start = joint_of(graph, link, k + 1 == drawn.border.end() ? drawn.border.front() : *(k + 1));
    std::vector<int>& around = out.emplace_back();
    for (int j = start; j >= 0 && (j != start || around.empty()); j = next[at(link)][at(j)])
      around.push_back(j);
  }
  return out;
}

std::vector<Side> sides_of(const std::vector<int>& around) {
  std::vector<Side> out;
  if (around.size() == 2) return {{around[0], around[1]}};
  for (std::size_t k = 0; k < around.size(); ++k) out.push_back({around[k], around[(k + 1) % around.size()]});
  return out;
}

// Means of neighbours. Meshes and links of more than three joints get a point in their middle, so that all
// faces are triangles and no two points fall together.
std::vector<Point> mean_places(const ChainGraph& graph, const ChainEmbedding& drawn,
                               const std::vector<std::vector<int>>& links) {
  const std::vector<int> border = joints_around(graph, drawn.border);
  const int joints = graph.joints();
  std::vector<std::vector<int>> beside(at(joints));
  const auto join = [&](int a, int b) { beside[at(a)].push_back(b), beside[at(b)].push_back(a); };
  for (const std::vector<int>& link : links)
    for (const auto& [a, b] : sides_of(link)) join(a, b);
  std::vector<std::vector<int>> faces = links;
  for (const LinkCycle& mesh : drawn.meshes) faces.push_back(joints_around(graph, mesh));
  for (const std::vector<int>& face : faces) {
    if (face.size() < 4) continue;
    beside.emplace_back();
    for (const int j : face) join(static_cast<int>(beside.size()) - 1, j);
  }
  std::vector<Point> places(beside.size(), Point{0, 0});
  std::vector<bool> is_fixed(beside.size(), false);
  const auto n = static_cast<double>(border.size());
  for (std::size_t k = 0; k < border.size(); ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / n, radius = 0.5 / std::sin(pi / n);
    places[at(border[k])] = {radius * std::cos(angle), radius * std::sin(angle)};
    is_fixed[at(border[k])] = true;
  }
  for (int sweep = 0; sweep < 200; ++sweep)
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (is_fixed[v]) continue;
      Point sum{0, 0};
      for (const int w : beside[v]) sum = sum + places[at(w)];
      places[v] = 1.0 / static_cast<double>(beside[v].size()) * sum;
    }
  places.resize(at(joints));
  return places;
}

// Moves joints one by one where that makes the drawing more even.
class Relaxation {
 public:
  Relaxation(ChainSketch& drawn, bool keep_order) : drawn_(drawn), keep_order_(keep_order) {
    beside_.resize(drawn.joints.size());
    own_.resize(drawn.joints.size());
    for (std::size_t link = 0; link < drawn.links.size(); ++link) {
      const std::vector<int>& around = drawn.links[link];
      for (const auto& [a, b] : sides_of(around)) sides_.push_back({a, b, static_cast<int>(link)});
      for (const int j : around) own_[at(j)].push_back(static_cast<int>(link));
      springs_of(around);
    }
  }

  void run() {
    constexpr int rounds = 30, directions = 5;
    double step = 0.3;
    for (int round = 0; round < rounds; ++round, step *= 0.91)
      for (std::size_t j = 0; j < drawn_.joints.size(); ++j) {
        const Point before = drawn_.joints[j];
        Point best = before;
        double least = energy(j);
        for (int k = 0; k < directions; ++k) {
          const double angle = 2 * pi * (k + 0.37 * round) / directions;
          drawn_.joints[j] = before + step * Point{std::cos(angle), std::sin(angle)};
          const double now = energy(j);
          if (now < least && allowed(j)) least = now, best = drawn_.joints[j];
        }
        drawn_.joints[j] = best;
      }
  }

 private:
  struct LinkSide {
    int from, to, link;
  };
  struct Spring {
    int to;
    double by_square;  // one over the square of its length
  };

  // Joints of a link keep the distances of a regular polygon with sides of one bar.
  void springs_of(const std::vector<int>& around) {
    const auto n = static_cast<double>(around.size());
    for (std::size_t a = 0; a < around.size(); ++a)
      for (std::size_t b = 0; b < around.size(); ++b) {
        if (a == b) continue;
        const double steps = std::abs(static_cast<double>(a) - static_cast<double>(b));
        const double wanted = around.size() == 2 ? 1 : std::sin(pi * steps / n) / std::sin(pi / n);
        beside_[at(around[a])].push_back({around[b], 1 / (wanted * wanted)});
      }
  }

  static double near(double square) { return square < 1 ? 0.04 * (1 / square - 1) : 0; }

  double energy(std::size_t j) const {
    const Point p = drawn_.joints[j];
    double out = 0;
    for (const Spring& s : beside_[j]) {
      const double stretch = std::log(square(drawn_.joints[at(s.to)] - p) * s.by_square);
      out += 0.25 * stretch * stretch;
    }
    for (std::size_t k = 0; k < drawn_.joints.size(); ++k)
      if (k != j) out += 0.02 / (0.01 + square(drawn_.joints[k] - p));
    for (const LinkSide& s : sides_) {
      const bool is_end = at(s.from) == j || at(s.to) == j;
      const Point &a = drawn_.joints[at(s.from)], &b = drawn_.joints[at(s.to)];
      if (!is_end) out += near(square_to_side(p, a, b));
      for (std::size_t k = 0; is_end && k < drawn_.joints.size(); ++k)
        if (at(s.from) != k && at(s.to) != k) out += near(square_to_side(drawn_.joints[k], a, b));
    }
    return out;
  }

  // True if no side of the joint crosses another one and its links are convex.
  bool allowed(std::size_t j) const {
    for (const int link : own_[j])
      if (!is_convex(drawn_.links[at(link)])) return false;
    if (!keep_order_) return true;
    for (const LinkSide& own : sides_) {
      if (at(own.from) != j && at(own.to) != j) continue;
      for (const LinkSide& other : sides_)
        if (cross_each_other(drawn_.joints[at(own.from)], drawn_.joints[at(own.to)],
                             drawn_.joints[at(other.from)], drawn_.joints[at(other.to)]))
          return false;
    }
    return true;
  }
  bool is_convex(const std::vector<int>& around) const {
    const std::size_t n = around.size();
    for (std::size_t k = 0; n > 2 && k < n; ++k)
      if (turn_of(drawn_.joints[at(around[k])], drawn_.joints[at(around[(k + 1) % n])],
                  drawn_.joints[at(around[(k + 2) % n])]) <= 0)
        return false;
    return true;
  }

  ChainSketch& drawn_;
  bool keep_order_;
  std::vector<LinkSide> sides_;
  std::vector<std::vector<Spring>> beside_;
  std::vector<std::vector<int>> own_;  // links of each joint
};

ChainSketch planar_sketch(const ChainGraph& graph, const ChainEmbedding& drawn) {
  ChainSketch out;
  out.links = joints_of_links(graph, drawn);
  out.joints = mean_places(graph, drawn, out.links);
  return out;
}

// The graph without a joint, or without a string of binary links with its joints; links keep their numbers.
ChainGraph without_string(const ChainGraph& graph, const std::vector<int>& path) {
  ChainGraph out = graph;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const int a = path[k - 1], b = path[k];
    out.neighbours[at(a)] = static_cast<std::uint16_t>(out.neighbours[at(a)] & ~(1u << b));
    out.neighbours[at(b)] = static_cast<std::uint16_t>(out.neighbours[at(b)] & ~(1u << a));
  }
  return out;
}

// The links that still have joints, numbered anew, and their old numbers.
std::pair<ChainGraph, std::vector<int>> joined_links(const ChainGraph& graph) {
  std::vector<int> old;
  std::array<int, max_chain_links> now{};
  for (int v = 0; v < graph.links; ++v)
    if (graph.degree(v) > 0) {
      now[at(v)] = static_cast<int>(old.size());
      old.push_back(v);
    }
  ChainGraph out{.links = static_cast<int>(old.size())};
  for (const auto& [a, b] : joints_of(graph)) out.join(now[at(a)], now[at(b)]);
  return {out, old};
}

// From a joint along binary links to links with more joints on both sides.
std::vector<int> string_of(const ChainGraph& graph, const JointEnds& joint) {
  std::vector<int> path{joint[0], joint[1]};
  for (int side = 0; side < 2; ++side) {
    while (graph.degree(path.back()) == 2) {
      const int before = path[path.size() - 2];
      path.push_back(std::countr_zero(graph.neighbours[at(path.back())] & ~(1u << before)));
    }
    std::reverse(path.begin(), path.end());
  }
  return path;
}

Point centre_of(const ChainSketch& drawn, int link) {
  Point sum{0, 0};
  for (const int j : drawn.links[at(link)]) sum = sum + drawn.joints[at(j)];
  return 1.0 / static_cast<double>(drawn.links[at(link)].size()) * sum;
}

void sort_around(ChainSketch& drawn, int link) {
  const Point centre = centre_of(drawn, link);
  const auto angle = [&](int j) {
    const Point d = drawn.joints[at(j)] - centre;
    return std::atan2(d.y, d.x);
  };
  std::vector<int>& around = drawn.links[at(link)];
  std::sort(around.begin(), around.end(), [&](int a, int b) { return angle(a) < angle(b); });
}

// The sketch of a part in the numbers of the whole, with a string laid straight across it.
ChainSketch with_string(const ChainGraph& graph, const std::vector<int>& string, const ChainGraph& part,
                        const std::vector<int>& old, const ChainSketch& drawn) {
  ChainSketch out;
  out.joints.resize(at(graph.joints()), Point{0, 0});
  out.links.resize(at(graph.links));
  const std::vector<JointEnds> joints = joints_of(part);
  std::vector<int> number;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    number.push_back(joint_of(graph, old[at(joints[j][0])], old[at(joints[j][1])]));
    out.joints[at(number.back())] = drawn.joints[j];
  }
  for (std::size_t link = 0; link < old.size(); ++link)
    for (const int j : drawn.links[link]) out.links[at(old[link])].push_back(number[at(j)]);
  const Point from = centre_of(out, string.front()), to = centre_of(out, string.back());
  for (std::size_t k = 1; k < string.size(); ++k) {
    const int j = joint_of(graph, string[k - 1], string[k]);
    const double share = static_cast<double>(k) / static_cast<double>(string.size());
    out.joints[at(j)] = from + share * (to - from);
    out.links[at(string[k - 1])].push_back(j), out.links[at(string[k])].push_back(j);
  }
  for (const int end : {string.front(), string.back()}) sort_around(out, end);
  return out;
}

// A graph that is not planar: one string crosses the others.
ChainSketch crossed_sketch(const ChainGraph& graph) {
  ChainSketch best;
  best.crossings = std::numeric_limits<int>::max();
  for (const JointEnds& joint : joints_of(graph)) {
    const std::vector<int> string = string_of(graph, joint);
    const auto [part, old] = joined_links(without_string(graph, string));
    if (!is_two_connected(part)) continue;
    const std::optional<ChainEmbedding> drawn = embedding(part);
    if (!drawn) continue;
    ChainSketch now = with_string(graph, string, part, old, planar_sketch(part, *drawn));
    now.crossings = crossings(now);
    if (now.crossings < best.crossings) best = std::move(now);
  }
  LINKWRIGHT_REQUIRE(!best.joints.empty(), "no string of {} links leaves a planar rest", graph.links);
  Relaxation(best, false).run();
  return best;
}

// Parts that share a link are tied together by joints that are not drawn.
ChainGraph tied(ChainGraph graph) {
  const unsigned all = (1u << graph.links) - 1;
  for (int cut = 0; cut < graph.links;) {
    const unsigned rest = all & ~(1u << cut), around = graph.neighbours[at(cut)];
    const unsigned part = connected_links(graph, rest, std::countr_zero(rest));
    if (part == rest)
      ++cut;
    else
      graph.join(std::countr_zero(around & part), std::countr_zero(around & ~part));
  }
  return graph;
}

void untie(ChainSketch& drawn, const ChainGraph& whole, const ChainGraph& graph) {
  std::vector<int> number;
  std::vector<Point> places;
  for (const auto& [a, b] : joints_of(whole)) {
    number.push_back(graph.joined(a, b) ? static_cast<int>(places.size()) : -1);
    if (graph.joined(a, b)) places.push_back(drawn.joints[number.size() - 1]);
  }
  for (std::vector<int>& link : drawn.links) {
    for (int& j : link) j = number[at(j)];
    std::erase(link, -1);
  }
  drawn.joints = std::move(places);
}

// The side of the base that belongs to the border becomes horizontal, with the chain above it.
void turn_upright(ChainSketch& drawn, int base) {
  const std::vector<int>& around = drawn.links[at(base)];
  const Point from = drawn.joints[at(around.back())], along = drawn.joints[at(around.front())] - from;
  const double size = length(along);
  if (!(size > 0)) return;
  for (Point& p : drawn.joints) p = rotate_inverse(1 / size * along, p - from);
}

}  // namespace

int crossings(const ChainSketch& drawn) {
  std::vector<std::pair<Side, std::size_t>> sides;
  for (std::size_t link = 0; link < drawn.links.size(); ++link)
    for (const Side& s : sides_of(drawn.links[link])) sides.push_back({s, link});
  int out = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t k = i + 1; k < sides.size(); ++k)
      if (sides[i].second != sides[k].second)
        out += cross_each_other(drawn.joints[at(sides[i].first[0])], drawn.joints[at(sides[i].first[1])],
                                drawn.joints[at(sides[k].first[0])], drawn.joints[at(sides[k].first[1])]);
  return out;
}

ChainSketch sketch(const ChainGraph& graph, std::optional<int> ground) {
  const ChainGraph whole = tied(graph);
  ChainSketch out;
  int base = ground.value_or(0);
  if (const std::optional<ChainEmbedding> drawn = embedding(whole, ground.value_or(-1))) {
    out = planar_sketch(whole, *drawn);
    untie(out, whole, graph);
    Relaxation(out, true).run();
    const auto fewer = [&](int a, int b) { return graph.degree(a) < graph.degree(b); };
    if (!ground) base = *std::max_element(drawn->border.begin(), drawn->border.end(), fewer);
  } else {
    out = crossed_sketch(graph);
  }
  out.crossings = crossings(out);
  turn_upright(out, base);
  return out;
}

}  // namespace linkwright::planar
