// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/study/kind.h"
#include "linkwright/study/scene.h"

namespace linkwright::report {

/// The links of a planar scene as solids in a STEP file (ISO 10303-21, AP214), in millimetres, scale 1:1, at
/// the first pose that is assembled: bars and plates with rounded ends and holes, as `flat_parts` stacks
/// them, and pins. Outlines and holes are lines and arcs, as in a drawing.
/// @param scene planar scene
/// @param sizes widths and thickness of the links
/// @returns the file; empty where the scene has no flat parts
std::string step(const study::Scene& scene, const study::PartSizes& sizes);

}  // namespace linkwright::report
