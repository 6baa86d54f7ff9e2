// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/prescribed_region.h"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

bool is_round(RegionShape shape) { return shape == RegionShape::cylinder || shape == RegionShape::circle; }

/// True if coordinate k is an angle that covers the full circle, so that its ends coincide.
bool closed(const PrescribedRegion& region, int k) {
  return is_round(region.shape) && k == 1 && !region.symmetric;
}

}  // namespace

std::string problem(const PrescribedRegion& region) {
  const auto bad = [](double v) { return !(v > 0 && std::isfinite(v)); };
  if (bad(region.width)) return fmt::format("width = {} m", region.width);
  if (region.shape == RegionShape::box && bad(region.length))
    return fmt::format("length = {} m", region.length);
  if (region.shape != RegionShape::circle && bad(region.height))
    return fmt::format("height = {} m", region.height);
  if (region.shape == RegionShape::box && region.symmetric)
    return "a box does not have the symmetry of the robots";
  for (int k = 0; k < coordinates(region.shape); ++k) {
    if (region.nodes[k] < 2 || region.nodes[k] > 1000)
      return fmt::format("{} nodes along coordinate {}: 2 to 1000", region.nodes[k], k + 1);
    if (region.cells[k] < 1 || region.cells[k] > 1000)
      return fmt::format("{} cells along coordinate {}: 1 to 1000", region.cells[k], k + 1);
  }
  return {};
}

bool is_planar(RegionShape shape) { return shape == RegionShape::circle || shape == RegionShape::rectangle; }

int coordinates(RegionShape shape) { return is_planar(shape) ? 2 : 3; }

CoordinateRange coordinate_range(const PrescribedRegion& region, int k) {
  const double half = region.width / 2;
  switch (region.shape) {
    case RegionShape::cylinder:
      if (k == 0) return {0, half};
      if (k == 1) return {0, region.symmetric ? pi / 3 : 2 * pi};
      return {0, region.height};
    case RegionShape::circle:
      if (k == 0) return {0, half};
      return {-pi / 2, region.symmetric ? pi / 2 : 1.5 * pi};
    case RegionShape::box:
      if (k == 0) return {-half, half};
      if (k == 1) return {-region.length / 2, region.length / 2};
      return {0, region.height};
    case RegionShape::rectangle:
      break;
  }
  if (k == 0) return {region.symmetric ? 0 : -half, half};
  return {0, region.height};
}

math::Vec3 place(const PrescribedRegion& region, const std::array<double, 3>& at) {
  switch (region.shape) {
    case RegionShape::cylinder:
      return {at[0] * std::cos(at[1]), at[0] * std::sin(at[1]), -at[2]};
    case RegionShape::circle:
      return {at[0] * std::cos(at[1]), region.width / 2 + at[0] * std::sin(at[1]), 0};
    case RegionShape::box:
      return {at[0], at[1], -at[2]};
    case RegionShape::rectangle:
      break;
  }
  return {at[0], at[1], 0};
}

math::Vec3 middle_of(const PrescribedRegion& region) {
  switch (region.shape) {
    case RegionShape::cylinder:
    case RegionShape::box:
      return {0, 0, -region.height / 2};
    case RegionShape::circle:
      return {0, region.width / 2, 0};
    case RegionShape::rectangle:
      break;
  }
  return {0, region.height / 2, 0};
}

std::vector<RegionPoint> region_nodes(const PrescribedRegion& region) {
  std::array<int, 3> count{1, 1, 1};
  for (int k = 0; k < coordinates(region.shape); ++k) count[k] = region.nodes[k] - closed(region, k);
  std::vector<RegionPoint> out;
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < (is_round(region.shape) && i == 0 ? 1 : count[1]); ++j)
      for (int k = 0; k < count[2]; ++k) {
        RegionPoint point;
        const std::array<int, 3> index{i, j, k};
        for (int c = 0; c < coordinates(region.shape); ++c) {
          const auto [lower, upper] = coordinate_range(region, c);
          point.at[c] = lower + (upper - lower) * index[c] / (region.nodes[c] - 1);
        }
        point.place = place(region, point.at);
        out.push_back(point);
      }
  for (RegionPoint& point : out) point.weight = 1.0 / static_cast<double>(out.size());
  return out;
}

std::vector<RegionPoint> region_cells(const PrescribedRegion& region) {
  std::array<int, 3> count{1, 1, 1};
  for (int k = 0; k < coordinates(region.shape); ++k) count[k] = region.cells[k];
  std::vector<RegionPoint> out;
  double sum = 0;
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        RegionPoint point;
        const std::array<int, 3> index{i, j, k};
        for (int c = 0; c < coordinates(region.shape); ++c) {
          const auto [lower, upper] = coordinate_range(region, c);
          point.at[c] = lower + (upper - lower) * (index[c] + 0.5) / count[c];
        }
        point.place = place(region, point.at);
        point.weight = is_round(region.shape) ? point.at[0] : 1;
        sum += point.weight;
        out.push_back(point);
      }
  for (RegionPoint& point : out) point.weight /= sum;
  return out;
}

}  // namespace linkwright::parallel
