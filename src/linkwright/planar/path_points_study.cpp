#include "linkwright/planar/path_points_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/csv.h"
#include "linkwright/core/units.h"
#include "linkwright/study/beside.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t most_points = 2000;

// Columns x and y of a CSV file, in metres; any length unit.
void read_points_file(study::ObjectReader& reader, const study::Common& common, const std::string& file,
                      std::vector<double>& x, std::vector<double>& y) {
  const std::optional<std::string> text = study::read_beside(reader, "points_file", common.folder, file);
  if (!text) return;
  Diagnostics problems;
  const std::optional<Table> table = read_csv(*text, (common.folder / file).string(), problems);
  for (const Diagnostic& problem : problems) reader.unreadable("points_file", to_string(problem));
  if (!table) return;
  const auto column = [&](std::string_view base) -> std::vector<double> {
    for (const Column& c : table->columns) {
      const auto key = split_unit(c.key);
      if (!key || key->base != base || key->dimension != Dimension::length) continue;
      std::vector<double> values;
      for (double v : c.values) values.push_back(key->unit->to_si(v));
      return values;
    }
    reader.error("points_file", fmt::format("'{}' has no column {}_m", file, base),
                 fmt::format("name the columns x_m,y_m (or x_mm,y_mm, ...)"));
    return {};
  };
  x = column("x");
  y = column("y");
  for (std::size_t k = 0; k < x.size() && k < y.size(); ++k)
    if (!std::isfinite(x[k]) || !std::isfinite(y[k]))
      reader.error("points_file", fmt::format("'{}': point {} is incomplete", file, k + 1));
}

// Largest distance from the origin along an axis (m).
double farthest(const std::vector<double>& x, const std::vector<double>& y) {
  double far = 0;
  for (std::size_t k = 0; k < x.size(); ++k) far = std::max({far, std::abs(x[k]), std::abs(y[k])});
  return far;
}

// Points that agree to rounding of their coordinates are the same.
bool same_point(const std::vector<double>& x, const std::vector<double>& y, std::size_t a, std::size_t b) {
  return std::hypot(x[a] - x[b], y[a] - y[b]) <= 1e-12 * farthest(x, y);
}

}  // namespace

bool repeats_first_point(const std::vector<double>& x, const std::vector<double>& y) {
  return x.size() > 1 && x.size() == y.size() && same_point(x, y, 0, x.size() - 1);
}

bool read_path_points(study::ObjectReader& target, const study::Common& common, const PathPointsForm& form,
                      bool closed, std::vector<double>& x, std::vector<double>& y) {
  const bool has_points = target.has(Field{.key = "points", .summary = {}, .dimension = Dimension::length});
  const bool has_file = target.has("points_file");
  if (has_points && has_file) {
    target.error("points_file", "the target has both points and points_file", "keep one of them");
    return false;
  }
  if (!has_points && !has_file) {
    target.error("points", "the target has no points",
                 "write points_m = [[x, y], ...] or points_file = \"path.csv\"");
    return false;
  }
  const char* key = has_file ? "points_file" : "points";
  if (form.points_file) read_points_file(target, common, *form.points_file, x, y);
  if (form.points)
    for (const auto& point : *form.points) {
      x.push_back(point[0]);
      y.push_back(point[1]);
    }
  if (x.size() != y.size() || (x.empty() && !form.points)) return false;  // told already
  return check_path_points(target, key, closed, x, y);
}

bool check_path_points(study::ObjectReader& target, const char* key, bool closed, std::vector<double>& x,
                       std::vector<double>& y) {
  const std::size_t n = x.size();
  if (n == 0) {
    target.error(key, "there are no points", "give at least 3 points [x, y]");
    return false;
  }
  if (n < 3) {
    target.error(key,
                 fmt::format("{} point{} make{} no path, at least 3 are needed", n, n == 1 ? "" : "s",
                             n == 1 ? "s" : ""),
                 "add points between them");
    return false;
  }
  if (n > most_points) {
    target.error(key, fmt::format("{} points, at most {} are allowed", n, most_points),
                 "keep every second or third point");
    return false;
  }
  const double far = farthest(x, y);
  if (far > 1e9) {
    target.error(key, fmt::format("a point lies {:.3g} m from the origin, at most 1e9 m are allowed", far),
                 "check the unit");
    return false;
  }
  for (std::size_t k = 1; k < n; ++k)
    if (same_point(x, y, k, k - 1))
      target.error(key, fmt::format("point {} repeats point {}: ({}, {})", k + 1, k, x[k], y[k]),
                   "remove one of them");
  if (!closed || n < 4 || !repeats_first_point(x, y)) return false;
  target.warning(key, fmt::format("the last of {} points repeats the first: taken once", n),
                 "closed = true joins the last point to the first");
  x.pop_back();
  y.pop_back();
  return true;
}

}  // namespace linkwright::planar
