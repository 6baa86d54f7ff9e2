// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "linkwright/flexible/arm.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/study/scene.h"

// Drawings of chains in motion.
namespace linkwright::flexible {

/// The scene "motion" of a run that kept its states: hub and links, dash-dotted the rigid arm. Bending is
/// drawn `scale` times as large, without one as large as can be seen; the title says so. Point 0 is O, point
/// 1 + k is node k.
study::Scene chain_scene(const ArmChain& arm, std::span<const std::string> names, const Simulation& run,
                         std::optional<double> scale);

}  // namespace linkwright::flexible
