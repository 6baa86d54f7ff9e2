// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/tool/path.h"

/// The shape of a tool's path, before it is run in time.
namespace linkwright::parallel {

/// A smooth piece of a path.
struct ToolPart {
  ToolCurve curve;
  int step = 0;
  double speed = infinity;  ///< limit of the step, m/s
};

/// A part of the motion between two rests: parts that join, a table, or nothing (a dwell).
struct ToolRun {
  int step = 0;  ///< its first one
  Pose start;
  std::vector<ToolPart> parts;
  Vec3 turn{};                       ///< rotation vector from start to end, seen from the base (rad)
  double dwell = 0;                  ///< s
  const ToolTable* table = nullptr;  ///< table of the path that was laid out
};

struct ToolLayout {
  std::vector<ToolRun> runs;
  Pose end;
  std::optional<ToolProblem> problem;  ///< the first one; the runs end before it
};

/// Curves and corners of a path from `start`. The path must outlive the layout.
ToolLayout lay_out(const ToolPath& path, const Pose& start);

}  // namespace linkwright::parallel
