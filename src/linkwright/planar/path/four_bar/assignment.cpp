// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/assignment.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t grid = 720;       // crank angles, of a turn or of the interval of inputs
constexpr std::size_t max_starts = 12;  // places of the first target that a search within a turn begins at

// Squared misses of all targets along the path, and the cheapest way through them in order.
class OrderedSearch {
 public:
  OrderedSearch(const PathProblem& problem, const std::vector<std::complex<double>>& path)
      : targets_(problem.x.size()), samples_(path.size()), cost_(targets_ * samples_) {
    for (std::size_t k = 0; k < targets_; ++k)
      for (std::size_t s = 0; s < samples_; ++s) {
        const TargetMiss m = target_miss(problem, k, path[s].real(), path[s].imag());
        const double square = m.x * m.x + m.y * m.y;
        cost_[k * samples_ + s] = std::isnan(square) ? infinity : square;
      }
  }

  // Cheapest places p_0 <= p_1 <= ... of the targets, counted on over the ends of the path: p_0 in
  // [first, first + starts), all in [first, first + length). Returns their cost.
  double run(std::size_t first, std::size_t starts, std::size_t length, std::vector<std::size_t>& places) {
    best_.assign(length, infinity);
    from_.resize(targets_ * length);
    for (std::size_t k = 0; k < targets_; ++k) {
      const double* cost = &cost_[k * samples_];
      std::uint32_t* from = &from_[k * length];
      double lowest = infinity;
      std::uint32_t where = 0;
      std::size_t s = first % samples_;
      for (std::size_t j = 0; j < length; ++j) {
        if (k == 0) {
          if (j < starts) best_[j] = cost[s];
        } else {
          if (best_[j] < lowest) lowest = best_[j], where = static_cast<std::uint32_t>(j);
          from[j] = where;
          best_[j] = lowest + cost[s];
        }
        if (++s == samples_) s = 0;
      }
    }
    const auto end = std::min_element(best_.begin(), best_.end());
    places.resize(targets_);
    std::size_t j = static_cast<std::size_t>(end - best_.begin());
    for (std::size_t k = targets_; k-- > 0;) {
      places[k] = first + j;
      if (k > 0) j = from_[k * length + j];
    }
    return *end;
  }

  double cost(std::size_t target, std::size_t place) const {
    return cost_[target * samples_ + place % samples_];
  }

  // Local nearest places of the first target, best first.
  std::vector<std::size_t> starts() const {
    std::vector<std::size_t> out;
    for (std::size_t s = 0; s < samples_; ++s)
      if (cost(0, s) <= cost(0, s + 1) && cost(0, s) <= cost(0, s + samples_ - 1)) out.push_back(s);
    std::sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return cost(0, a) < cost(0, b); });
    if (out.size() > max_starts) out.resize(max_starts);
    return out;
  }

 private:
  std::size_t targets_, samples_;
  std::vector<double> cost_, best_;
  std::vector<std::uint32_t> from_;
};

}  // namespace

std::optional<PathAssignment> assign_crank_angles(const PathProblem& problem, const FourBar& linkage,
                                                  double sense, double near) {
  LINKWRIGHT_REQUIRE(sense == 1 || sense == -1, "sense must be +1 or -1, got {}", sense);
  const std::size_t n = problem.x.size();
  const FourBarClass type = classify(linkage);
  bool turns = type.crank_rotates_fully;
  double begin = sense > 0 ? 0 : 2 * pi, step = sense * 2 * pi / grid;
  if (!turns) {
    const AngleInterval* holds = nullptr;
    for (const AngleInterval& interval : type.inputs) {
      const double turned = near - 2 * pi * std::floor((near - interval.from) / (2 * pi));
      if (turned <= interval.to + 1e-9 || turned >= interval.from + 2 * pi - 1e-9) holds = &interval;
    }
    if (!holds) return std::nullopt;
    // Just inside: at its ends the branches meet.
    const double inside = 1e-4 * (holds->to - holds->from);
    begin = (sense > 0 ? holds->from + inside : holds->to - inside);
    step = sense * (holds->to - holds->from - 2 * inside) / (grid - 1);
  }
  std::vector<std::complex<double>> path(grid);
  for (std::size_t s = 0; s < grid; ++s)
    path[s] = position(linkage, begin + step * static_cast<double>(s)).coupler_point;

  OrderedSearch search(problem, path);
  std::vector<std::size_t> places;
  double lowest = search.run(0, grid, turns ? 2 * grid : grid, places);
  if (!std::isfinite(lowest)) return std::nullopt;
  if (turns && places.back() - places.front() >= grid) {
    // More than a turn from first to last: one turn from each place where the first target is near.
    lowest = infinity;
    std::vector<std::size_t> other;
    for (std::size_t start : search.starts()) {
      const double cost = search.run(start, 1, grid, other);
      if (cost < lowest) lowest = cost, places = other;
    }
  }

  PathAssignment out;
  out.angles.resize(n);
  for (std::size_t k = 0; k < n;) {
    // Targets that share a place take equal parts of it.
    std::size_t next = k + 1;
    while (next < n && places[next] == places[k]) ++next;
    const std::size_t p = places[k];
    for (std::size_t i = k; i < next; ++i) {
      double offset = 0;
      if (next - k > 1) {
        offset = (static_cast<double>(i - k) + 0.5) / static_cast<double>(next - k) - 0.5;
      } else if (turns || (p > 0 && p + 1 < grid)) {
        const double before = search.cost(k, p + grid - 1), at = search.cost(k, p),
                     after = search.cost(k, p + 1);
        const double bend = before - 2 * at + after;
        if (before >= at && after >= at && bend > 0 && std::isfinite(bend))
          offset = std::clamp(0.5 * (before - after) / bend, -0.49, 0.49);
      }
      out.angles[i] = begin + step * (static_cast<double>(p) + offset);
    }
    k = next;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const FourBarPosition pose = position(linkage, out.angles[k]);
    const TargetMiss m = target_miss(problem, k, pose.coupler_point.real(), pose.coupler_point.imag());
    out.error += m.x * m.x + m.y * m.y;
  }
  if (!std::isfinite(out.error)) return std::nullopt;
  return out;
}

}  // namespace linkwright::planar
