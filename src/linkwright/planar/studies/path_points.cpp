// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/type_synthesis/stroke.h"
#include "linkwright/study/beside.h"

namespace linkwright::planar {
namespace {

/// How many points a target may have, and if one may follow that is the same: it is then left out.
struct PointRules {
  std::size_t least = 3, most = 2000;
  bool merge_repeated = false;
  bool from_drawing = false;  // a drawing may give them
};

// The lengths of a CSV file by the name of their column, in metres; any length unit.
class LengthColumns {
 public:
  LengthColumns(study::ObjectReader& reader, const std::string& file, const Table& table)
      : reader_(reader), file_(file), table_(table) {}

  bool has(std::string_view base) const { return find(base) != nullptr; }

  // True if all columns are present; else reports the columns of the file.
  bool complete(std::span<const char* const> bases) {
    if (std::all_of(bases.begin(), bases.end(), [&](const char* base) { return has(base); })) return true;
    std::vector<std::string> found;
    for (const Column& c : table_.columns) found.push_back(c.key);
    reader_.error(
        "points_file",
        fmt::format("'{}' has the columns {}, but needs {}, each with a unit of length", file_,
                    fmt::join(found, ", "), fmt::join(bases, ", ")),
        fmt::format("name them {}_mm; a heading like X [mm] will do, too", fmt::join(bases, "_mm,")));
    return false;
  }

  // Every cell of a column that is there.
  std::vector<double> values(std::string_view base) {
    const Column* column = find(base);
    std::vector<double> out;
    for (const double v : column->values) {
      out.push_back(split_unit(column->key)->unit->to_si(v));
      if (std::isfinite(out.back())) continue;
      reader_.error("points_file", fmt::format("'{}': point {} is incomplete", file_, out.size()),
                    fmt::format("give it a number in column {}", column->key));
      return {};
    }
    return out;
  }

 private:
  const Column* find(std::string_view base) const {
    for (const Column& c : table_.columns) {
      const auto key = split_unit(c.key);
      if (key && key->base == base && key->dimension == Dimension::length) return &c;
    }
    return nullptr;
  }

  study::ObjectReader& reader_;
  const std::string& file_;
  const Table& table_;
};

constexpr std::array<const char*, 2> coordinates = {"x", "y"};
constexpr std::array<const char*, 4> posts = {"from_x", "from_y", "to_x", "to_y"};

// Points of a drawn line: at most `rules.most`, and more on its sides where it has fewer than `rules.least`.
// A closed line ends at its first point. False where the drawing has no line, and that has been reported.
bool read_drawn_points(study::ObjectReader& reader, const study::Common& common, const std::string& file,
                       std::string_view text, const PointRules& rules, PathTargets& targets) {
  if (!rules.from_drawing) {
    reader.error("points_file", fmt::format("'{}' is a drawing, this study meets single points", file),
                 "write them as a table with the columns x_mm, y_mm, or draw the line with planar.any");
    return false;
  }
  Diagnostics problems;
  std::optional<DrawnLine> line = read_drawing(text, (common.folder / file).string(), problems);
  for (const Diagnostic& problem : problems) reader.unreadable("points_file", study::in_file(problem));
  if (!line) return false;
  if (!line->has_unit)
    reader.warning("points_file",
                   fmt::format("'{}' names no unit of length: its numbers are taken as mm", file),
                   "save an SVG page with its width and height in mm, or a DXF drawing with $INSUNITS");
  std::vector<std::complex<double>> points = std::move(line->points);
  if (points.size() > rules.most) {
    reader.warning("points_file", fmt::format("the line of '{}' has {} points: taken at {} equal steps", file,
                                              points.size(), rules.most - 1));
    points = equal_steps(points, line->closed, rules.most - 1);
  }
  if (line->closed) points.push_back(points.front());
  const std::size_t sides = points.size() - 1, parts = (rules.least + sides - 1) / sides;
  for (std::size_t i = 0; i < sides; ++i)
    for (std::size_t k = 0; k < parts; ++k) {
      const auto p =
          points[i] + static_cast<double>(k) / static_cast<double>(parts) * (points[i + 1] - points[i]);
      targets.x.push_back(p.real()), targets.y.push_back(p.imag());
    }
  targets.x.push_back(points.back().real()), targets.y.push_back(points.back().imag());
  return true;
}

// False where something is missing, and has been reported.
bool read_points_file(study::ObjectReader& reader, const study::Common& common, const std::string& file,
                      bool with_bands, const PointRules& rules, PathTargets& targets) {
  const std::optional<std::string> text = study::read_beside(reader, "points_file", common.folder, file);
  if (!text) return false;
  if (drawing_format(*text) != DrawingFormat::none)
    return read_drawn_points(reader, common, file, *text, rules, targets);
  Diagnostics problems;
  const std::optional<Table> table = read_csv(*text, (common.folder / file).string(), problems);
  for (const Diagnostic& problem : problems) reader.unreadable("points_file", study::in_file(problem));
  if (!table) return false;
  LengthColumns columns(reader, file, *table);
  const bool gates =
      std::any_of(posts.begin(), posts.end(), [&](const char* post) { return columns.has(post); });
  if (!with_bands && (gates || columns.has("tolerance"))) {
    reader.error(
        "points_file",
        fmt::format("'{}' has {}, this study meets points exactly", file, gates ? "gates" : "tolerances"),
        "keep the columns x and y");
    return false;
  }
  if (gates && (columns.has("x") || columns.has("y"))) {
    reader.error("points_file", fmt::format("'{}' has both points and gates", file),
                 "keep the columns x, y or from_x, from_y, to_x, to_y; a gate whose posts agree is a point");
    return false;
  }
  if (gates ? !columns.complete(posts) : !columns.complete(coordinates)) return false;
  const std::size_t rows = table->columns.empty() ? 0 : table->columns[0].values.size();
  const auto read = [&](const char* base, std::vector<double>& out) {
    out = columns.values(base);
    return out.size() == rows;
  };
  if (gates) {
    std::array<std::vector<double>, posts.size()> post;
    for (std::size_t i = 0; i < posts.size(); ++i)
      if (!read(posts[i], post[i])) return false;
    for (std::size_t k = 0; k < rows; ++k) {
      targets.x.push_back(0.5 * (post[0][k] + post[2][k]));
      targets.y.push_back(0.5 * (post[1][k] + post[3][k]));
      targets.gate_x.push_back(0.5 * (post[2][k] - post[0][k]));
      targets.gate_y.push_back(0.5 * (post[3][k] - post[1][k]));
    }
  } else {
    const bool x = read("x", targets.x), y = read("y", targets.y);
    if (!x || !y) return false;
  }
  if (!columns.has("tolerance")) return true;
  if (!read("tolerance", targets.tolerance)) return false;
  for (std::size_t k = 0; k < rows; ++k)
    if (targets.tolerance[k] < 0) {
      reader.error("points_file", fmt::format("'{}': the tolerance of point {} is negative", file, k + 1),
                   "write 0 or more");
      return false;
    }
  return true;
}

// Largest distance from the origin along an axis (m).
double farthest(const std::vector<double>& x, const std::vector<double>& y) {
  double far = 0;
  for (std::size_t k = 0; k < x.size(); ++k) far = std::max({far, std::abs(x[k]), std::abs(y[k])});
  return far;
}

// Points that agree to rounding of their coordinates, `far` from the origin at most, are the same.
bool same_point(const std::vector<double>& x, const std::vector<double>& y, double far, std::size_t a,
                std::size_t b) {
  return std::hypot(x[a] - x[b], y[a] - y[b]) <= 1e-12 * far;
}

// Leaves out points that repeat the one before, with a warning.
void merge_repeated(study::ObjectReader& target, const char* key, PathTargets& targets) {
  std::vector<double> x, y;
  const double far = farthest(targets.x, targets.y);
  for (std::size_t k = 0; k < targets.x.size(); ++k)
    if (k == 0 || !same_point(targets.x, targets.y, far, k, k - 1))
      x.push_back(targets.x[k]), y.push_back(targets.y[k]);
  if (x.size() == targets.x.size()) return;
  const std::size_t left_out = targets.x.size() - x.size();
  target.warning(key, fmt::format("{} point{} repeat{} the one before: taken once", left_out,
                                  left_out == 1 ? "" : "s", left_out == 1 ? "s" : ""));
  targets.x = std::move(x), targets.y = std::move(y);
}

// Enough targets and none twice in a row; problems are reported at `key`.
void check_targets(study::ObjectReader& target, const char* key, const PointRules& rules,
                   PathTargets& targets) {
  if (rules.merge_repeated) merge_repeated(target, key, targets);
  const std::vector<double>&x = targets.x, &y = targets.y;
  const std::size_t n = x.size();
  if (n == 0) {
    target.error(key, "there are no points", fmt::format("give at least {} points [x, y]", rules.least));
    return;
  }
  if (n < rules.least) {
    target.error(key,
                 fmt::format("{} point{} make{} no path, at least {} are needed", n, n == 1 ? "" : "s",
                             n == 1 ? "s" : "", rules.least),
                 "add points between them");
    return;
  }
  if (n > rules.most) {
    target.error(key, fmt::format("{} points, at most {} are allowed", n, rules.most),
                 "keep every second or third point");
    return;
  }
  const double far = farthest(x, y);
  if (far > 1e9) {
    target.error(key, fmt::format("a point lies {:.3g} m from the origin, at most 1e9 m are allowed", far),
                 "check the unit");
    return;
  }
  for (std::size_t k = 1; k < n; ++k)
    if (same_point(x, y, far, k, k - 1))
      target.error(key, fmt::format("point {} repeats point {}: ({}, {})", k + 1, k, x[k], y[k]),
                   "remove one of them");
}

void read_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                 bool with_bands, const PointRules& rules, PathTargets& targets) {
  const bool has_points = target.has(field::length("points"));
  const bool has_file = target.has("points_file");
  if (has_points && has_file) {
    target.error("points_file", "the target has both points and points_file", "keep one of them");
    return;
  }
  if (!has_points && !has_file) {
    target.error("points", "the target has no points",
                 "write points_m = [[x, y], ...] or points_file = \"path.csv\"");
    return;
  }
  if (has_file) {
    if (form.points_file && !read_points_file(target, common, *form.points_file, with_bands, rules, targets))
      targets = {};
    else if (form.points_file)
      check_targets(target, "points_file", rules, targets);
    return;
  }
  if (!form.points) return;  // reported already
  for (const auto& point : *form.points) {
    targets.x.push_back(point[0]);
    targets.y.push_back(point[1]);
  }
  check_targets(target, "points", rules, targets);
}

// The middles of gates, and half of the way from one post to the other.
void read_gates(study::ObjectReader& target, const PathTargetForm& form, PathTargets& targets) {
  const bool has_points = target.has(field::length("points"));
  if (has_points || target.has("points_file")) {
    target.error("gates",
                 fmt::format("the target has both gates and {}", has_points ? "points" : "points_file"),
                 "keep one of them; a gate whose posts agree is a point");
    return;
  }
  for (const PathGate& gate : *form.gates) {
    targets.x.push_back(0.5 * (gate.from[0] + gate.to[0]));
    targets.y.push_back(0.5 * (gate.from[1] + gate.to[1]));
    targets.gate_x.push_back(0.5 * (gate.to[0] - gate.from[0]));
    targets.gate_y.push_back(0.5 * (gate.to[1] - gate.from[1]));
  }
  check_targets(target, "gates", {}, targets);
}

void read_tolerances(study::ObjectReader& target, const PathTargetForm& form, PathTargets& targets) {
  if (form.tolerance && form.tolerances) {
    target.error("tolerances", "the target has both tolerance and tolerances", "keep one of them");
    return;
  }
  if (!form.tolerance && !form.tolerances) return;
  if (!targets.tolerance.empty()) {
    target.error(form.tolerance ? "tolerance" : "tolerances", "the points file also has tolerances",
                 "keep the key or the column");
    return;
  }
  if (form.tolerance) targets.tolerance.assign(targets.x.size(), *form.tolerance);
  if (!form.tolerances) return;
  if (targets.x.size() >= 3 && form.tolerances->size() != targets.x.size()) {
    target.error("tolerances",
                 fmt::format("{} tolerances for {} targets", form.tolerances->size(), targets.x.size()),
                 "give one for each, or tolerance for all");
    return;
  }
  targets.tolerance = *form.tolerances;
}

// Crank rotation that the timing gives from the first to the last of so many points.
std::optional<double> turned(const PathTiming& t, std::size_t points) {
  if (t.mode == Timing::equal_steps && t.step) return *t.step * static_cast<double>(points - 1);
  if (t.mode == Timing::increments && t.increments && t.increments->size() + 1 == points)
    return std::accumulate(t.increments->begin(), t.increments->end(), 0.0);
  if (t.mode == Timing::given && t.angles && t.angles->size() == points)
    return t.angles->back() - t.angles->front();
  return std::nullopt;
}

// Leaves out what the timing says of the last point alone.
void leave_out_closing_angle(PathTiming& t) {
  if (t.mode == Timing::increments) t.increments->pop_back();
  if (t.mode == Timing::given) t.angles->pop_back();
}

// True if a crank rotation is one turn, in either sense, to rounding (rad).
bool is_one_turn(double turned) { return std::abs(std::abs(turned) - 2 * pi) < 1e-6; }

// Leaves out the last target where it is the first one again and the path is closed, or is to be: then the
// path is said to be closed. True when it was left out.
bool leave_out_closing_target(study::ObjectReader& target, const char* key, std::optional<double> turned,
                              PathTargets& targets) {
  const std::size_t n = targets.x.size();
  if (n < 4 || !repeats_first_point(targets.x, targets.y)) return false;
  if (!targets.gate_x.empty() &&
      (targets.gate_x.front() != targets.gate_x.back() || targets.gate_y.front() != targets.gate_y.back()))
    return false;
  const char* what = targets.gate_x.empty() ? "point" : "gate";
  if (targets.closed) {
    target.warning(key, fmt::format("the last of {} {}s repeats the first: taken once", n, what),
                   fmt::format("closed = true joins the last {} to the first", what));
  } else {
    if (target.has("closed") || (turned && !is_one_turn(*turned))) return false;
    target.warning(
        key, fmt::format("the last of {} {}s repeats the first: taken once, and the path as closed", n, what),
        "write closed = true, or closed = false to keep it open");
    targets.closed = true;
  }
  for (auto* values : {&targets.x, &targets.y, &targets.gate_x, &targets.gate_y, &targets.tolerance})
    if (!values->empty()) values->pop_back();
  return true;
}

}  // namespace

bool repeats_first_point(const std::vector<double>& x, const std::vector<double>& y) {
  return x.size() > 1 && x.size() == y.size() && same_point(x, y, farthest(x, y), 0, x.size() - 1);
}

std::vector<double> timed_angles(study::ObjectReader& target, const study::DisplayUnits& units,
                                 const PathTiming& t, std::size_t points) {
  const auto only_for = [&](bool there, const char* what, Timing mode) {
    if (there && t.mode != mode)
      target.error("timing", fmt::format("{} mode {}, the mode is {}", what, name_of(mode), name_of(t.mode)),
                   "keep only what the mode needs");
  };
  only_for(t.step.has_value(), "step is for", Timing::equal_steps);
  only_for(t.increments.has_value(), "increments go with", Timing::increments);
  only_for(t.angles.has_value(), "angles go with", Timing::given);
  std::vector<double> out;
  if (t.mode == Timing::equal_steps) {
    if (!t.step)
      target.error("timing", "equal_steps needs step_deg",
                   "for example timing = { mode = \"equal_steps\", step_deg = 20.0 }");
    else if (*t.step == 0 || std::abs(*t.step) > 2 * pi)
      target.error("timing", fmt::format("the step is {}, it must not be zero nor more than a turn",
                                         units.text(*t.step, Dimension::angle, 6)));
    else
      for (std::size_t k = 0; k < points; ++k) out.push_back(*t.step * static_cast<double>(k));
  } else if (t.mode == Timing::increments) {
    if (!t.increments) {
      target.error("timing", "increments needs increments_deg, one from each point to the next");
    } else if (points >= 3 && t.increments->size() + 1 != points) {
      target.error("timing", fmt::format("{} increments for {} points", t.increments->size(), points),
                   fmt::format("give {}: the crank rotation from each point to the next", points - 1));
    } else {
      out.push_back(0);
      for (const double increment : *t.increments) out.push_back(out.back() + increment);
    }
  } else if (t.mode == Timing::given) {
    if (!t.angles)
      target.error("timing", "given needs angles_deg, one for each point");
    else if (points >= 3 && t.angles->size() != points)
      target.error("timing", fmt::format("{} angles for {} points", t.angles->size(), points),
                   "give one crank angle for each point");
    else
      out = *t.angles;
  }
  return out;
}

void read_path_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                      std::vector<double>& x, std::vector<double>& y) {
  PathTargets targets;
  read_points(target, common, form, false, {}, targets);
  x = std::move(targets.x);
  y = std::move(targets.y);
}

void read_stroke(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                 std::vector<double>& x, std::vector<double>& y) {
  PathTargets targets;
  read_points(target, common, form, false,
              {.least = 5, .most = 100'000, .merge_repeated = true, .from_drawing = true}, targets);
  x = std::move(targets.x);
  y = std::move(targets.y);
}

PathTargets read_path_targets(study::ObjectReader& target, const study::Common& common,
                              PathTargetForm& form) {
  PathTargets targets;
  if (form.gates)
    read_gates(target, form, targets);
  else
    read_points(target, common, form, true, {}, targets);
  targets.closed = form.closed;
  read_tolerances(target, form, targets);
  const std::size_t n = targets.x.size();
  if (n == 0) return targets;
  const std::optional<double> rotation = turned(form.timing, n);
  if (leave_out_closing_target(target, key_of(form), rotation, targets) && rotation && is_one_turn(*rotation))
    leave_out_closing_angle(form.timing);
  form.closed = targets.closed;
  return targets;
}

void write_path_targets(const PathTargets& targets, PathTargetForm& form) {
  form.points_file.reset();
  form.points.reset();
  form.gates.reset();
  const std::size_t n = std::min(targets.x.size(), targets.y.size());
  if (targets.gate_x.empty()) {
    form.points.emplace();
    for (std::size_t k = 0; k < n; ++k) form.points->push_back({targets.x[k], targets.y[k]});
  } else {
    form.gates.emplace();
    for (std::size_t k = 0; k < n; ++k)
      form.gates->push_back({.from = {targets.x[k] - targets.gate_x[k], targets.y[k] - targets.gate_y[k]},
                             .to = {targets.x[k] + targets.gate_x[k], targets.y[k] + targets.gate_y[k]}});
  }
  if (!form.tolerance && !targets.tolerance.empty()) form.tolerances = targets.tolerance;
}

const char* key_of(const PathTargetForm& form) {
  return form.gates ? "gates" : form.points_file ? "points_file" : "points";
}

}  // namespace linkwright::planar
