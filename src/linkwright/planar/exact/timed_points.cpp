// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/timed_points.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/dyads/family.h"

namespace linkwright::planar {
namespace {

using TimedComplex = std::complex<double>;

// Each of the cranks of a sweep has a sweep of rockers: some thousand four-bars.
constexpr DyadSweep timed_sweep{.one = 30, .two = 8};
// Pivots and pins nearer than this, times the size of the points, are one.
constexpr double timed_same = 1e-6;

// Timed cognates have the same rocker pivot and have the same curve, hence the same third pivot: that of
// one is the crank pivot of the other.
TimedComplex third_pivot(const TracingFourBar& bars, TimedComplex first) {
  const TimedComplex share = (first - bars.crank_pin) / (bars.rocker_pin - bars.crank_pin);
  return bars.crank_pivot + share * (bars.rocker_pivot - bars.crank_pivot);
}

std::vector<int> curves_of(const std::vector<TracingFourBar>& found, TimedComplex first, double size) {
  std::vector<int> out(found.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (out[i] >= 0) continue;
    out[i] = count++;
    const TimedComplex third = third_pivot(found[i], first);
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      if (out[j] >= 0) continue;
      const double apart = std::abs(found[j].crank_pivot - third) +
                           std::abs(third_pivot(found[j], first) - found[i].crank_pivot) +
                           std::abs(found[j].rocker_pivot - found[i].rocker_pivot);
      if (apart < timed_same * (size + std::abs(third - first) + std::abs(found[i].rocker_pivot - first)))
        out[j] = out[i];
    }
  }
  return out;
}

}  // namespace

TimedPointSolutions solve_timed_points(const TimedPoints& target, RunContext& context) {
  const std::size_t n = target.points.size();
  LINKWRIGHT_REQUIRE(n >= min_timed_points && n <= max_timed_points && target.turns.size() == n,
                     "{} points, {} rotations", n, target.turns.size());
  const auto& [crank_pivot, rocker_pivot] = target.pivots;
  LINKWRIGHT_REQUIRE(n == 3 || (!crank_pivot && !rocker_pivot), "{} points beside a given pivot", n);
  LINKWRIGHT_REQUIRE(!crank_pivot || !rocker_pivot || *crank_pivot != *rocker_pivot, "the pivots coincide");
  std::vector<BodyPose> cranks;
  for (std::size_t k = 0; k < n; ++k) cranks.push_back({target.points[k], target.turns[k]});
  const double size = size_of_motion(cranks);
  TimedPointSolutions out;
  const Prescription of_crank{.fixed = crank_pivot, .moving = {}, .fixed_line = {}, .moving_line = {}},
      of_rocker{.fixed = rocker_pivot, .moving = {}, .fixed_line = {}, .moving_line = {}};
  out.swept = open_numbers(n, of_crank) > 0 || open_numbers(n, of_rocker) > 0;
  DyadFamily drives = dyad_family(cranks, of_crank, timed_sweep);
  out.cranks = drives.solutions;
  out.dependent = drives.dependent;
  std::erase_if(drives.dyads, [](const GuidingDyad& d) { return d.type != GuidingDyadType::rr; });
  out.real_cranks = static_cast<int>(drives.dyads.size());
  std::vector<BodyPose> couplers(n);
  for (std::size_t i = 0; i < drives.dyads.size(); ++i) {
    out.status = context.interruption();
    if (out.status != Status::done) break;
    context.report({"cranks", static_cast<double>(i) / static_cast<double>(drives.dyads.size()), nan});
    // The crank points from its pivot against `arm`, both in the frame that turns with it.
    const TimedComplex pivot = drives.dyads[i].fixed, arm = drives.dyads[i].moving;
    if (std::abs(arm) < timed_same * size) continue;
    std::vector<TimedComplex> pins;
    for (std::size_t k = 0; k < n; ++k) {
      pins.push_back(pivot - arm * std::polar(1.0, target.turns[k]));
      couplers[k] = {target.points[k], std::arg(target.points[k] - pins[k])};
    }
    // A point that is the pin itself has no direction.
    if (std::abs(target.points[0] - pins[0]) < timed_same * size) continue;
    const DyadFamily rockers = dyad_family(couplers, of_rocker, timed_sweep);
    out.dependent = out.dependent || rockers.dependent;
    for (const GuidingDyad& rocker : rockers.dyads) {
      const TimedComplex pin = place(couplers[0], rocker.moving);
      const double far = size + std::abs(rocker.fixed - target.points[0]);
      if (rocker.type != GuidingDyadType::rr) {
        ++out.slides;
      } else if (std::abs(rocker.fixed - pivot) > timed_same * far &&
                 std::abs(pin - pins[0]) > timed_same * size) {
        out.found.push_back({pivot, pins[0], pin, rocker.fixed});
      }
    }
  }
  if (!out.swept) out.curve = curves_of(out.found, target.points[0], size);
  return out;
}

}  // namespace linkwright::planar
