// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linkwright/planar/chains/markings.h"
#include "linkwright/study/scene.h"

namespace linkwright::planar {

/// A chain or a mechanism to be drawn.
struct ChainFigure {
  const Chain* chain = nullptr;
  Marking marking;
  std::string name;  ///< written at its uppermost joint
};

/// Sheets of figures in rows, all with bars of one length, "sheet-1" and so on. Ground joints have their
/// sign, a slider is a block on its guide, geared links carry pitch circles that touch, and an arc of a
/// circle shows the driven joint.
std::vector<study::Scene> chain_sheets(std::span<const ChainFigure> figures);

}  // namespace linkwright::planar
