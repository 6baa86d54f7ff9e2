// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/parallel/studies/robot.h"

// Single poses in studies of parallel robots: everything that a pose has, and the other modes.
namespace linkwright::parallel {

/// `[[pose]]`: where the platform is, or the arm angles that put it there.
struct AskedPose {
  std::string name;
  std::optional<Coordinates> position, rotation;
  std::optional<std::vector<double>> arm_angles;
  Coordinates force{}, moment{};
};
template <class Visitor>
void fields(Visitor&& visit, AskedPose& p) {
  visit(field::entry("name", "for tables"), p.name);
  visit(field::length("position", "of the platform point"), p.position);
  visit(field::angle("rotation", "rotation vector seen from the base (HEXA)"), p.rotation);
  visit(field::angle("arm_angles", "one a leg, instead of position: direct kinematics"), p.arm_angles);
  visit(field::force("force", "that acts on the platform point"), p.force);
  visit(field::torque("moment", "that acts on the platform (HEXA)"), p.moment);
}

/// `[modes]`: tables of the other solutions of each pose.
struct ModesForm {
  bool working = true, assembly = true;
};
template <class Visitor>
void fields(Visitor&& visit, ModesForm& m) {
  visit(field::entry("working", "all arm angles that put the platform there"), m.working);
  visit(field::entry("assembly", "all poses that the arm angles allow"), m.assembly);
}

struct PosesForm {
  std::vector<AskedPose> poses;
  std::optional<ModesForm> modes;
};

/// Reads `[[pose]]` of a robot of this freedom with so many arms, each of one of the `owners` ("legs").
std::vector<AskedPose> read_asked_poses(study::ObjectReader& document, Freedom freedom, int arms,
                                        std::string_view owners, Value& canonical);
/// Reads `[[pose]]` and `[modes]`.
PosesForm read_poses(study::ObjectReader& document, const RobotDescription& description, Value& canonical);
void describe_poses(study::SchemaWriter& document);

/// A pose of the study as solved.
struct SolvedPose {
  Status status = Status::done;
  Sentence reason;  ///< says why it is not done
  Pose pose;
  ArmAngles angles;
  /// The knowledge of a path from home. 1: the straight one (of arms that were given: with all of them led at
  /// once) is free of singularities; 0: it is not, and whether another leads there is not shown; -1: none
  /// does, the marks of regular_ball.h differ.
  int joined = 0;
  Sentence way;  ///< the same in words
};
/// Arm angles of the pose, or the pose of the arm angles: of robots that turn the one to which the arms can
/// be led from `home`, of others that of the assembly that `home` has. A pose of another assembly than home's
/// is branch_lost.
SolvedPose solve_pose(const RobotDescription& description, const AskedPose& asked, const Pose& home);

/// Columns of a table that are filled row by row: each row gives the same keys in the same order.
class Rows {
 public:
  explicit Rows(Table& table) : table_(table) {}
  void operator()(std::string_view key, std::string_view label, double value);
  void next();

 private:
  Table& table_;
  std::size_t at_ = 0, rows_ = 0;
};

/// Tables "poses", "working_modes", "assembly_modes" (as far as there is time), facts, warnings and a scene.
void add_poses(study::Result& result, const RobotDescription& description, const PosesForm& form,
               const Pose& home, const RunContext& context);

}  // namespace linkwright::parallel
