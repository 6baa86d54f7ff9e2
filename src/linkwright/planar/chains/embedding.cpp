// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/embedding.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

unsigned set_of(const LinkCycle& links) {
  unsigned out = 0;
  for (const int v : links) out |= 1u << v;
  return out;
}

// Extends a path whose first link has the least number of the cycle; each cycle is found in one sense only.
void extend_path(const ChainGraph& graph, LinkCycle& path, std::vector<LinkCycle>& out) {
  const unsigned used = set_of(path);
  for (int next = path.front(); next < graph.links; ++next) {
    if (!graph.joined(path.back(), next)) continue;
    if (next == path.front() && path.size() > 2 && path[1] < path.back()) out.push_back(path);
    if ((used >> next & 1) != 0) continue;
    path.push_back(next);
    extend_path(graph, path, out);
    path.pop_back();
  }
}

// What is not drawn yet and hangs together: a joint between drawn links, or links with all that join them.
struct Fragment {
  unsigned inner = 0;     // links that are not drawn
  unsigned contacts = 0;  // drawn links at its ends
};

bool fits(const Fragment& fragment, const LinkCycle& face) {
  return (fragment.contacts & ~set_of(face)) == 0;
}

class Drawing {
 public:
  Drawing(const ChainGraph& graph, const LinkCycle& border)
      : graph_(graph), drawn_{.links = graph.links}, faces_{border} {
    draw_path(border);
    drawn_.join(border.back(), border.front());
  }

  // False when something fits into no face.
  bool complete() {
    for (;;) {
      const std::vector<Fragment> left = fragments();
      if (left.empty()) return true;
      const auto room = [&](const Fragment& f) {
        return std::count_if(faces_.begin(), faces_.end(),
                             [&](const LinkCycle& face) { return fits(f, face); });
      };
      // The one with the fewest faces to choose from is next.
      const auto next = std::min_element(
          left.begin(), left.end(), [&](const Fragment& a, const Fragment& b) { return room(a) < room(b); });
      if (room(*next) == 0) return false;
      draw(*next);
    }
  }
  std::vector<LinkCycle> faces() && { return std::move(faces_); }

 private:
  void draw_path(const std::vector<int>& path) {
    for (std::size_t k = 1; k < path.size(); ++k) drawn_.join(path[k - 1], path[k]);
    inside_ |= set_of(path);
  }

  std::vector<Fragment> fragments() const {
    std::vector<Fragment> out;
    for (const auto& [a, b] : joints_of(graph_))
      if ((inside_ >> a & inside_ >> b & 1) != 0 && !drawn_.joined(a, b))
        out.push_back({0, 1u << a | 1u << b});
    unsigned rest = ((1u << graph_.links) - 1) & ~inside_;
    while (rest != 0) {
      Fragment f{connected_links(graph_, rest, std::countr_zero(rest)), 0};
      for (unsigned set = f.inner; set != 0; set &= set - 1)
        f.contacts |= graph_.neighbours[at(std::countr_zero(set))] & inside_;
      rest &= ~f.inner;
      out.push_back(f);
    }
    return out;
  }

  // A shortest path through a fragment from its first contact to another one.
  std::vector<int> path_through(const Fragment& f) const {
    const int from = std::countr_zero(f.contacts);
    const unsigned goals = f.contacts & ~(1u << from);
    if (f.inner == 0) return {from, std::countr_zero(goals)};
    std::vector<std::vector<int>> paths{{from}};
    unsigned seen = 1u << from;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const int last = paths[k].back();
      unsigned next = graph_.neighbours[at(last)] & f.inner & ~seen;
      if (const unsigned ends = graph_.neighbours[at(last)] & goals; ends != 0 && last != from) next = ends;
      for (; next != 0; next &= next - 1) {
        paths.push_back(paths[k]);
        paths.back().push_back(std::countr_zero(next));
        if ((goals >> paths.back().back() & 1) != 0) return paths.back();
      }
      seen |= graph_.neighbours[at(last)] & f.inner;
    }
    return {};
  }

  void draw(const Fragment& fragment) {
    const std::vector<int> path = path_through(fragment);
    // The largest face that has room, so that meshes stay of similar size.
    auto best = faces_.end();
    for (auto face = faces_.begin(); face != faces_.end(); ++face)
      if (fits(fragment, *face) && (best == faces_.end() || face->size() > best->size())) best = face;
    LinkCycle face = std::move(*best);
    std::rotate(face.begin(), std::find(face.begin(), face.end(), path.front()), face.end());
    const auto end = std::find(face.begin(), face.end(), path.back());
    // Along the face to the end of the path and back on the path, and the other way round.
    LinkCycle one(face.begin(), end), other(path.begin(), path.end() - 1);
    one.insert(one.end(), path.rbegin(), path.rend() - 1);
    other.insert(other.end(), end, face.end());
    *best = std::move(one);
    faces_.push_back(std::move(other));
    draw_path(path);
  }

  const ChainGraph& graph_;
  ChainGraph drawn_;
  unsigned inside_ = 0;  // drawn links
  std::vector<LinkCycle> faces_;
};

}  // namespace

std::vector<LinkCycle> cycles(const ChainGraph& graph) {
  std::vector<LinkCycle> out;
  for (int first = 0; first < graph.links; ++first) {
    LinkCycle path{first};
    extend_path(graph, path, out);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const LinkCycle& a, const LinkCycle& b) { return a.size() > b.size(); });
  return out;
}

bool is_two_connected(const ChainGraph& graph) {
  const unsigned all = (1u << graph.links) - 1;
  for (int removed = 0; removed < graph.links; ++removed) {
    const unsigned rest = all & ~(1u << removed);
    if (connected_links(graph, rest, std::countr_zero(rest)) != rest) return false;
  }
  return true;
}

std::optional<ChainEmbedding> embedding(const ChainGraph& graph, int link) {
  for (const LinkCycle& border : cycles(graph)) {
    if (link >= 0 && std::find(border.begin(), border.end(), link) == border.end()) continue;
    Drawing drawing(graph, border);
    if (drawing.complete()) return ChainEmbedding{border, std::move(drawing).faces()};
  }
  return std::nullopt;
}

}  // namespace linkwright::planar
