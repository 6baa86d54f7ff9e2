// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/suspension/indirect/synthesis.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/studies/lists.h"

// The synthesis of a wheel suspension from positions of its carrier: what its file holds, how it is read, run
// and reported.
namespace linkwright::suspension {

/// `[[target.pose]]`: one position that the carrier is to take.
struct PoseEntry {
  double rack = 0;
  std::array<double, 3> centre{};
  double toe = 0, camber = 0;
  std::optional<double> carrier_pitch;
};
template <class Visitor>
void fields(Visitor&& visit, PoseEntry& p) {
  visit(field::length("rack", "displacement along its direction").between(-10, 10), p.rack);
  visit(field::length("centre", "of the wheel, in the vehicle's frame").required(), p.centre);
  const auto angle = [](std::string_view key, std::string_view summary, bool required) {
    return field::angle(key, summary).between(-1.5, 1.5).required(required);
  };
  visit(angle("toe", "> 0: front of the wheel towards the vehicle", true), p.toe);
  visit(angle("camber", "> 0: top of the wheel away from the vehicle", true), p.camber);
  visit(angle("carrier_pitch", "of the carrier about the wheel's axis; left out: not prescribed", false),
        p.carrier_pitch);
}

/// `[target]`: positions listed, or in a CSV file with the columns rack, centre_x, centre_y, centre_z, toe,
/// camber, carrier pitch.
struct PosesTarget {
  std::optional<std::string> file;
  std::optional<std::vector<PoseEntry>> poses;
};
template <class Visitor>
void fields(Visitor&& visit, PosesTarget& t) {
  visit(field::entry("file", "CSV file with one position per line"), t.file);
  visit(field::entry("pose", "positions of the carrier"), t.poses);
}

struct RecommendedIndirect {
  IndirectOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedIndirect& r) {
  fields(visit, r.options.link);
  visit(field::entry("unknown_carrier_pitch", "for positions that do not prescribe the carrier pitch"),
        r.options.carrier_pitch);
}
constexpr Word choice_word(const RecommendedIndirect&) {
  return {"recommended", "link by link: variable projection and least squares within the boxes"};
}

struct PublishedIndirect {
  IndirectEvolutionOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, PublishedIndirect& p) {
  visit(field::entry("generations", "at most").between(1, 1e7), p.options.method.method.generations);
  visit(field::entry("together", "all links at once, not link by link"), p.options.together);
  visit(field::length("tolerance", "root mean square of the structural errors of a link that counts as found")
            .between(1e-14, 1),
        p.options.tolerance);
  visit(
      field::entry("carrier_pitch_technique", "how carrier pitches that are not prescribed are represented"),
      p.options.method.technique);
}
constexpr Word choice_word(const PublishedIndirect&) {
  return {"differential_evolution",
          "with the settings of Poznanovic 2016: 5 members an unknown, F 0.6, CR 0.9"};
}

struct IndirectOptimiser {
  std::variant<RecommendedIndirect, PublishedIndirect> method;
};
template <class Visitor>
void fields(Visitor&& visit, IndirectOptimiser& o) {
  visit(field::entry("method", "how links are searched"), o.method);
}

/// A synthesis as read.
struct IndirectStudy {
  CornerDescription description;
  IndirectTask task;  ///< task for a left wheel: a right one is mirrored, and its answer mirrored back
  IndirectOptimiser optimiser;
  std::vector<ListForm> lists;
};

/// "synthesis" of "suspension.corner" for "carrier_poses".
study::Kind indirect_kind();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader.
std::optional<IndirectStudy> read_indirect_study(study::ObjectReader& document, const study::Common& common,
                                                 Value& canonical);

/// Runs it over the seeds and reports.
study::Result run_indirect_study(const IndirectStudy& study, const study::Common& common,
                                 RunContext& context);

}  // namespace linkwright::suspension
