// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_report.h"
#include "linkwright/planar/type_synthesis/title.h"

namespace linkwright::planar {
namespace {

constexpr double kept_within = 0.01;  // of the time ratio and of the range: machines that miss them are none

class QuickReturnReport final : public AnyReport {
 public:
  QuickReturnReport(const AnyStudy& s, const study::Common& common)
      : AnyReport(s, common), wanted_(*s.quick_return) {}

 private:
  bool slider() const { return motion_.output == MachineOutput::slide; }
  const char* unit() const { return slider() ? "m" : "rad"; }
  const char* range_key() const { return slider() ? "stroke_m" : "swing_angle_rad"; }
  Measured output(double value, int digits = 4) const {
    return slider() ? millimetres(value, digits) : degrees_of(value, digits);
  }

  /// Machines whose output has two dead centres, with the time ratio and the range; by falling pair angle.
  void look_at_machines(RunContext& /*context*/, bool /*refined*/) override {
    strokes_.clear();
    std::vector<std::size_t> kept;
    for (const FoundMachine& found : machines()) {
      const MachineStrokes& strokes = strokes_.emplace_back(strokes_of(wanted_, motion_, found.machine));
      const double of_ratio = std::abs(strokes.time_ratio / wanted_.time_ratio - 1),
                   of_range = std::abs(strokes.range / wanted_.range - 1);
      if (strokes.extremes == 2 && of_ratio <= kept_within && of_range <= kept_within)
        kept.push_back(strokes_.size() - 1);
    }
    std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
      return machines()[a].measures.min_pair_angle > machines()[b].measures.min_pair_angle;
    });
    std::vector<MachineStrokes> strokes;
    for (const std::size_t i : kept) strokes.push_back(strokes_[i]);
    strokes_ = std::move(strokes);
    keep(kept);
  }

  SearchError search_error() const override {
    return {slider() ? "dead_centre_error_m" : "dead_centre_error_rad", unit(), motion_.error_unit()};
  }
  std::string compared_by() const override { return "least_pair_angle_rad"; }
  Measured error_outside(const MachineMeasures& measures) const override {
    return output(measures.error * motion_.error_unit());
  }
  Sentence error_in_words(std::size_t i) const override {
    return say("pair angle {}", degrees_of(machines()[i].measures.min_pair_angle).fixed(1));
  }

  Sentence label_of(std::size_t i) const override {
    const FoundMachine& found = machines()[i];
    return say("{}, time ratio {}, pair angle {}", title_of(*found.machine.shape.program),
               plain_number(strokes_[i].time_ratio), degrees_of(found.measures.min_pair_angle).fixed(1));
  }

  void describe(std::size_t i, const FoundLinkage& of, study::Solution& out) const override {
    out.objectives["time_ratio"] = strokes_[i].time_ratio;
    out.objectives[range_key()] = std::abs(strokes_[i].range);
    out.classification["output"] = of.traced.substr(0, of.traced.find('.'));
    out.classification["slow_stroke_begins_rad"] = machines()[i].machine.angle[0] + of.crank_angle;
  }

  /// Rotation of the crank from the beginning of the slow stroke, at a row of the tables.
  double turned_at(std::size_t row) const {
    return (wanted_.clockwise ? -2 : 2) * pi * static_cast<double>(row) / (common_.output.samples - 1);
  }
  std::vector<double> crank_angles(std::size_t i, const FoundLinkage& of) const override {
    std::vector<double> out(static_cast<std::size_t>(common_.output.samples));
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = machines()[i].machine.angle[0] + of.crank_angle + turned_at(k);
    return out;
  }

  /// The output over the turn.
  void add_motion(std::size_t i, const FoundLinkage& /*of*/, const std::vector<double>& crank,
                  std::span<const PartState<double>> states, study::Scene& /*scene*/) override {
    std::vector<double> turned, output;
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const PartState<double>& state = states[k];
      turned.push_back(turned_at(k));
      output.push_back(slider() ? state.origin.x : std::atan2(state.direction.y, state.direction.x));
    }
    if (!slider()) math::unwrap_angles(output);
    const double begin = output.front();
    for (double& value : output) value -= begin;
    const std::string suffix = suffix_of(i);
    Table table{.name = "strokes" + suffix};
    table.add("input_rad", "rotation of the crank from the beginning of the slow stroke (rad)",
              std::move(turned));
    table.add(fmt::format("output_{}", unit()), fmt::format("output ({})", unit()), std::move(output));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "strokes" + suffix, .x = "input_rad"}};
    plot("output" + suffix, i == 0 ? "Output" : fmt::format("Output of solution {}", i + 1),
         {fmt::format("output_{}", unit())});
  }

  void add_columns(Table& table) const override {
    table.add("time_ratio", "time of the slow stroke over that of the quick one",
              column_of([&](std::size_t i) { return strokes_[i].time_ratio; }));
    table.add(range_key(), slider() ? "stroke (m)" : "swing angle (rad)",
              column_of([&](std::size_t i) { return std::abs(strokes_[i].range); }));
  }

  void tell_of_best(const study::AddFact& fact, const Sentence& links, const Measured& pair_angle) override {
    const Measured range = output(std::abs(strokes_[0].range)), ratio = plain_number(strokes_[0].time_ratio);
    result_.headline =
        say("A machine of {} links returns {} times as quickly as it goes forth over {}, pair angles "
            "of at least {}.",
            links, ratio, range, pair_angle);
    fact("time ratio of the slow and the quick stroke", ratio);
    fact(slider() ? "stroke" : "swing angle", range);
  }

  const QuickReturn& wanted_;
  std::vector<MachineStrokes> strokes_;  ///< of each machine of the list
};

}  // namespace

study::Result run_any_quick_return_study(const AnyStudy& s, const study::Common& common,
                                         RunContext& context) {
  return QuickReturnReport(s, common).make(context);
}

}  // namespace linkwright::planar
