// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/workspace.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"

namespace linkwright::parallel {

namespace {

constexpr std::size_t block = 2048;  // nodes of one call: a fraction of a millisecond

std::size_t nodes_along(double low, double high, double step) {
  LINKWRIGHT_REQUIRE(std::isfinite(low) && std::isfinite(high) && high >= low, "grid from {} to {} m", low,
                     high);
  // The end counts when it is missed by rounding alone.
  const double steps = std::floor((high - low) / step + 1e-6);
  LINKWRIGHT_REQUIRE(steps < 1e9, "grid from {} to {} m in steps of {} m", low, high, step);
  return static_cast<std::size_t>(steps) + 1;
}

}  // namespace

std::array<std::size_t, 3> nodes_of(const WorkspaceGrid& grid) {
  LINKWRIGHT_REQUIRE(grid.step > 0 && std::isfinite(grid.step), "grid step {} m must be positive", grid.step);
  const std::array<std::size_t, 3> out = {nodes_along(grid.low.x, grid.high.x, grid.step),
                                          nodes_along(grid.low.y, grid.high.y, grid.step),
                                          nodes_along(grid.low.z, grid.high.z, grid.step)};
  double all = 1;
  for (const std::size_t n : out) all *= static_cast<double>(n);
  LINKWRIGHT_REQUIRE(all <= 1e9, "grid of {} nodes", all);
  return out;
}

double cell_of(const WorkspaceGrid& grid, const std::array<std::size_t, 3>& nodes) {
  double cell = 1;
  for (const std::size_t n : nodes)
    if (n > 1) cell *= grid.step;
  return cell;
}

Vec3 WorkspaceMap::position(std::size_t node) const {
  const std::size_t i = node % nodes[0], j = node / nodes[0] % nodes[1], k = node / nodes[0] / nodes[1];
  return {grid.low.x + grid.step * static_cast<double>(i), grid.low.y + grid.step * static_cast<double>(j),
          grid.low.z + grid.step * static_cast<double>(k)};
}

WorkspaceMap workspace(const WorkspaceTask& task, const RunContext& context) {
  const auto trouble = problem(task.conditions);
  LINKWRIGHT_REQUIRE(!trouble, "{}", trouble.value_or(""));
  const WorkspaceGrid& grid = task.grid;
  LINKWRIGHT_REQUIRE(task.conditions.robot.freedom == Freedom::space || task.rotation == Mat3{},
                     "the platform of this robot does not turn");
  WorkspaceMap out{.grid = grid};
  out.nodes = nodes_of(grid);
  out.cell = cell_of(grid, out.nodes);
  for (const std::size_t n : out.nodes) out.axes += n > 1;
  LINKWRIGHT_REQUIRE(
      task.conditions.robot.freedom != Freedom::plane_translation || (out.nodes[2] == 1 && grid.low.z == 0),
      "a planar robot lies in the plane z = 0, got nodes from {} to {} m", grid.low.z, grid.high.z);
  const std::size_t count = out.nodes[0] * out.nodes[1] * out.nodes[2];
  out.criterion.assign(count, Criterion::open);
  for (std::size_t k = 0; k < pose_index_count; ++k)
    if (task.wanted[k]) out.index[k].assign(count, nan);

  const std::size_t blocks = (count + block - 1) / block;
  std::atomic<std::size_t> finished{0};
  optimise::parallel_for(blocks, context.threads(), [&](std::size_t b) {
    if (context.interrupted()) return;
    std::array<Vec3, block> positions;
    const std::size_t first = b * block, here = std::min(block, count - first);
    for (std::size_t n = 0; n < here; ++n) positions[n] = out.position(first + n);
    PoseFindings findings{.criterion = std::span(out.criterion).subspan(first, here)};
    for (std::size_t k = 0; k < pose_index_count; ++k)
      if (task.wanted[k]) findings.index[k] = std::span(out.index[k]).subspan(first, here);
    check_poses(task.conditions, std::span(positions).first(here), task.rotation, findings);
    const std::size_t done = finished.fetch_add(1, std::memory_order_relaxed) + 1;
    if (done % 64 == 0 || done == blocks)
      context.report(
          {.stage = "workspace", .fraction = static_cast<double>(done) / static_cast<double>(blocks)});
  });
  if (finished.load() < blocks) out.status = context.interruption();
  return out;
}

NodeSet nodes_before(const WorkspaceMap& map, Criterion first) {
  NodeSet out(map.count());
  for (std::size_t n = 0; n < out.size(); ++n)
    out[n] = map.criterion[n] == Criterion::none ||
             (map.criterion[n] >= first && map.criterion[n] != Criterion::open);
  return out;
}

IndexSummary summary(const WorkspaceMap& map, PoseIndex index, const NodeSet& set) {
  const std::vector<double>& values = map.index[slot(index)];
  LINKWRIGHT_REQUIRE(!values.empty(), "the map does not hold {}", name_of(index));
  LINKWRIGHT_REQUIRE(set.size() == values.size(), "a set of {} nodes for a map of {}", set.size(),
                     values.size());
  IndexSummary out;
  double sum = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!set[n] || std::isnan(values[n])) continue;
    if (out.count == 0 || values[n] < out.least) out.least = values[n], out.least_at = n;
    if (out.count == 0 || values[n] > out.greatest) out.greatest = values[n], out.greatest_at = n;
    sum += values[n];
    ++out.count;
  }
  if (out.count == 0) out.least = out.greatest = nan;
  out.mean = sum / static_cast<double>(out.count);
  return out;
}

WorkspaceTotals totals(const WorkspaceMap& map) {
  WorkspaceTotals out;
  for (const Criterion h : map.criterion) ++out.count[static_cast<std::size_t>(h)];
  out.passing = out.count[0];
  out.measure = static_cast<double>(out.passing) * map.cell;
  const NodeSet set = passing(map);
  for (std::size_t k = 0; k < pose_index_count; ++k)
    if (!map.index[k].empty()) out.index[k] = summary(map, static_cast<PoseIndex>(k), set);
  return out;
}

}  // namespace linkwright::parallel
