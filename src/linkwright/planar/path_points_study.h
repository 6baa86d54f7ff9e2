#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/study/kind.h"

// The points of a path as studies give them, in the file or beside it.
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

/// The points of a target that has been read into `form` (m), three at least and none twice in a row. Where
/// the last point of a closed path repeats the first it is left out, with a warning: true then. Problems are
/// told at the keys of the target.
bool read_path_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                      bool closed, std::vector<double>& x, std::vector<double>& y);

/// The same checks for points from elsewhere; problems are told at `key`.
bool check_path_points(study::ObjectReader& target, const char* key, bool closed, std::vector<double>& x,
                       std::vector<double>& y);

/// Whether the last point of a path is the first one again, to rounding.
bool repeats_first_point(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace linkwright::planar
