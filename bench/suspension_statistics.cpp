// SPDX-License-Identifier: BSD-3-Clause

// Figures over seeds of the indirect synthesis of Poznanovic 2016, beside the published ones:
//
//   suspension_statistics REPEATS ROW ...
//
// runs seeds 1 ... REPEATS of the rows named and prints them in Markdown. Each seed has its own boxes of 150
// mm. Rows: "fit-1" ... "fit-4" (the recommended method), "fit-each", "fit-quadratic", "fit-dyad" (example 4
// without carrier pitch), "de-1" ... "de-4" (differential evolution, link by link), "de-1-together" (30
// unknowns), "de-quadratic", "de-dyad" (example 4 without carrier pitch).

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/corner_deviations.h"
#include "linkwright/suspension/indirect/published_suspensions.h"
#include "linkwright/suspension/indirect/synthesis.h"

namespace {

using namespace linkwright;
using namespace linkwright::suspension;

struct Row {
  std::string name;
  std::size_t example = 0;
  bool evolution = false, together = false;
  CarrierPitchTechnique technique = CarrierPitchTechnique::each;
  bool carrier_pitch_open = false;
  int generations = 10000;
  double another_program = 0;  // mean generations there; 0 = not measured
};

const std::vector<Row> rows = {
    {"fit-1", 0},
    {"fit-2", 1},
    {"fit-3", 2},
    {"fit-4", 3},
    {"fit-each", 3, false, false, CarrierPitchTechnique::each, true},
    {"fit-quadratic", 3, false, false, CarrierPitchTechnique::quadratic, true},
    {"fit-dyad", 3, false, false, CarrierPitchTechnique::dyad, true},
    {"de-1", 0, true, false, CarrierPitchTechnique::each, false, 10000, 2053},
    {"de-1-together", 0, true, true, CarrierPitchTechnique::each, false, 50000, 36685},
    {"de-2", 1, true, false, CarrierPitchTechnique::each, false, 10000, 1183},
    {"de-3", 2, true, false, CarrierPitchTechnique::each, false, 50000, 46121},
    {"de-4", 3, true, false, CarrierPitchTechnique::each, false, 50000, 13377},
    {"de-quadratic", 3, true, false, CarrierPitchTechnique::quadratic, true, 50000, 50000},
    {"de-dyad", 3, true, false, CarrierPitchTechnique::dyad, true, 50000, 50000},
};

std::string pair(double largest, double mean) { return fmt::format("{:.1e} / {:.1e}", largest, mean); }

struct Mean {
  double largest = 0, mean = 0;
  void add(const Deviation& d, int repeats) { largest += d.largest / repeats, mean += d.mean / repeats; }
  std::string in(double unit) const { return pair(largest / unit, mean / unit); }
};

void run(const Row& row, int repeats) {
  const PublishedSuspension& published = published_suspensions()[row.example];
  const Suspension& truth = corner_sample(published.sample).suspension;
  IndirectTask task{.targets = published_targets(published), .links = {}, .couplers = {}};
  const CarrierTargets complete = task.targets;
  if (row.carrier_pitch_open)
    for (CarrierTarget& pose : task.targets.poses)
      pose.angles.carrier_pitch = std::numeric_limits<double>::quiet_NaN();
  IndirectEvolutionOptions evolution;
  evolution.together = row.together;
  evolution.method.method.generations = row.generations;
  evolution.method.technique = row.technique;
  IndirectOptions fit;
  fit.carrier_pitch.technique = row.technique;
  double generations = 0, coordinates = 0, rms = 0, seconds = 0;
  int links = 0, done = 0, movable = 0, at_limit = 0;
  Mean x, y, toe, camber, carrier_pitch;
  for (int i = 1; i <= repeats; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    task.links = published_tasks(truth, seed);
    task.couplers = published_coupler_tasks(truth, seed);
    RunContext context;
    const auto begin = std::chrono::steady_clock::now();
    const IndirectSynthesis found =
        row.evolution ? evolve(task, evolution, seed, context) : synthesise(task, fit, seed, context);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    generations += static_cast<double>(found.generations) / repeats;
    at_limit += found.generations >= row.generations;
    coordinates +=
        coordinate_error(task.links, found.suspension.links, found.suspension.couplers, truth) / repeats;
    for (const LinkFit& link : found.links) {
      ++links;
      done += link.status == Status::done;
      rms += link.rms;
    }
    const PoseDeviations d = pose_deviations(found.suspension, complete);
    movable += d.missed == 0;
    x.add(d.x, repeats), y.add(d.y, repeats), toe.add(d.toe, repeats), camber.add(d.camber, repeats),
        carrier_pitch.add(d.carrier_pitch, repeats);
  }
  const PublishedEvolution& source = row.technique == CarrierPitchTechnique::quadratic ? published_quadratic()
                                     : row.technique == CarrierPitchTechnique::dyad    ? published_dyad()
                                                                                       : published.evolution;
  const double degree = math::radians(1);
  fmt::print(
      "| {} | {} | {:.0f} | {} | {} | {} | {:.1e} | {:.1e} | {}/{} | {:.1e} | {}/{} | {} | {} | {} | {} "
      "| {} | {:.2g} |\n",
      row.name, repeats, source.generations,
      row.another_program > 0 ? fmt::format("{:.0f}", row.another_program) : "",
      row.evolution ? fmt::format("{:.0f}", generations) : "",
      row.evolution ? fmt::format("{}", at_limit) : "", source.coordinate_error, coordinates, done, links,
      rms / links, movable, repeats, x.in(1), y.in(1), toe.in(degree), camber.in(degree),
      row.carrier_pitch_open ? "" : carrier_pitch.in(degree), seconds / repeats);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
  fmt::print(
      "| row | repeats | generations published | another program | ours | runs of a limit or more | "
      "coordinate "
      "error published (m) | ours (m) | links found | rms (m) | movable | x (m) | y (m) | toe (deg) | camber "
      "(deg) | carrier pitch (deg) | seconds a run "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 2; i < argc; ++i) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == argv[i]; });
    if (row == rows.end()) {
      fmt::print(stderr, "there is no row '{}'\n", argv[i]);
      return 2;
    }
    run(*row, repeats);
  }
}
