// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"

// Rows of a study out of those of its simulations. Part of clearance_study.
namespace linkwright::clearance {

class ClearanceRows {
 public:
  /// `keep` receives every row; false ends the simulation.
  ClearanceRows(const ClearanceStudy& study, ClearanceRecording& out,
                std::function<bool(RecordedRow&&)> keep);

  /// Linkages whose rows are to come; they must outlive this.
  void expect(const ClearedLinkage& linkage, std::span<const JointClearance> clearances);
  void expect(const OpenLinkage& linkage);
  /// Leaves the columns that all expected linkages have.
  void choose_columns();

  bool add(const JointClearanceRow& row);
  bool add(const ContactRow& row);

 private:
  using Value = std::function<double(const planar::LinkageInstant&, const RecordedRow&)>;
  // A linkage in motion: its columns in the order of the recording's (empty where it has none) and its joints
  // by those of the study (-1: a pin with clearance).
  struct Stage {
    const planar::Linkage* linkage = nullptr;
    const planar::LinkagePlan* plan = nullptr;
    std::vector<Value> values = {};
    std::vector<int> joints = {};
  };

  Stage stage(const planar::Linkage& linkage, const planar::LinkagePlan& plan) const;
  Value value_of(const planar::LinkageColumn& column, const planar::Linkage& linkage,
                 const planar::LinkagePlan& plan, std::span<const planar::LinkageColumn> own) const;
  PinInstant pin_in_contact(const ContactRow& row, std::size_t pin);
  bool finish(RecordedRow row, const Stage& stage, std::span<const planar::InputMotion> inputs,
              const planar::LinkageMotion& motion);

  const ClearanceStudy& s_;
  ClearanceRecording& out_;
  std::function<bool(RecordedRow&&)> keep_;
  std::optional<Stage> continuous_, contact_;
  const ClearedLinkage* cleared_ = nullptr;
  std::vector<double> clearances_;
  const OpenLinkage* open_ = nullptr;
  planar::Linkage pressed_;  // linkage with the forces of the contacts as loads
  planar::LinkageForces forces_;
};

}  // namespace linkwright::clearance
