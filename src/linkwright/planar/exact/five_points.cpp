#include "linkwright/planar/exact/five_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/planar/exact/detail/monodromy.h"
#include "linkwright/planar/exact/detail/path_systems.h"

namespace linkwright::planar {
namespace {

using Five = FivePointsTwoPivots;
constexpr std::uint64_t five_point_seed = 1;
constexpr double five_real_tolerance = 1e-8;
// A path that stops this near to its end has come to it; one that ends at infinity has then left the size of
// the points (1 here) far behind, growing with the root of the way that is left.
constexpr double five_nearly_there = 1e-6, five_far_out = 100;

const StartSet<Five>& five_point_starts() {
  static const StartSet<Five> starts = [] {
    RunContext alone;  // milliseconds: not worth a cancellation
    alone.set_threads(1);
    return find_starts<Five>(five_point_seed, five_point_solutions, alone);
  }();
  return starts;
}

enum class FiveEnd { regular, infinite, singular, lost };

// What became of a path that did not arrive at a simple solution: followed on with twice the digits until it
// is as near to its end as they allow.
FiveEnd settle_path(const SystemData<Five>& from, const SystemData<Five>& to, const SystemPoint<Five>& start,
                    SystemPoint<Five>& z, RunContext& context) {
  const auto path =
      follow(Five(), from, to, Paths<Five, math::DoubleDouble>{{.z = widened(start)}}, careful, context)[0];
  z = rounded(path.z);
  if (path.arrived && polish_as_needed(Five(), to, z, 1e-12) < 1e-9) return FiveEnd::regular;
  if (path.at < 1 - five_nearly_there) return FiveEnd::lost;
  return squared_size(z) > five_far_out * five_far_out ? FiveEnd::infinite : FiveEnd::singular;
}

}  // namespace

FivePointSolutions solve_five_points(std::span<const std::complex<double>, 5> points,
                                     const std::array<std::complex<double>, 2>& pivots, RunContext& context) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    LINKWRIGHT_REQUIRE(std::isfinite(std::abs(points[i])), "point {} is not finite", i + 1);
    for (std::size_t j = 0; j < i; ++j)
      LINKWRIGHT_REQUIRE(points[i] != points[j], "point {} repeats point {}", i + 1, j + 1);
  }
  LINKWRIGHT_REQUIRE(
      std::isfinite(std::abs(pivots[0])) && std::isfinite(std::abs(pivots[1])) && pivots[0] != pivots[1],
      "the pivots must be finite and different");
  const Five system;
  const StartSet<Five>& starts = five_point_starts();
  LINKWRIGHT_REQUIRE(starts.status == Status::done, "{} of {} start solutions", starts.points.size(),
                     five_point_solutions);
  SystemData<Five> target;
  for (std::size_t j = 0; j < Five::others; ++j) target[j] = complex_number(points[j + 1] - points[0]);
  for (std::size_t k = 0; k < 2; ++k) target[Five::others + k] = complex_number(pivots[k] - points[0]);
  for (std::size_t j = 0; j < Five::half; ++j) target[Five::half + j] = math::conj(target[j]);
  const Scaling scaling = scale_towards<Five>(starts.base, target);

  Paths<Five> paths(starts.points.size());
  for (std::size_t i = 0; i < paths.size(); ++i) paths[i].z = starts.points[i];
  paths = follow(system, starts.base, target, paths, {}, context);
  FivePointSolutions out;
  if (context.interrupted()) {
    out.status = context.interruption();
    return out;
  }
  // Places in the scaled plane back to metres; real solutions have conjugate partners there.
  const ComplexNumber place = math::inverse(scaling.place), partner = math::inverse(scaling.partner);
  Identities met;
  std::vector<std::size_t> again;
  const auto take = [&](SystemPoint<Five> z) {
    const ComplexNumber identity = Five::identity(z);
    if (met.find(identity) >= 0) return false;
    met.add(identity);
    ++out.finite;
    double off = 0, size = 0;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = (i < 2 ? place : partner) * z[i];
    for (std::size_t i = 0; i < 2; ++i) {
      off = std::max(off, math::norm(z[i + 2] - math::conj(z[i])));
      size = std::max({size, math::norm(z[i]), math::norm(z[i + 2]), math::norm(place)});
    }
    if (off > five_real_tolerance * five_real_tolerance * size) return true;
    const auto pin = [&](std::size_t i) {
      return points[0] + 0.5 * (standard_complex(z[i]) + std::conj(standard_complex(z[i + 2])));
    };
    out.real.push_back({pivots[0], pin(0), pin(1), pivots[1]});
    return true;
  };
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (!paths[i].arrived || !(polish(system, target, paths[i].z, 1e-14) < 1e-9) || !take(paths[i].z))
      again.push_back(i);
  for (const std::size_t i : again) {
    SystemPoint<Five> z{};
    switch (settle_path(starts.base, target, starts.points[i], z, context)) {
      case FiveEnd::regular:
        take(z) ? void() : void(++out.singular);
        break;
      case FiveEnd::infinite:
        ++out.infinite;
        break;
      case FiveEnd::singular:
        ++out.singular;
        break;
      case FiveEnd::lost:
        ++out.lost;
        break;
    }
  }
  out.status = context.interrupted() ? context.interruption()
               : out.lost > 0        ? Status::not_converged
                                     : Status::done;
  std::sort(out.real.begin(), out.real.end(), [](const TracingFourBar& a, const TracingFourBar& b) {
    return std::pair(a.crank_pin.real(), a.crank_pin.imag()) <
           std::pair(b.crank_pin.real(), b.crank_pin.imag());
  });
  return out;
}

}  // namespace linkwright::planar
