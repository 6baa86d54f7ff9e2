// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "linkwright/app/ranks.h"

namespace linkwright::cli {

/// The ranks that mpirun, or srun with PMI, has started this program with; nullptr where it is alone. A
/// problem says why ranks that were started cannot share a study.
struct JoinedRanks {
  std::unique_ptr<app::Ranks> ranks;
  std::string problem;
};
JoinedRanks join_ranks();

/// Threads of one of the ranks on this machine, if nothing is said of them: a share of its processors, or all
/// that the launcher has left to this rank.
int threads_of_rank();

}  // namespace linkwright::cli
