// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "linkwright/study/scene.h"

namespace linkwright::report {

/// The parts of a scene that go into a DXF file; each is a layer of that name.
struct DxfLayers {
  bool ground = true;
  bool links = true;
  bool joints = true;
  bool trace = true;
  bool targets = true;
};

struct DxfOptions {
  std::optional<std::size_t> sample;  ///< pose to draw; none = the first that is assembled
  DxfLayers layers;
};

/// The scene as an AutoCAD R12 (AC1009) drawing in millimetres, scale 1:1, for CAD and workshop: bars as
/// LINE, plates, traces, springs and guides as POLYLINE, pitch circles as CIRCLE, pins as CIRCLE with their
/// name as TEXT, targets as POINT. A spatial scene is drawn in space: joints are points, plates, traces,
/// springs and the circles of wheels (layer WHEELS) polylines in space, axes lines of their own layer AXES;
/// of a scene with a second input, the samples with that of `sample` are drawn. Arrows are no part of a
/// workshop drawing and are left out, as are points that do not exist at the sample. Throws ContractError
/// when `sample` is not one of the scene.
std::string dxf(const study::Scene& scene, const DxfOptions& options = {});

}  // namespace linkwright::report
