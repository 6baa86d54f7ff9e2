// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/value.h"
#include "linkwright/planar/type_synthesis/atlas.h"
#include "linkwright/planar/type_synthesis/function_starts.h"
#include "linkwright/planar/type_synthesis/search.h"

namespace linkwright::planar {

/// What a search knows of one family.
struct FamilyState {
  FamilyReport report;
  int links = 4;
  std::vector<std::shared_ptr<const FamilyAtlas>> atlases;  ///< of shapes that turn, and of others
  std::vector<AtlasMatch> pool;
  std::vector<FunctionStart> starts;  ///< the pool of a function
  std::vector<FittedMachine> exact;   ///< of dyads through poses, before those of the pool
  std::size_t next_in_pool = 0;
  bool prepared = false;  ///< atlases and pool are there

  std::size_t pooled() const { return exact.size() + std::max(pool.size(), starts.size()); }
  const FamilyAtlas& atlas_of(const AtlasMatch& match) const { return *atlases[match.atlas]; }
  int rounds = 0;
  double last_gain = 1;               ///< relative fall of the error in its last round
  double grown_from = infinity;       ///< error of the smaller machine that was grown last
  std::vector<FoundMachine> elite;    ///< best first
  std::vector<FoundMachine> archive;  ///< not dominated
  std::optional<FoundMachine> outside;
};

/// What a search knows between two rounds.
struct SearchState {
  std::vector<FamilyState> families;
  std::vector<TypeSearchPoint> progress;
  std::int64_t curves = 0, rounds = 0;
  bool turns = true;  ///< the drives of its machines turn fully
};

/// The state as a checkpoint keeps it, without atlases and pools, which follow from the stroke.
Value saved_state(const SearchState& state);

/// Takes up a saved state of a search in the same families. Throws CheckpointError for what no search has
/// saved.
void load_state(const Value& value, SearchState& state);

/// The answer of a search that came to its end, as a checkpoint keeps it, and back. Throws CheckpointError,
/// naming `what`, for what no search in these families has saved.
Value saved_answer(const TypeSearchAnswer& answer);
TypeSearchAnswer load_answer(const Value& value, std::span<const MachineFamily> families,
                             std::string_view what);

}  // namespace linkwright::planar
