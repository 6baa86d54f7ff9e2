#include "linkwright/parallel/tool/table.h"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/units.h"

namespace linkwright::parallel {
namespace {

struct Wanted {
  std::string_view base;
  Dimension dimension;
};
constexpr Wanted columns[] = {{"time", Dimension::time},        {"x", Dimension::length},
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
  std::vector<double> values[places];
  bool given[places] = {};
  for (const Column& column : table->columns) {
    const auto key = split_unit(column.key);
    const Wanted* wanted = nullptr;
    for (const Wanted& w : columns)
      if (column.key == w.base || (key && key->base == w.base)) wanted = &w;
    if (!wanted) {
      complain(column.key, "unknown column",
               "columns are time, x, y, z and rotation_x, rotation_y, rotation_z or roll, pitch, yaw, each "
               "with its unit");
      continue;
    }
    const Unit* unit = key ? find_unit(wanted->dimension, key->unit->suffix) : nullptr;
    if (!unit) {
      complain(column.key, fmt::format("needs the unit of {}", describe(wanted->dimension)),
               fmt::format("write {}", si_key(wanted->base, wanted->dimension)));
      continue;
    }
    const auto place = wanted - columns;
    if (given[place]) {
      complain(column.key, fmt::format("{} is given twice", wanted->base));
      continue;
    }
    given[place] = true;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      const double v = values[place].emplace_back(unit->to_si(column.values[i]));
      if (std::isnan(v)) {
        complain(column.key, fmt::format("row {} holds no number", i + 1));
        break;
      }
      if (std::abs(v) > most) {
        complain(column.key,
                 fmt::format("row {} holds {:g}, more than {:g} in SI units", i + 1, column.values[i], most));
        break;
      }
    }
  }
  if (!table->names.empty()) complain("name", "unknown column", "rows of points have no names");
  const bool turns = given[rotation_x] || given[rotation_y] || given[rotation_z];
  const bool rolls = given[roll] || given[pitch] || given[yaw];
  for (int k = 0; k < places; ++k) {
    const bool needed = k <= z || (k <= rotation_z ? turns : rolls);
    if (needed && !given[k])
      complain(std::string(columns[k].base), "column is missing",
               fmt::format("add {}", si_key(columns[k].base, columns[k].dimension)));
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
