// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/chains.h"
#include "linkwright/planar/studies/chain.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

// Mechanisms that a report can hold.
constexpr double max_placements = 5e4;

// Number of chains, without and with those that have cut links: for estimates, before any is made.
struct Known {
  int links, freedoms, chains, fractionated;
};
constexpr Known known[] = {{4, 1, 1, 0}, {6, 1, 2, 0},  {8, 1, 16, 0}, {10, 1, 230, 0}, {5, 2, 1, 0},
                           {7, 2, 3, 1}, {9, 2, 35, 5}, {6, 3, 1, 0},  {8, 3, 5, 1},    {10, 3, 74, 19}};

int number_of_chains(const ChainMechanism& m) {
  for (const Known& k : known)
    if (k.links == m.links && k.freedoms == m.freedoms)
      return k.chains + (m.fractionated ? k.fractionated : 0);
  return 0;
}

// Placements of all marks on a chain of so many joints, before symmetry.
double estimate(const ChainMechanism& m) {
  const int joints = (3 * (m.links - 1) - m.freedoms) / 2;
  double out = number_of_chains(m);
  for (int i = 1; i <= m.sliders; ++i) out = out * (joints - m.sliders + i) / i;
  if (m.gear_pair) out *= 2 * joints;
  if (m.ground) out *= m.driver ? 2 * joints : m.links;
  return out;
}

// The numbers of links next to the given one that chains of these freedoms have: "5 or 7".
std::string possible_links(int links, int freedoms) {
  std::string out;
  for (int n = std::max(4, links - 1); n <= std::min(10, std::max(links, freedoms + 2) + 1); ++n)
    if (chain_can_exist(n, freedoms)) out += fmt::format("{}{}", out.empty() ? "" : " or ", n);
  return out;
}

void check_sliders(study::ObjectReader& reader, const ChainMechanism& m) {
  const int joints = (3 * (m.links - 1) - m.freedoms) / 2;
  if (m.sliders > joints - 1)
    reader.error(
        "sliders", fmt::format("{} sliders for the {} joints of {} links", m.sliders, joints, m.links),
        fmt::format("write at most {}: a chain of slides alone does not turn its links", joints - 1));
}

void check_chain(study::ObjectReader& reader, const ChainMechanism& m) {
  if (m.links < 4 || m.links > 10 || m.freedoms < 1 || m.freedoms > 3) return;  // reported with its range
  if (!chain_can_exist(m.links, m.freedoms)) {
    reader.error(
        "links",
        fmt::format("no chain of {} links has {} degree{} of freedom: 3 (links - 1) - 2 joints is {}",
                    m.links, m.freedoms, m.freedoms == 1 ? "" : "s",
                    m.links < m.freedoms + 3 ? "then that of a loop of less links than joints"
                    : m.links % 2 == 0       ? "odd for an even number of links"
                                             : "even for an odd number of links"),
        fmt::format("write links = {}", possible_links(m.links, m.freedoms)));
    return;
  }
  check_sliders(reader, m);
  if (m.gear_pair && m.freedoms != 2)
    reader.error("gear_pair",
                 fmt::format("a gear pair takes one degree of freedom, and the chain has {}", m.freedoms),
                 "write freedoms = 2, with 5, 7 or 9 links, for geared mechanisms of one degree of freedom");
  if (m.driver && !m.ground && reader.has("driver"))
    reader.error("driver", "the driven joint is one of the ground, and ground = false leaves no link held",
                 "write ground = true, or driver = false");
  if (const double cases = estimate(m); cases > max_placements)
    reader.error("links",
                 fmt::format("{} chains with their marks have about {:.0f} placements, more than {:.0f}",
                             number_of_chains(m), cases, max_placements),
                 "write driver = false or ground = false, or take fewer sliders or links");
}

}  // namespace

study::Kind chain_kind() {
  study::Kind kind;
  kind.kind = "enumeration";
  kind.mechanism = "planar.chain";
  kind.summary = "all kinematic chains of a number of links: type synthesis";
  kind.example = templates::enumeration_chain();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the chains").required(),
                      study::schema_fields<ChainMechanism>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common&) {
    ChainMechanism m;
    if (auto table = document.table(field::entry("mechanism").required())) {
      table->read(m);
      check_chain(*table, m);
    }
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(m);
    prepared.run = [m](RunContext& context) { return run_chain_study(m, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
