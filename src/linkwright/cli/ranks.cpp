// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/ranks.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include "linkwright/cli/plug_ins.h"
#include "linkwright/core/platform/machine.h"
#include "linkwright/core/platform/processes.h"

namespace linkwright::cli {
namespace {

/// The first of these environment variables as a number, 0 if there is none.
int number_in(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const char* text = std::getenv(name)) {
      int number = 0;
      const std::string_view all(text);
      std::from_chars(all.data(), all.data() + all.size(), number);
      return number;
    }
  return 0;
}

}  // namespace

JoinedRanks join_ranks() {
  // Open MPI's mpirun; MPICH's, and Slurm with PMI-1 or PMI-2.
  const int count = number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
  if (count <= 1) return {};
  // Open MPI looks for the fastest network first, which takes 0.2 s; messages here are few and short.
  platform::set_where_unset("OMPI_MCA_pml", "ob1");
  std::string problem;
  void* library = load_plug_in("mpi.so", problem);
  auto* join =
      library ? reinterpret_cast<app::JoinRanks*>(platform::function_of(library, "linkwright_join_ranks"))
              : nullptr;
  std::unique_ptr<app::Ranks> ranks(
      // Open MPI's gives both to all; others may not.
      join ? join(number_in({"OMPI_COMM_WORLD_RANK"}), number_in({"OMPI_COMM_WORLD_SIZE"})) : nullptr);
  if (!ranks)
    return {nullptr,
            fmt::format("was started as {} ranks, but cannot share a study between them: the part for "
                        "MPI, {}; without them, use --shard",
                        count, problem)};
  return {std::move(ranks), {}};
}

int threads_of_rank() {
  const int all = platform::processors(), given = platform::own_processors();
  const int ranks =
      std::max(1, number_in({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "SLURM_NTASKS_PER_NODE"}));
  return given * ranks <= all ? given : std::max(1, all / ranks);
}

}  // namespace linkwright::cli
