#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/optimise/statistics.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {

/// What the seeds of a study came to; under an interruption perhaps not all of them.
template <class Answer>
struct SeedRuns {
  Status status = Status::done;  ///< done, or why it was interrupted
  std::vector<std::uint64_t> seeds;
  std::vector<Answer> answers;
};

/// Runs answer(seed) for each seed of a study on the threads of the context. `status` and `cost` (for the
/// progress; infinite if none) of an answer are asked of it.
template <class Run, class StatusOf, class CostOf>
auto run_seeds(const Seeds& asked, RunContext& context, std::string_view stage, Run&& run, StatusOf&& status,
               CostOf&& cost) {
  using Answer = decltype(run(std::uint64_t{}));
  const auto count = static_cast<std::size_t>(asked.count);
  const optimise::SeedRange seeds{static_cast<std::uint64_t>(asked.first), asked.count};
  std::vector<Answer> all(count);
  const optimise::SeedLoop loop =
      optimise::for_each_seed(seeds, context, stage, [&](std::size_t i, std::uint64_t seed) {
        all[i] = run(seed);
        return cost(all[i]);
      });
  SeedRuns<Answer> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!loop.ran[i]) continue;
    const Status ended = status(all[i]);
    if (out.status == Status::done && (ended == Status::deadline || ended == Status::cancelled))
      out.status = ended;
    out.seeds.push_back(seeds.first + i);
    out.answers.push_back(std::move(all[i]));
  }
  // An interruption after the last seed was done took nothing away.
  if (out.answers.size() < count) out.status = loop.status;
  return out;
}

/// Writes what seeds came to behind what `out` holds, under the keys that all studies with seeds have.
inline void write_statistics(Value& out, const optimise::SeedStatistics& st) {
  out["seeds"] = st.seeds;
  out["feasible_seeds"] = st.feasible;
  out["best"] = st.best;
  out["quantile10"] = st.quantile10;
  out["median"] = st.median;
  out["quantile90"] = st.quantile90;
  out["worst"] = st.worst;
  out["success_threshold"] = st.threshold;
  out["success_rate"] = st.success_rate;
  out["evaluations"] = st.evaluations;
  out["median_evaluations"] = st.median_evaluations;
}

}  // namespace linkwright::study
