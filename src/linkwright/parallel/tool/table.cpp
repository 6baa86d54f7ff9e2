// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/table.h"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/quantity_columns.h"

namespace linkwright::parallel {
namespace {

constexpr QuantityColumn columns[] = {{"time", Dimension::time},        {"x", Dimension::length},
                                      {"y", Dimension::length},         {"z", Dimension::length},
                                      {"rotation_x", Dimension::angle}, {"rotation_y", Dimension::angle},
                                      {"rotation_z", Dimension::angle}, {"roll", Dimension::angle},
                                      {"pitch", Dimension::angle},      {"yaw", Dimension::angle}};
enum Place { time, x, y, z, rotation_x, rotation_y, rotation_z, roll, pitch, yaw, places };

// Beyond it the digits of a double no longer separate neighbouring positions.
constexpr double most = 1e9;

}  // namespace

std::optional<ToolTable> read_tool_table(std::string_view text, const std::string& file,
                                         Diagnostics& diagnostics) {
  const std::optional<Table> table = read_csv(text, file, diagnostics);
  if (!table) return std::nullopt;
  const std::size_t before = diagnostics.size();
  const auto complain = [&](std::string key, std::string message, std::string hint = {}) {
    diagnostics.push_back(
        {.file = file, .key = std::move(key), .message = std::move(message), .hint = std::move(hint)});
  };
  const Quantities found = read_quantities(
      *table, columns, "time, x, y, z and rotation_x, rotation_y, rotation_z or roll, pitch, yaw", file,
      diagnostics);
  const std::vector<std::vector<double>>& values = found.values;
  for (int k = 0; k < places; ++k)
    for (std::size_t i = 0; i < values[k].size(); ++i) {
      const double v = values[k][i];
      if (std::abs(v) <= most) continue;
      complain(found.keys[k], std::isnan(v)
                                  ? fmt::format("row {} holds no number", i + 1)
                                  : fmt::format("row {} holds {:g}, more than {:g} in SI units", i + 1,
                                                table->find(found.keys[k])->values[i], most));
      break;
    }
  const auto given = [&](int k) { return !found.keys[k].empty(); };
  if (!table->names.empty()) complain("name", "unknown column", "rows of points have no names");
  const bool turns = given(rotation_x) || given(rotation_y) || given(rotation_z);
  const bool rolls = given(roll) || given(pitch) || given(yaw);
  for (int k = 0; k < places; ++k) {
    const bool needed = k <= z || (k <= rotation_z ? turns : rolls);
    if (needed && !given(k)) report_missing(columns[k], file, diagnostics);
  }
  if (turns && rolls)
    complain("roll", "the rotation is given twice",
             "give rotation_x, rotation_y, rotation_z or roll, pitch, yaw");
  if (table->rows() < 2) complain({}, fmt::format("{} rows, needs at least 2", table->rows()));
  if (diagnostics.size() != before) return std::nullopt;
  const std::size_t n = table->rows();
  for (std::size_t i = 1; i < n; ++i)
    if (!(values[time][i] > values[time][i - 1])) {
      complain("time", fmt::format("times must increase, but row {} with {:g} s follows {:g} s", i + 1,
                                   values[time][i], values[time][i - 1]));
      return std::nullopt;
    }

  ToolTable out;
  out.file = file;
  out.times = values[time];
  for (std::size_t i = 0; i < n; ++i) {
    out.points.push_back({values[x][i], values[y][i], values[z][i]});
    if (turns) out.rotations.push_back({values[rotation_x][i], values[rotation_y][i], values[rotation_z][i]});
    if (rolls) {
      const Vec3 turn = turn_of(math::turn_z(values[yaw][i]) * math::turn_y(values[pitch][i]) *
                                math::turn_x(values[roll][i]));
      out.rotations.push_back({turn.x, turn.y, turn.z});
    }
  }
  return out;
}

}  // namespace linkwright::parallel
