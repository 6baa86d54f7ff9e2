// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/math/spline.h"
#include "linkwright/parallel/robot/robot.h"
#include "linkwright/parallel/tool/path.h"

/// @file
/// The position and motion of the tool at any time.
namespace linkwright::parallel {

/// The tool at one instant, seen from the base.
struct ToolState {
  Vec3 position{},             ///< m
      velocity{},              ///< m/s
      acceleration{},          ///< m/s2
      jerk{};                  ///< m/s3
  Mat3 rotation{};             ///< axes of the tool in base axes
  Vec3 angular_velocity{},     ///< rad/s
      angular_acceleration{};  ///< rad/s2
};

/// The reason why a path is not a motion.
///
/// @param path the path
/// @param limits limits of the motion
/// @param start pose at the start
/// @returns the first problem; nothing if there is none
std::optional<ToolProblem> problem(const ToolPath& path, const ToolLimits& limits, const Pose& start);

/// The motion along a path: from rest to rest, step by step, as fast as the limits and the law allow.
///
/// Steps are cut into runs, between which the tool rests; tool/timing.h says how a run is timed. A turn is
/// about a fixed axis by the least angle, in proportion to the length run through; the slower of both
/// decides.
class ToolMotion {
 public:
  /// Times the steps of a path.
  ///
  /// @param path the path
  /// @param limits limits of the motion
  /// @param start pose at the start
  /// @throws ContractError with the message of `problem` if there is one
  ToolMotion(const ToolPath& path, const ToolLimits& limits, const Pose& start);

  /// The duration of the motion. @returns s
  double duration() const { return duration_; }

  /// The state of the tool at a time: at rest at the ends before 0 and after the duration. At a step of the
  /// jerk the value to the right counts. Allocates nothing.
  ///
  /// @param t time (s)
  /// @returns the state
  ToolState operator()(double t) const;

  /// The step that is being done; a rounded corner belongs to the step before it.
  ///
  /// @param t time (s)
  /// @returns index of the step
  int piece_at(double t) const;
  /// The place in the path in words: "step 3 (arc) at 0.412 s".
  ///
  /// @param t time (s)
  /// @returns the text
  Sentence where(double t) const;

  /// The share of its step's path that has been covered.
  ///
  /// @param t time (s)
  /// @returns the share, in [0, 1]; nothing for a rest and for a table
  std::optional<double> share_at(double t) const;
  /// The place in the path in words, with the share: "step 3 (arc) at 0.412 s, 63.51 % of its path".
  ///
  /// @param t time (s)
  /// @returns the text
  Sentence where_exactly(double t) const;

  /// The times between which the path and its law are smooth. @returns s, from 0 to the duration, increasing
  std::vector<double> breaks() const;
  /// The distance that the tool covers, and the angle that it turns, between two times without a break
  /// between them: along curves the very length, along a table a bound that tends to it. Allocates nothing.
  ///
  /// @param a first time (s)
  /// @param b second time (s)
  /// @returns distance and angle
  Displaced way(double a, double b) const;

  /// The state at one time.
  struct Sample {
    double time = 0;  ///< s
    ToolState state;  ///< state of the tool
  };
  /// The states at 0, dt, 2 dt, ... and at the duration.
  ///
  /// @param dt interval (s)
  /// @returns the states
  /// @throws ContractError unless dt > 0 and the samples are at most ten millions
  std::vector<Sample> samples(double dt) const;

 private:
  struct Piece {
    ToolCurve curve;
    int step = 0;
    double offset = 0;  // length of the run before it
  };
  // Columns of a table: coordinates and rotation vectors by the time since its start.
  struct Spline {
    std::array<math::PiecewisePolynomial, 3> position, rotation;
    bool turns = false;
  };
  // Between two rests: pieces, a spline or a dwell.
  struct Run {
    int step = 0;
    double start = 0, duration = 0, length = 0;
    std::size_t first_piece = 0, end_piece = 0, first_phase = 0, end_phase = 0;
    int spline = -1;
    TimeLaw law = TimeLaw::double_s;
    Vec3 position;  // at the start
    Mat3 rotation;  // at the start
    Vec3 turn;      // by the end of the run, rad
  };

  const Run& run_at(double t) const;
  const Piece& piece_at(const Run& run, double length) const;
  Progress progress(const Run& run, double time) const;
  ToolState along(const Run& run, double time) const;
  ToolState on(const Spline& spline, const Run& run, double time) const;
  double length_at(const Run& run, double t) const;

  std::vector<Run> runs_;
  std::vector<Piece> pieces_;
  std::vector<JerkPhase> phases_;
  std::vector<Spline> splines_;
  std::vector<std::string> names_;  // names of the steps
  ToolState end_;
  double duration_ = 0;
};

}  // namespace linkwright::parallel
