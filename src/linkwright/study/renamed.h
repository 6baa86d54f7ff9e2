// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/value.h"

// Names that studies had in an earlier version. They stay readable for one version more, with a warning that
// gives the new one.
namespace linkwright::study {

/// The kind of thing that a name stands for.
enum class NameOf { kind, mechanism, target, key, word, link, column };
constexpr std::array<EnumName<NameOf>, 7> names(NameOf) {
  return {{{NameOf::kind, "kind", "kind of a study"},
           {NameOf::mechanism, "mechanism", "type of a mechanism"},
           {NameOf::target, "target", "type of a target"},
           {NameOf::key, "key", "key of a table, without its unit"},
           {NameOf::word, "word", "text of a `type`, `quantity` or `quantities`"},
           {NameOf::link, "link", "code of a link, as its `type` and in the name of a `sample`"},
           {NameOf::column, "column", "column of a table of results, without its unit"}}};
}

struct Renamed {
  NameOf of;
  /// Old name of a column: may begin with "_", the end of its name; or hold its unit.
  std::string_view before;
  std::string_view now;
  std::string_view mechanism = {};  ///< in studies of mechanisms whose type begins so; empty = in all
  std::string_view kinds = {};      ///< in studies of the kinds that it lists; empty = in all
};

/// All of them: what `linkwright catalogue --renamed` lists.
std::span<const Renamed> renamed();

/// The document with today's names; a warning for each that it had from before. A table that has a name
/// twice, from before and of today, keeps both, so that reading it says what is wrong.
Value with_todays_names(Value document, const std::string& file, Diagnostics& diagnostics);

/// A kind, "synthesis/suspension.wheel_guide/carrier_poses", by its name of today.
std::string todays_kind(std::string_view name);

}  // namespace linkwright::study
