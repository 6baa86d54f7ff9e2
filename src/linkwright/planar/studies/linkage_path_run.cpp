// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/linkage_path.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

constexpr int path_targets = 60;  // places of the path in the scene, at most

std::vector<double> path_times(const LinkageStudy& s) {
  const auto& times = std::get<study::TimeSamples>(s.sweep);
  std::vector<double> out;
  for (int i = 0; i < times.samples; ++i) out.push_back(times.to * i / (times.samples - 1));
  return out;
}

PointPathMotion motion_of(const LinkagePath& path) { return {path.form, path.from, path.angle}; }

bool is_angle(const LinkagePath& path) { return path.point.followed == FollowedCoordinates::angle; }

Sentence path_place(const LinkageStudy& s, const PathState& at) {
  if (is_angle(*s.path)) return say("{}", degrees_of(at.angle, 6));
  return say("({}, {})", s.units.measured(at.position.x, Dimension::length, 6),
             s.units.measured(at.position.y, Dimension::length, 6));
}

void add_path_target(const LinkageStudy& s, const PathDrives& found, const PointPathMotion& path,
                     study::Scene& scene) {
  if (is_angle(*s.path)) return;
  study::Scene::Target target{.name = "path"};
  const auto followed = s.path->point.followed;
  const auto add = [&](double time) {
    const PathState state = path(time);
    const PathState reached = path(std::min(time, found.end));
    target.x.push_back(state.position.x), target.y.push_back(state.position.y);
    target.achieved_x.push_back(reached.position.x), target.achieved_y.push_back(reached.position.y);
    target.achieved_input.push_back(std::min(time, found.end));
  };
  // A coordinate that is not followed has no place of its own.
  if (followed == FollowedCoordinates::x || followed == FollowedCoordinates::y) return;
  for (int i = 0; i <= path_targets; ++i) add(path.duration() * i / path_targets);
  scene.targets.push_back(std::move(target));
}

}  // namespace

LinkageRows path_rows(const LinkageStudy& s) {
  LinkageRows rows;
  std::vector<std::optional<math::MotionCurve>> laws;
  for (const LinkageDrive& d : s.drives)
    laws.push_back(d.law ? std::optional(math::MotionCurve(*d.law)) : std::nullopt);
  rows.path =
      follow_path(s.linkage, s.plan, s.path->point, motion_of(*s.path), laws, s.path->start, path_times(s));
  for (const PathRow& row : rows.path->rows) {
    rows.time.push_back(row.time);
    rows.inputs.push_back(row.inputs);
  }
  return rows;
}

void add_drive_motion_columns(const LinkageStudy& s, std::vector<LinkageColumn>& columns) {
  for (std::size_t k = 0; k < s.plan.inputs(); ++k) {
    const bool rotary = s.plan.rotary[k];
    const std::string& name = input_joint(s.linkage, k).name;
    const auto add = [&](const char* what, Dimension dimension, auto value) {
      const Quantity quantity{fmt::format("{}_drive_{}", identifier(name), what),
                              fmt::format("drive {} at {}", what, name), dimension};
      columns.push_back({quantity.column_key(), quantity.label(), std::move(value)});
    };
    if (s.quantities.rates) {
      add("speed", rotary ? Dimension::speed_angular : Dimension::speed,
          [k](const LinkageInstant& i) { return i.inputs[k].rate; });
      add("acceleration", rotary ? Dimension::acceleration_angular : Dimension::acceleration,
          [k](const LinkageInstant& i) { return i.inputs[k].acceleration; });
    }
    if (s.quantities.power)
      add("power", Dimension::power,
          [k](const LinkageInstant& i) { return i.forces->drives[k] * i.inputs[k].rate; });
  }
}

Table empty_path_table() {
  Table table{.name = "path"};
  table.add({"time", "time", Dimension::time});
  table.add({"path_x", "path x", Dimension::length});
  table.add({"path_y", "path y", Dimension::length});
  table.add({"path_angle", "path angle of the body", Dimension::angle});
  table.add({"path_share", "share of the path", Dimension::none});
  table.add(
      {"conditioning", "conditioning of the drives, least over greatest singular value", Dimension::none});
  return table;
}

void add_path(const LinkageStudy& s, const LinkageRows& rows, study::Result& result) {
  const PathDrives& found = *rows.path;
  const PointPathMotion path = motion_of(*s.path);
  Table table = empty_path_table();
  for (const PathRow& row : found.rows) {
    const PathState state = path(row.time);
    const double values[] = {row.time,    state.position.x,     state.position.y,
                             state.angle, path.share(row.time), row.conditioning};
    for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].values.push_back(values[c]);
    table.status.emplace_back(to_string(row.singular ? Status::singular : Status::done));
  }
  result.tables.push_back(std::move(table));
  if (!result.scenes.empty()) add_path_target(s, found, path, result.scenes[0]);
  using Verdict = study::Fact::Verdict;
  const study::AddFact fact{result.facts};
  const bool whole = found.status == Status::done;
  const PathState& last = found.last;
  Sentence begins;
  for (const std::size_t k : s.path->point.drives)
    begins += say("{}{} {}", begins.empty() ? "" : ", ", input_joint(s.linkage, k).name,
                  study::angle_or_length(s.path->start[k].value, s.plan.rotary[k], 6));
  fact("drives at the beginning of the path", begins);
  fact("share of the path reached", percent(found.share), whole ? Verdict::good : Verdict::bad);
  fact("duration of the path", seconds(path.duration()));
  if (path.length() > 0) fact("length of the path", s.units.measured(path.length(), Dimension::length));
  Sentence text;
  if (whole) {
    text = "The path is followed to its end.";
  } else {
    const Sentence ends = say("the path is reached to {}, {}", percent(found.share, 6), path_place(s, last));
    result.status = found.status;
    result.troubles.push_back(
        {.what = "path", .where = {{"time_s", found.end}}, .why = say("{}: {}", ends, found.reason)});
    const study::AddWarning warn{result.diagnostics};
    warn("path.step", say("{}: {}", ends, found.reason),
         "end the path there, move it, or change the linkage");
    text =
        say("The path is reached to {}, {}: {}.", percent(found.share, 6), path_place(s, last), found.reason);
  }
  result.headline = result.headline.empty() ? text : text + say(" {}", result.headline);
}

}  // namespace linkwright::planar
