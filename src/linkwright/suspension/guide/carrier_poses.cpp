#include "linkwright/suspension/guide/carrier_poses.h"

#include <fmt/core.h>

#include <cmath>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"

namespace linkwright::suspension {
namespace {

struct Wanted {
  std::string_view base;
  Dimension dimension;
  bool needed;
};
constexpr Wanted columns[] = {
    {"travel", Dimension::length, false},  {"rack", Dimension::length, false},
    {"centre_x", Dimension::length, true}, {"centre_y", Dimension::length, true},
    {"centre_z", Dimension::length, true}, {"toe", Dimension::angle, true},
    {"camber", Dimension::angle, true},    {"carrier_pitch", Dimension::angle, false}};
enum Place { travel, rack, x, y, z, toe, camber, carrier_pitch, places };

// Travel is written beside the centre for people; a file in which they disagree by more than what rounding to
// a micrometre makes was put together wrongly.
constexpr double travel_tolerance = 1e-6;

}  // namespace

Mat3 target_rotation(const CarrierTargets& targets, const CarrierTarget& pose) {
  LINKWRIGHT_REQUIRE(std::isfinite(pose.angles.carrier_pitch), "a position does not give the carrier pitch");
  return carrier_rotation(Side::left, targets.wheel, pose.angles);
}

bool carrier_pitch_is_given(const CarrierTargets& targets) {
  for (const CarrierTarget& pose : targets.poses)
    if (std::isnan(pose.angles.carrier_pitch)) return false;
  return true;
}

std::optional<CarrierTargets> carrier_targets(CarrierTargets targets, const Table& table,
                                              const std::string& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const auto complain = [&](std::string key, std::string message, std::string hint = {}) {
    diagnostics.push_back(
        {.file = file, .key = std::move(key), .message = std::move(message), .hint = std::move(hint)});
  };
  std::vector<double> values[places];
  for (const Column& column : table.columns) {
    const auto key = split_unit(column.key);
    const Wanted* wanted = nullptr;
    std::string_view base = key ? key->base : std::string_view(column.key);
    if (base == "spin") base = "carrier_pitch";  // as it was called before
    for (const Wanted& w : columns)
      if (base == w.base) wanted = &w;
    if (!wanted) {
      complain(column.key, "unknown column",
               "columns are travel, rack, centre_x, centre_y, centre_z, toe, camber and carrier_pitch, each "
               "with its unit");
      continue;
    }
    const Unit* unit = key ? find_unit(wanted->dimension, key->unit->suffix) : nullptr;
    if (!unit) {
      complain(column.key, fmt::format("needs the unit of {}", describe(wanted->dimension)),
               fmt::format("write {}", si_key(wanted->base, wanted->dimension)));
      continue;
    }
    std::vector<double>& to = values[wanted - columns];
    if (!to.empty()) {
      complain(column.key, fmt::format("{} is given twice", wanted->base));
      continue;
    }
    for (const double v : column.values) to.push_back(unit->to_si(v));
    for (std::size_t i = 0; i < to.size(); ++i)
      if (!std::isfinite(to[i]) && wanted->base != "carrier_pitch")
        complain(column.key, fmt::format("row {} holds no number", i + 1));
  }
  for (int k = 0; k < places; ++k)
    if (values[k].empty() && columns[k].needed && table.rows() > 0)
      complain(std::string(columns[k].base), "column is missing",
               fmt::format("add {}", si_key(columns[k].base, columns[k].dimension)));
  if (table.rows() == 0) complain({}, "holds no positions");
  if (diagnostics.size() == before)
    for (std::size_t i = 0; i < values[travel].size(); ++i) {
      const double apart = values[z][i] - targets.wheel.centre.z - values[travel][i];
      if (std::abs(apart) > travel_tolerance)
        complain("travel",
                 fmt::format("row {}: travel {:.6g} m, but the centre is {:.6g} m above the reference", i + 1,
                             values[travel][i], values[travel][i] + apart));
    }
  if (diagnostics.size() != before) return std::nullopt;

  targets.poses.clear();
  for (std::size_t i = 0; i < table.rows(); ++i)
    targets.poses.push_back({.rack = values[rack].empty() ? 0 : values[rack][i],
                             .centre = {values[x][i], values[y][i], values[z][i]},
                             .angles = {values[toe][i], values[camber][i],
                                        values[carrier_pitch].empty() ? nan : values[carrier_pitch][i]}});
  return targets;
}

}  // namespace linkwright::suspension
