// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/detail/synthesis_model.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

constexpr double centimetre = 0.01;

}  // namespace

DirectModel::DirectModel(const DirectTask& task, const DirectOptions& options) : task_(task) {
  LINKWRIGHT_REQUIRE(!task.designed.empty(), "nothing to design");
  LINKWRIGHT_REQUIRE(options.starts >= 1 && options.draws >= 1 && options.refined >= 1 &&
                         options.evaluations >= 1 && options.same_cost >= 0,
                     "starts {}, draws {}, refined {}, evaluations {}, same_cost {}", options.starts,
                     options.draws, options.refined, options.evaluations, options.same_cost);
  LINKWRIGHT_REQUIRE(options.one >= 0 && options.one < static_cast<int>(task.objectives.size()),
                     "objective {} of {}", options.one, task.objectives.size());
  for (const auto& [number, lower, upper] : task.designed) {
    LINKWRIGHT_REQUIRE(std::isfinite(lower) && std::isfinite(upper) && lower < upper, "{} from {} to {}",
                       label(task.suspension, number), lower, upper);
    LINKWRIGHT_REQUIRE(std::find(numbers_.begin(), numbers_.end(), number) == numbers_.end(),
                       "{} is designed twice", label(task.suspension, number));
    numbers_.push_back(number);
  }
  positions_ = target_positions(task.objectives, task.driver);
  limits_ = limit_answers(task.suspension, task.limits, {}, {}, {}).size();
}

Suspension DirectModel::suspension(std::span<const double> u) const {
  Suspension out = task_.suspension;
  for (std::size_t j = 0; j < size(); ++j) {
    const auto& [number, lower, upper] = task_.designed[j];
    design_value(out, number) = lower + u[j] * (upper - lower);
  }
  return out;
}

std::vector<double> DirectModel::values(std::span<const double> u) const {
  std::vector<double> out(size());
  for (std::size_t j = 0; j < size(); ++j)
    out[j] = task_.designed[j].lower + u[j] * (task_.designed[j].upper - task_.designed[j].lower);
  return out;
}

std::vector<double> DirectModel::shares(const Suspension& suspension) const {
  std::vector<double> out(size());
  for (std::size_t j = 0; j < size(); ++j) {
    const auto& [number, lower, upper] = task_.designed[j];
    out[j] = (design_value(suspension, number) - lower) / (upper - lower);
  }
  return out;
}

std::vector<double> DirectModel::given() const {
  std::vector<double> out = shares(task_.suspension);
  for (double& share : out) share = std::clamp(share, 0.0, 1.0);
  return out;
}

double DirectModel::reached(std::span<const double> u) const {
  DirectPoint at;
  evaluate(u, false, at);
  return at.reached;
}

void DirectModel::evaluate(std::span<const double> u, bool derivatives, DirectPoint& out) const {
  const Suspension made = suspension(u);
  std::span<const DesignNumber> numbers;
  if (derivatives) numbers = numbers_;
  TargetAnswer found = answer(made, task_.objectives, positions_, numbers);
  out.assembled = found.assembled;
  out.reached = found.reached;
  out.deviations = std::move(found.deviations);
  out.by = std::move(found.by);
  out.limits.clear();
  out.limits_by.clear();
  if (!out.assembled) return;
  const std::size_t n = size();
  for (std::size_t i = 0; i < out.by.size(); ++i) {
    const DesignVariable& of = task_.designed[i % n];
    out.by[i] *= of.upper - of.lower;
  }
  if (limits_ == 0) return;
  for (const LimitAnswer& limit : limit_answers(made, task_.limits, found.positions, numbers, found.shifts)) {
    out.limits.push_back(limit.excess / centimetre);
    for (std::size_t j = 0; j < limit.by.size(); ++j)
      out.limits_by.push_back(limit.by[j] * (task_.designed[j].upper - task_.designed[j].lower) / centimetre);
  }
}

}  // namespace linkwright::suspension
