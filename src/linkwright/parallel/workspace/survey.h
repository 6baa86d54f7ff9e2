// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "linkwright/parallel/workspace/workspace.h"

namespace linkwright::parallel {

/// The results of a grid of any size, without its nodes: layers are looked at one by one.
struct WorkspaceSurvey {
  Status status = Status::done;        ///< cancelled or deadline: layers are missing
  std::array<std::size_t, 3> nodes{};  ///< along x, y, z
  double cell = 0;                     ///< cell, as in WorkspaceMap
  std::size_t count = 0;               ///< nodes that were looked at
  WorkspaceTotals totals;              ///< totals; places of indices are numbers as in WorkspaceMap
  std::vector<std::size_t> passing;    ///< nodes of each layer that pass: levels of z, else rows along x
};

/// The totals of `workspace` (the means to rounding). Layers are pieces that run on all threads, in shards
/// and on ranks, and are saved in the checkpoint. A layer takes 1 byte a node and 8 for each wanted index.
/// Throws ContractError as `workspace`.
WorkspaceSurvey survey_workspace(const WorkspaceTask& task, RunContext& context);

}  // namespace linkwright::parallel
