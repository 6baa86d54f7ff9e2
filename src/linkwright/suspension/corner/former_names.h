// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"

/// @file
/// Names that were given up, for programs that still use them; they go with version 0.2.
namespace linkwright::suspension {

using WheelGuide [[deprecated("Suspension")]] = Suspension;                         ///< Suspension
using GuideLink [[deprecated("CornerLink")]] = CornerLink;                          ///< CornerLink
using GuideSpring [[deprecated("CornerSpring")]] = CornerSpring;                    ///< CornerSpring
using GuideWheel [[deprecated("CornerWheel")]] = CornerWheel;                       ///< CornerWheel
using GuidePlan [[deprecated("CornerPlan")]] = CornerPlan;                          ///< CornerPlan
using GuideInput [[deprecated("CornerInput")]] = CornerInput;                       ///< CornerInput
using GuidePosition [[deprecated("CornerPosition")]] = CornerPosition;              ///< CornerPosition
using GuideRates [[deprecated("CornerRates")]] = CornerRates;                       ///< CornerRates
using GuideConstruction [[deprecated("CornerConstruction")]] = CornerConstruction;  ///< CornerConstruction
using GuideSample [[deprecated("CornerSample")]] = CornerSample;                    ///< CornerSample

/// The same as prepare_suspension().
///
/// @param suspension the suspension of a corner
/// @returns its plan
[[deprecated("prepare_suspension")]] inline CornerPlan prepare_guide(const Suspension& suspension) {
  return prepare_suspension(suspension);
}
/// The same as corner_samples().
///
/// @returns all samples
[[deprecated("corner_samples")]] inline std::span<const CornerSample> guide_samples() {
  return corner_samples();
}
/// The same as corner_sample().
///
/// @param name name of a sample
/// @returns the sample
[[deprecated("corner_sample")]] inline const CornerSample& guide_sample(std::string_view name) {
  return corner_sample(name);
}

}  // namespace linkwright::suspension
