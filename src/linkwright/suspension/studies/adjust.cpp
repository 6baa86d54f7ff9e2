// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/adjust.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "linkwright/core/diagnostic.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/wheel/corner_columns.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

constexpr std::array<const char*, 3> angle_words{"toe", "camber", "caster"};

std::optional<DesignNumber> number_named(const Suspension& suspension, const std::string& name) {
  for (const DesignNumber& n : hard_points(suspension))
    if (label(suspension, n) == name) return n;
  return std::nullopt;
}

/// Toe, camber and caster of a suspension with its adjusters turned, and their changes by a turn of each.
struct Setting {
  bool reached = false;
  std::array<double, 3> angle{};
  std::vector<std::array<double, 3>> by_turn;  ///< [adjuster]
};

class Adjustment {
 public:
  Adjustment(const Suspension& suspension, const AdjustForm& form, Driver travel, Driver lock)
      : suspension_(suspension), form_(form), travel_(travel) {
    for (const AdjusterForm& a : form.adjusters) numbers_.push_back(*number_named(suspension, a.number));
    for (std::size_t i = 0; i < 3; ++i) quantities_[i] = *quantity_of(*corner_column(angle_words[i]), lock);
  }

  Setting at(const std::vector<double>& turns) const {
    Suspension turned = suspension_;
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      design_value(turned, numbers_[k]) += turns[k] * form_.adjusters[k].per_turn;
    Setting out;
    if (!check(turned).empty()) return out;
    const DerivativePlan plan = prepare_derivatives(turned, numbers_);
    const CornerPosition reference = reference_position(plan.plan, travel_);
    if (reference.status != Status::done) return out;
    const WheelDerivatives found = wheel_derivatives(plan, reference);
    if (found.status != Status::done) return out;
    out.reached = true;
    for (std::size_t i = 0; i < 3; ++i) out.angle[i] = value_of(found.parameters, quantities_[i]);
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      auto& by = out.by_turn.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        by[i] = form_.adjusters[k].per_turn * value_of(found.by[k], quantities_[i]);
    }
    return out;
  }

 private:
  const Suspension& suspension_;
  const AdjustForm& form_;
  Driver travel_;
  std::vector<DesignNumber> numbers_;
  std::array<WheelQuantity, 3> quantities_{};
};

/// The least turns t with J t = right, for the rows of J that are wanted; empty if the adjusters do not have
/// that many effects.
std::vector<double> least_turns(const Setting& s, const std::vector<std::size_t>& wanted,
                                const std::array<double, 3>& right) {
  std::array<std::array<double, 3>, 3> square{};
  std::array<double, 3> wanted_right{};
  for (std::size_t i = 0; i < 3; ++i) square[i][i] = 1;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted_right[i] = right[wanted[i]];
    for (std::size_t j = 0; j < wanted.size(); ++j) {
      square[i][j] = 0;
      for (const auto& by : s.by_turn) square[i][j] += by[wanted[i]] * by[wanted[j]];
    }
  }
  math::SmallLu<3> lu;
  lu.factor(square);
  // Volume of the rows against the product of their lengths: angles that no combination sets apart.
  double volume = 1;
  for (std::size_t i = 0; i < wanted.size(); ++i) volume *= square[i][i];
  if (!(std::abs(lu.determinant()) > 1e-12 * volume)) return {};
  const std::array<double, 3> weights = lu.solve(wanted_right);
  std::vector<double> out;
  for (const auto& by : s.by_turn) {
    double turns = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) turns += by[wanted[i]] * weights[i];
    out.push_back(turns);
  }
  return out;
}

}  // namespace

void check_adjust(study::ObjectReader& document, const AdjustForm& adjust, const Suspension& suspension) {
  auto table = document.table("adjust");
  if (!adjust.toe && !adjust.camber && !adjust.caster)
    table->error("toe", "nothing is wanted", "write toe_deg, camber_deg or caster_deg");
  if (adjust.caster && !std::any_of(suspension.links.begin(), suspension.links.end(),
                                    [](const CornerLink& l) { return l.moved_by_rack; }))
    table->error("caster", "the wheel is not steered: it has no steering axis",
                 "write moved_by = \"rack\" in the tie rod's table");
  if (!suspension.couplers.empty()) {
    table->error("adjuster", "a coupler is on a link of this suspension, whose place depends on the length");
    return;
  }
  if (adjust.adjusters.empty())
    table->error("adjuster", "there are none", "add [[adjust.adjuster]] with name, number and per_turn_mm");
  const Suspension made = as_built(suspension);
  std::vector<std::string> known;
  for (const DesignNumber& n : hard_points(made)) known.push_back(label(made, n));
  const std::vector<std::string_view> words(known.begin(), known.end());
  std::vector<study::ObjectReader> tables = table->tables("adjuster");
  for (std::size_t i = 0; i < adjust.adjusters.size() && i < tables.size(); ++i) {
    const AdjusterForm& a = adjust.adjusters[i];
    if (!number_named(made, a.number))
      tables[i].error("number", fmt::format("there is no number '{}'", a.number),
                      did_you_mean(a.number, words, fmt::format("there are: {}", fmt::join(known, ", "))));
    if (a.per_turn == 0) tables[i].error("per_turn", "is 0", "write the change by a turn, for example 1.5");
  }
}

void add_adjustment(study::Result& result, const Suspension& drawn, const AdjustForm& form, Driver travel,
                    Driver lock) {
  const Suspension suspension = as_built(drawn);
  const std::array<std::optional<double>, 3> goals{form.toe, form.camber, form.caster};
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < 3; ++i)
    if (goals[i]) wanted.push_back(i);
  const Adjustment adjustment(suspension, form, travel, lock);
  std::vector<double> turns(form.adjusters.size());
  const Setting before = adjustment.at(turns);
  const study::AddWarning warn{result.diagnostics};
  if (!before.reached) return warn("adjust", "the reference position has no derivatives", {});
  Setting now = before;
  double off = 0;
  for (int i = 0; i < 40; ++i) {
    off = 0;
    std::array<double, 3> right{};
    for (const std::size_t w : wanted) {
      right[w] = *goals[w] - now.angle[w];
      off = std::max(off, std::abs(right[w]));
      for (std::size_t k = 0; k < turns.size(); ++k) right[w] += now.by_turn[k][w] * turns[k];
    }
    if (i > 0 && off < 1e-13) break;
    std::vector<double> next = least_turns(now, wanted, right);
    if (next.empty())
      return warn(
          "adjust",
          say("the adjusters do not set {} apart", fmt::format("{}", fmt::join(
                                                                         [&] {
                                                                           std::vector<std::string_view> out;
                                                                           for (const std::size_t w : wanted)
                                                                             out.emplace_back(angle_words[w]);
                                                                           return out;
                                                                         }(),
                                                                         ", "))),
          "add an adjuster that changes them otherwise");
    // Half a step where the wheel would not reach its place.
    Setting there = adjustment.at(next);
    for (int halves = 0; !there.reached && halves < 20; ++halves) {
      for (std::size_t k = 0; k < turns.size(); ++k) next[k] = (next[k] + turns[k]) / 2;
      there = adjustment.at(next);
    }
    if (!there.reached) break;
    turns = std::move(next), now = std::move(there);
  }
  Table table{.name = "adjustment"};
  std::vector<double> change;
  std::array<std::vector<double>, 3> by_turn;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    table.names.push_back(form.adjusters[k].name);
    change.push_back(turns[k] * form.adjusters[k].per_turn);
    for (std::size_t i = 0; i < 3; ++i) by_turn[i].push_back(now.by_turn[k][i]);
  }
  table.add("turns", "turns, or shims", turns);
  table.add("change_m", "change of the number (m)", change);
  for (std::size_t i = 0; i < 3; ++i)
    if (goals[i] || std::isfinite(by_turn[i].front()))
      table.add(fmt::format("{}_by_turn_rad", angle_words[i]),
                fmt::format("{} by a turn (rad)", angle_words[i]), by_turn[i]);
  result.tables.push_back(std::move(table));
  const study::AddFact fact{result.facts};
  for (const std::size_t w : wanted)
    fact(say("{}, adjusted", angle_words[w]),
         say("{}, from {}", degrees_of(now.angle[w]).fixed(3), degrees_of(before.angle[w]).fixed(3)));
  if (!(off < 1e-9))
    warn("adjust",
         say("the wanted angles are not reached; the greatest is off by {}", degrees_of(off).fixed(3)),
         "add an adjuster, or want less");
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const AdjusterForm& a = form.adjusters[k];
    const bool too_many = a.most_turns && std::abs(turns[k]) > *a.most_turns;
    fact(say("turns of {}", a.name), plain_number(turns[k]).fixed(3),
         too_many ? study::Fact::Verdict::bad : study::Fact::Verdict::plain);
    if (too_many)
      warn("adjust",
           say("{} needs {} turns, and has {}", a.name, plain_number(turns[k]).fixed(2),
               plain_number(*a.most_turns).fixed(2)),
           {});
  }
}

}  // namespace linkwright::suspension
