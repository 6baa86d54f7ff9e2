// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/aspects.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "linkwright/core/check.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/parallel/robot/path_trouble.h"

namespace linkwright::parallel {

namespace {

// The data of a node that the bounds need.
struct Node {
  Marks marks;
  double clear = 0;  // radius (m)
};

class Edges {
 public:
  explicit Edges(const WorkspaceAspectsTask& task)
      : rotation_(task.rotation),
        task_{.robot = task.conditions.robot,
              .mode = task.conditions.mode,
              .length = task.conditions.characteristic_length} {}

  Node node(const Vec3& place) const {
    const RegularAt at = regular_at(task_.robot, {place, rotation_}, task_.mode, task_.length);
    return {at.marks, clear_radius(task_.robot, at, task_.length)};
  }

  bool open(const Vec3& a, const Node& at_a, const Vec3& b, const Node& at_b) const {
    if (at_a.marks != at_b.marks || at_a.marks.assembly == 0) return false;
    if (at_a.clear + at_b.clear >= norm(b - a)) return true;
    TroubleTask task = task_;
    task.home = at_a.marks;
    return !first_trouble(task, {a, rotation_}, {b, rotation_});
  }

 private:
  Mat3 rotation_;
  TroubleTask task_;
};

// Half of the neighbours: the other half are the same edges.
std::vector<std::array<int, 3>> directions(const WorkspaceAspectsTask& task) {
  if (task.neighbours == Neighbours::along_axes) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<std::array<int, 3>> out;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (i + 3 * j + 9 * k > 0) out.push_back({i, j, k});
  return out;
}

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t n) {
  while (parent[n] != n) n = parent[n] = parent[parent[n]];
  return n;
}

std::size_t nearest_node(const WorkspaceMap& map, const Vec3& place) {
  const auto along = [&](double low, double value, std::size_t nodes) {
    const double steps = std::round((value - low) / map.grid.step);
    return static_cast<std::size_t>(std::clamp(steps, 0.0, static_cast<double>(nodes - 1)));
  };
  return map.number(along(map.grid.low.x, place.x, map.nodes[0]),
                    along(map.grid.low.y, place.y, map.nodes[1]),
                    along(map.grid.low.z, place.z, map.nodes[2]));
}

}  // namespace

std::size_t WorkspaceAspects::all() const {
  return std::accumulate(size.begin(), size.end(), std::size_t{0});
}

WorkspaceAspects workspace_aspects(const WorkspaceMap& map, const NodeSet& set,
                                   const WorkspaceAspectsTask& task, const RunContext& context) {
  LINKWRIGHT_REQUIRE(set.size() == map.count(), "a set of {} nodes for a map of {}", set.size(), map.count());
  WorkspaceAspects out;
  const auto stopped = [&](Status status) {
    out.status = status;
    return status != Status::done;
  };
  // Every layer looks at the edges that begin in it.
  const auto ways = directions(task);
  const Edges edges(task);
  const auto [nx, ny, nz] = map.nodes;
  std::vector<Node> at(map.count());
  optimise::parallel_for(ny * nz, context.threads(), [&, nx = nx](std::size_t row) {
    if (context.interrupted()) return;
    for (std::size_t n = row * nx; n < (row + 1) * nx; ++n)
      if (set[n]) at[n] = edges.node(map.position(n));
  });
  if (stopped(context.interruption())) return out;
  std::vector<std::uint32_t> open(map.count());  // bit w: the edge along ways[w]
  std::vector<std::size_t> edge_count(ny * nz), closed_count(ny * nz);
  optimise::parallel_for(ny * nz, context.threads(), [&, nx = nx, ny = ny, nz = nz](std::size_t row) {
    if (context.interrupted()) return;
    const std::size_t j = row % ny, k = row / ny;
    constexpr std::size_t between_looks = 256;
    for (std::size_t i = 0; i < nx; ++i) {
      if (i % between_looks == between_looks - 1 && context.interrupted()) return;
      const std::size_t n = map.number(i, j, k);
      if (!set[n]) continue;
      for (std::size_t w = 0; w < ways.size(); ++w) {
        const std::size_t to_i = i + ways[w][0], to_j = j + ways[w][1], to_k = k + ways[w][2];
        if (to_i >= nx || to_j >= ny || to_k >= nz) continue;  // also below 0
        const std::size_t m = map.number(to_i, to_j, to_k);
        if (!set[m]) continue;
        ++edge_count[row];
        if (edges.open(map.position(n), at[n], map.position(m), at[m]))
          open[n] |= 1u << w;
        else
          ++closed_count[row];
      }
    }
  });
  if (stopped(context.interruption())) return out;

  std::vector<std::size_t> parent(map.count());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto reach = [&, nx = nx, ny = ny](std::size_t w) {
    return static_cast<std::ptrdiff_t>(ways[w][0]) +
           static_cast<std::ptrdiff_t>(nx) * (ways[w][1] + static_cast<std::ptrdiff_t>(ny) * ways[w][2]);
  };
  for (std::size_t n = 0; n < map.count(); ++n)
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (!(open[n] >> w & 1)) continue;
      // The smaller number is the root, so that roots are first nodes.
      const std::size_t a = root_of(parent, n),
                        b = root_of(parent,
                                    static_cast<std::size_t>(static_cast<std::ptrdiff_t>(n) + reach(w)));
      parent[std::max(a, b)] = std::min(a, b);
    }
  out.edges = std::accumulate(edge_count.begin(), edge_count.end(), std::size_t{0});
  out.closed = std::accumulate(closed_count.begin(), closed_count.end(), std::size_t{0});
  out.aspect.assign(map.count(), -1);
  for (std::size_t n = 0; n < map.count(); ++n) {
    if (!set[n]) continue;
    const std::size_t root = root_of(parent, n);
    if (root == n) {
      out.aspect[n] = static_cast<std::int32_t>(out.size.size());
      out.size.push_back(0);
    }
    out.aspect[n] = out.aspect[root];
    ++out.size[static_cast<std::size_t>(out.aspect[n])];
  }
  out.home_node = nearest_node(map, task.home);
  out.home = out.aspect[out.home_node];
  return out;
}

NodeSet nodes_of(const WorkspaceAspects& aspects, int aspect) {
  NodeSet out(aspects.aspect.size());
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = aspects.aspect[n] == aspect;
  return out;
}

}  // namespace linkwright::parallel
