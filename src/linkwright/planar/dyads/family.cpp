// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/family.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <optional>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Swept dyads with pivots or links farther than this times the size of the motion are left out.
constexpr double swept_reach = 5;
// Links shorter than this, times the size, have no length.
constexpr double no_length = 1e-6;

Complex middle_of(std::span<const BodyPose> poses) {
  Complex sum = 0;
  for (const BodyPose& pose : poses) sum += pose.origin;
  return sum / static_cast<double>(poses.size());
}

// A pivot of a dyad and what a prescription can say of it.
struct Pivot {
  std::optional<Complex> Prescription::*place;
  std::optional<PivotLine> Prescription::*line;
  std::optional<PivotRegion> Prescription::*region;
  GuidingDyadType without;  ///< the slide that has no such pivot
  Complex GuidingDyad::*at;
};
constexpr Pivot fixed_pivot = {&Prescription::fixed, &Prescription::fixed_line, &Prescription::fixed_region,
                               GuidingDyadType::pr, &GuidingDyad::fixed};
constexpr Pivot moving_pivot = {&Prescription::moving, &Prescription::moving_line,
                                &Prescription::moving_region, GuidingDyadType::rp, &GuidingDyad::moving};

bool contains(const PivotRegion& region, Complex z) {
  return z.real() >= region.lower.real() && z.real() <= region.upper.real() &&
         z.imag() >= region.lower.imag() && z.imag() <= region.upper.imag();
}

// True if a swept dyad has pivots within reach of `middle` and of the origin of the body.
bool near(const GuidingDyad& dyad, const Prescription& given, Complex middle, double reach) {
  const auto far = [&](const Pivot& pivot, Complex from) {
    return !(given.*pivot.region) && dyad.type != pivot.without && std::abs(dyad.*pivot.at - from) > reach;
  };
  return !far(fixed_pivot, middle) && !far(moving_pivot, 0);
}

double part(int k, int count) { return (k + 0.5) / count; }

// The prescription with one condition more of a pivot, in `count` ways that leave no part of its line or
// region out, or of the plane.
std::vector<Prescription> with_one_more(const Prescription& given, const Pivot& pivot, Complex middle,
                                        double reach, int count) {
  std::vector<Prescription> out(static_cast<std::size_t>(count), given);
  for (int k = 0; k < count; ++k) {
    Prescription& p = out[static_cast<std::size_t>(k)];
    if (const auto& line = given.*pivot.line) {
      const Complex along = line->direction / std::abs(line->direction);
      const double foot = ((middle - line->point) * std::conj(along)).real();
      p.*pivot.place = line->point + (foot + reach * (2 * part(k, count) - 1)) * along;
      (p.*pivot.line).reset();
    } else if (const auto& region = given.*pivot.region) {
      const Complex extent = region->upper - region->lower;
      const int upright = count / 2;
      p.*pivot.line =
          k < upright
              ? PivotLine{region->lower + extent.real() * part(k, upright), Complex(0, 1)}
              : PivotLine{region->lower + Complex(0, extent.imag() * part(k - upright, count - upright)), 1};
    } else {
      // Lines through one point meet every other point of the plane once.
      p.*pivot.line = PivotLine{middle, std::polar(1.0, pi * k / count)};
    }
  }
  return out;
}

// A pivot at `count` by `count` points of its region.
std::vector<Prescription> at_points(const Prescription& given, const Pivot& pivot, int count) {
  const PivotRegion& region = *(given.*pivot.region);
  const Complex extent = region.upper - region.lower;
  std::vector<Prescription> out;
  for (int k = 0; k < count; ++k)
    for (int l = 0; l < count; ++l) {
      out.push_back(given);
      out.back().*pivot.place =
          region.lower + Complex(extent.real() * part(k, count), extent.imag() * part(l, count));
    }
  return out;
}

// Prescriptions that leave nothing open, instead of one that leaves one number or two.
std::vector<Prescription> swept(const Prescription& given, int missing, Complex middle, double reach,
                                const DyadSweep& sweep) {
  const auto one_more = [&](const Prescription& p, const Pivot& pivot, int count) {
    return with_one_more(p, pivot, &pivot == &fixed_pivot ? middle : 0, reach, count);
  };
  std::vector<Prescription> out;
  const auto append = [&](std::vector<Prescription> more) {
    out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  // A pivot with a region is swept there, as most of a sweep elsewhere would be left out.
  for (const Pivot* pivot : {&fixed_pivot, &moving_pivot})
    if (given.*pivot->region)
      append(missing == 1 ? one_more(given, *pivot, sweep.one) : at_points(given, *pivot, sweep.two));
  if (!out.empty()) return out;
  if (missing == 2) {
    for (const Prescription& p : one_more(given, fixed_pivot, sweep.two))
      append(one_more(p, moving_pivot, sweep.two));
    return out;
  }
  for (const bool on_line : {false, true})
    for (const Pivot* pivot : {&fixed_pivot, &moving_pivot})
      if (!(given.*pivot->place) && (given.*pivot->line).has_value() == on_line)
        return one_more(given, *pivot, sweep.one);
  return out;
}

}  // namespace

double size_of_motion(std::span<const BodyPose> poses) {
  const Complex middle = middle_of(poses);
  double sum = 0;
  for (const BodyPose& pose : poses) sum += std::norm(pose.origin - middle);
  const double rms = std::sqrt(sum / static_cast<double>(poses.size()));
  return rms > 0 ? rms : 1;
}

bool in_regions(const GuidingDyad& dyad, const Prescription& given) {
  for (const Pivot& pivot : {fixed_pivot, moving_pivot})
    if (const auto& region = given.*pivot.region;
        region && (dyad.type == pivot.without || !contains(*region, dyad.*pivot.at)))
      return false;
  return true;
}

int open_numbers(std::size_t poses, const Prescription& prescription) {
  return 5 - static_cast<int>(poses) - poses_replaced(prescription);
}

DyadFamily dyad_family(std::span<const BodyPose> poses, const Prescription& given, const DyadSweep& sweep) {
  const int missing = open_numbers(poses.size(), given);
  LINKWRIGHT_REQUIRE(missing >= 0 && missing <= max_open_numbers, "{} numbers are open", missing);
  const Complex middle = middle_of(poses);
  const double size = size_of_motion(poses);
  const double reach = swept_reach * size;
  DyadFamily out;
  const auto keep = [&](const GuidingDyad& dyad) {
    if (dyad.type == GuidingDyadType::rr && !(dyad.length > no_length * size)) return;
    if (!in_regions(dyad, given))
      ++out.outside;
    else if (missing == 0 || near(dyad, given, middle, reach))
      out.dyads.push_back(dyad);
  };
  const auto take = [&](const Prescription& prescription) {
    const GuidingDyads dyads = solve_dyads(poses, prescription);
    out.solutions += dyads.solutions;
    out.dependent = out.dependent || dyads.status == Status::singular;
    for (const GuidingDyad& dyad : dyads.real()) keep(dyad);
  };
  if (missing == 0) take(given);
  if (missing > 0)
    for (const Prescription& prescription : swept(given, missing, middle, reach, sweep)) take(prescription);
  if (poses.size() == 4 && missing == 1)
    for (const GuidingDyadType type : {GuidingDyadType::pr, GuidingDyadType::rp})
      if (const auto slide = slide_dyad(poses, type);
          slide && slide->type == type && in_regions(*slide, given))
        out.dyads.push_back(*slide);
  if (missing > 0) out.outside = 0;
  return out;
}

}  // namespace linkwright::planar
