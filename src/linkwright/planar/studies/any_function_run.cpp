// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_report.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/minimax.h"
#include "linkwright/planar/type_synthesis/title.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t looked_at = 4001;  // places of the range at which the greatest error is sought

/// The errors of a machine over the whole range, closer than the samples that it was fitted to.
struct FunctionFindings {
  double greatest = 0;       ///< rad, or m
  double root_mean = 0;      ///< root mean square
  double worst_rest = 0;     ///< greatest departure from its mean while it is to rest
  std::vector<double> rest;  ///< value at which it rests, of each dwell: rad, or m
};

/// A study at ranges of the crank and of the output.
AnyStudy at_ranges(const AnyStudy& s, double input, double output) {
  AnyStudy out = s;
  FunctionProblem& p = out.function.problem;
  const double given = 0.5 * (s.ranges->output.lower + s.ranges->output.upper);
  p.input_range = input;
  // The output is proportional to its range.
  p.output = [own = s.function.problem.output, by = output / given](double share) { return by * own(share); };
  out.ranges->input = {input, input}, out.ranges->output = {output, output};
  out.motion = function_target({.output = s.motion->output,
                                .range = input,
                                .at = p.output,
                                .dwells = {},
                                .size = s.motion->stroke.size});
  return out;
}

/// Chooses the ranges that are free: those at which the simplest machines of the search have the least root
/// mean square error, as a part of the range of the output. A grid, then steps in each range, halved three
/// times. The choice counts curves, never seconds, so that it is the same on every machine.
AnyStudy with_chosen_ranges(const AnyStudy& s, const study::Common& common, RunContext& context) {
  constexpr int rounds = 3;
  constexpr std::int64_t curves_by_time = 20'000;
  const FunctionRanges& r = *s.ranges;
  const std::array<const Range*, 2> range{&r.input, &r.output};
  TypeSearchOptions options = search_options(s, common, limits_of(s.limits, s.motion->stroke));
  std::vector<MachineFamily> families = searched_families(*s.motion, options);
  int fewest = 100;
  for (const MachineFamily f : families) fewest = std::min(fewest, links_of(f));
  std::erase_if(families, [&](MachineFamily f) { return links_of(f) > fewest; });
  options.families = families, options.max_links = fewest;
  options.max_curves =
      s.optimiser.evaluations ? std::max<std::int64_t>(3000, *s.optimiser.evaluations / 40) : curves_by_time;
  double least = infinity;
  std::array<double, 2> best{0.5, 0.5};  // shares of the ranges
  const auto value_at = [&](int i, double share) {
    const Range& of = *range[static_cast<std::size_t>(i)];
    return of.lower + share * (of.upper - of.lower);
  };
  const auto look_at = [&](std::array<double, 2> share) {
    if (context.interrupted()) return;
    const AnyStudy trial = at_ranges(s, value_at(0, share[0]), value_at(1, share[1]));
    options.limits = limits_of(s.limits, trial.motion->stroke);
    RunContext part;
    part.set_part_of(context);
    part.set_threads(context.threads());
    const TypeSearchAnswer answer = search_types(*trial.motion, options, part);
    double error = infinity;
    for (const FamilyReport& f : answer.families) error = std::min(error, f.error);
    error *= trial.motion->error_unit() / std::abs(value_at(1, share[1]));
    if (error < least) least = error, best = share;
  };
  const bool both = !r.input.fixed() && !r.output.fixed();
  const int steps = both ? 3 : 4;
  for (int i = 0; i <= (r.input.fixed() ? 0 : steps); ++i)
    for (int j = 0; j <= (r.output.fixed() ? 0 : steps); ++j)
      look_at({static_cast<double>(i) / steps, static_cast<double>(j) / steps});
  double step = 0.5 / steps;
  for (int round = 0; round < rounds; ++round, step *= 0.5)
    for (std::size_t i = 0; i < 2; ++i)
      for (const double by : {-step, step}) {
        std::array<double, 2> share = best;
        share[i] += by;
        if (!range[i]->fixed() && share[i] >= 0 && share[i] <= 1) look_at(share);
      }
  return at_ranges(s, value_at(0, best[0]), value_at(1, best[1]));
}

class FunctionReport final : public AnyReport {
 public:
  FunctionReport(const AnyStudy& s, const study::Common& common)
      : AnyReport(s, common), p_(s.function.problem) {}

 private:
  bool slider() const { return motion_.output == MachineOutput::slide; }
  const char* unit() const { return slider() ? "m" : "rad"; }
  /// A size of the target, or a radian, in the unit of the output.
  double scale() const { return slider() ? size() : 1; }
  std::string key(const char* name) const { return fmt::format("{}_{}", name, unit()); }
  std::string label(const char* text) const { return fmt::format("{} ({})", text, unit()); }
  Measured output(double value, int digits = 3) const {
    return slider() ? millimetres(value, digits) : degrees_of(value, digits);
  }

  double share_of(double turned) const { return turned / p_.input_range; }
  /// The dwell that a rotation of the crank is in, -1 for none.
  int dwell_at(double turned) const {
    for (std::size_t i = 0; i < s_.dwells.size(); ++i)
      if (std::abs(turned) >= s_.dwells[i].from - 1e-9 && std::abs(turned) <= s_.dwells[i].to + 1e-9)
        return static_cast<int>(i);
    return -1;
  }

  /// Errors of the output from the function at rotations of the crank from the beginning, those of rests from
  /// the function, too.
  std::vector<double> errors_at(const FittedMachine& m, const std::vector<double>& turned) const {
    const std::size_t n = turned.size(), padded = (n + 7) / 8 * 8;
    std::vector<double> angle(padded), px(padded), py(padded), bx(padded), by(padded), out;
    for (std::size_t k = 0; k < padded; ++k) angle[k] = m.angle[0] + turned[std::min(k, n - 1)];
    CurveTask task{.program = m.shape.program,
                   .x = m.shape.x.data(),
                   .signs = m.shape.signs,
                   .angle = angle.data(),
                   .count = padded,
                   .px = px.data(),
                   .py = py.data()};
    // A slider has one pin, and so no angle.
    if (!slider()) task.bx = bx.data(), task.by = by.data();
    compute_curve(task);
    for (std::size_t k = 0; k < n; ++k) {
      const double wanted = p_.output(share_of(turned[k]));
      out.push_back(
          slider() ? motion_.stroke.centre.real() + size() * px[k] - wanted
                   : math::wrap_angle(std::arg(std::complex<double>(bx[k], by[k])) + m.body_angle - wanted));
    }
    return out;
  }

  FunctionFindings findings_of(const FittedMachine& m) const {
    std::vector<double> turned;
    for (std::size_t k = 0; k < looked_at; ++k)
      turned.push_back(p_.input_range * static_cast<double>(k) / (looked_at - 1));
    std::vector<double> error = errors_at(m, turned);
    FunctionFindings out;
    out.rest.assign(s_.dwells.size(), 0);
    std::vector<double> count(s_.dwells.size(), 0);
    const auto reached = [&](std::size_t k) { return error[k] + p_.output(share_of(turned[k])); };
    std::vector<double> first(s_.dwells.size(), nan);
    for (std::size_t k = 0; k < looked_at; ++k)
      if (const int i = dwell_at(turned[k]); i >= 0) {
        const auto d = static_cast<std::size_t>(i);
        if (std::isnan(first[d])) first[d] = reached(k);
        out.rest[d] += slider() ? reached(k) : first[d] + math::wrap_angle(reached(k) - first[d]);
        count[d] += 1;
      }
    for (std::size_t d = 0; d < count.size(); ++d) out.rest[d] /= std::max(count[d], 1.0);
    double squares = 0;
    for (std::size_t k = 0; k < looked_at; ++k) {
      const int i = dwell_at(turned[k]);
      if (i >= 0) {
        const double apart = reached(k) - out.rest[static_cast<std::size_t>(i)];
        error[k] = slider() ? apart : math::wrap_angle(apart);
        out.worst_rest = std::max(out.worst_rest, std::abs(error[k]));
      }
      out.greatest = std::max(out.greatest, std::abs(error[k]));
      squares += error[k] * error[k];
    }
    out.root_mean = std::sqrt(squares / looked_at);
    return out;
  }

  /// Finds the errors of the list, and brings each machine to its least greatest error where that is asked
  /// for; the refinement begins with such machines. Sorts by what is asked for.
  void look_at_machines(RunContext& context, bool refined) override {
    std::vector<FoundMachine>& list = answer_.machines;
    found_.assign(list.size(), {});
    optimise::parallel_for(list.size(), context.threads(), [&](std::size_t i) {
      found_[i] = findings_of(list[i].machine);
      if (refined || s_.fit != FunctionFit::minimax || context.interrupted()) return;
      FoundMachine lessened = list[i];
      RunContext part;
      part.set_part_of(context);
      lessen_greatest_error(motion_, limits_, lessened.machine, part);
      lessened.measures = MachineFitter(motion_, limits_).measure(lessened.machine);
      const FunctionFindings now = findings_of(lessened.machine);
      if (lessened.measures.defect == MachineDefect::none && now.greatest < found_[i].greatest)
        list[i] = lessened, found_[i] = now;
    });
    std::vector<std::size_t> kept(list.size());
    std::iota(kept.begin(), kept.end(), 0u);
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::size_t a, std::size_t b) { return error_of(found_[a]) < error_of(found_[b]); });
    std::vector<FunctionFindings> errors;
    for (const std::size_t i : kept) errors.push_back(found_[i]);
    found_ = std::move(errors);
    keep(kept);
  }

  /// The error that machines are compared by.
  double error_of(const FunctionFindings& found) const {
    return s_.fit == FunctionFit::minimax ? found.greatest : found.root_mean;
  }

  /// Errors are limited over the whole range, closer than the samples.
  FunctionErrorLimit error_limit() override {
    return {.greatest = s_.fit == FunctionFit::minimax,
            .whole_error = [&](const FittedMachine& m) { return error_of(findings_of(m)) / scale(); }};
  }
  SearchError search_error() const override {
    return {slider() ? "structural_error_rms_m" : "structural_error_rms_rad", unit(), scale()};
  }
  std::string compared_by() const override { return key("structural_error"); }
  Measured error_outside(const MachineMeasures& measures) const override {
    return output(measures.error * scale());
  }
  Sentence error_in_words(std::size_t i) const override {
    return say("greatest error {}", output(found_[i].greatest));
  }

  Sentence label_of(std::size_t i) const override {
    const FoundMachine& found = machines()[i];
    return say("{}, greatest error {}, pair angle {}", title_of(*found.machine.shape.program),
               output(found_[i].greatest), degrees_of(found.measures.min_pair_angle).fixed(1));
  }

  void describe(std::size_t i, const FoundLinkage& of, study::Solution& out) const override {
    const FittedMachine& machine = machines()[i].machine;
    out.objectives[key("structural_error")] = found_[i].greatest;
    out.objectives[key("structural_error_rms")] = found_[i].root_mean;
    if (!s_.dwells.empty()) out.objectives[key("rest_error")] = found_[i].worst_rest;
    if (s_.ranges) {
      out.objectives["input_range_rad"] = s_.ranges->input.lower;
      out.objectives[key("output_range")] = s_.ranges->output.lower;
      out.objectives["structural_error_share"] = found_[i].greatest / std::abs(s_.ranges->output.lower);
    }
    out.classification["output"] = of.traced.substr(0, of.traced.find('.'));
    out.classification["crank_begins_rad"] = machine.angle[0] + of.crank_angle;
    if (!slider()) out.classification["output_angle_on_link_rad"] = machine.body_angle;
  }

  /// Rotation of the crank from the beginning, at a row of the tables.
  double input_at(std::size_t row) const {
    return p_.input_range * (static_cast<double>(row) / (common_.output.samples - 1));
  }
  std::vector<double> crank_angles(std::size_t i, const FoundLinkage& of) const override {
    std::vector<double> out(static_cast<std::size_t>(common_.output.samples));
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = machines()[i].machine.angle[0] + of.crank_angle + input_at(k);
    return out;
  }

  void add_motion(std::size_t i, const FoundLinkage& /*of*/, const std::vector<double>& crank,
                  std::span<const PartState<double>> states, study::Scene& /*scene*/) override {
    const FunctionStudy& f = s_.function;
    std::vector<double> x, input, wanted, reached, error;
    for (std::size_t k = 0; k < crank.size(); ++k) {
      input.push_back(input_at(k));
      const double share = share_of(input.back());
      x.push_back(f.x_from + (f.x_to - f.x_from) * share);
      const int dwell = dwell_at(input.back());
      wanted.push_back(dwell < 0 ? p_.output(share) : found_[i].rest[static_cast<std::size_t>(dwell)]);
      const PartState<double>& state = states[k];
      error.push_back(slider() ? state.origin.x - wanted.back()
                               : math::wrap_angle(std::atan2(state.direction.y, state.direction.x) +
                                                  machines()[i].machine.body_angle - wanted.back()));
      reached.push_back(wanted.back() + error.back());
    }
    const std::string suffix = suffix_of(i);
    Table table{.name = "structural_error" + suffix};
    table.add("x", "x", std::move(x));
    table.add("input_rad", "rotation of the crank from the start (rad)", std::move(input));
    table.add(key("wanted"), label("wanted output"), std::move(wanted));
    table.add(key("output"), label("output"), std::move(reached));
    table.add(key("error"), label("structural error"), std::move(error));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "structural_error" + suffix, .x = "input_rad"}};
    const std::string which = i == 0 ? "" : fmt::format(" of solution {}", i + 1);
    plot("error" + suffix, "Structural error" + which, {key("error")});
    plot("output" + suffix, "Output, and what is wanted" + which, {key("output"), key("wanted")});
  }

  void add_columns(Table& table) const override {
    table.add(key("structural_error"), label("greatest error"),
              column_of([&](std::size_t i) { return found_[i].greatest; }));
    table.add(key("structural_error_rms"), label("root mean square error"),
              column_of([&](std::size_t i) { return found_[i].root_mean; }));
    if (!s_.dwells.empty())
      table.add(key("rest_error"), label("greatest departure from rest"),
                column_of([&](std::size_t i) { return found_[i].worst_rest; }));
  }

  void introduce(const study::AddFact& fact) const override {
    fact("function", say("{}, x = {} to {}", s_.function.name, plain_number(s_.function.x_from),
                         plain_number(s_.function.x_to)));
    if (!s_.ranges) return;
    fact("rotation of the crank over the range", degrees_of(s_.ranges->input.lower, 5));
    fact("range of the output", output(s_.ranges->output.lower, 5));
  }

  void tell_of_best(const study::AddFact& fact, const Sentence& links, const Measured& pair_angle) override {
    const Measured greatest = output(found_[0].greatest);
    result_.headline =
        say("A machine of {} links generates the function within {}, pair angles of at least {}.", links,
            greatest, pair_angle);
    report_greatest_error(p_, greatest, result_);
    fact("root mean square error", output(found_[0].root_mean));
    for (std::size_t d = 0; d < s_.dwells.size(); ++d)
      fact(s_.dwells.size() == 1 ? std::string("value at which the output rests")
                                 : fmt::format("value at which the output rests, dwell {}", d + 1),
           output(found_[0].rest[d], 4));
    if (!s_.dwells.empty()) fact("greatest departure from rest", output(found_[0].worst_rest));
  }

  const FunctionProblem& p_;
  std::vector<FunctionFindings> found_;  ///< of each machine of the list
};

}  // namespace

study::Result run_any_function_study(const AnyStudy& s, const study::Common& common, RunContext& context) {
  if (!s.ranges) return FunctionReport(s, common).make(context);
  const AnyStudy chosen = with_chosen_ranges(s, common, context);
  return FunctionReport(chosen, common).make(context);
}

}  // namespace linkwright::planar
