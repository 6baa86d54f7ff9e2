// SPDX-License-Identifier: BSD-3-Clause

// Figures over seeds of the synthesis of parallel robots, exact method and population methods side by side:
//
//   parallel_statistics SEEDS ROW ...
//
// runs seeds 1 ... SEEDS of the rows named and prints them in Markdown. A row is "B1", "B2" or "B3", the
// benchmarks of a DELTA for a cylinder, with a method: "B1:exact", "B3:differential_evolution", or
// "joint:MU", B3 with Pi-joints that telescope by 2 and have a transmission angle of at least MU degrees.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/parallel/dexterity/synthesis.h"
#include "linkwright/parallel/dexterity/synthesis_samples.h"

namespace {

using namespace linkwright;
using namespace linkwright::parallel;

struct Run {
  DexterityDesign best;
  std::int64_t evaluations = 0, poses = 0;
  double seconds = 0;
  int starts = 0, reached_best = 0, exchanges = 0;
};

Run run(const DexterityTask& task, const std::string& method, std::uint64_t seed) {
  RunContext context;
  context.set_threads(1);
  // One thread: seconds of the processor, whatever else the machine does.
  const std::clock_t begin = std::clock();
  Run out;
  if (method == "exact") {
    const DexteritySynthesis found = synthesise(task, {}, seed, context);
    out = {.best = found.best,
           .evaluations = found.evaluations,
           .poses = found.poses,
           .starts = static_cast<int>(found.starts.size()),
           .reached_best = found.reached_best};
    for (const DexterityStart& start : found.starts) out.exchanges = std::max(out.exchanges, start.exchanges);
  } else {
    optimise::OptimiserOptions options;
    for (const auto& name : names(optimise::Method{}))
      if (name.name == method) options.method = name.value;
    optimise::MinimiseOptions minimise;
    minimise.log = minimise.progress = false;
    minimise.stop.evaluations = 5000;
    const DexterityEvolution found = evolve(task, options, minimise, seed, context);
    out = {.best = found.best, .evaluations = found.report.evaluations, .poses = found.poses};
  }
  out.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return out;
}

std::string values(const DexterityDesign& design) {
  std::string text;
  for (const double x : design.x) text += fmt::format("{}{:.8f}", text.empty() ? "" : ", ", x);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  fmt::print(
      "| row | method | seeds | feasible | best | median | worst | designs a seed | poses a seed | seconds a "
      "seed | starts, reached best, rounds | best design "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int a = 2; a < argc; ++a) {
    const std::string row = argv[a];
    const auto colon = row.find(':');
    const std::string name = row.substr(0, colon);
    std::string method = colon == std::string::npos ? "exact" : row.substr(colon + 1);
    DexterityTask task = name == "B1"   ? dexterity_benchmark(DexterityGoal::worst)
                         : name == "B2" ? dexterity_benchmark(DexterityGoal::mean)
                                        : dexterity_benchmark(DexterityGoal::size);
    if (name == "joint") {
      task = dexterity_benchmark_with_pi_joints(math::radians(std::atof(method.c_str())));
      method = "exact";
    }
    std::vector<Run> runs;
    for (int i = 1; i <= seeds; ++i) runs.push_back(run(task, method, static_cast<std::uint64_t>(i)));
    const double sign = task.goal == DexterityGoal::size ? 1 : -1;
    std::stable_sort(runs.begin(), runs.end(), [&](const Run& x, const Run& y) {
      return optimise::better(sign * x.best.objective, x.best.violation, sign * y.best.objective,
                              y.best.violation);
    });
    double designs = 0, poses = 0, seconds = 0;
    int feasible = 0;
    for (const Run& r : runs) {
      designs += static_cast<double>(r.evaluations) / seeds;
      poses += static_cast<double>(r.poses) / seeds;
      seconds += r.seconds / seeds;
      feasible += r.best.status == Status::done;
    }
    fmt::print(
        "| {} | {} | {} | {} | {:.9f} | {:.9f} | {:.9f} | {:.0f} | {:.0f} | {:.3f} | {}, {}, {} | {} |\n",
        name == "joint" ? row : name, method, seeds, feasible, runs[0].best.objective,
        runs[runs.size() / 2].best.objective, runs.back().best.objective, designs, poses, seconds,
        runs[0].starts, runs[0].reached_best, runs[0].exchanges, values(runs[0].best));
    std::fflush(stdout);
  }
}
