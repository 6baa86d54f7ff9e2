#include "linkwright/planar/dyads/family.h"

#include <algorithm>
#include <cmath>
#include <complex>

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

// A link of some length within reach, or a slide.
bool usable(const GuidingDyad& dyad, Complex middle, double size, double reach) {
  if (dyad.type == GuidingDyadType::rr && !(dyad.length > no_length * size)) return false;
  const double most = dyad.type == GuidingDyadType::pr
                          ? std::abs(dyad.moving)
                          : std::max(std::abs(dyad.fixed - middle), std::abs(dyad.moving));
  return most <= reach * size;
}

}  // namespace

double size_of_motion(std::span<const BodyPose> poses) {
  const Complex middle = middle_of(poses);
  double sum = 0;
  for (const BodyPose& pose : poses) sum += std::norm(pose.origin - middle);
  const double rms = std::sqrt(sum / static_cast<double>(poses.size()));
  return rms > 0 ? rms : 1;
}

int open_numbers(std::size_t poses, const Prescription& prescription) {
  return 5 - static_cast<int>(poses) - poses_replaced(prescription);
}

DyadFamily dyad_family(std::span<const BodyPose> poses, const Prescription& given, const DyadSweep& sweep) {
  const int missing = open_numbers(poses.size(), given);
  LINKWRIGHT_REQUIRE(missing >= 0 && missing <= most_open_numbers, "{} numbers are open", missing);
  const Complex middle = middle_of(poses);
  const double size = size_of_motion(poses);
  DyadFamily out;
  const auto take = [&](const Prescription& prescription) {
    const GuidingDyads dyads = solve_dyads(poses, prescription);
    out.solutions += dyads.solutions;
    out.dependent = out.dependent || dyads.status == Status::singular;
    for (const GuidingDyad& dyad : dyads.real())
      if (usable(dyad, middle, size, missing > 0 ? swept_reach : infinity)) out.dyads.push_back(dyad);
  };
  const bool fixed_free = !given.fixed && !given.fixed_line;
  const auto line = [](Complex point, int k, int count) {
    return PivotLine{point, std::polar(1.0, pi * k / count)};
  };
  if (missing == 0) take(given);
  if (missing == 1)
    for (int k = 0; k < sweep.one; ++k) {
      Prescription swept = given;
      // Lines through one point meet every other point of the plane once.
      (fixed_free ? swept.fixed_line : swept.moving_line) =
          line(fixed_free ? middle : Complex(0), k, sweep.one);
      take(swept);
    }
  if (missing == 2)
    for (int k = 0; k < sweep.two; ++k)
      for (int l = 0; l < sweep.two; ++l) {
        Prescription swept = given;
        swept.fixed_line = line(middle, k, sweep.two);
        swept.moving_line = line(0, l, sweep.two);
        take(swept);
      }
  if (poses.size() == 4 && missing == 1)
    for (const GuidingDyadType type : {GuidingDyadType::pr, GuidingDyadType::rp})
      if (const auto slide = slide_dyad(poses, type); slide && slide->type == type)
        out.dyads.push_back(*slide);
  return out;
}

}  // namespace linkwright::planar
