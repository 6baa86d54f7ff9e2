// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/scene.h"

namespace linkwright::planar {

/// The data of a drawing for one instant.
struct LinkageRecord {
  Status status = Status::done;
  double input = 0;
  /// One a body; empty when not assembled and nothing is known. NaN for bodies without a place.
  std::vector<PartState<double>> bodies;
  std::array<math::Vec2, 2> gap{{{nan, nan}, {nan, nan}}};  ///< gap of a loop that does not close (lay_open)
  int open_group = -1;                                      ///< the group that does not
  std::vector<JointReaction> joints;                        ///< empty without forces
  std::vector<CamContact> cams;                             ///< likewise
  std::vector<double> drives;
  /// Loads of Linkage::forces and then of Linkage::torques; empty without forces.
  std::vector<AppliedLoad> loads;
  math::Vec2 shaking_force{0, 0};  ///< only with forces
};
/// `forces` may be null.
LinkageRecord record_of(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                        const LinkageForces* forces, double input);

/// The record where a linkage does not assemble: the bodies that have a place, and those that do not close as
/// near as they come, in `motion`, too (lay_open).
LinkageRecord open_record_of(const Linkage& linkage, const LinkagePlan& plan,
                             std::span<const InputMotion> inputs, LinkageMotion& motion, double input);

/// Drawing of a linkage in motion, named "motion": bodies as bars and plates, sliders as blocks on their
/// guides, springs, traces, and arrows of joint forces, loads, shaking force and velocities of the traced
/// points. Its points begin with those of the bodies, body after body, and its joints go by the names of the
/// linkage's.
study::Scene linkage_scene(const Linkage& linkage, const LinkagePlan& plan,
                           const std::vector<LinkageRecord>& records, const std::vector<BodyPoint>& traces,
                           std::string input_key, std::string input_label);

/// Adds discs at the mass centres of the moving bodies, as large as steel discs of these masses (see
/// drawn_radius).
void add_mass_centres(study::Scene& scene, const Linkage& linkage, const LinkagePlan& plan,
                      const std::vector<LinkageRecord>& records);

/// Says which loads keep the last value of their tables while the first input goes from `low` to `high`.
void warn_of_held_loads(const Linkage& linkage, const LinkagePlan& plan, double low, double high,
                        const study::AddWarning& warn);

}  // namespace linkwright::planar
