// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linkwright/clearance/sensitivity.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/study/kind.h"

// Tolerance studies: the effect of clearances and errors of lengths on path, function and forces of a
// linkage; what its file holds, how it is read, run and reported.
namespace linkwright::clearance {

/// A study as read.
struct ToleranceStudy {
  planar::LinkageStudy motion;
  LinkageTolerances tolerances;
  ToleranceOutputs outputs;    ///< the points are those traced
  std::vector<double> limits;  ///< one a quantity: m or rad that its error is to keep to; NaN = none
  int draws = 2000;
  std::int64_t seed = 1;

  std::size_t tolerance_count() const { return tolerances.pins.size() + tolerances.lengths.size(); }
};

/// "analysis" of "clearance.linkage".
study::Kind tolerance_kind();

/// Derivatives, random linkages and the report.
study::Result run_tolerance_study(const ToleranceStudy& study, RunContext& context);

// ---- between running and reporting
// -----------------------------------------------------------------------------

/// A quantity that deviates as one thing, in the order of `quantity_count`.
struct ToleranceQuantity {
  enum class Kind { point, angle, displacement, force, torque } kind = Kind::point;
  std::string key;            ///< "coupler_P", "B0_angle", "A_force", "O_drive_torque"
  std::string name;           ///< "coupler.P", "angle of B0"
  std::size_t first = 0;      ///< its first value
  std::size_t size = 1;       ///< values: 2 of a vector
  std::size_t worst_row = 0;  ///< sample of its largest worst case
  bool any = false;           ///< true if there is one
};
/// "m", "rad" and the like as keys and as labels have them.
std::string unit_key(ToleranceQuantity::Kind kind);
std::string unit_label(ToleranceQuantity::Kind kind);
/// "0.31 mm", "0.21°", "12 N".
Measured shown(ToleranceQuantity::Kind kind, double value);

/// Clearance or tolerance k of a study, pins before lengths, m.
double tolerance_range(const ToleranceStudy& study, std::size_t k);

/// The results of a run.
struct ToleranceRecording {
  planar::LinkageRows rows;
  std::vector<SensitivitySample> linear;
  MonteCarloResult random;
  std::vector<planar::LinkageRecord> records;  ///< records of the nominal linkage, for the scene
  std::vector<ToleranceQuantity> quantities;
  std::vector<std::string> tolerances;  ///< their names: pins, then lengths
  /// Least transmission angle of a dyad: rad, its sample and its group; infinite when there is no dyad.
  double transmission = infinity;
  std::size_t transmission_row = 0;
  std::string transmission_group;

  /// Samples along the last axis of a grid, or all: those that a drawing shows first.
  std::size_t run_length = 0;

  std::size_t samples() const { return linear.size(); }
  /// The contribution of tolerance k to the worst error of quantity q at a sample, and to its mean square.
  double contribution(std::size_t sample, std::size_t q, std::size_t k) const {
    return linear[sample].contributions[q * tolerances.size() + k];
  }
  double mean_square(std::size_t sample, std::size_t q, std::size_t k) const {
    return linear[sample].mean_squares[q * tolerances.size() + k];
  }
  /// The root mean square of the error by all tolerances together, to first order.
  double root_mean_square(std::size_t sample, std::size_t q) const;
  /// The largest worst case over the motion; NaN when there is none.
  double worst(std::size_t q) const;
  /// Tolerances by what they have in that, the largest first.
  std::vector<std::size_t> by_share(std::size_t q) const;
};
ToleranceRecording record_tolerances(const ToleranceStudy& study, RunContext& context);

/// Worst error of a point across its path at every sample, m, and the normal of the path there (to the left);
/// NaN where the point does not move.
struct PathBand {
  std::vector<double> across;
  std::vector<math::Vec2> normal;
};
PathBand path_band(const ToleranceStudy& study, const ToleranceRecording& recording, std::size_t point);

/// The linkage in motion with the band of every traced point and the clearance of its pins, both enlarged
/// `scale` times.
study::Scene tolerance_scene(const ToleranceStudy& study, const ToleranceRecording& recording,
                             const std::vector<PathBand>& bands, double scale);
/// 1, 2, 5, 10, ... so that the bands can be seen.
double tolerance_scale(const ToleranceStudy& study, const std::vector<PathBand>& bands);

/// The tables: errors, values, band, a budget and the contributions over the motion for each quantity, draws.
std::vector<Table> tolerance_tables(const ToleranceStudy& study, const ToleranceRecording& recording,
                                    const std::vector<PathBand>& bands, double scale);
/// Key of the last input, or of the time: what diagrams run over.
std::string tolerance_input_key(const ToleranceStudy& study);
/// A sample for people: "132°".
Sentence tolerance_place(const ToleranceStudy& study, const ToleranceRecording& recording,
                         std::size_t sample);

/// Tables, plots and facts.
study::Result report_tolerances(const ToleranceStudy& study, ToleranceRecording recording);

}  // namespace linkwright::clearance
