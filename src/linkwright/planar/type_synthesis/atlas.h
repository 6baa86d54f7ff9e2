// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/program.h"
#include "linkwright/planar/type_synthesis/stroke.h"

namespace linkwright::planar {

/// Harmonics of a closed curve by arc length: h = -8 ... -1, 1 ... 8.
inline constexpr std::size_t curve_harmonics = 16;

/// Shapes of one family whose curves differ, drawn at random.
struct FamilyAtlas {
  struct Entry {
    const PointProgram* program = nullptr;
    unsigned signs = 0;
    std::array<float, 18> x{};  ///< without place and scale
    std::array<float, curve_harmonics>
        magnitude{};  ///< of its harmonics; the squares of all harmonics add up to 1
    std::array<float, curve_harmonics> real{}, imaginary{};
    std::array<std::array<std::int16_t, 32>, 2> points{};  ///< x and y at equal steps of arc length, scaled
  };
  std::vector<Entry> entries;
  std::int64_t drawn = 0;  ///< shapes that were tried

  MachineShape shape(std::size_t i) const;
};

/// An entry that may trace a stroke, or its mirror image.
struct AtlasMatch {
  std::size_t entry = 0;
  bool mirrored = false;
  double score = 1;  ///< squared distance that is left over that of the stroke from its mean
};

/// The atlas of a family: drawn at its first use, from a seed of its own, and kept. Null when the run was
/// interrupted.
std::shared_ptr<const FamilyAtlas> family_atlas(MachineFamily family, const RunContext& context);

/// The best matches of a stroke, best first, at most `count`. For closed strokes these are exact nearest
/// neighbours.
std::vector<AtlasMatch> match_atlas(const FamilyAtlas& atlas, const SampledStroke& target, std::size_t count,
                                    const RunContext& context);

}  // namespace linkwright::planar
