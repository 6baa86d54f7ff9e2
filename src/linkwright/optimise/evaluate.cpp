// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/evaluate.h"

#include <algorithm>

#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"

namespace linkwright::optimise {
namespace {

constexpr std::size_t block_size = 256;  // a multiple of 8, see PopulationView::slice

}  // namespace

void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, int threads) {
  if (threads == 1 || candidates.size <= block_size) return problem.evaluate(candidates, cost, violation);
  const std::size_t m = problem.objectives, blocks = (candidates.size + block_size - 1) / block_size;
  parallel_for(blocks, threads, [&](std::size_t block) {
    const std::size_t first = block * block_size, count = std::min(block_size, candidates.size - first);
    problem.evaluate(candidates.slice(first, count), cost.subspan(first * m, count * m),
                     violation.subspan(first, count));
  });
}

void evaluate(const Problem& problem, const PopulationView& candidates, std::span<double> cost,
              std::span<double> violation, const RunContext& context) {
  std::fill(cost.begin(), cost.end(), nan);
  std::fill(violation.begin(), violation.end(), nan);
  const std::size_t m = problem.objectives, blocks = (candidates.size + block_size - 1) / block_size;
  parallel_for(blocks, context.threads(), [&](std::size_t block) {
    if (block > 0) throw_if_interrupted(context);
    const std::size_t first = block * block_size, count = std::min(block_size, candidates.size - first);
    problem.evaluate(candidates.slice(first, count), cost.subspan(first * m, count * m),
                     violation.subspan(first, count));
  });
}

}  // namespace linkwright::optimise
