// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_paths.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/random.h"

namespace linkwright::parallel {
namespace {

constexpr double same_path_end = 1e-7;   // distance of solutions that are one
constexpr double shortest_step = 1e-12;  // share of the path
constexpr int max_steps = 500;
constexpr double nearly_there = 1e-6;     // share of the path done, for a path that is stuck
constexpr double on_the_last_part = 0.1;  // the same, on its path to infinity
constexpr double small = 0.2;             // ratio of |e| to |x|, for a path that leads to infinity
constexpr double far_correction = 1e-3;   // size of the first Newton step: the series failed
constexpr double path_rounding = 1e-13;

struct Workspace {
  PlatformValues values;
  EightLu lu;
  PlatformSeries terms;
};

// Leaves the factors at the old x.
double correct(const PlatformLegs& legs, PlatformPoint& x, Workspace& work) {
  evaluate(legs, x, x, work.values);
  if (!work.lu.factor(work.values.jacobian)) return INFINITY;
  PlatformPoint step = work.values.value;
  work.lu.solve(step);
  const double size = length(step);
  if (!std::isfinite(size)) return INFINITY;
  for (int k = 0; k < 8; ++k) x[k] -= step[k];
  x = normalised(x);
  return size;
}

// The last two terms stay below the accuracy: with eight of them, at a third of the radius of convergence.
double step_of(const PlatformSeries& terms, double accuracy) {
  constexpr int n = series_order;
  return std::min(std::pow(accuracy / length(terms[n]), 1.0 / n),
                  std::pow(accuracy / length(terms[n - 1]), 1.0 / (n - 1)));
}

PlatformPoint sum(const PlatformSeries& terms, double t) {
  PlatformPoint out = terms[series_order];
  for (int n = series_order - 1; n >= 0; --n)
    for (int k = 0; k < 8; ++k) out[k] = out[k] * t + terms[n][k];
  return normalised(out);
}

PathEnd end_of_stuck(const PlatformPath& path) {
  if (1 - path.at < on_the_last_part && nearly_infinite(path.point)) return PathEnd::infinite;
  return 1 - path.at < nearly_there ? PathEnd::singular : PathEnd::lost;
}

}  // namespace

bool nearly_infinite(const PlatformPoint& x) {
  double rotation = 0;
  for (int k = 0; k < 4; ++k) rotation += std::norm(x[k]);
  return std::sqrt(rotation) < small * length(x);
}

PlatformPath follow(const PlatformLegs& from, const PlatformLegs& to, const PlatformPoint& start,
                    double accuracy) {
  PlatformPath path{.point = normalised(start)};
  Workspace work;
  const PlatformLegs rate = sum(to, -1, from);
  PlatformLegs legs = from;
  if (!(correct(legs, path.point, work) < far_correction)) return path;
  while (path.at < 1) {
    // The Newton step that made the point good to the last digits left the factors for the series.
    expand(legs, rate, path.point, work.lu, work.terms);
    for (double step = step_of(work.terms, accuracy);; step /= 2) {
      if (!(step > shortest_step) || ++path.steps > max_steps) {
        path.end = end_of_stuck(path);
        return path;
      }
      const bool last = path.at + step >= 1;
      if (last) step = 1 - path.at;
      const double at = last ? 1 : path.at + step;
      const PlatformLegs ahead = last ? to : sum(from, at, rate);
      PlatformPoint trial = sum(work.terms, step);
      const double first = correct(ahead, trial, work);
      if (!(first < far_correction)) continue;
      // Quadratic convergence, or the point is not this path's.
      if (!(correct(ahead, trial, work) < std::max(first * 1e-2, path_rounding))) continue;
      path.point = trial;
      path.at = at;
      legs = ahead;
      break;
    }
  }
  path.end = PathEnd::regular;
  return path;
}

PlatformLegs random_platform(std::uint64_t seed, std::uint32_t number) {
  RandomStream random({seed, number});
  PlatformLegs out;
  const auto fill = [&](Six& six, int from) {
    for (int i = from; i < 6; ++i) {
      six.re[i] = random.normal() / 2;
      six.im[i] = random.normal() / 2;
    }
  };
  for (int k = 0; k < 3; ++k) {
    fill(out.base[k], 1);
    fill(out.platform[k], 1);
  }
  fill(out.square, 0);
  return out;
}

SolvedPlatform monodromy(std::uint64_t seed) {
  SolvedPlatform out{.legs = random_platform(seed, 0)};
  RandomStream random({seed, 1});
  PlatformPoint first;
  for (Complex& c : first) {
    const double re = random.normal(), im = random.normal();
    c = {re, im};
  }
  // Onto e . h = 0 by its last number.
  first[7] = -(first[0] * first[4] + first[1] * first[5] + first[2] * first[6]) / first[3];
  out.legs.square = squares_through(out.legs, first);
  out.solutions.push_back(normalised(first));
  // Each loop takes all known solutions around; one that comes back new joins them.
  constexpr std::uint32_t max_loops = 100;
  for (std::uint32_t loop = 1; out.solutions.size() < max_solutions && loop < max_loops; ++loop) {
    const PlatformLegs corner[] = {out.legs, random_platform(seed, 2 * loop),
                                   random_platform(seed, 2 * loop + 1), out.legs};
    for (std::size_t i = 0; i < out.solutions.size() && out.solutions.size() < max_solutions; ++i) {
      PlatformPath path{.end = PathEnd::regular, .point = out.solutions[i]};
      for (int side = 0; side < 3 && path.end == PathEnd::regular; ++side, ++out.paths)
        path = follow(corner[side], corner[side + 1], path.point);
      if (path.end != PathEnd::regular) continue;
      if (std::none_of(out.solutions.begin(), out.solutions.end(),
                       [&](const PlatformPoint& s) { return distance(s, path.point) < same_path_end; }))
        out.solutions.push_back(path.point);
    }
  }
  return out;
}

}  // namespace linkwright::parallel
