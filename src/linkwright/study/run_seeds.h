// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {

/// The outcome of the seeds of a study; under an interruption perhaps not all of them.
template <class Answer>
struct SeedRuns {
  Status status = Status::done;  ///< done, or why it was interrupted
  std::vector<std::uint64_t> seeds;
  std::vector<Answer> answers;
};

inline bool is_interrupted(Status status) {
  return status == Status::deadline || status == Status::cancelled;
}

/// The status of a seed that ended, as a checkpoint saves it under the key `status` of a table, and back.
/// Throws CheckpointError, naming `what`, unless it is the name of a status of a seed that came to its end.
Value saved_status(Status status);
Status load_status(const Value& table, std::string_view what);

/// Likewise the generations of a population method, under the key `log`.
Value saved_log(std::span<const optimise::GenerationLog> log);
std::vector<optimise::GenerationLog> load_log(const Value& table, std::string_view what);

/// Member `key` of a table: `count` packed numbers, all of them finite. Throws CheckpointError, naming
/// `what`.
std::vector<double> load_numbers(const Value& table, std::string_view key, std::size_t count,
                                 std::string_view what);

/// Far more evaluations than a search makes, and few enough that the sum over the seeds of a study is an
/// integer.
inline constexpr std::int64_t max_kept_evaluations = std::int64_t{1} << 46;

/// Runs answer(seed) for each seed of a study on the threads of the context. `status` and `cost` (for the
/// progress; infinite if none) of an answer are asked of it.
///
/// Seeds that came to their end go to the checkpoint of the context, if it has one, as kept(answer); those
/// that it has are not run again, but taken as restored(value, what), which must be the same answer to the
/// bit, and throws CheckpointError, naming `what`, for everything that `kept` cannot have made.
template <class Run, class StatusOf, class CostOf, class Kept, class Restored>
auto run_seeds(const Seeds& asked, RunContext& context, std::string_view stage, Run&& run, StatusOf&& status,
               CostOf&& cost, Kept&& kept, Restored&& restored) {
  using Answer = decltype(run(std::uint64_t{}));
  const auto count = static_cast<std::size_t>(asked.count);
  const optimise::SeedRange seeds{static_cast<std::uint64_t>(asked.first), asked.count};
  std::vector<Answer> all(count);
  const optimise::PieceLoop loop = optimise::for_each_seed(
      seeds, context, stage,
      [&](std::size_t i, std::uint64_t seed) {
        all[i] = run(seed);
        return cost(all[i]);
      },
      [&](std::size_t i) { return is_interrupted(status(all[i])) ? Value() : kept(all[i]); },
      [&](std::size_t i, const Value& value) {
        all[i] = restored(value, optimise::seed_name(seeds.first + i));
        return cost(all[i]);
      });
  SeedRuns<Answer> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!loop.ran[i]) continue;
    const Status ended = status(all[i]);
    if (out.status == Status::done && is_interrupted(ended)) out.status = ended;
    out.seeds.push_back(seeds.first + i);
    out.answers.push_back(std::move(all[i]));
  }
  // An interruption after the last seed was done took nothing away.
  if (out.answers.size() < count) out.status = loop.status;
  return out;
}

/// The outcome of one seed, for the log of a result.
Value seed_entry(std::uint64_t seed, Status status, double best, std::int64_t evaluations);

/// Adds how the best of a seed fell to its entry: what had been reached after so many evaluations, to the end
/// of the run.
template <class Point>
void write_history(Value& entry, std::vector<Point> points, std::int64_t evaluations) {
  if (!points.empty()) points.push_back({evaluations, points.back().best});
  entry["history"] = Value::array();
  for (const Point& point : points) {
    Value step;
    step["evaluations"] = point.evaluations;
    step["best"] = point.best;
    entry["history"].push_back(std::move(step));
  }
}

/// Writes what seeds came to behind what `out` holds, under the keys that all studies with seeds have. Where
/// a cost is minus the quantity to be maximised, sign = -1 writes that quantity.
void write_statistics(Value& out, const optimise::SeedStatistics& st, double sign = 1);

/// "7 of 10": how many of the seeds that ran succeeded by the statistics of a result.
Sentence successful_seeds(const Result& result, std::size_t ran);
/// Adds how many seeds succeeded and what all of them evaluated; `judged`: it is good when nearly all did.
void add_seed_facts(Result& result, std::string label, std::size_t ran, bool judged = true);
/// Warns when not all of the seeds that were asked for ran.
void warn_of_missing_seeds(Result& result, std::size_t ran, const Seeds& asked);

}  // namespace linkwright::study
