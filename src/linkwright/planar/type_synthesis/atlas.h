// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
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
    float from = 0, range = 0;  ///< part of the turn that its curve is of (rad); no range: the whole turn
    std::array<float, 18> x{};  ///< without place and scale
    std::array<float, curve_harmonics>
        magnitude{};  ///< of its harmonics; the squares of all harmonics add up to 1
    std::array<float, curve_harmonics> real{}, imaginary{};
    std::array<std::array<std::int16_t, 32>, 2> points{};  ///< x and y at equal steps of arc length, scaled
  };
  std::vector<Entry> entries;
  std::int64_t drawn = 0;  ///< shapes that were tried

  MachineShape shape(std::size_t i) const;
  /// The part of the turn of an entry; none: it turns fully.
  std::optional<CrankPart> part(std::size_t i) const;
};

/// An entry that may trace a stroke, or its mirror image.
struct AtlasMatch {
  std::size_t entry = 0, atlas = 0;  ///< number of the entry, and of its atlas where there are several
  bool mirrored = false;
  double score = 1;  ///< squared distance that is left over that of the stroke from its mean
};

/// The atlas of a family: drawn at its first use, from a seed of its own, and kept. Null when the run was
/// interrupted.
std::shared_ptr<const FamilyAtlas> family_atlas(MachineFamily family, const RunContext& context);

/// The same of shapes that assemble over a part of the turn, for drives that rock.
std::shared_ptr<const FamilyAtlas> rocking_atlas(MachineFamily family, const RunContext& context);

/// The best matches of a stroke, best first, at most `count`. For closed strokes these are exact nearest
/// neighbours. Entries of a part of the turn are for open strokes.
std::vector<AtlasMatch> match_atlas(const FamilyAtlas& atlas, const SampledStroke& target, std::size_t count,
                                    const RunContext& context);

}  // namespace linkwright::planar
