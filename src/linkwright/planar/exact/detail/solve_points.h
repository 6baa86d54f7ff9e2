// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/exact/detail/follow.h"
#include "linkwright/planar/exact/detail/monodromy.h"

namespace linkwright::planar {

/// Throws ContractError unless all points are finite and different.
void require_different(std::span<const std::complex<double>> points);

/// The ends of all paths from a start set to real data.
template <class System>
struct PointSolutions {
  Status status = Status::done;  ///< not_converged: paths were lost; or interrupted
  int infinite = 0, lost = 0;
  int singular = 0;  ///< ends where solutions meet
  std::vector<SystemPoint<System>> found;

  /// Copies status and numbers of ends.
  template <class Solutions>
  void count(Solutions& out) const {
    out.status = status;
    out.finite = static_cast<int>(found.size());
    out.infinite = infinite;
    out.lost = lost;
    out.singular = singular;
  }
};

/// Sorts real solutions by a place of theirs.
template <class Solution, class PlaceOf>
void sort_by_place(std::vector<Solution>& real, const PlaceOf& place_of) {
  const auto key = [&](const Solution& s) { return std::pair(place_of(s).real(), place_of(s).imag()); };
  std::sort(real.begin(), real.end(), [&](const Solution& a, const Solution& b) { return key(a) < key(b); });
}

namespace solve_points_detail {

inline constexpr double arrived_accuracy = 1e-9;  // size of the last step of Newton's method

// The data are real: what stands for conjugates becomes the places, and the places become the conjugates.
template <class System>
SystemPoint<System> conjugate_solution(const SystemPoint<System>& z) {
  constexpr std::size_t n = System::places;
  SystemPoint<System> out;
  for (std::size_t i = 0; i < n; ++i) out[i] = math::conj(z[i + n]), out[i + n] = math::conj(z[i]);
  for (std::size_t i = 2 * n; i < z.size(); ++i) out[i] = math::inverse(math::conj(z[i]));
  return out;
}

// True if a solution is isolated, so that small changes of the equations move it little: a family of them, or
// a place where some meet, does not. `z` has a size near 1.
template <class System>
bool stands_alone(const System& system, const SystemData<System>& p, const SystemPoint<System>& z) {
  constexpr double max_moved = 1e13;
  constexpr std::size_t n = System::unknowns;
  ComplexNumber values[n], right[1][n];
  math::tracker::Lu<double, n> lu;
  system.evaluate(z.data(), p.data(), values, lu.a);
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) size += math::norm(lu.a[i][j]);
    // A change of each equation by its own size, no two alike.
    right[0][i] = std::sqrt(size) * ComplexNumber(1, 0.37 * static_cast<double>(i));
  }
  lu.solve(right);
  return math::tracker::size(right[0]) < max_moved * max_moved * (1 + squared_size(z));
}

}  // namespace solve_points_detail

/// Follows every solution of the start set to real data, the second half of `target` the conjugates of the
/// first. What does not arrive, or arrives where another path does, is followed again in small steps and then
/// with twice the digits; the conjugate of a solution is one as well.
template <class System>
PointSolutions<System> solve_points(const StartSet<System>& starts, const SystemData<System>& target,
                                    RunContext& context, std::string_view stage = {},
                                    const System& system = {}) {
  using namespace solve_points_detail;
  PointSolutions<System> out;
  SystemData<System> scaled = target;
  const Scaling scaling = scale_towards<System>(starts.base, scaled), back = inverse(scaling);
  const std::size_t all = starts.points.size();
  Identities met;
  std::vector<SystemPoint<System>> found;         // solutions of the scaled data
  std::vector<std::optional<std::size_t>> owner;  // the path that came to it
  std::vector<std::size_t> open(all);
  for (std::size_t i = 0; i < all; ++i) open[i] = i;
  // One of two paths that come to the same solution has jumped.
  const auto take = [&](const SystemPoint<System>& z, std::optional<std::size_t> path,
                        std::vector<std::size_t>& again) {
    const ComplexNumber identity = System::identity(z);
    if (const int known = met.find(identity); known >= 0) {
      std::optional<std::size_t>& other = owner[static_cast<std::size_t>(known)];
      if (path && other) {
        again.insert(again.end(), {*path, *other});
        other.reset();
      } else if (path) {
        other = path;
      }
      return;
    }
    met.add(identity);
    found.push_back(z);
    owner.push_back(path);
  };
  const auto add_conjugates = [&] {
    std::vector<std::size_t> unused;
    for (std::size_t i = 0; i < found.size() && found.size() < all; ++i) {
      SystemPoint<System> z = found[i];
      scale_solution<System>(back, z);
      z = conjugate_solution<System>(z);
      scale_solution<System>(scaling, z);
      if (polish(system, scaled, z, 1e-14) < arrived_accuracy && stands_alone(system, scaled, z))
        take(z, std::nullopt, unused);
    }
  };

  for (const math::TrackerOptions& options : {math::TrackerOptions(), small_steps}) {
    if (open.empty() || found.size() == all) break;
    Paths<System> paths;
    for (const std::size_t i : open) paths.push_back({.z = starts.points[i]});
    paths = follow(system, starts.base, scaled, paths, options, context, stage);
    if (context.interrupted()) {
      out.status = context.interruption();
      return out;
    }
    std::vector<std::size_t> again;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (paths[k].arrived && polish(system, scaled, paths[k].z, 1e-14) < arrived_accuracy &&
          stands_alone(system, scaled, paths[k].z))
        take(paths[k].z, open[k], again);
      else
        again.push_back(open[k]);
    }
    open = std::move(again);
    stage = {};
    add_conjugates();
  }
  if (!open.empty() && found.size() < all) {
    Paths<System, math::DoubleDouble> paths;
    for (const std::size_t i : open) paths.push_back({.z = widened(starts.points[i])});
    paths = follow(system, starts.base, scaled, paths, careful, context);
    if (context.interrupted()) {
      out.status = context.interruption();
      return out;
    }
    std::vector<std::size_t> unused;
    for (const auto& path : paths) {
      SystemPoint<System> z = rounded(path.z);
      const double size = squared_size(z);
      if (path.arrived && polish_as_needed(system, scaled, z, 1e-12) < arrived_accuracy &&
          stands_alone(system, scaled, z))
        take(z, std::nullopt, unused);
      else if (path.at < 1 - nearly_there)
        ++out.lost;
      else if (size > far_out * far_out)
        ++out.infinite;
    }
    add_conjugates();
  }
  // Each solution takes one path. Of the others, some end at infinity, some got lost unless a conjugate made
  // up for them; the rest ended where solutions meet.
  const int missing = std::max(0, static_cast<int>(all) - static_cast<int>(found.size()));
  out.infinite = std::min(out.infinite, missing);
  out.lost = std::min(out.lost, missing - out.infinite);
  out.singular = missing - out.infinite - out.lost;
  if (out.lost > 0) out.status = Status::not_converged;
  for (SystemPoint<System>& z : found) {
    scale_solution<System>(back, z);
    out.found.push_back(z);
  }
  return out;
}

/// True if a solution is real, so that its partners are its conjugates; `size` (m) is that of the points.
template <class System>
bool is_real_solution(const SystemPoint<System>& z, double size) {
  constexpr double real_tolerance = 1e-8;
  constexpr std::size_t n = System::places;
  double off = 0, largest = size * size;
  for (std::size_t i = 0; i < n; ++i) {
    off = std::max(off, math::norm(z[i + n] - math::conj(z[i])));
    largest = std::max({largest, math::norm(z[i]), math::norm(z[i + n])});
  }
  bool real = off <= real_tolerance * real_tolerance * largest;
  for (std::size_t i = 2 * n; i < z.size(); ++i)
    real = real && std::abs(math::norm(z[i]) - 1) <= real_tolerance;
  return real;
}

/// A place of a real solution, from the first point (m).
template <class System>
std::complex<double> real_place(const SystemPoint<System>& z, std::size_t i) {
  return 0.5 * (standard_complex(z[i]) + std::conj(standard_complex(z[i + System::places])));
}

}  // namespace linkwright::planar
