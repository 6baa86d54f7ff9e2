// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/task.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// The targets of a path as studies give them, in the file or beside it.
namespace linkwright::planar {

/// `points` or `points_file` of a `[target]`.
struct PathPointsForm {
  std::optional<std::vector<std::array<double, 2>>> points;
  std::optional<std::string> points_file;
};
template <class Visitor>
void fields(Visitor&& visit, PathPointsForm& t) {
  visit(field::length("points", "target points [x, y] in their order"), t.points);
  visit(field::entry(
            "points_file",
            "CSV file with columns x_m, y_m (any length unit) instead of points; planar.any also takes "
            "a drawing of one line, SVG or DXF"),
        t.points_file);
}

/// Two points that the path passes between, or a point where both are the same.
struct PathGate {
  std::array<double, 2> from{}, to{};
};
template <class Visitor>
void fields(Visitor&& visit, PathGate& g) {
  visit(field::length("from", "one post [x, y]").required().with_inherited_unit(), g.from);
  visit(field::length("to", "the other post [x, y]").required().with_inherited_unit(), g.to);
}

/// `timing` of a `[target]`.
struct PathTiming {
  Timing mode = Timing::free;
  std::optional<double> step;
  std::optional<std::vector<double>> increments, angles;
};
template <class Visitor>
void fields(Visitor&& visit, PathTiming& t) {
  visit(field::entry("mode", "how crank angles are tied to the points"), t.mode);
  visit(field::angle("step", "crank rotation from point to point (equal_steps)"), t.step);
  visit(field::angle("increments",
                     "crank rotation from each point to the next, one less than points (increments)"),
        t.increments);
  visit(field::angle("angles",
                     "crank angle of each point (given): of a four-bar from O->B0, of a slider-crank from "
                     "the x axis; fit = \"exact\" takes the rotations between them"),
        t.angles);
}

/// `[target]` of a path synthesis, whatever the mechanism that traces the path.
struct PathTargetForm : PathPointsForm {
  bool closed = false;
  std::optional<std::vector<PathGate>> gates;
  std::optional<double> tolerance;
  std::optional<std::vector<double>> tolerances;
  PathTiming timing;
};
template <class Visitor>
void fields(Visitor&& visit, PathTargetForm& t) {
  visit(field::entry("closed",
                     "the last point is followed by the first; default: whether the last repeats the first"),
        t.closed);
  visit(field::length("gates",
                      "instead of points: pairs of points that the path passes between, in their order"),
        t.gates);
  visit(field::length("tolerance", "every point or gate counts as met within this distance, at no cost")
            .not_negative(),
        t.tolerance);
  visit(field::length("tolerances", "the same, one for each point or gate").not_negative(), t.tolerances);
  visit(field::entry("timing", "how crank angles are tied to the points"), t.timing);
  fields(visit, static_cast<PathPointsForm&>(t));
}

/// The points of a target that has been read into `form` (m), three at least and none twice in a row, where
/// points are all that a study knows. Problems are reported at the keys of the target.
void read_path_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                      std::vector<double>& x, std::vector<double>& y);

/// The points of a stroke (m): 5 to 100 000; one that repeats the point before is left out with a warning.
/// Its file may be a table or a drawing, SVG or DXF, whose line ends at its first point where it is closed.
void read_stroke(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                 std::vector<double>& x, std::vector<double>& y);

/// The targets of a form that has been read: points, the columns x, y of their file, or gates, its columns
/// from_x, from_y, to_x, to_y; with their tolerances, its column tolerance. A path that ends where it begins
/// is a closed one, unless the study says that it is not: its last target is the first one again, and is left
/// out with what the timing says of it, with a warning. Problems are reported at the keys of the target.
PathTargets read_path_targets(study::ObjectReader& target, const study::Common& common, PathTargetForm& form);

/// Says of a form what its targets are in the end, for the canonical study.
void write_path_targets(const PathTargets& targets, PathTargetForm& form);

/// The key that the targets stand at.
const char* key_of(const PathTargetForm& form);

/// The crank angles of so many points by the timing (rad): given angles, else the crank rotation from the
/// first point to each. Empty for free timing, and where a problem was reported, at the timing of the target.
std::vector<double> timed_angles(study::ObjectReader& target, const study::DisplayUnits& units,
                                 const PathTiming& timing, std::size_t points);

/// True if the last point of a path is the first one again, to rounding.
bool repeats_first_point(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace linkwright::planar
