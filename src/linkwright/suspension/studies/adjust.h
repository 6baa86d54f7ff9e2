// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"

// The table `[adjust]`: the turns of adjusters, or the shims, that set toe, camber and caster.
namespace linkwright::suspension {

struct AdjusterForm {
  std::string name, number;
  double per_turn = 0;
  std::optional<double> most_turns;
};
template <class Visitor>
void fields(Visitor&& visit, AdjusterForm& a) {
  visit(field::entry("name", "of the adjuster").required(), a.name);
  visit(field::entry("number", "what it changes: \"tie rod.length\", \"upper wishbone.body_1_y\"").required(),
        a.number);
  visit(field::length("per_turn", "change of that number by a turn, or the thickness of a shim")
            .between(-1, 1)
            .required(),
        a.per_turn);
  visit(field::entry("most_turns", "either way").between(0, 1e6), a.most_turns);
}

/// `[adjust]`.
struct AdjustForm {
  std::optional<double> toe, camber, caster;
  std::vector<AdjusterForm> adjusters;
};
template <class Visitor>
void fields(Visitor&& visit, AdjustForm& a) {
  const auto wanted = [](std::string_view key) {
    return field::angle(key, "wanted at the reference, the rack centred").between(-1, 1);
  };
  visit(wanted("toe"), a.toe);
  visit(wanted("camber"), a.camber);
  visit(wanted("caster"), a.caster);
  visit(field::entry("adjuster", "what can be turned or shimmed").required(), a.adjusters);
}

/// Checks what was read against the suspension; problems go to the reader.
void check_adjust(study::ObjectReader& document, const AdjustForm& adjust, const Suspension& suspension);

/// The table `adjustment`: turns of each adjuster, the least that give what is wanted with all links as they
/// are built, and the change of each angle by a turn of it.
void add_adjustment(study::Result& result, const Suspension& suspension, const AdjustForm& adjust,
                    Driver travel, Driver lock);

}  // namespace linkwright::suspension
