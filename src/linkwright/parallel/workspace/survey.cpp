// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/survey.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/pieces.h"

namespace linkwright::parallel {

namespace {

constexpr std::size_t numbers_of_index = 6;

std::vector<double> numbers_of(const IndexSummary& s) {
  return {static_cast<double>(s.count),      s.least, s.mean, s.greatest, static_cast<double>(s.least_at),
          static_cast<double>(s.greatest_at)};
}

IndexSummary summary_of(const std::vector<double>& v, std::string_view what) {
  if (v.size() != numbers_of_index) throw CheckpointError(fmt::format("{}: {} numbers", what, v.size()));
  return {static_cast<std::size_t>(v[0]), v[1], v[2], v[3], static_cast<std::size_t>(v[4]),
          static_cast<std::size_t>(v[5])};
}

Value kept(const WorkspaceTotals& totals) {
  std::vector<double> counts(totals.count.begin(), totals.count.end());
  Value out;
  out["nodes"] = pack_numbers(counts);
  out["indices"] = Value::array();
  for (const IndexSummary& s : totals.index) out["indices"].push_back(pack_numbers(numbers_of(s)));
  return out;
}

WorkspaceTotals restored(const Value& value, std::size_t nodes, const std::string& what) {
  WorkspaceTotals out;
  const std::vector<double> counts = unpack_numbers(load_member(value, "nodes", what), what);
  const Value& indices = load_member(value, "indices", what);
  double all = 0;
  for (const double c : counts) all += c;
  if (counts.size() != criterion_count || all != static_cast<double>(nodes) || !indices.is_array() ||
      indices.as_array().size() != pose_index_count)
    throw CheckpointError(what + ": other nodes or indices");
  for (std::size_t k = 0; k < criterion_count; ++k) out.count[k] = static_cast<std::size_t>(counts[k]);
  out.passing = out.count[0];
  for (std::size_t k = 0; k < pose_index_count; ++k)
    out.index[k] = summary_of(unpack_numbers(indices.as_array()[k], what), what);
  return out;
}

/// Adds a layer whose first node has the number `first`.
void add(WorkspaceTotals& sum, const WorkspaceTotals& layer, std::size_t first) {
  for (std::size_t k = 0; k < criterion_count; ++k) sum.count[k] += layer.count[k];
  sum.passing += layer.passing;
  for (std::size_t k = 0; k < pose_index_count; ++k) {
    IndexSummary& all = sum.index[k];
    const IndexSummary& own = layer.index[k];
    if (own.count == 0) continue;
    if (all.count == 0 || own.least < all.least) all.least = own.least, all.least_at = first + own.least_at;
    if (all.count == 0 || own.greatest > all.greatest)
      all.greatest = own.greatest, all.greatest_at = first + own.greatest_at;
    all.mean += own.mean * static_cast<double>(own.count);  // the sum until the last layer
    all.count += own.count;
  }
}

}  // namespace

WorkspaceSurvey survey_workspace(const WorkspaceTask& task, RunContext& context) {
  WorkspaceSurvey out;
  out.nodes = nodes_of(task.grid);
  out.cell = cell_of(task.grid, out.nodes);
  const auto [nx, ny, nz] = out.nodes;
  const bool levels = nz > 1;
  const std::size_t layers = levels ? nz : ny, nodes = levels ? nx * ny : nx;
  const auto layer_task = [&](std::size_t k) {
    WorkspaceTask layer = task;
    const double way = task.grid.step * static_cast<double>(k);
    if (levels)
      layer.grid.low.z = layer.grid.high.z = task.grid.low.z + way;
    else
      layer.grid.low.y = layer.grid.high.y = task.grid.low.y + way;
    return layer;
  };
  std::vector<WorkspaceTotals> found(layers);
  std::vector<char> complete(layers, 0);
  const auto name = [](std::size_t k) { return fmt::format("layer {}", k + 1); };
  const optimise::PieceLoop loop = optimise::for_each_piece(
      layers, context, "workspace", name,
      [&](std::size_t k) {
        RunContext own;
        own.set_part_of(context);
        own.set_threads(1);
        const WorkspaceMap map = workspace(layer_task(k), own);
        complete[k] = map.status == Status::done;
        if (complete[k] != 0) found[k] = totals(map);
        return infinity;
      },
      [&](std::size_t k) { return complete[k] != 0 ? kept(found[k]) : Value(); },
      [&](std::size_t k, const Value& value) {
        found[k] = restored(value, nodes, name(k));
        complete[k] = 1;
        return infinity;
      });
  for (std::size_t k = 0; k < layers; ++k) {
    out.passing.push_back(found[k].passing);
    if (complete[k] == 0) {
      out.status = loop.status;
      continue;
    }
    out.count += nodes;
    add(out.totals, found[k], k * nodes);
  }
  out.totals.measure = static_cast<double>(out.totals.passing) * out.cell;
  for (std::size_t k = 0; k < pose_index_count; ++k) {
    IndexSummary& index = out.totals.index[k];
    if (index.count == 0 && task.wanted[k]) index.least = index.greatest = nan;
    if (index.count > 0 || task.wanted[k]) index.mean /= static_cast<double>(index.count);
  }
  return out;
}

}  // namespace linkwright::parallel
