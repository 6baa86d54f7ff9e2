// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/program.h"
#include "linkwright/planar/type_synthesis/stroke.h"

namespace linkwright::planar {

/// Samples of a motion in which the output rests: `first` to before `end`.
struct RestingSamples {
  std::size_t first = 0, end = 0;
};

/// A part of a stroke in which the distances of its samples up to a tolerance count as none. A closed
/// stroke's band may go on past its first point: then it ends before it begins.
struct ToleranceBand {
  double from = 0, to = 1;  ///< shares of the length of the stroke
  double tolerance = 0;     ///< in sizes, > 0
};

/// What machines are fitted to: the points of a stroke, or poses of a body, at any time or at given crank
/// angles; or a function of the crank angle. Lengths are in sizes of the stroke, places from its mean.
struct MotionTarget {
  MotionTarget(const SampledStroke& traced);  // a stroke is the plainest target

  SampledStroke stroke;                ///< the traced path, by which machines are looked up and placed
  std::size_t count = stroke_samples;  ///< samples that are compared, a multiple of 8
  alignas(64) std::array<double, stroke_samples> x{}, y{};
  std::array<double, stroke_samples> weight{};  ///< of each sample in the sum of squares
  std::array<double, stroke_samples> share{};   ///< the same without the weights that points were given
  std::array<double, stroke_samples> at{};      ///< where it is along the stroke, in samples of the stroke
  std::array<double, stroke_samples> turn{};    ///< crank rotation from the first sample (rad), where `timed`
  std::array<double, stroke_samples> angle{};   ///< of the body (rad), where `oriented`
  double total_weight = stroke_samples;         ///< sum of the weights, and of the shares
  bool timed = false;                           ///< the crank rotation from the first sample to each is given
  bool oriented = false;  ///< the angle of the body of the traced point is given, up to a constant
  MachineOutput output = MachineOutput::point;  ///< what of the machine is compared
  bool turns = true;                            ///< limits hold over the whole turn, else over the samples
  double beyond = 0;                            ///< and so much further at both ends (rad), without turns
  std::vector<RestingSamples> rests;            ///< where the output of a function keeps any one value
  bool dense = true;        ///< the samples follow the stroke, between them a curve stays near it
  double angle_length = 0;  ///< an error of a radian counts as this length
  std::array<double, stroke_samples> tolerance{};  ///< distances of each sample up to this count as none
  std::vector<ToleranceBand> bands;                ///< parts of the stroke with tolerances of their own
  /// Errors up to this count as none where many machines have none: of these the pair angle decides.
  double met = 0;

  /// Some samples have a tolerance, or all have.
  bool has_tolerance() const;
  bool has_tolerance_everywhere() const;
  /// Places are compared, not angles alone.
  bool placed() const { return output != MachineOutput::angle; }

  /// Crank angles, equally far apart, over which limits hold where the crank does not turn: `sampled` are
  /// those of the samples (rad).
  void cover_used_part(std::span<const double> sampled, std::span<double> out) const;
  /// The output of a function is compared, not a path or a body.
  bool is_function() const { return output != MachineOutput::point; }
  /// An error of 1 in m, or in rad where the output is an angle.
  double error_unit() const { return placed() ? stroke.size : 1; }
};

/// Lets the drive of an open stroke or of open poses rock over the part of its rotation that they take:
/// machines need not turn, and limits hold over that part and a degree further at both ends.
///
/// @param target an open one
/// @throws ContractError for a closed target
void let_drive_rock(MotionTarget& target);

/// A stroke whose points, one after the other, are met at crank rotations from the first (rad), which change
/// in one sense; between two points they change with the arc length. A closed stroke takes one turn.
MotionTarget timed_stroke(const Stroke& stroke, std::span<const double> rotations);

/// Samples that are in a band: those between its ends, or the nearest one of a shorter band.
std::vector<std::size_t> samples_of(const MotionTarget& target, const ToleranceBand& band);

/// Gives all samples of a stroke a tolerance (sizes, 0 for none), and those of bands the least of their own.
void set_tolerances(MotionTarget& target, double everywhere, std::span<const ToleranceBand> bands);

/// Lets the samples of a stroke or of poses count by weights, whose mean does not matter: one for each point
/// or pose, not negative, some positive; along a stroke they change with the arc length from point to point.
void weigh_points(MotionTarget& target, const Stroke& stroke, std::span<const double> weights);

/// Poses of a body, one after the other: places of its origin (m) and rotations (rad), whose common offset is
/// free. Between the places the path is a smooth curve, by which machines are looked up. An error of a radian
/// counts as `angle_length` (m); none: the size of the path. At most `stroke_samples` poses. With `rotations`
/// the poses are met at crank rotations from the first (rad), one each, which change in one sense.
MotionTarget pose_target(const Stroke& places, std::span<const double> angles,
                         std::optional<double> angle_length, std::span<const double> rotations = {});

/// A part of the rotation of the crank, from where the motion begins (rad), over which the output rests.
struct Dwell {
  double from = 0, to = 0;
};

/// A function of the crank angle: the output (rad, or m of a slider) at a part of `range`, the rotation of
/// the crank (rad, signed). A whole turn is closed: the function ends as it begins, but for whole turns of
/// the output. Without a turn, limits hold over the range alone. The output is an angle, counted from any
/// direction, with `size` (m) as the unit of lengths; or a travel, whose root mean square from its mean is
/// the unit, along x.
struct FunctionWanted {
  MachineOutput output = MachineOutput::angle;
  double range = 2 * pi;
  std::function<double(double)> at;  ///< 0 to 1
  std::vector<Dwell> dwells;
  double size = 0.1;
};
MotionTarget function_target(const FunctionWanted& wanted);

}  // namespace linkwright::planar
