#include "linkwright/planar/path/checkpoint.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/path/search_record.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t linkage_numbers = 11;  // before the crank angles

std::vector<double> numbers_of(const PathDesign& d) {
  const FourBar& l = d.linkage;
  std::vector<double> numbers = {sign(l.branch), l.ground,  l.crank,   l.coupler,     l.rocker, l.coupler_u,
                                 l.coupler_v,    l.pivot_x, l.pivot_y, l.frame_angle, d.sense};
  numbers.insert(numbers.end(), d.angles.begin(), d.angles.end());
  return numbers;
}

PathDesign design_of(const std::vector<double>& v, const PathProblem& problem, std::string_view what) {
  require_numbers(v, linkage_numbers + problem.x.size(), what);
  if (!is_kept_sign(v[0]) || !std::all_of(v.begin() + 1, v.begin() + 5, is_kept_length) ||
      !std::all_of(v.begin() + 5, v.begin() + 9, is_kept_place) || !is_kept_angle(v[9]) ||
      !is_kept_sign(v[10]) || !std::all_of(v.begin() + linkage_numbers, v.end(), is_kept_angle))
    throw CheckpointError(fmt::format("{}: a design is not a four-bar", what));
  const FourBar linkage{.ground = v[1],
                        .crank = v[2],
                        .coupler = v[3],
                        .rocker = v[4],
                        .coupler_u = v[5],
                        .coupler_v = v[6],
                        .pivot_x = v[7],
                        .pivot_y = v[8],
                        .frame_angle = v[9],
                        .branch = v[0] > 0 ? Branch::open : Branch::crossed};
  return measure(problem, linkage, v[10], {v.begin() + linkage_numbers, v.end()});
}

}  // namespace

Value kept(const PathSeedRun& run) {
  std::vector<std::vector<double>> designs;
  for (const PathDesign& design : run.designs) designs.push_back(numbers_of(design));
  return kept({run.status, run.evaluations, run.history}, designs);
}

PathSeedRun restored(const Value& value, const PathProblem& problem, std::string_view what) {
  PathSeedRun run;
  SearchRecord record = restored(value, what, [&](const std::vector<double>& numbers) {
    run.designs.push_back(design_of(numbers, problem, what));
  });
  run.status = record.status;
  run.evaluations = record.evaluations;
  run.history = std::move(record.history);
  return run;
}

}  // namespace linkwright::planar
