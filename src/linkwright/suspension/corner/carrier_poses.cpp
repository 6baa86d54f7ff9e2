// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/carrier_poses.h"

#include <fmt/core.h>

#include <cmath>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity_columns.h"

namespace linkwright::suspension {
namespace {

constexpr QuantityColumn columns[] = {
    {"travel", Dimension::length},   {"rack", Dimension::length},
    {"centre_x", Dimension::length}, {"centre_y", Dimension::length},
    {"centre_z", Dimension::length}, {"toe", Dimension::angle},
    {"camber", Dimension::angle},    {"carrier_pitch", Dimension::angle, "spin"}};
enum Place { travel, rack, x, y, z, toe, camber, carrier_pitch, places };
constexpr bool is_needed(int place) { return place >= x && place <= camber; }

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
  const Quantities found = read_quantities(
      table, columns, "travel, rack, centre_x, centre_y, centre_z, toe, camber and carrier_pitch", file,
      diagnostics);
  const std::vector<std::vector<double>>& values = found.values;
  for (int k = 0; k < places; ++k) {
    if (k != carrier_pitch)
      for (std::size_t i = 0; i < values[k].size(); ++i)
        if (!std::isfinite(values[k][i]))
          complain(found.keys[k], fmt::format("row {} holds no number", i + 1));
    if (found.keys[k].empty() && is_needed(k) && table.rows() > 0)
      report_missing(columns[k], file, diagnostics);
  }
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
