// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/dyads/dyad.h"
#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::planar {

/// The linkage of two dyads that hold a body, driven at the first: ground, a link or slide of each dyad, and
/// the body with its own frame and origin "P". The coordinate of its drive is that of Passage; the mode is
/// the one in which the body is at `pose`.
///
/// Bodies: ground, drive, body, guide. Joints: O (fixed pivot or slide of the drive), A (its moving end), B
/// and G of the other dyad.
Linkage guided_body(const GuidingDyad& driver, const GuidingDyad& other, const BodyPose& pose);

}  // namespace linkwright::planar
