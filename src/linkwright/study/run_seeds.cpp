// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/run_seeds.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linkwright/study/remarks.h"

namespace linkwright::study {
namespace {

constexpr std::array ends{Status::done, Status::no_assembly, Status::singular, Status::not_converged,
                          Status::infeasible};
constexpr std::size_t numbers_of_generation = 5;

}  // namespace

Value saved_status(Status status) { return Value(to_string(status)); }

Status load_status(const Value& table, std::string_view what) {
  const Value& name = load_member(table, "status", what);
  for (const Status end : ends)
    if (name.is_string() && name.as_string() == to_string(end)) return end;
  throw CheckpointError(fmt::format("{}: has no status of a seed that came to its end", what));
}

Value saved_log(std::span<const optimise::GenerationLog> log) {
  Value::Array evaluations;
  std::vector<double> numbers;
  for (const optimise::GenerationLog& g : log) {
    evaluations.emplace_back(g.evaluations);
    numbers.insert(numbers.end(), {g.best_cost, g.best_violation, g.median, g.mean, g.violated});
  }
  Value out;
  out["evaluations"] = Value(std::move(evaluations));
  out["numbers"] = pack_numbers(numbers);
  return out;
}

std::vector<optimise::GenerationLog> load_log(const Value& table, std::string_view what) {
  const Value& log = load_member(table, "log", what);
  const Value& evaluations = load_member(log, "evaluations", what);
  const std::vector<double> numbers = unpack_numbers(load_member(log, "numbers", what), what);
  if (!evaluations.is_array() || numbers.size() != numbers_of_generation * evaluations.as_array().size())
    throw CheckpointError(fmt::format("{}: its log is not one of generations", what));
  std::vector<optimise::GenerationLog> out;
  for (std::size_t i = 0; i < evaluations.as_array().size(); ++i) {
    const Value& count = evaluations.as_array()[i];
    if (!count.is_integer() || count.as_integer() < 0 || count.as_integer() > max_kept_evaluations)
      throw CheckpointError(fmt::format("{}: generation {} of its log has no evaluations", what, i));
    const double* g = &numbers[numbers_of_generation * i];
    out.push_back({.evaluations = count.as_integer(),
                   .best_cost = g[0],
                   .best_violation = g[1],
                   .median = g[2],
                   .mean = g[3],
                   .violated = g[4]});
  }
  return out;
}

std::vector<double> load_numbers(const Value& table, std::string_view key, std::size_t count,
                                 std::string_view what) {
  std::vector<double> out = unpack_numbers(load_member(table, key, what), what);
  if (out.size() != count)
    throw CheckpointError(fmt::format("{}: {} has {} numbers, must be {}", what, key, out.size(), count));
  if (!std::all_of(out.begin(), out.end(), [](double x) { return std::isfinite(x); }))
    throw CheckpointError(fmt::format("{}: {} is not finite", what, key));
  return out;
}

Value seed_entry(std::uint64_t seed, Status status, double best, std::int64_t evaluations) {
  Value entry;
  entry["seed"] = static_cast<std::int64_t>(seed);
  entry["status"] = to_string(status);
  entry["best"] = best;
  entry["evaluations"] = evaluations;
  return entry;
}

void write_statistics(Value& out, const optimise::SeedStatistics& st, double sign) {
  out["seeds"] = st.seeds;
  out["feasible_seeds"] = st.feasible;
  out["best"] = sign * st.best;
  out["quantile10"] = sign * st.quantile10;
  out["median"] = sign * st.median;
  out["quantile90"] = sign * st.quantile90;
  out["worst"] = sign * st.worst;
  out["success_threshold"] = sign * st.threshold;
  out["success_rate"] = st.success_rate;
  out["evaluations"] = st.evaluations;
  out["median_evaluations"] = st.median_evaluations;
}

Sentence successful_seeds(const Result& result, std::size_t ran) {
  const double share = result.statistics.find("success_rate")->as_number();
  return say("{} of {}", count_of(share * static_cast<double>(ran)), ran);
}

void add_seed_facts(Result& result, std::string label, std::size_t ran, bool judged) {
  using Verdict = Fact::Verdict;
  const bool good = judged && result.statistics.find("success_rate")->as_number() > 0.9;
  const AddFact fact{result.facts};
  fact(std::move(label), successful_seeds(result, ran), good ? Verdict::good : Verdict::plain);
  fact("evaluations", say("{}", result.statistics.find("evaluations")->as_integer()));
}

void warn_of_missing_seeds(Result& result, std::size_t ran, const Seeds& asked) {
  if (ran < static_cast<std::size_t>(asked.count))
    AddWarning{result.diagnostics}(fmt::format("interrupted: {} of {} seeds ran", ran, asked.count));
}

}  // namespace linkwright::study
