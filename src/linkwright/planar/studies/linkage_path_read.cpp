// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity_columns.h"
#include "linkwright/planar/studies/linkage_path.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"

namespace linkwright::planar {
namespace {

constexpr QuantityColumn path_columns[] = {{"time", Dimension::time},
                                           {"x", Dimension::length},
                                           {"y", Dimension::length},
                                           {"angle", Dimension::angle}};

// The rows of a CSV; problems go to the diagnostics.
std::optional<PathTable> read_path_table(std::string_view text, const std::string& file,
                                         Diagnostics& diagnostics) {
  const std::optional<Table> table = read_csv(text, file, diagnostics);
  if (!table) return std::nullopt;
  const std::size_t before = diagnostics.size();
  const Quantities found = read_quantities(*table, path_columns, "time, x, y and angle", file, diagnostics);
  for (std::size_t k = 0; k < found.values.size(); ++k) {
    if (k < 3 && found.keys[k].empty()) report_missing(path_columns[k], file, diagnostics);
    const std::vector<double>& values = found.values[k];
    const auto bad =
        std::find_if(values.begin(), values.end(), [](double v) { return !(std::abs(v) <= 1e9); });
    if (bad != values.end())
      diagnostics.push_back({.file = file,
                             .key = found.keys[k],
                             .message = fmt::format("row {} holds no number", bad - values.begin() + 1)});
  }
  if (table->rows() < 2)
    diagnostics.push_back({.file = file, .message = fmt::format("{} rows, needs at least 2", table->rows())});
  if (diagnostics.size() != before) return std::nullopt;
  PathTable out{.file = file, .times = found.values[0]};
  for (std::size_t i = 0; i < table->rows(); ++i)
    out.points.push_back({found.values[1][i], found.values[2][i]});
  out.angles = found.values[3];
  return out;
}

void read_path_files(study::ObjectReader& table, const study::Common& common, PointPath& path) {
  auto steps = table.tables("step");
  for (std::size_t i = 0; i < std::min(path.steps.size(), steps.size()); ++i) {
    auto* rows = std::get_if<PathTable>(&path.steps[i].form);
    if (!rows || rows->file.empty()) continue;
    const auto text = study::read_beside(steps[i], "file", common.folder, rows->file);
    if (!text) continue;
    Diagnostics problems;
    const auto read = read_path_table(*text, rows->file, problems);
    for (const Diagnostic& one : problems) steps[i].unreadable("file", study::in_file(one));
    if (!read) continue;
    rows->times = read->times;
    rows->points = read->points;
    rows->angles = read->angles;
    rows->file.clear();  // the canonical study holds the places themselves
  }
}

std::vector<std::string_view> joint_names(const Linkage& l, const std::vector<int>& joints) {
  std::vector<std::string_view> out;
  for (const int j : joints) out.push_back(l.joints[at(j)].name);
  return out;
}

std::string counted_drives(std::size_t n) {
  constexpr const char* words[] = {"no drives", "one drive", "two drives", "three drives"};
  return n < 4 ? words[n] : fmt::format("{} drives", n);
}

constexpr std::array<std::string_view, 5> asked_words = {"a point", "x of a point", "y of a point",
                                                         "the angle of a body", "a point with an angle"};

std::string place_text(math::Vec2 p) { return fmt::format("({:.6g}, {:.6g}) mm", 1e3 * p.x, 1e3 * p.y); }

}  // namespace

void read_path_drives(study::ObjectReader& document, Linkage& l, bool own_drives) {
  auto table = document.table("path");
  if (!table) return;
  std::vector<std::string> drives;
  if (!(*table)(field::entry("drives"), drives)) return;
  for (const std::string& name : drives) {
    const int j = joint_index(l, name);
    if (j < 0) {
      std::vector<std::string_view> known;
      for (const LinkageJoint& k : l.joints) known.push_back(k.name);
      table->no_such("drives", "joint", name, known);
    } else if (std::find(l.driven.begin(), l.driven.end(), j) == l.driven.end()) {
      if (own_drives)
        table->error("drives",
                     fmt::format("this mechanism takes a drive at {}, not at '{}'",
                                 fmt::join(joint_names(l, l.driven), " and "), name),
                     "name that joint, or give bodies and joints instead, of which any may have the drive");
      else
        l.driven.push_back(j);
    }
  }
}

std::optional<LinkagePath> read_path(study::ObjectReader& document, const study::Common& common,
                                     const Linkage& l, const LinkagePlan& plan, LinkagePathForm& form) {
  auto table = document.table("path");
  if (!table) return std::nullopt;
  table->read(form);
  read_path_files(*table, common, form.path);
  if (document.document().has_errors()) return std::nullopt;
  LinkagePath out;
  const auto dot = form.point.rfind('.');
  const int body = dot == std::string::npos ? -1 : body_index(l, form.point.substr(0, dot));
  const int index = body < 0 ? -1 : point_index(l.bodies[at(body)], form.point.substr(dot + 1));
  if (index < 0) {
    table->error("point", fmt::format("there is no point '{}'", form.point),
                 "write body.point, as \"bucket.T\"");
    return std::nullopt;
  }
  if (plan.bodies[at(body)].part == 0) {
    table->error("point", fmt::format("the point '{}' is fixed to the ground", form.point),
                 "name a point of a body that moves");
    return std::nullopt;
  }
  out.point = {body, l.bodies[at(body)].points[at(index)].at, form.along, {}};
  out.traced = {body, index};
  if (form.drives.empty()) {
    // Those without a law of their own.
    std::vector<std::string> with_law;
    for (study::ObjectReader& drive : drive_tables(document))
      if (std::string joint; drive.has("law") && drive(field::entry("joint"), joint))
        with_law.push_back(std::move(joint));
    for (std::size_t k = 0; k < plan.inputs(); ++k)
      if (const std::string& name = input_joint(l, k).name;
          std::find(with_law.begin(), with_law.end(), name) == with_law.end())
        form.drives.push_back(name);
  }
  for (const std::string& name : form.drives)
    for (std::size_t k = 0; k < plan.inputs(); ++k)
      if (input_joint(l, k).name == name) out.point.drives.push_back(k);
  const std::size_t asked = drives_of(form.along), free = out.point.drives.size();
  if (asked != free) {
    table->error("drives",
                 fmt::format("{} asks for {}, {} {} free", asked_words[static_cast<std::size_t>(form.along)],
                             counted_drives(asked), free, free == 1 ? "is" : "are"),
                 free == 1      ? "along = \"x\" or \"y\" lets the point follow that coordinate alone"
                 : free > asked ? "name those that follow in `drives`, and give each of the others a law in "
                                  "[[drive]]"
                                : "give the linkage as many drives");
    return std::nullopt;
  }
  out.form = form.path;
  out.samples = form.samples;
  return out;
}

namespace {

// The places of the drives, by a search over all of their range, that bring the point nearest to the target.
std::optional<std::vector<InputMotion>> search_start(const LinkagePlan& plan, const LinkagePath& path,
                                                     std::vector<InputMotion> inputs,
                                                     const std::vector<bool>& known,
                                                     const PathState& target) {
  constexpr int steps = 24;
  std::vector<std::size_t> searched;
  for (const std::size_t k : path.point.drives)
    if (!known[k]) searched.push_back(k);
  long places = 1;
  for (std::size_t i = 0; i < searched.size(); ++i) places *= steps;
  std::vector<std::pair<double, std::vector<InputMotion>>> near;
  LinkageInverse inverse(plan, path.point);
  for (long n = 0; n < places; ++n) {
    long rest = n;
    for (const std::size_t k : searched) {
      const double share = static_cast<double>(rest % steps) / steps;
      inputs[k].value = plan.rotary[k] ? full_turn * (share - 0.5) : 2 * plan.size * (share + 0.5 / steps);
      rest /= steps;
    }
    solve_position(plan, inputs, inverse.motion);
    if (inverse.motion.status != Status::done) continue;
    near.emplace_back(norm(inverse.state().position - target.position), inputs);
  }
  std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < std::min<std::size_t>(near.size(), 40); ++i)
    if (auto start = path_start(plan, path.point, near[i].second, near[i].second, target)) return start;
  return std::nullopt;
}

}  // namespace

bool find_path_start(study::ObjectReader& document, const LinkageDescription& description,
                     const std::vector<LinkageDrive>& drives, LinkagePathForm& form, LinkagePath& path) {
  auto table = document.table("path");
  const LinkagePlan& plan = description.plan;
  const bool drawn = !plan.drawn_inputs.empty();
  const bool angled = form.along == FollowedCoordinates::angle || form.along == FollowedCoordinates::pose;
  std::vector<InputMotion> guess(plan.inputs()), begin(plan.inputs());
  std::vector<bool> known(plan.inputs(), drawn);
  for (std::size_t k = 0; k < plan.inputs(); ++k) {
    if (drawn) guess[k].value = plan.drawn_inputs[k];
    if (drives[k].law) begin[k].value = math::MotionCurve(*drives[k].law)(0).value;
    if (drives[k].law && !drawn) guess[k].value = begin[k].value, known[k] = true;
    if (drives[k].limits.start) guess[k].value = *drives[k].limits.start, known[k] = true;
  }
  const bool located = std::find(known.begin(), known.end(), false) == known.end();
  PathState at_guess;
  if (located) {
    LinkageInverse inverse(plan, path.point);
    solve_position(plan, guess, inverse.motion);
    if (inverse.motion.status != Status::done) {
      table->error("from",
                   "the linkage does not assemble with its drives as they are drawn or given by `path_start`",
                   "correct the drawing, or `path_start` of the drives");
      return false;
    }
    at_guess = inverse.state();
  }
  const auto* rows = form.path.steps.empty() ? nullptr : std::get_if<PathTable>(&form.path.steps[0].form);
  if (rows && !rows->points.empty()) {
    if (form.from && std::hypot((*form.from)[0] - rows->points[0][0], (*form.from)[1] - rows->points[0][1]) >
                         1e-6 * plan.size) {
      table->error("from", "the path begins with a table, whose first place is another", "leave `from` out");
      return false;
    }
    form.from = rows->points[0];
    if (!rows->angles.empty()) form.from_angle = rows->angles[0];
  }
  if (!form.from && !located) {
    table->missing(field::length("from"), "give the place where the path begins");
    return false;
  }
  if (!form.from) form.from = PathPlace{at_guess.position.x, at_guess.position.y};
  if (angled && !form.from_angle && !located) {
    table->missing(field::angle("from_angle"), "give the angle of the body where the path begins");
    return false;
  }
  if (!form.from_angle && angled) form.from_angle = at_guess.angle;
  path.from = {(*form.from)[0], (*form.from)[1]};
  path.angle = form.from_angle.value_or(0);
  if (const auto wrong = problem(path.form, path.from)) {
    auto steps = table->tables("step");
    (at(wrong->step) < steps.size() ? steps[at(wrong->step)] : *table)
        .error(wrong->key, wrong->message, wrong->hint);
    return false;
  }
  const PathState target = PointPathMotion(path.form, path.from, path.angle)(0);
  auto start = located ? path_start(plan, path.point, guess, begin, target) : std::nullopt;
  if (!start && !located) start = search_start(plan, path, begin, known, target);
  if (!start) {
    const std::string where = form.along == FollowedCoordinates::angle
                                  ? fmt::format("{:.6g} deg", path.angle * 180 / pi)
                                  : place_text(path.from);
    table->error("from", fmt::format("the linkage does not reach {}, where the path begins", where),
                 "begin it within reach; `path_start` of the drives says from where they go there");
    return false;
  }
  path.start = std::move(*start);
  return true;
}

void describe_path(study::SchemaWriter& document) {
  document.property(
      field::entry("path", "path of a point that the drives follow, in place of their motion and of [sweep]"),
      study::schema_fields<LinkagePathForm>());
}

}  // namespace linkwright::planar
