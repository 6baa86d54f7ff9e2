#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/sentence.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/planar/path/four_bar/synthesis.h"
#include "linkwright/study/result.h"
#include "linkwright/study/run_seeds.h"

// The seeds of a path synthesis study, of whatever mechanism: an answer has a status, designs (best first),
// a history and evaluations, and kept() and restored() take it to a checkpoint and back.
namespace linkwright::planar {

/// The outcome of the seeds, and the name of the method that they ran.
template <class Answer>
struct PathRuns : study::SeedRuns<Answer> {
  std::string method;
};

/// Least error of a seed (m2); infinite when it found no feasible design.
template <class Answer>
double best_error(const Answer& answer) {
  return answer.designs.empty() || !answer.designs[0].violations.empty() ? infinity : answer.designs[0].error;
}

/// The sum of squares of an answer (m2) as it is written: with decimals that compare, a small one by its
/// digits.
inline Measured path_error(double sum) {
  return sum >= 1e-4 ? measured("m2", sum).fixed(8) : measured("m2", sum);
}

/// A seed succeeds when its error is not above this (m2): close to the best of all seeds, or, where zero is
/// within reach, to zero, for a path of so large a size (m).
inline double success_threshold(double best, double size) {
  constexpr double share_of_best = 1e-4, of_size = 1e-12;
  return best + std::max(share_of_best * best, of_size * size * size);
}

/// The decrease of the least error of a feasible design in a population method.
inline std::vector<SearchPoint> improvements(const std::vector<optimise::GenerationLog>& log) {
  std::vector<SearchPoint> out;
  for (const optimise::GenerationLog& generation : log)
    if (generation.best_violation == 0 && (out.empty() || generation.best_cost < out.back().best))
      out.push_back({generation.evaluations, generation.best_cost});
  return out;
}

/// Runs run_seed(method, seed, only_seed) for each seed of a study, `method` being the one it chose.
template <class Study, class RunSeed>
auto run_path_seeds(const Study& s, const study::Common& common, RunContext& context, RunSeed&& run_seed) {
  std::string method(std::visit([](const auto& m) { return choice_word(m).name; }, s.optimiser.method));
  const bool only_seed = common.seeds.count == 1;
  const auto run = [&](std::uint64_t seed) {
    return std::visit([&](const auto& m) { return run_seed(m, seed, only_seed); }, s.optimiser.method);
  };
  using Answer = decltype(run(std::uint64_t{}));
  study::SeedRuns<Answer> runs = study::run_seeds(
      common.seeds, context, method, run, [](const Answer& answer) { return answer.status; },
      [](const Answer& answer) { return best_error(answer); },
      [](const Answer& answer) { return kept(answer); },
      [&](const Value& value, const std::string& what) { return restored(value, s.problem, what); });
  return PathRuns<Answer>{std::move(runs), std::move(method)};
}

/// The table "seeds"; `missing`: of a front, the share of the common one that each seed misses, else empty.
template <class Answer>
Table path_seed_table(const PathRuns<Answer>& runs, const std::vector<double>& missing) {
  Table seeds{.name = "seeds", .columns{}, .status{}};
  std::vector<double> number, error, evaluations;
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const Answer& answer = runs.answers[i];
    const double best = best_error(answer);
    number.push_back(static_cast<double>(runs.seeds[i]));
    error.push_back(best == infinity ? nan : best);
    evaluations.push_back(static_cast<double>(answer.evaluations));
    seeds.status.emplace_back(to_string(answer.status));
  }
  seeds.add("seed", "seed", number);
  seeds.add("path_error_sum_sq_m2", "path error, sum of squares (m2)", error);
  if (!missing.empty()) seeds.add("missing", "share of the common front that is missing", missing);
  seeds.add("evaluations", "evaluations", evaluations);
  return seeds;
}

}  // namespace linkwright::planar
