#include "linkwright/planar/linkage_smooth_branch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace linkwright::planar {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

ChangeZone::Weights ChangeZone::interpolation(double x) {
  Weights out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out[i] = 1;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k != i) out[i] *= (x - nodes[k]) / (nodes[i] - nodes[k]);
  }
  return out;
}

SmoothBranch::SmoothBranch(const LinkagePlan& plan, double value, std::span<const double> modes) {
  const double unit = plan.rotary[0] ? 1 : plan.size;
  const double reach = plan.rotary[0] ? 4 * std::numbers::pi : 4 * plan.size;
  path_ =
      branch_path(plan, std::span(&value, 1), 0, modes, value - reach, value + reach, AtChangePoint::smooth);
  half_width_ = ChangeZone::width * unit;
  if (path_.change_points.empty()) return;
  // Nodes stay clear of what comes next.
  double gap = path_.period > 0
                   ? path_.change_points.front().value + path_.period - path_.change_points.back().value
                   : infinity;
  for (std::size_t i = 0; i < path_.change_points.size(); ++i) {
    const double here = path_.change_points[i].value;
    if (i > 0) gap = std::min(gap, here - path_.change_points[i - 1].value);
    if (path_.period == 0) gap = std::min({gap, here - path_.low.value, path_.high.value - here});
  }
  if (gap > 0) half_width_ = std::min(half_width_, gap / 6);
}

template <class Distance>
SmoothBranch::Near SmoothBranch::best(double value, Distance&& distance) const {
  Near out;
  double least = infinity;
  const bool repeats = path_.period > 0;
  const double turn = repeats ? std::floor((value - path_.start) / path_.period) : 0;
  for (const RangeEnd& end : path_.change_points)
    for (int k = repeats ? -1 : 0; k <= (repeats ? 1 : 0); ++k) {
      const double there = end.value + (turn + k) * path_.period;
      if (const double d = distance(there); d < least) least = d, out = {there, &end};
    }
  return out;
}
SmoothBranch::Near SmoothBranch::nearest(double value) const {
  return best(value, [&](double there) { return std::abs(there - value); });
}
SmoothBranch::Near SmoothBranch::next(double value, double sense) const {
  return best(value, [&](double there) {
    const double way = (there - value) * sense;
    return way > 0 ? way : infinity;
  });
}

}  // namespace linkwright::planar
