// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/table.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/parallel/studies/robot.h"
#include "linkwright/parallel/tool/motion.h"
#include "linkwright/study/remarks.h"

// The report of studies on a tool path, for any robot: motions and efforts of its drives, shares of their
// limits, and whether the path can be done.
namespace linkwright::parallel {

/// One drive at one instant of a path.
struct DriveMotion {
  double arm_angle = 0, arm_speed = 0;  ///< rad, rad/s
  DriveAt at;
  double speed = 0;                              ///< speed of the drive's value (m/s, rad/s)
  double arm_torque = 0, effort = 0, power = 0;  ///< N m; N or N m; W
};

/// The quantity that an instant of a path asks of the robot.
enum class Asked {
  travel,        ///< travel of drive i (rad)
  swing,         ///< a rod out of the plane of its arm (rad)
  elbow,         ///< angle between arm and rod, or between two arms (rad)
  speed,         ///< speed of drive i (m/s, rad/s)
  effort,        ///< effort of drive i (N, N m)
  transmission,  ///< least index of the legs
  conditioning,  ///< local conditioning index
  constraint,    ///< constraint index of a DELTA
  /// Transmission index of drive i: sine of the angle between diagonal and arm of its Pi-joint.
  drive_transmission,
};
struct Demand {
  Asked asked = Asked::travel;
  int drive = -1;               ///< from 0, of those that are of a drive
  double value = 0, limit = 0;  ///< SI units
  /// More than 0: the limit is not kept, and the more so the larger. Of speeds and efforts value / limit - 1.
  double excess = 0;
};

/// Travel of drive i, from 0.
Demand travel_demand(int i, const Drive& drive, const DriveAt& at);
/// An index that is to be at least `least`; 0 = only watched.
Demand index_demand(Asked asked, double value, double least, int drive = -1);
/// An angle that is to stay between two limits.
Demand angle_demand(Asked asked, double lowest, double highest, double least, double most);
/// Speed and effort of drive i against what it and its motor can give; without a finite limit their excess is
/// -1.
void add_drive_demands(std::vector<Demand>& out, int i, const PiDrive& motor, double speed, double effort);

/// The greatest demand on a drive, against its limit.
struct DriveUse {
  std::string what;  ///< "speed of drive 2"
  double share = 0;  ///< share of the limit
  double value = 0, limit = 0;
  double time = 0;  ///< s
};

/// The severity of a trouble, the worst first.
enum class Severity {
  impossible,  ///< no leg gets there, or the platform is not held on the path
  stopped,     ///< a drive or a joint would have to go beyond its travel
  too_much,    ///< more than a drive can give
  poor,        ///< an index below its limit
};

/// The troubles along a path, each kind of trouble once, with its worst and where it begins, and how far
/// limits are used. It looks at instants of its own: in each stretch between two breaks of the path or its
/// law at 32 equal steps, and at the peak of what is asked between three of them; so nothing depends on the
/// rows of a table.
class PathJudge {
 public:
  /// `motion` and `drives` must outlive this.
  PathJudge(const ToolMotion& motion, std::span<const Drive> drives) : motion_(motion), drives_(drives) {}

  struct Failure {
    Severity severity = Severity::impossible;
    double time = 0;   ///< start (s)
    double worst = 0;  ///< greatest excess, among those of one severity
    Status status = Status::done;
    Sentence text;  ///< "torque of drive 1 is 74 N m at ..., the limit is 38 N m; ..."
  };
  /// A trouble that something else has found.
  void fail(Severity severity, double time, Status status, Sentence text) {
    failures_.push_back({severity, time, 0, status, std::move(text)});
  }

  /// Fills `out` with what time t (s) asks for, always the same in the same order; nothing where the robot is
  /// not.
  using Look = math::FunctionRef<void(double, std::vector<Demand>&)>;
  /// Looks at all of the path before `end` (s); with `end` itself where that is the end of the path. Status:
  /// done, or why it was stopped.
  Status judge(Look look, double end, const RunContext& context);

  /// The worst first.
  std::vector<Failure> failures() const;
  std::vector<DriveUse> uses() const;

  /// The largest excess of what is asked for, and its time; nothing if it never is.
  struct Peak {
    Demand demand;
    double time = 0;
    double begin = 0;  ///< time at which the limit is first not kept (s), if it is not
  };
  const Peak* peak(Asked asked) const;
  const std::vector<Peak>& peaks() const { return peaks_; }

 private:
  Sentence text(const Peak& peak) const;

  const ToolMotion& motion_;
  std::span<const Drive> drives_;
  std::vector<Failure> failures_;
  std::vector<Peak> peaks_;
};

/// Table "drive_limits".
Table uses_table(const std::vector<DriveUse>& uses);

/// Columns of the drives of a path, one row an instant, `rows[instant][drive]`; an empty row is NaN. Torques,
/// efforts and powers only with `forces`, those of motors where one drives by a screw or gear and limits are
/// known.
void add_drive_columns(Table& table, std::span<const Drive> drives, std::span<const PiDrive> motors,
                       const std::vector<std::vector<DriveMotion>>& rows, bool motors_known, bool forces);
/// A diagram for each kind of these columns, as far as the table has them.
void add_drive_plots(const study::AddPlot& plot, std::span<const Drive> drives);

/// Facts on the limits of the drives and on failures, the headline with the verdict, and the status that goes
/// with it: of the worst. `end`: of the last instant that was looked at (s); `whole`: all of it was looked
/// at.
void add_verdict(study::Result& result, const PathJudge& judge, const ToolMotion& motion, double end,
                 bool whole);

}  // namespace linkwright::parallel
