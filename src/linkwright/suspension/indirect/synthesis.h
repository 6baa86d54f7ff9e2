// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/coupler_fit.h"
#include "linkwright/suspension/indirect/link_fit.h"
#include "linkwright/suspension/indirect/link_synthesis.h"
#include "linkwright/suspension/indirect/link_task.h"
#include "linkwright/suspension/indirect/synthesis_carrier_pitch.h"

namespace linkwright::suspension {

/// A wheel suspension to be found from positions of its carrier. The wheel needs its tyre diameter: at its
/// radius turns count in the check of the rank.
struct IndirectTask {
  CarrierTargets targets;
  std::vector<LinkTask> links;
  std::vector<CouplerTask> couplers;
};

struct IndirectSynthesis {
  /// done: all links are exact and the suspension moves as it should; not_converged, infeasible: of the links
  /// or couplers, or of a rod that cannot determine the carrier pitches; singular: exact links that leave the
  /// carrier a further freedom, see `findings`; deadline, cancelled: the best so far.
  Status status = Status::infeasible;
  std::vector<LinkFit> links;  ///< each with its own status
  std::vector<CouplerFit> couplers;
  Suspension suspension;         ///< suspension, as far as it was found
  CarrierTargets targets;        ///< targets with the carrier pitches that were not prescribed
  double largest = 0;            ///< m: structural error of all links and couplers
  double fewest = 0;             ///< positions that determine all links, see fewest_positions
  std::vector<CornerLink> arms;  ///< hinged arms that exact rods come from, where these were asked for
  std::int64_t evaluations = 0;
  int generations = 0;   ///< generations of population methods, all links together
  Diagnostics findings;  ///< findings of check_structure, and a warning when there are fewer positions
};

struct IndirectOptions {
  LinkFitOptions link;
  /// For positions that do not prescribe the carrier pitch, when no US link is given.
  CarrierPitchFitOptions carrier_pitch;
};

/// Finds the links one after the other, each from its own starts and none twice, then the couplers. Where no
/// start of a rod is exact and there are seven positions, the rods that fit seven of them exactly are starts,
/// too. Links that share a coupler are at last fitted together if they are not exact, from where they are and
/// then from starts of their own; the best is taken.
///
/// Carrier pitches that are not prescribed follow from a US link whose coordinates are all given, if there is
/// one (section 5.3.5.1); else all links are found together with them.
///
/// Throws ContractError as fit_link, fit_coupler and fit_with_unknown_carrier_pitch do.
IndirectSynthesis synthesise(const IndirectTask& task, const IndirectOptions& options, std::uint64_t seed,
                             RunContext& context);

/// The synthesis that ended with these links, couplers, targets, evaluations and generations, and with all
/// that follows from them: to the bit what synthesise() or evolve() had made of them. `arms` stay empty.
IndirectSynthesis completed(const IndirectTask& task, const IndirectSynthesis& ended);

struct IndirectEvolutionOptions {
  EvolutionOptions method;
  bool together = false;    ///< all links at once, not link by link
  double tolerance = 1e-6;  ///< m: root mean square of the structural errors of a link that counts as found
};

/// The same by differential evolution, as the source has it: link by link, links that share a coupler
/// together, and all together where carrier pitches are missing and no US link is given.
IndirectSynthesis evolve(const IndirectTask& task, const IndirectEvolutionOptions& options,
                         std::uint64_t seed, RunContext& context);

}  // namespace linkwright::suspension
