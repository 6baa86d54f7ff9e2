#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/path/problem.h"
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
  visit(
      Field{
          .key = "points", .summary = "target points [x, y] in their order", .dimension = Dimension::length},
      t.points);
  visit(Field{.key = "points_file",
              .summary = "CSV file with columns x_m, y_m (any length unit) instead of points"},
        t.points_file);
}

/// Targets in their order (m): points, or the middles of gates with half of the distance from one post to the
/// other; `gate_x`, `gate_y` and `tolerance` are empty where there are none.
struct PathPoints {
  std::vector<double> x, y, gate_x, gate_y, tolerance;
  void pop_back();
};

/// The points of a target that has been read into `form` (m), three at least and none twice in a row.
/// Problems are reported at the keys of the target.
void read_path_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                      std::vector<double>& x, std::vector<double>& y);

/// The same where targets may be gates, columns from_x, from_y, to_x, to_y of the file, and have tolerances,
/// its column tolerance.
void read_path_targets(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                       PathPoints& targets);

/// The same checks for targets from elsewhere; problems are reported at `key`.
void check_path_targets(study::ObjectReader& target, const char* key, const PathPoints& targets);

/// A path that ends where it begins is a closed one, unless the study says that it is not: its last target is
/// the first one again, and is left out, with a warning at `key`. `turned`: crank rotation from the first
/// target to the last one where the timing gives it (rad); a path that says nothing of being closed is so
/// only if that is a turn. True when the last target was left out.
bool leave_out_closing_target(study::ObjectReader& target, const char* key, bool& closed,
                              std::optional<double> turned, PathPoints& targets);

/// `timing` of a `[target]`.
struct PathTiming {
  Timing mode = Timing::free;
  std::optional<double> step;
  std::optional<std::vector<double>> increments, angles;
};
template <class Visitor>
void fields(Visitor&& visit, PathTiming& t) {
  visit(Field{.key = "mode", .summary = "how crank angles are tied to the points"}, t.mode);
  visit(Field{.key = "step",
              .summary = "crank rotation from point to point (equal_steps)",
              .dimension = Dimension::angle},
        t.step);
  visit(Field{.key = "increments",
              .summary = "crank rotation from each point to the next, one less than points (increments)",
              .dimension = Dimension::angle},
        t.increments);
  visit(
      Field{.key = "angles",
            .summary = "crank angle of each point (given): of a four-bar from O->B0, of a slider-crank from "
                       "the x axis; fit = \"exact\" takes the rotations between them",
            .dimension = Dimension::angle},
      t.angles);
}

/// What the timing says of so many points (rad): given angles, else the crank rotation from the first point
/// to each. Empty for free timing, and where a problem was reported, at the timing of the target.
std::vector<double> timed_angles(study::ObjectReader& target, const study::DisplayUnits& units,
                                 const PathTiming& timing, std::size_t points);

/// Crank rotation that the timing gives from the first to the last of so many points.
std::optional<double> turned(const PathTiming& timing, std::size_t points);

/// Leaves out what the timing says of the last point alone.
void leave_out_closing_angle(PathTiming& timing);

/// Whether a crank rotation is one turn, in either sense, to rounding (rad).
bool is_one_turn(double turned);

/// Whether the last point of a path is the first one again, to rounding.
bool repeats_first_point(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace linkwright::planar
