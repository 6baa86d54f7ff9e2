#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/parallel/robot_study.h"
#include "linkwright/parallel/tool_motion.h"
#include "linkwright/study/result.h"

// What studies of a tool path tell of it whatever the robot: what its drives do, how much of their limits
// that takes, and whether the path can be done.
namespace linkwright::parallel {

/// One drive at one instant of a path.
struct DriveMotion {
  double arm_angle = 0, arm_speed = 0;  ///< rad, rad/s
  DriveAt at;
  double speed = 0;                              ///< of the drive's value (m/s, rad/s)
  double arm_torque = 0, effort = 0, power = 0;  ///< N m; N or N m; W
};

/// What was asked of a drive at most, against what it has.
struct DriveUse {
  std::string what;  ///< "speed of drive 2"
  double share = 0;  ///< of the limit
  double value = 0, limit = 0;
  double time = 0;  ///< s
};

/// Notes what is wrong along a path, each kind of trouble once, where it begins, and how far limits are used.
class PathJudge {
 public:
  /// `motion` must outlive this.
  explicit PathJudge(const ToolMotion& motion) : motion_(motion) {}

  struct Failure {
    std::string kind;
    double time = 0;
    Status status = Status::done;
    std::string text;  ///< "step 3 (arc) at 0.412 s: ..."
  };
  void fail(std::string kind, double time, Status status, std::string_view why);
  /// Unless it is finite, a limit is none. `what`: "torque of drive 1".
  void use(double time, const std::string& what, double value, double limit, std::string_view unit);

  /// Travel of drive i, from 0.
  void travel(double time, int i, const Drive& drive, const DriveAt& at);
  /// Sine of the angle between its diagonal and its arm, at least this.
  void transmission(double time, int i, const DriveAt& at, double least);
  /// Speed and effort of drive i against what it and its motor can give.
  void limits(double time, int i, const Drive& drive, const PiDrive& motor, double speed, double effort);

  const std::vector<Failure>& failures() const { return failures_; }
  const std::vector<DriveUse>& uses() const { return uses_; }

 private:
  const ToolMotion& motion_;
  std::vector<Failure> failures_;
  std::vector<DriveUse> uses_;
};

/// Table "drive_limits".
Table uses_table(const std::vector<DriveUse>& uses);

/// Columns of the drives of a path, one row an instant, `rows[instant][drive]`; an empty row is NaN. Torques,
/// efforts and powers only with `forces`, those of motors where one drives by a screw or gear and limits are
/// known.
void add_drive_columns(Table& table, std::span<const Drive> drives, std::span<const PiDrive> motors,
                       const std::vector<std::vector<DriveMotion>>& rows, bool motors_known, bool forces);
/// A diagram over the time for each kind of these columns, as far as the table "motion" has them.
void add_drive_plots(study::Result& result, const Table& motion, std::span<const Drive> drives);
/// A diagram of columns of the table "motion" over the time.
study::Plot motion_plot(std::string name, std::string title, std::vector<std::string> columns);

/// Facts on the limits of the drives and on failures, the headline with the verdict, and the status that goes
/// with it. `end`: of the last instant that was looked at (s); `whole`: that is the end of the path.
void add_verdict(study::Result& result, const PathJudge& judge, const ToolMotion& motion, double end,
                 bool whole);

}  // namespace linkwright::parallel
