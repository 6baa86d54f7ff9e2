// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/detail/synthesis_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/optimise/nlopt_bridge.h"

namespace linkwright::parallel {
namespace {

/// The value of an index for the model's limits, see Extreme.
double index_of(PoseLimit::Kind kind, int leg, const PoseDexterity<double>& there) {
  switch (kind) {
    case PoseLimit::input:
      return there.input_square[leg];
    case PoseLimit::output:
      return there.output[leg];
    case PoseLimit::side_swing:
      return there.side[leg];
    case PoseLimit::arm_low:
    case PoseLimit::arm_high:
      return std::atan2(there.sine[leg], there.cosine[leg]);
    case PoseLimit::constraint:
      return there.constraint;
    case PoseLimit::conditioning:
      break;
  }
  return there.conditioning;
}

const Extreme& extreme_of(const Extremes& extremes, PoseLimit::Kind kind, int leg) {
  switch (kind) {
    case PoseLimit::input:
      return extremes.input_square[leg];
    case PoseLimit::output:
      return extremes.output[leg];
    case PoseLimit::side_swing:
      return extremes.side[leg];
    case PoseLimit::arm_low:
      return extremes.lowest[leg];
    case PoseLimit::arm_high:
      return extremes.highest[leg];
    case PoseLimit::constraint:
      return extremes.constraint;
    case PoseLimit::conditioning:
      break;
  }
  return extremes.conditioning;
}

class Search {
 public:
  Search(const DexterityModel& model, const DexterityOptions& options, RunContext& context)
      : model_(model), options_(options), context_(context), n_(model.unknowns()) {}

  Descent run(std::vector<double> u);

 private:
  bool epigraph() const { return model_.task().goal == DexterityGoal::worst; }
  bool is_function(const PoseLimit& which) const {
    return epigraph() && which.kind == PoseLimit::conditioning;
  }
  /// Conditioning counts where it is a goal or a limit.
  bool looks_at(PoseLimit::Kind kind) const {
    return model_.wants(kind) || (epigraph() && kind == PoseLimit::conditioning);
  }
  DexterityModel::At place_of(std::size_t pose) const {
    return pose < model_.nodes() ? model_.at(pose) : between_[pose - model_.nodes()];
  }
  bool add(const PoseLimit& which);
  void measure_at(std::span<const double> u);
  void fill(bool functions, std::span<const double> u, std::span<double> values, std::span<double> jacobian);
  optimise::LocalReport improve(std::vector<double>& u);
  void look(const std::vector<double>& u);
  void go(std::vector<double> u);
  /// `all`: also what is not missed yet, so that the first step knows of every limit.
  bool exchange(std::span<const double> u, const Extremes& extremes, bool all = false);
  bool exchange_between(std::span<const double> u, const Extremes& extremes);

  const DexterityModel& model_;
  const DexterityOptions& options_;
  RunContext& context_;
  const int n_;
  std::vector<PoseLimit> functions_, limits_;  ///< the working set
  std::vector<std::size_t> poses_;             ///< all of them, each once
  std::vector<std::size_t> slot_of_function_, slot_of_limit_;
  std::vector<PoseDexterity<double>> there_;  ///< indices of each of `poses_`, at `last_`
  std::vector<double> last_, whole_by_;
  std::vector<DexterityModel::Whole> whole_;
  std::vector<DexterityModel::At> between_;
  DexterityModel::Work work_;
  double worst_ = 0;  ///< least index of the working set
  Descent known_;     ///< the unknowns and extremes that were last looked at
  DexterityStart out_;
};

bool Search::add(const PoseLimit& which) {
  const bool function = is_function(which);
  std::vector<PoseLimit>& list = function ? functions_ : limits_;
  if (std::find(list.begin(), list.end(), which) != list.end()) return false;
  list.push_back(which);
  const auto known = std::find(poses_.begin(), poses_.end(), which.pose);
  (function ? slot_of_function_ : slot_of_limit_).push_back(known - poses_.begin());
  if (known == poses_.end()) poses_.push_back(which.pose);
  last_.clear();
  return true;
}

void Search::measure_at(std::span<const double> u) {
  if (std::equal(u.begin(), u.end(), last_.begin(), last_.end())) return;
  last_.assign(u.begin(), u.end());
  const DesignedRobot designed = model_.designed(u);
  there_.resize(poses_.size());
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const DexterityModel::At at = place_of(poses_[k]);
    measure(designed, model_.task().mode, model_.measures(), at.place,
            model_.task().orientations[at.orientation], there_[k]);
  }
  ++out_.evaluations;
  out_.poses += static_cast<std::int64_t>(poses_.size());
}

void Search::fill(bool functions, std::span<const double> u, std::span<double> values,
                  std::span<double> jacobian) {
  measure_at(u);
  const auto& list = functions ? functions_ : limits_;
  const auto& slots = functions ? slot_of_function_ : slot_of_limit_;
  for (std::size_t k = 0; k < list.size(); ++k)
    values[k] = model_.limit(list[k], there_[slots[k]], u,
                             jacobian.empty() ? jacobian : jacobian.subspan(k * n_, n_));
  if (functions) return;
  model_.whole(u, whole_, jacobian.empty() ? nullptr : &whole_by_);
  for (std::size_t k = 0; k < whole_.size(); ++k) values[list.size() + k] = whole_[k].excess;
  if (!jacobian.empty())
    std::copy(whole_by_.begin(), whole_by_.end(),
              jacobian.begin() + static_cast<std::ptrdiff_t>(list.size() * n_));
}

optimise::LocalReport Search::improve(std::vector<double>& u) {
  const optimise::LocalOptions local{.max_evaluations = options_.evaluations,
                                     .step_tolerance = 1e-12,
                                     .decrease_tolerance = 1e-14,
                                     .constraint_tolerance = feasible / 10};
  model_.whole(u, whole_, nullptr);
  const std::size_t m = limits_.size() + whole_.size();
  const auto limits = [&](std::span<const double> at, std::span<double> values, std::span<double> jacobian) {
    fill(false, at, values, jacobian);
  };
  if (epigraph()) {
    const auto functions = [&](std::span<const double> at, std::span<double> values,
                               std::span<double> jacobian) { fill(true, at, values, jacobian); };
    return optimise::minimise_largest(functions_.size(), functions, {}, m, limits, u, model_.lower(),
                                      model_.upper(), local, context_);
  }
  const auto cost = [&](std::span<const double> at, std::span<double> gradient) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    const int arm = model_.dimensions() - 3;
    if (model_.task().goal == DexterityGoal::size) {
      if (!gradient.empty()) gradient[arm] = gradient[arm + 1] = 1;
      return at[arm] + at[arm + 1];
    }
    const double mean = model_.mean(model_.designed(at), work_, gradient);
    for (double& g : gradient) g = -g;
    ++out_.evaluations;
    out_.poses += static_cast<std::int64_t>(model_.cells());
    return -mean;
  };
  return optimise::minimise_local(cost, m, limits, u, model_.lower(), model_.upper(), local, context_);
}

bool Search::exchange(std::span<const double> u, const Extremes& extremes, bool all) {
  // The goal of the epigraph on the working set: nodes that are worse join it.
  measure_at(u);
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const double value = there_[slot_of_function_[k]].conditioning;
    worst_ = k == 0 ? value : std::min(worst_, value);
  }
  bool added = false;
  for (int k = 0; k < pose_limit_kinds; ++k) {
    const auto kind = static_cast<PoseLimit::Kind>(k);
    if (!looks_at(kind)) continue;
    for (int i = 0; i < model_.entries(kind); ++i) {
      const Extreme& extreme = extreme_of(extremes, kind, i);
      const PoseLimit which{kind, i, extreme.pose};
      const double g = is_function(which) ? worst_ - extreme.value : model_.limit(kind, extreme, u);
      if (all || g > feasible / 2) added |= add(which);
    }
  }
  return added;
}

bool Search::exchange_between(std::span<const double> u, const Extremes& extremes) {
  constexpr double close = 0.02;
  const DesignedRobot designed = model_.designed(u);
  bool added = false;
  for (int k = 0; k < pose_limit_kinds; ++k) {
    const auto kind = static_cast<PoseLimit::Kind>(k);
    if (!looks_at(kind)) continue;
    for (int i = 0; i < model_.entries(kind); ++i) {
      const Extreme& extreme = extreme_of(extremes, kind, i);
      const bool function = is_function({kind, i, extreme.pose});
      if (!function && model_.limit(kind, extreme, u) < -close) continue;
      for (const BetweenNodes& found :
           between_nodes(model_, designed, kind, i, close, context_, out_.poses)) {
        const double g = function ? worst_ - found.value : model_.limit(kind, {found.value, 0}, u);
        if (g <= feasible) break;
        between_.push_back(found.at);
        added |= add({kind, i, model_.nodes() + between_.size() - 1});
      }
    }
  }
  return added;
}

void Search::look(const std::vector<double>& u) {
  known_.extremes = model_.extremes(model_.designed(u), work_);
  known_.known = true;
  out_.x = u;
}

void Search::go(std::vector<double> u) {
  if (epigraph())
    for (const std::size_t node : model_.few()) add({PoseLimit::conditioning, 0, node});
  look(u);
  // Nothing but limits keeps a robot from the lower bounds of its size, from where few searches come back.
  exchange(u, known_.extremes, model_.task().goal == DexterityGoal::size);
  for (out_.exchanges = 1; out_.exchanges <= options_.exchanges; ++out_.exchanges) {
    improve(u);
    look(u);
    ++out_.evaluations;
    out_.poses += static_cast<std::int64_t>(model_.nodes());
    out_.settled = !exchange(u, known_.extremes);
    if (out_.settled && options_.between_nodes) out_.settled = !exchange_between(u, known_.extremes);
    if (out_.settled || context_.interrupted()) break;
  }
}

Descent Search::run(std::vector<double> u) {
  out_.x = u;
  try {
    go(std::move(u));
  } catch (const Interrupted&) {
    out_.settled = false;
  }
  out_.exchanges = std::min(out_.exchanges, options_.exchanges);
  out_.working = static_cast<int>(functions_.size() + limits_.size());
  double mean = 0;
  try {
    if (known_.known && model_.task().goal == DexterityGoal::mean)
      mean = model_.mean(model_.designed(out_.x), work_, {});
  } catch (const Interrupted&) {
    known_.known = false;
  }
  if (known_.known) {
    const double cost = model_.cost(out_.x, known_.extremes, mean);
    out_.objective = model_.task().goal == DexterityGoal::size ? cost : -cost;
    out_.violation = model_.violation(model_.design_of(out_.x), known_.extremes);
  }
  known_.start = std::move(out_);
  return std::move(known_);
}

}  // namespace

std::vector<BetweenNodes> between_nodes(const DexterityModel& model, const DesignedRobot& designed,
                                        PoseLimit::Kind kind, int leg, double close, RunContext& context,
                                        std::int64_t& poses) {
  constexpr std::size_t most = 8;
  const PrescribedRegion& region = model.task().region;
  const int n = coordinates(region.shape);
  const double sign = kind == PoseLimit::side_swing || kind == PoseLimit::arm_high ? -1 : 1;
  std::array<double, 3> step{};
  for (int k = 0; k < n; ++k) {
    const auto [low, high] = coordinate_range(region, k);
    step[k] = (high - low) / (region.nodes[k] - 1);
  }
  DexterityModel::Work work;
  std::vector<double> values;
  model.indices(designed, kind, leg, work, values);
  poses += static_cast<std::int64_t>(values.size());
  // Few of many nodes are close to the worst: only those are put in order.
  double worst = infinity;
  for (const double v : values) worst = std::min(worst, sign * v);
  std::vector<std::size_t> order;
  for (std::size_t node = 0; node < values.size(); ++node)
    if (!(std::abs(sign * values[node] - worst) > close)) order.push_back(node);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sign * values[a] < sign * values[b]; });
  std::vector<BetweenNodes> out;
  for (const std::size_t node : order) {
    if (out.size() == most || std::abs(values[node] - values[order[0]]) > close) break;
    const DexterityModel::At at = model.at(node);
    const bool apart = std::all_of(out.begin(), out.end(), [&](const BetweenNodes& other) {
      if (other.at.orientation != at.orientation) return true;
      for (int k = 0; k < n; ++k)
        if (std::abs(other.at.coordinates[k] - at.coordinates[k]) > 1.5 * step[k]) return true;
      return false;
    });
    if (apart) out.push_back({at, values[node]});
  }
  for (BetweenNodes& found : out) {
    const auto start = found.at.coordinates;
    std::vector<double> at(start.begin(), start.begin() + n), lower(n), upper(n);
    for (int k = 0; k < n; ++k) {
      const auto [low, high] = coordinate_range(region, k);
      lower[k] = std::max(low, at[k] - step[k]);
      upper[k] = std::min(high, at[k] + step[k]);
    }
    const auto coordinates_of = [&](std::span<const double> c) {
      std::array<double, 3> all{};
      std::copy(c.begin(), c.end(), all.begin());
      return all;
    };
    const auto cost = [&](std::span<const double> c, std::span<double>) {
      PoseDexterity<double> there;
      measure(designed, model.task().mode, model.measures(), place(region, coordinates_of(c)),
              model.task().orientations[found.at.orientation], there);
      ++poses;
      return sign * index_of(kind, leg, there);
    };
    const optimise::LocalOptions local{.method = optimise::LocalMethod::bobyqa,
                                       .max_evaluations = 200,
                                       .step_tolerance = 1e-9,
                                       .decrease_tolerance = 1e-13};
    const optimise::LocalReport report = optimise::minimise_local(cost, at, lower, upper, local, context);
    if (!(report.cost < sign * found.value)) continue;
    found.value = sign * report.cost;
    found.at.coordinates = coordinates_of(at);
    found.at.place = place(region, found.at.coordinates);
  }
  std::stable_sort(out.begin(), out.end(), [&](const BetweenNodes& a, const BetweenNodes& b) {
    return sign * a.value < sign * b.value;
  });
  return out;
}

Descent descend(const DexterityModel& model, const DexterityOptions& options, std::vector<double> start,
                RunContext& context) {
  return Search(model, options, context).run(std::move(start));
}

}  // namespace linkwright::parallel
