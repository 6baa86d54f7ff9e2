// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/workspace.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/workspace/aspects.h"
#include "linkwright/parallel/workspace/rays.h"
#include "linkwright/parallel/workspace/survey.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

/// More nodes are looked at layer by layer, and only totals are kept of them.
constexpr double max_in_memory = 2e6;
constexpr double max_nodes = 1e9;
/// More rows are no table to look at.
constexpr std::size_t max_rows = 500000;
/// Rows of all slices of a grid that is not in memory.
constexpr std::size_t max_slice_rows = 100000;

std::string words_of(PoseIndex index) {
  for (const auto& entry : names(PoseIndex{}))
    if (entry.value == index) return std::string(entry.summary);
  return {};
}
std::string key_of(PoseIndex index) {
  const bool length = index == PoseIndex::axis_resolution || index == PoseIndex::worst_resolution;
  return std::string(name_of(index)) + (length ? "_m" : "");
}
std::string label_of(PoseIndex index) {
  const bool length = index == PoseIndex::axis_resolution || index == PoseIndex::worst_resolution;
  return words_of(index) + (length ? " (m)" : "");
}

/// Nodes of a map that are shown.
struct ShownNodes {
  const WorkspaceMap* map;
  std::vector<std::size_t> nodes;
};

/// Nodes of maps as rows.
Table node_table(const std::vector<ShownNodes>& shown, const WorkspaceStudy& s, bool planar,
                 std::string name) {
  Table table{.name = std::move(name)};
  std::vector<double> x, y, z;
  for (const auto& [map, nodes] : shown)
    for (const std::size_t node : nodes) {
      const Vec3 at = map->position(node);
      x.push_back(at.x);
      y.push_back(at.y);
      z.push_back(at.z);
      table.status.emplace_back(map->criterion[node] == Criterion::none ? "done"
                                                                        : name_of(map->criterion[node]));
    }
  table.add("x_m", "x (m)", std::move(x));
  table.add("y_m", "y (m)", std::move(y));
  if (!planar) table.add("z_m", "z (m)", std::move(z));
  for (const PoseIndex index : s.form.indices) {
    std::vector<double> column;
    // Nodes that do not pass are not coloured.
    for (const auto& [map, nodes] : shown)
      for (const std::size_t node : nodes)
        column.push_back(map->criterion[node] == Criterion::none ? map->index[slot(index)][node]
                                                                 : std::nan(""));
    table.add(key_of(index), label_of(index), std::move(column));
  }
  return table;
}

/// Nodes of each level of z that pass.
std::vector<std::size_t> passing_by_level(const WorkspaceMap& map) {
  std::vector<std::size_t> out(map.nodes[2]);
  const std::size_t level = map.nodes[0] * map.nodes[1];
  for (std::size_t n = 0; n < map.count(); ++n) out[n / level] += map.criterion[n] == Criterion::none;
  return out;
}

/// Evenly chosen levels out of those that have a node that passes.
std::vector<std::size_t> levels_of(const std::vector<std::size_t>& passing, int wanted) {
  std::vector<std::size_t> used, out;
  for (std::size_t k = 0; k < passing.size(); ++k)
    if (passing[k] > 0) used.push_back(k);
  const std::size_t count = std::min(used.size(), static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < count; ++i) out.push_back(used[(2 * i + 1) * used.size() / (2 * count)]);
  return out;
}

/// One level of a grid that is not in memory, with as many nodes as a drawing can show.
WorkspaceMap coarse_level(WorkspaceTask task, double height, std::size_t most, const RunContext& context) {
  task.grid.low.z = task.grid.high.z = height;
  const auto [nx, ny, nz] = nodes_of(task.grid);
  task.grid.step *= std::ceil(std::sqrt(static_cast<double>(nx * ny) / static_cast<double>(most)));
  return workspace(task, context);
}

Table totals_table(const WorkspaceTotals& totals, std::size_t all, double cell, int axes) {
  Table table{.name = "workspace_totals"};
  std::vector<double> nodes, left, measure;
  std::size_t passing = all;
  for (const auto& entry : names(Criterion{})) {
    if (entry.value == Criterion::open || entry.value == Criterion::none) continue;
    const std::size_t stopped = totals.count[static_cast<std::size_t>(entry.value)];
    passing -= stopped;
    table.names.emplace_back(entry.summary);
    nodes.push_back(static_cast<double>(stopped));
    left.push_back(static_cast<double>(passing));
    measure.push_back(static_cast<double>(passing) * cell);
  }
  table.add("nodes", "nodes that fail by it", nodes);
  table.add("left", "nodes left", left);
  table.add(axes == 3 ? "volume_left_m3" : "area_left_m2", axes == 3 ? "volume left (m3)" : "area left (m2)",
            measure);
  return table;
}

/// Ends of what passes on rays around home, at each level.
Table boundary_table(const WorkspaceTask& task, const std::vector<double>& heights, const WorkspaceForm& f,
                     const Pose& home, bool planar, const RunContext& context) {
  Table table{.name = "workspace_boundary"};
  std::vector<double> z, angle, from, to;
  const RaySearch search{.longest = std::hypot(f.upper[0] - f.lower[0], f.upper[1] - f.lower[1]),
                         .step = f.step,
                         .tolerance = 1e-7};
  for (const double height : heights) {
    const Pose origin{{home.position.x, home.position.y, height}, task.rotation};
    const Rays rays = position_rays(task.conditions, origin, directions_around(f.boundary), search, context);
    for (std::size_t i = 0; i < rays.ray.size(); ++i)
      for (const RayStretch& stretch : rays.ray[i].stretch) {
        z.push_back(height);
        angle.push_back(2 * pi * static_cast<double>(i) / f.boundary);
        from.push_back(stretch.from);
        to.push_back(stretch.to);
        table.names.emplace_back(stretch.after == Criterion::none ? "end of the ray"
                                                                  : name_of(stretch.after));
      }
  }
  if (!planar) table.add("z_m", "z (m)", z);
  table.add("direction_rad", "direction from home (rad)", angle);
  table.add("from_m", "passes from this distance (m)", from);
  table.add("to_m", "to this one (m)", to);
  return table;
}

Sentence body_text(const Inscribed& body, const InscribedForm& f, bool planar) {
  // Hundredths of a millimetre.
  const auto mm = [](double metres) { return millimetres(std::round(1e5 * metres) / 1e5, 6); };
  const auto along = [&](const char* separator, const Measured& x, const Measured& y, const Measured& z) {
    return planar ? say("{}{}{}", x.sharing_unit(), separator, y)
                  : say("{}{}{}{}{}", x.sharing_unit(), separator, y.sharing_unit(), separator, z);
  };
  const Vec3 &c = body.centre, &half = body.half;
  const Sentence at = along(", ", at_place("x", mm(c.x)), at_place("y", mm(c.y)), at_place("z", mm(c.z)));
  if (f.shape == InscribedShape::ball) return say("diameter {}, at {}", mm(2 * half.x), at);
  if (f.shape == InscribedShape::cylinder)
    return say("diameter {}, height {}, at {}", mm(2 * half.x), mm(2 * half.z), at);
  return say("{}, at {}", along(" x ", mm(2 * half.x), mm(2 * half.y), mm(2 * half.z)), at);
}

/// The size of a workspace.
Measured area_or_volume(double value, bool planar) {
  static constexpr Unit cubic_metre{"m3"};
  return (planar ? measured("m2", value) : measured(cubic_metre, value)).spelled();
}

/// The largest body of a form that fits into the nodes that pass.
void add_inscribed(study::Result& result, const WorkspaceMap& map, const WorkspaceTask& task,
                   const InscribedForm& form, bool planar, RunContext& context) {
  InscribedTask inner{.conditions = task.conditions, .rotation = task.rotation, .shape = form.shape};
  if (form.axis) inner.axis = Vec3{(*form.axis)[0], (*form.axis)[1], 0};
  inner.height = form.height.value_or(0);
  inner.ratio = form.ratio.value_or(0);
  const Inscribed body = inscribed(map, passing(map), inner, context);
  if (body.status != Status::done && body.status != Status::infeasible) result.status = body.status;
  study::AddFact{result.facts}(
      fmt::format("largest {}", name_of(form.shape)),
      body.status == Status::infeasible ? "none fits"
      : body.half.x == 0
          ? "not found before the run ended"
          : body_text(body, form, planar) + (body.proven ? ", proven free of singularities" : ""));
}

void add_rotation_range(study::Result& result, const PoseConditions& conditions, const Pose& home,
                        RunContext& context) {
  const study::AddFact fact{result.facts};
  const RotationRange range =
      rotation_range(conditions, home, 72, {.longest = pi, .step = 0.02, .tolerance = 1e-6}, context);
  if (range.status == Status::done) {
    fact("tilt at home, about any horizontal axis", degrees_of(range.tilt).fixed(2));
    fact("yaw at home",
         say("{} to {}", degrees_of(range.min_yaw).fixed(2), degrees_of(range.max_yaw).fixed(2)));
  }
}

/// The nodes of the levels that are drawn.
Table slice_table(const WorkspaceMap& map, const WorkspaceTask& task, const WorkspaceStudy& s,
                  const std::vector<std::size_t>& levels, const std::vector<double>& heights,
                  const RunContext& context) {
  std::vector<WorkspaceMap> coarse;
  std::vector<ShownNodes> slices;
  coarse.reserve(levels.size());  // the slices point to its elements
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (s.large) coarse.push_back(coarse_level(task, heights[i], max_slice_rows / levels.size(), context));
    const std::size_t count = s.large ? coarse.back().count() : map.nodes[0] * map.nodes[1];
    ShownNodes& slice = slices.emplace_back(ShownNodes{s.large ? &coarse.back() : &map, {}});
    for (std::size_t n = 0; n < count; ++n) slice.nodes.push_back(s.large ? n : levels[i] * count + n);
  }
  return node_table(slices, s, task.conditions.robot.freedom == Freedom::plane_translation,
                    "workspace_slices");
}

}  // namespace

PoseConditions conditions_of(const RobotDescription& d, const QualityLimits& limits, const Pose& home) {
  PoseConditions out{.robot = d.robot, .drives = d.drives, .mode = d.mode};
  const Marks marks = marks_at(d.robot, home, d.mode);
  out.assembly = marks.assembly;
  if (d.robot.freedom == Freedom::space_translation) {
    out.constraint = marks.constraint;
    out.least_constraint = std::max(limits.constraint, constraint_floor);
  }
  if (limits.min_elbow) out.min_elbow = *limits.min_elbow;
  if (limits.largest_elbow) out.max_elbow = *limits.largest_elbow;
  if (limits.rod_swing) out.max_swing = *limits.rod_swing;
  out.min_drive_transmission = limits.drive_transmission;
  out.min_transmission = limits.transmission;
  out.min_conditioning = limits.conditioning;
  out.characteristic_length = platform_size(d.robot);
  return out;
}

std::optional<WorkspaceStudy> read_workspace(study::ObjectReader& document, const RobotDescription& d,
                                             Value& canonical) {
  auto table = document.table("workspace");
  if (!table) return std::nullopt;
  WorkspaceStudy out;
  WorkspaceForm& form = out.form;
  table->read(form);
  if (document.document().has_errors()) return std::nullopt;
  double nodes = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (form.upper[i] < form.lower[i]) {
      table->error("upper", fmt::format("is below lower along {}", "xyz"[i]), "exchange them");
      return std::nullopt;
    }
    nodes *= std::floor((form.upper[i] - form.lower[i]) / form.step + 1e-9) + 1;
  }
  if (nodes > max_nodes) {
    table->error("step", fmt::format("makes {:.3g} nodes, at most {:.3g} are allowed", nodes, max_nodes),
                 "take a larger step or a smaller box");
    return std::nullopt;
  }
  if (d.robot.freedom == Freedom::plane_translation && (form.lower[2] != 0 || form.upper[2] != 0)) {
    table->error("lower", "must have z = 0: the robot is planar", "write [x, y, 0]");
    return std::nullopt;
  }
  if (!d.tool_turns() && table->has("rotation")) {
    table->error("rotation", "the platform of this robot does not turn", "leave it out");
    return std::nullopt;
  }
  out.large = nodes > max_in_memory;
  if (out.large && form.inscribed) {
    table->error(
        "inscribed",
        fmt::format("needs all nodes in memory: at most {:.3g}, these are {:.3g}", max_in_memory, nodes),
        "take a larger step or a smaller box");
    return std::nullopt;
  }
  if (form.indices.empty()) {
    table->error("indices", "name at least one");
    return std::nullopt;
  }
  if (std::set(form.indices.begin(), form.indices.end()).size() < form.indices.size()) {
    table->error("indices", "one is named twice");
    return std::nullopt;
  }
  if (form.inscribed) {
    auto inner = table->table("inscribed");
    const bool planar = d.robot.freedom == Freedom::plane_translation;
    if (planar && form.inscribed->shape == InscribedShape::cylinder) {
      inner->error("shape", "a cylinder needs space", "take ball (a circle) or box (a rectangle)");
      return std::nullopt;
    }
    if (form.inscribed->shape != InscribedShape::cylinder &&
        (form.inscribed->axis || form.inscribed->height || form.inscribed->ratio)) {
      inner->error("shape", "axis, height and ratio are those of a cylinder", "leave them out");
      return std::nullopt;
    }
    if (form.inscribed->height && form.inscribed->ratio) {
      inner->error("ratio", "is given together with the height", "keep one of them");
      return std::nullopt;
    }
    for (const std::size_t i : {0u, 1u, 2u})
      if (!(planar && i == 2) && form.upper[i] - form.lower[i] < form.step) {
        inner->error("shape",
                     fmt::format("the box has no extent along {}: nothing can be inscribed", "xyz"[i]));
        return std::nullopt;
      }
  }
  constexpr std::array<std::string_view, 1> rotation = {"rotation"};
  canonical["workspace"] =
      d.tool_turns() ? study::write_fields(form) : without(study::write_fields(form), rotation);
  return out;
}

void describe_workspace(study::SchemaWriter& document) {
  document.property(field::entry("workspace", "grid of places of the platform point"),
                    study::schema_fields<WorkspaceForm>());
}

void add_workspace(study::Result& result, const RobotDescription& d, const QualityLimits& limits,
                   const WorkspaceStudy& s, const Pose& home, RunContext& context) {
  const WorkspaceForm& f = s.form;
  WorkspaceTask task{.conditions = conditions_of(d, limits, home),
                     .grid = {vec(f.lower), vec(f.upper), f.step},
                     .rotation = math::turn_about(vec(f.rotation))};
  task.wanted[slot(PoseIndex::conditioning)] = true;
  for (const PoseIndex index : f.indices) task.wanted[slot(index)] = true;
  WorkspaceMap map;
  WorkspaceSurvey all;
  if (s.large) {
    all = survey_workspace(task, context);
  } else {
    map = workspace(task, context);
    all = {.status = map.status, .nodes = map.nodes, .cell = map.cell, .count = map.count()};
    all.totals = totals(map);
    all.passing = passing_by_level(map);
  }
  if (all.status != Status::done) result.status = all.status;
  const WorkspaceTotals& sums = all.totals;
  const bool planar = d.robot.freedom == Freedom::plane_translation;
  const int axes = planar ? 2 : 3;
  result.tables.push_back(totals_table(sums, all.count, all.cell, axes));
  const study::AddFact fact{result.facts};
  fact("workspace",
       say("{} ({} of {} nodes)", area_or_volume(sums.measure, planar), sums.passing, all.count));
  const IndexSummary lci = sums.index[slot(PoseIndex::conditioning)];
  if (lci.count > 0)
    fact("global conditioning index",
         say("{} (least {})", plain_number(lci.mean).fixed(4), plain_number(lci.least).fixed(4)));

  if (planar) fact("area within reach of the legs", measured("m2", reachable_area(d.robot), 6).spelled());
  if (f.aspects && s.large)
    fact("joined to home without a singularity",
         say("not looked at: {} nodes are more than {}", plain_number(static_cast<double>(all.count), 3),
             plain_number(max_in_memory, 3)));
  if (f.aspects && !s.large && sums.passing > 0) {
    const WorkspaceAspects aspects = workspace_aspects(
        map, passing(map), {.conditions = task.conditions, .rotation = task.rotation, .home = home.position},
        context);
    if (aspects.status == Status::done)
      fact("joined to home without a singularity",
           aspects.home < 0 ? Sentence("none: home does not pass")
                            : say("{} of {} nodes, {} aspect{}", aspects.reachable(), aspects.all(),
                                  aspects.size.size(), aspects.size.size() == 1 ? "" : "s"));
  }
  if (f.inscribed) add_inscribed(result, map, task, *f.inscribed, planar, context);
  if (d.tool_turns()) add_rotation_range(result, task.conditions, home, context);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < map.count(); ++i)
    if (map.criterion[i] != Criterion::leg && map.criterion[i] != Criterion::open) reached.push_back(i);
  const std::size_t rows =
      s.large ? all.count - sums.count[static_cast<std::size_t>(Criterion::leg)] : reached.size();
  if (f.nodes && rows <= max_rows && !s.large)
    result.tables.push_back(node_table({{&map, reached}}, s, planar, "workspace"));
  if (f.nodes && rows > max_rows)
    fact("table of nodes", say("left out: {} nodes are more than {}", rows, max_rows));
  const auto levels = all.nodes[2] > 1 ? levels_of(all.passing, f.slices)
                                       : std::vector<std::size_t>(sums.passing > 0 ? 1 : 0);
  std::vector<double> heights;
  for (const std::size_t level : levels) heights.push_back(f.lower[2] + f.step * static_cast<double>(level));
  if (f.boundary > 0) result.tables.push_back(boundary_table(task, heights, f, home, planar, context));
  result.tables.push_back(slice_table(map, task, s, levels, heights, context));
  for (const PoseIndex index : f.indices)
    result.plots.push_back({.name = fmt::format("workspace-{}", name_of(index)),
                            .title = fmt::format("Workspace: {}", words_of(index)),
                            .table = "workspace_slices",
                            .x = "x_m",
                            .y = {"y_m", key_of(index)},
                            .style = study::Plot::Style::map,
                            .group = planar ? "" : "z_m"});
  if (result.headline.empty())
    result.headline = say("Workspace {}, mean conditioning {}.", area_or_volume(sums.measure, planar),
                          plain_number(lci.count > 0 ? lci.mean : 0).fixed(3));
}

}  // namespace linkwright::parallel
