// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

struct TypeSearchOptions {
  std::vector<MachineFamily>
      families;  ///< in which machines are looked for; none = all with at most `max_links`
  int max_links = 8;
  MachineLimits limits;
  std::int64_t max_curves =
      0;  ///< number of curves after which the search ends; 0 = only the context ends it
  std::uint64_t seed = 1;
  std::size_t max_solutions = 12;
  std::string saved_as = "types";  ///< name of the search in a checkpoint
};

/// A machine of the list, in sizes of the stroke from its mean.
struct FoundMachine {
  FittedMachine machine;
  MachineMeasures measures;
  double chamfer = infinity;  ///< chamfer distance of curve and stroke; of a dense target alone
  std::int64_t origin = 0;    ///< number of the start from which it has come by hops
};

/// What the search did in one family.
struct FamilyReport {
  MachineFamily family{};
  double error = infinity;  ///< of its best machine within the limits
  std::int64_t polished = 0, hops = 0, grown = 0, curves = 0, atlas_entries = 0;
  std::int64_t best_at = 0;  ///< curves of the whole search when the best was found
};

/// An improvement of the best machine of a family.
struct TypeSearchPoint {
  std::int64_t curves = 0;
  MachineFamily family{};
  double error = infinity;
};

struct TypeSearchAnswer {
  Status status = Status::done;
  std::vector<FoundMachine>
      machines;  ///< not worse than another one in links, error, pair angle, size and acceleration
  std::vector<FoundMachine> outside;  ///< the best machine of each family that has none within the limits
  std::vector<FamilyReport> families;
  std::vector<TypeSearchPoint> progress;
  std::int64_t curves = 0;
};

/// What searches of the same target in the same families with different seeds come to together: one list, the
/// sums of what they did, and progress as if they had run one after the other.
TypeSearchAnswer merged_answers(const MotionTarget& target, std::span<const TypeSearchAnswer> answers,
                                std::size_t max_solutions);

/// Chamfer distance of the curve of a measured machine and the stroke of a dense target, in sizes.
double chamfer_of(const MotionTarget& target, const FittedMachine& machine);

/// The families that a search looks in, in their order.
std::vector<MachineFamily> searched_families(const MotionTarget& target, const TypeSearchOptions& options);

/// Finds machines of many types that trace a stroke, whose body takes poses, or that generate a function. The
/// sequence of its trials depends on the seed alone; the context or the number of curves says where it ends.
TypeSearchAnswer search_types(const MotionTarget& target, const TypeSearchOptions& options,
                              RunContext& context);

}  // namespace linkwright::planar
