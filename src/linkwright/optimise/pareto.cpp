// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pareto.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::optimise {

bool dominates(std::span<const double> a, std::span<const double> b) {
  LINKWRIGHT_REQUIRE(a.size() == b.size(), "{} and {} objectives", a.size(), b.size());
  bool less = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!(a[k] <= b[k])) return false;
    less |= a[k] < b[k];
  }
  return less;
}

// Share of a cost that a limit met within tolerance leaves open.
constexpr double settled = 100 * tolerance::feasibility;

bool less_by_more_than_rounding(double a, double b) {
  return b - a > settled * std::max(std::abs(a), std::abs(b));
}

bool no_cost_more(std::span<const double> a, std::span<const double> b) {
  LINKWRIGHT_REQUIRE(a.size() == b.size(), "{} and {} objectives", a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    if (less_by_more_than_rounding(b[k], a[k])) return false;
  return true;
}

std::vector<std::size_t> non_dominated(std::span<const double> costs, std::size_t objectives) {
  LINKWRIGHT_REQUIRE(objectives > 0 && costs.size() % objectives == 0, "{} costs of {} objectives",
                     costs.size(), objectives);
  const std::size_t n = costs.size() / objectives;
  const auto of = [&](std::size_t i) { return costs.subspan(i * objectives, objectives); };
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < n; ++i) {
    bool stays = true;
    for (std::size_t j = 0; j < n && stays; ++j)
      stays = !dominates(of(j), of(i)) && !(j < i && std::equal(of(j).begin(), of(j).end(), of(i).begin()));
    if (stays) front.push_back(i);
  }
  return front;
}

std::vector<ParetoPoint> non_dominated(std::vector<ParetoPoint> points) {
  // Whoever dominates or equals a point comes before it in this order.
  std::stable_sort(points.begin(), points.end(),
                   [](const ParetoPoint& a, const ParetoPoint& b) { return a.costs < b.costs; });
  std::vector<ParetoPoint> front;
  for (ParetoPoint& point : points)
    if (std::none_of(front.begin(), front.end(), [&](const ParetoPoint& other) {
          return other.costs == point.costs || dominates(other.costs, point.costs);
        }))
      front.push_back(std::move(point));
  return front;
}

ParetoArchive::ParetoArchive(std::size_t dimension, std::size_t objectives, std::size_t capacity)
    : dimension_(dimension),
      objectives_(objectives),
      capacity_(capacity),
      x_((capacity + 1) * dimension),
      costs_((capacity + 1) * objectives),
      distance_(capacity + 1),
      order_(capacity + 1) {
  LINKWRIGHT_REQUIRE(dimension > 0 && objectives > 0, "{} variables, {} objectives", dimension, objectives);
  LINKWRIGHT_REQUIRE(capacity >= 2 * objectives, "a front of {} objectives needs room for {}, got {}",
                     objectives, 2 * objectives, capacity);
}

bool ParetoArchive::tell(std::span<const double> x, std::span<const double> costs) {
  LINKWRIGHT_REQUIRE(x.size() == dimension_ && costs.size() == objectives_,
                     "{} values for {} variables, {} costs for {} objectives", x.size(), dimension_,
                     costs.size(), objectives_);
  for (std::size_t k = 0; k < objectives_; ++k)
    LINKWRIGHT_REQUIRE(!std::isnan(costs[k]), "cost {}: {}", k, costs[k]);
  if (!std::all_of(costs.begin(), costs.end(), [](double v) { return std::isfinite(v); })) return false;
  const auto none_more = [m = objectives_](const double* a, const double* b) {
    for (std::size_t k = 0; k < m; ++k)
      if (!(a[k] <= b[k])) return false;
    return true;
  };
  const auto refuses = [&](std::size_t i) { return none_more(&costs_[i * objectives_], costs.data()); };
  // The one that refused the last design probably refuses this one, too.
  if (refuser_ < size_ && refuses(refuser_)) return false;
  for (std::size_t i = 0; i < size_; ++i)
    if (refuses(i)) {
      refuser_ = i;
      return false;
    }
  // No other has the same costs: whoever is nowhere less is dominated.
  std::size_t left = 0;
  for (std::size_t i = 0; i < size_; ++i)
    if (!none_more(costs.data(), &costs_[i * objectives_])) move(i, left++);
  std::copy(x.begin(), x.end(), &x_[left * dimension_]);
  std::copy(costs.begin(), costs.end(), &costs_[left * objectives_]);
  size_ = left + 1;
  if (size_ <= capacity_) return true;
  const std::size_t out = most_crowded();
  for (std::size_t i = out + 1; i < size_; ++i) move(i, i - 1);
  --size_;
  return out != size_;
}

void ParetoArchive::move(std::size_t from, std::size_t to) {
  if (from == to) return;
  std::copy_n(&x_[from * dimension_], dimension_, &x_[to * dimension_]);
  std::copy_n(&costs_[from * objectives_], objectives_, &costs_[to * objectives_]);
}

std::size_t ParetoArchive::most_crowded() {
  std::fill(distance_.begin(), distance_.end(), 0.0);
  for (std::size_t k = 0; k < objectives_; ++k) {
    const auto cost = [&](std::size_t place) { return costs_[order_[place] * objectives_ + k]; };
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double cost_a = costs_[a * objectives_ + k], cost_b = costs_[b * objectives_ + k];
      return cost_a != cost_b ? cost_a < cost_b : a < b;
    });
    const double range = cost(capacity_) - cost(0);
    distance_[order_[0]] = distance_[order_[capacity_]] = infinity;
    for (std::size_t place = 1; place < capacity_ && range > 0; ++place)
      distance_[order_[place]] += (cost(place + 1) - cost(place - 1)) / range;
  }
  std::size_t least = 0;
  for (std::size_t i = 1; i < size_; ++i)
    if (distance_[i] <= distance_[least]) least = i;
  return least;
}

std::vector<ParetoPoint> ParetoArchive::points() const {
  std::vector<ParetoPoint> all;
  for (std::size_t i = 0; i < size_; ++i)
    all.push_back({{x(i).begin(), x(i).end()}, {costs(i).begin(), costs(i).end()}});
  std::sort(all.begin(), all.end(),
            [](const ParetoPoint& a, const ParetoPoint& b) { return a.costs < b.costs; });
  return all;
}

constexpr double largest_cost = 1e75, violation_unit = 1e100;

double cost_by_feasibility_rules(double cost, double violation) {
  if (!(violation > 0)) return std::clamp(cost, -largest_cost, largest_cost);
  // Square roots are rounded correctly and thus keep the order.
  const double root =
      std::sqrt(std::sqrt(std::sqrt(std::sqrt(std::min(violation, std::numeric_limits<double>::max())))));
  return violation_unit * root;
}

}  // namespace linkwright::optimise
