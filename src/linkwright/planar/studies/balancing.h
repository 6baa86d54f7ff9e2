// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/balancing/balancing.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/balancing/search.h"
#include "linkwright/study/design_variables.h"
#include "linkwright/study/kind.h"

// Balancing of any mechanism that has an analysis: the tables of the analysis with open numbers in them, what
// is minimised, what must hold, and how designs are searched.
namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, BalancingGoal& o) {
  visit(field::entry("quantity", "column of the analysis: \"shaking_force_N\"").required(), o.quantity);
  visit(field::entry("measure", "one number for the column"), o.measure);
  visit(field::entry("weight", "how much it counts among the others").positive().at_most(1e9), o.weight);
  visit(field::entry("reference",
                     "value that counts as 1, in the unit of the column; default: that of the initial "
                     "design")
            .positive(),
        o.reference);
  visit(field::entry("at_most", "the objective may be at most this many times its reference").not_negative(),
        o.at_most);
  visit(field::entry("target",
                     "in order: the objective is met when it is at most this many times its reference")
            .positive(),
        o.target);
}
template <class Visitor>
void fields(Visitor&& visit, BalancingLimit& c) {
  visit(field::entry("quantity", "column of the analysis: \"transmission_angle_rad\"").required(),
        c.quantity);
  visit(field::entry("measure", "one number for the column").required(), c.measure);
  visit(field::entry("change", "measure the difference from the initial design"), c.change);
  visit(field::entry("at_least", "lower limit, in the unit of the column"), c.at_least);
  visit(field::entry("at_most", "upper limit, in the unit of the column"), c.at_most);
  visit(field::entry("enabled", "false leaves it out"), c.enabled);
}

/// A kind of mechanism that can be balanced.
struct BalancedMechanism {
  std::string_view type;  ///< "planar.four_bar"
  std::string_view (*example)();
  study::Kind (*analysis)();
  /// The table of its analysis; problems go to the reader, and the table is then empty.
  Table (*table)(study::ObjectReader& document, const study::Common& common,
                 std::span<const std::string> columns);
};
std::span<const BalancedMechanism> balanced_mechanisms();

/// A study as read.
struct BalancingStudy {
  const BalancedMechanism* mechanism = nullptr;
  study::DesignedTables designed;
  std::vector<BalancingGoal> objectives;
  std::vector<BalancingLimit> constraints;  ///< constraints that are enabled
  BalancingOptimiser optimiser;
};

/// "balancing" of every mechanism of `balanced_mechanisms`.
std::vector<study::Kind> balancing_kinds();

/// Reads the tables of the study; problems go to the reader. Throws ContractError for a mechanism that is not
/// among the balanced ones.
BalancingStudy read_balancing_study(study::ObjectReader& document, const study::Common& common);

/// The tables of an analysis of one design, as the study has them: `x` in the units of the keys of the design
/// variables.
Value design_tables(const BalancingStudy& study, std::span<const double> x);
/// The table of one design: `x` in the units of the keys of the design variables. Empty when they are no
/// mechanism.
Table design_table(const BalancingStudy& study, std::span<const double> x,
                   std::span<const std::string> columns);
/// True if the rows of the initial design are those of a period with both its ends: means count one of them,
/// for all designs alike.
bool closes(const BalancingStudy& study);
/// The whole analysis of one design.
study::Result design_analysis(const BalancingStudy& study, const study::Common& common,
                              std::span<const double> x, RunContext& context);

/// Runs it over the seeds and reports.
study::Result run_balancing_study(const BalancingStudy& study, const study::Common& common,
                                  RunContext& context);

}  // namespace linkwright::planar
