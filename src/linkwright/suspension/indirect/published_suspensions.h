// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_task.h"

/// Examples 1 to 4 of Poznanovic 2016 (sections 6.2 to 6.5) as printed: facts to compare with.
namespace linkwright::suspension {

inline constexpr double not_printed = nan;

/// A row of tables 6-1, 6-5, 6-9, 6-13: m and degrees, five decimals.
struct PublishedPosition {
  double travel, rack;
  double x, y;                        ///< position of the wheel centre
  double toe, camber, carrier_pitch;  ///< deg
};

/// Largest and mean deviation, mean over repeats; m and degrees.
struct PublishedDeviations {
  std::array<double, 2> x, y, toe, camber, carrier_pitch;
};

/// The results of differential evolution in the source.
struct PublishedEvolution {
  int repeats = 0;
  double generations = 0;       ///< mean number for all links together
  double coordinate_error = 0;  ///< m, mean over coordinates and repeats
  PublishedDeviations deviations;
};

struct PublishedSuspension {
  int example = 0;
  std::string_view table;   ///< "Tab. 6-1"
  std::string_view sample;  ///< name in corner_samples
  std::span<const PublishedPosition> positions;
  PublishedEvolution evolution;
  double minimize_coordinate_error = 0;  ///< m: of the quasi-Newton method of a vendor; NaN = not run
};

/// The four of them.
std::span<const PublishedSuspension> published_suspensions();

/// Example 4 without the carrier pitch: by the quadratic (68) and by the dyad (73).
const PublishedEvolution& published_quadratic();
const PublishedEvolution& published_dyad();

/// Example 2 with the four decimals of figure 6-3 instead of the refined ones.
Suspension strut_as_printed();

/// The result of the run in the appendix (example 1), true less found, m: of each link body x, y, z, carrier
/// x, y, z; and the objective that it reports.
std::span<const double> published_run();
inline constexpr double published_run_objective = 2.2477179192e-9;

/// Positions to be taken, computed from the suspension at the inputs of its table, with all digits.
CarrierTargets published_targets(const PublishedSuspension& suspension);

/// The tasks of the source: boxes of 150 mm, placed at random so that they hold the true coordinate. Given
/// are z of a strut's point (example 2), y of both hinge points (example 3); the coupler's offset is at least
/// 0.1 m and at most the length of its first link.
std::vector<LinkTask> published_tasks(const Suspension& suspension, std::uint64_t seed);
std::vector<CouplerTask> published_coupler_tasks(const Suspension& suspension, std::uint64_t seed);

/// Mean distance of unknown coordinates from the true ones (m), over links and the points of couplers, as
/// tables 6-3, 6-7, 6-11 and 6-15 have it.
double coordinate_error(std::span<const LinkTask> tasks, std::span<const CornerLink> links,
                        std::span<const Coupler> couplers, const Suspension& truth);

}  // namespace linkwright::suspension
