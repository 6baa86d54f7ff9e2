// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/sentence.h"
#include "linkwright/study/result.h"

// Helpers by which a study reports its findings: `const AddFact fact{result.facts};`, then fact("circuits",
// "2").
namespace linkwright::study {

/// Adds facts to those of a result.
struct AddFact {
  std::vector<Fact>& facts;
  Fact& operator()(Sentence label, Sentence text, Fact::Verdict verdict = Fact::Verdict::plain) const {
    return facts.emplace_back(Fact{std::move(label), std::move(text), verdict});
  }
};

/// Adds warnings to the diagnostics of a result; `key` is that of the study which they are about.
struct AddWarning {
  Diagnostics& diagnostics;
  void operator()(const Sentence& message, const Sentence& hint = {}) const { (*this)({}, message, hint); }
  void operator()(std::string key, const Sentence& message, const Sentence& hint) const {
    diagnostics.push_back({Diagnostic::Severity::warning, {}, {}, std::move(key), message, hint});
  }
};

/// Adds diagrams of one table to a result: `const AddPlot plot{result, {.table = "motion", .x = "time_s",
/// .scene = "motion"}};`, then plot("torque", "Drive torque", {"torque_N_m"}). Columns that the table does
/// not have are left out, and a diagram without columns is not added.
struct AddPlot {
  Result& result;
  Plot like;  ///< properties that all plots share
  void operator()(std::string name, std::string title, std::vector<std::string> y) const {
    (*this)(std::move(name), std::move(title), std::move(y), like.style);
  }
  void operator()(std::string name, std::string title, std::vector<std::string> y, Plot::Style style) const {
    const Table* table = result.table(like.table);
    std::erase_if(y, [&](const std::string& key) { return !table || !table->find(key); });
    if (y.empty()) return;
    Plot& plot = result.plots.emplace_back(like);
    plot.name = std::move(name), plot.title = std::move(title), plot.y = std::move(y), plot.style = style;
  }
};

/// An angle or a length, as those of a joint: "45°", "12.5 mm".
inline Measured angle_or_length(double value, bool is_angle, int digits) {
  return is_angle ? degrees_of(value, digits) : millimetres(value, digits);
}
/// A torque or a force, as those of a drive: "5.567 N m", "12.5 N".
inline Measured torque_or_force(double value, bool is_torque, int digits) {
  return is_torque ? newton_metres(value, digits) : newtons(value, digits);
}

/// The error of the energy balance of a simulation.
struct EnergyBalance {
  double drift = 0;  ///< J, at most
  double peak = 0;   ///< J, the largest energy

  double share() const { return peak > 0 ? drift / peak : 0; }
  /// True if the answer is not to be trusted.
  bool poor() const { return share() > 1e-5; }
  Sentence text() const {
    return say("within {} ({} of the peak energy {})", measured("J", drift, 2), plain_number(share(), 2),
               measured("J", peak));
  }
};

}  // namespace linkwright::study
