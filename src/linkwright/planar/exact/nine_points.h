// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/exact/given_pivots.h"

namespace linkwright::planar {

/// A coupler curve through nine points: up to six four-bars, three cognates each with two orders of its
/// dyads.
struct CurveClass {
  /// The cognate with the smallest numbers, standing at the first point and relative to it (m): crank pin,
  /// crank pivot, rocker pin, rocker pivot, then what stands for their conjugates, which they are where it is
  /// real.
  std::array<std::complex<double>, 8> four_bar{};
  bool real = false;  ///< then each of the cognates is
  /// Proved to be a simple solution, different from the others; a real one to be real.
  bool certified = false;
  bool extended = false;  ///< took more digits than a double has
};

/// The knowledge of the set of classes. That generic points have 1442 is a numerical result (trace test,
/// nine_point_starts.h), not a theorem.
enum class Completeness {
  complete,              ///< all 1442 classes, each with a certificate
  complete_uncertified,  ///< 1442 different classes, some without certificate
  special_target,        ///< fewer: the other paths end at infinity or where classes meet
  incomplete,            ///< paths were lost
};
constexpr std::array<EnumName<Completeness>, 4> names(Completeness) {
  return {{{Completeness::complete, "complete", "all classes, each certified"},
           {Completeness::complete_uncertified, "complete_uncertified", "all classes, not all certified"},
           {Completeness::special_target, "special_target",
            "fewer classes than generic points have; the others are at infinity or meet"},
           {Completeness::incomplete, "incomplete", "paths were lost"}}};
}

struct NinePointOptions {
  std::filesystem::path cache;  ///< folder of the start set; empty = it is kept in memory alone
  bool certify = true;
};

struct NinePointSolutions {
  Status status = Status::done;  ///< deadline or cancelled: nothing is complete
  Completeness completeness = Completeness::incomplete;
  std::vector<CurveClass> classes;  ///< real ones first
  int certified = 0, real = 0;
  int infinite = 0, singular = 0, lost = 0;  ///< ends of paths without a class
  int first_lost = 0;                        ///< paths that needed a second attempt, or their conjugate
};

/// The folder "linkwright" in the user's cache folder: XDG_CACHE_HOME, or .cache in HOME; empty where there
/// is neither.
std::filesystem::path user_cache_folder();

/// Classes of generic points; six four-bars a class (Wampler, Morgan and Sommese 1992).
inline constexpr std::size_t nine_point_classes = 1442;

/// The reason why points have no solution whatever the rest: some are the same, or seven lie on a line or on
/// a circle, which a coupler curve (degree 6, tricircular) meets in six points at most.
struct PointObstacle {
  enum Kind { none, repeated, collinear, concyclic } kind = none;
  std::vector<int> points;  ///< the points, from 0
};
PointObstacle obstacle(std::span<const std::complex<double>> points);

/// All coupler curves of four-bars through nine points, by following all classes of generic complex points to
/// them. Throws ContractError unless there are nine finite points without an obstacle.
NinePointSolutions solve_nine_points(std::span<const std::complex<double>> points,
                                     const NinePointOptions& options, RunContext& context);

/// The three cognates of a real class (m); those with a pivot at infinity or without length are left out.
std::vector<TracingFourBar> cognates_of(const CurveClass& curve, std::complex<double> first_point);

}  // namespace linkwright::planar
