// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/tolerance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::clearance {
namespace {

using Kind = ToleranceQuantity::Kind;
// Below it errors, like forces, grow without bound.
constexpr double poor_transmission = 5 * 3.14159265358979 / 180;
// Random linkages and the first order are said to differ when the root mean squares do by more than this,
// and by more than chance explains.
constexpr double poor_linearity = 0.1;
// Share of random linkages that "nearly all" means.
constexpr double nearly_all = 0.99;
// Facts and plots are of the first few quantities; the tables have all.
constexpr std::size_t max_told = 8, max_curves = 7;

// A share of `count` out of `draws`, with the interval that holds the true one with 95 % confidence (Wilson
// 1927).
struct Share {
  double value = 0, lower = 0, upper = 1;
};
Share share_of(int count, int draws) {
  constexpr double z = 1.959963984540054;
  const double n = draws, p = count / n, w = z * z / n;
  const double middle = (p + w / 2) / (1 + w), half = z / (1 + w) * std::sqrt(p * (1 - p) / n + w / (4 * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

class ToleranceReporter {
 public:
  ToleranceReporter(const ToleranceStudy& s, ToleranceRecording recording) : s_(s), r_(std::move(recording)) {
    for (std::size_t p = 0; p < s_.outputs.points.size(); ++p) bands_.push_back(path_band(s_, r_, p));
    scale_ = tolerance_scale(s_, bands_);
    for (std::size_t q = 0; q < quantities(); ++q) nearly_.push_back(quantile(q, nearly_all));
  }

  study::Result report() {
    status();
    result_.tables = tolerance_tables(s_, r_, bands_, scale_);
    yield();
    result_.scenes.push_back(tolerance_scene(s_, r_, bands_, scale_));
    plots();
    facts();
    warnings();
    headline();
    return std::move(result_);
  }

 private:
  std::size_t quantities() const { return r_.quantities.size(); }
  std::size_t rows() const { return r_.samples(); }
  double range(std::size_t k) const { return tolerance_range(s_, k); }
  Sentence where(std::size_t row) const { return tolerance_place(s_, r_, row); }
  double worst(std::size_t q) const { return r_.worst(q); }
  // Error that a share of the random linkages keeps to at every sample; infinite when too many do not
  // assemble everywhere.
  double quantile(std::size_t q, double share) const {
    const auto n = at(r_.random.draws);
    if (n == 0) return nan;
    std::vector<double> all;
    for (std::size_t d = 0; d < n; ++d)
      all.push_back(r_.random.missed[d] > 0 ? infinity : r_.random.largest[d * quantities() + q]);
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(n))) - 1;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rank), all.end());
    return all[rank];
  }

  void status() {
    result_.status = r_.random.status;
    for (const SensitivitySample& row : r_.linear)
      if (result_.status == Status::done) result_.status = row.status;
  }

  struct Yield {
    std::size_t quantity;
    double limit;
    Share share;
  };
  void yield() {
    if (r_.random.draws == 0) return;
    for (std::size_t q = 0; q < quantities(); ++q) {
      if (std::isnan(s_.limits[q])) continue;
      int within = 0;
      for (std::size_t d = 0; d < at(r_.random.draws); ++d)
        within += r_.random.missed[d] == 0 && r_.random.largest[d * quantities() + q] <= s_.limits[q];
      yields_.push_back({q, s_.limits[q], share_of(within, r_.random.draws)});
      const std::string& key = r_.quantities[q].key;
      result_.statistics[key + "_yield"] = yields_.back().share.value;
      result_.statistics[key + "_yield_least"] = yields_.back().share.lower;
      result_.statistics[key + "_yield_most"] = yields_.back().share.upper;
    }
  }

  // ---- plots
  // --------------------------------------------------------------------------------------------------

  using Style = study::Plot::Style;
  study::AddPlot over_input(std::string table) {
    const bool linked =
        std::holds_alternative<study::TimeSamples>(s_.motion.sweep) || s_.motion.plan.inputs() == 1;
    return {result_,
            {.table = std::move(table),
             .x = tolerance_input_key(s_),
             .style = linked ? Style::line : Style::points,
             .scene = linked ? "motion" : ""}};
  }
  void plots() {
    std::vector<std::string> paths;
    for (std::size_t p = 0; p < bands_.size(); ++p)
      for (const char* end : {"_x_m", "_y_m", "_left_x_m", "_left_y_m", "_right_x_m", "_right_y_m"})
        paths.push_back(r_.quantities[p].key + end);
    over_input("band")("paths", fmt::format("Paths and their tolerance bands, drawn {:g} x", scale_), paths,
                       Style::polar);
    for (std::size_t q = 0; q < std::min(quantities(), max_told); ++q) {
      const ToleranceQuantity& quantity = r_.quantities[q];
      if (!quantity.any) continue;
      const std::string unit = unit_key(quantity.kind);
      std::vector<std::string> y;
      for (const char* key : {"_worst_", "_across_", "_drawn_", "_rms_"})
        y.push_back(quantity.key + key + unit);
      over_input("errors")("error-" + quantity.key, "Error of " + quantity.name, y);
      std::vector<std::string> parts;
      for (const std::size_t k : r_.by_share(q))
        if (parts.size() < max_curves) parts.push_back(identifier(r_.tolerances[k]) + "_" + unit);
      over_input("contributions_" + quantity.key)("contributions-" + quantity.key,
                                                  "Contributions to the worst-case error of " + quantity.name,
                                                  parts);
      // The diagram is drawn where a band can be seen around its curve.
      if ((quantity.kind == Kind::force || quantity.kind == Kind::torque) &&
          worst(q) > 0.02 * largest_value(q))
        for (const char* axis : {"", "_x", "_y"}) {
          const std::string key = quantity.key + axis;
          study::AddPlot plot = over_input("values");
          plot.like.bands = {{key + "_lower_" + unit, key + "_upper_" + unit, "worst case"}};
          plot("value-" + key, quantity.name + (*axis ? std::string(" along ") + axis[1] : ""),
               {key + "_" + unit});
        }
      study::AddPlot{result_, {.table = "draws", .style = Style::histogram}}(
          "draws-" + quantity.key,
          fmt::format("{} random linkages by the largest error of {}", r_.random.draws, quantity.name),
          {quantity.key + "_" + unit});
    }
  }

  // ---- facts
  // --------------------------------------------------------------------------------------------------

  using Verdict = study::Fact::Verdict;
  void facts() {
    result_.statistics["draws"] = r_.random.draws;
    result_.statistics["seed"] = s_.seed;
    for (std::size_t q = 0; q < quantities(); ++q) {
      const ToleranceQuantity& quantity = r_.quantities[q];
      if (!quantity.any) continue;
      const std::string unit = unit_key(quantity.kind);
      result_.statistics[quantity.key + "_worst_" + unit] = worst(q);
      if (std::isfinite(nearly_[q])) result_.statistics[quantity.key + "_99_percent_" + unit] = nearly_[q];
      if (q >= max_told) continue;
      Sentence text = say("at most {} at {}", shown(quantity.kind, worst(q)), where(quantity.worst_row));
      if (quantity.kind == Kind::point)
        text +=
            say(", at most {} across its path", shown(quantity.kind, study::largest_size(bands_[q].across)));
      if (quantity.kind == Kind::force || quantity.kind == Kind::torque)
        if (const double size = largest_value(q); size > 0)
          text += say(", {} of the largest there is, {}", percent(worst(q) / size, 2),
                      shown(quantity.kind, size));
      if (std::isfinite(nearly_[q]))
        text += say("; {} of the random linkages stay within {}", percent(nearly_all, 6),
                    shown(quantity.kind, nearly_[q]));
      fact("error of " + quantity.name, text);
      if (worst(q) > 0) tighten(q);
    }
    for (const Yield& y : yields_) {
      const ToleranceQuantity& quantity = r_.quantities[y.quantity];
      const double largest = worst(y.quantity);
      Sentence text = say("{} of the random linkages ({} to {} with {} confidence)", percent(y.share.value),
                          percent(y.share.lower, 3).sharing_unit(), percent(y.share.upper, 3), percent(0.95));
      const bool always = largest <= y.limit;
      if (always)
        text += "; the worst case does, too";
      else if (quantity.any)
        text += say("; with all tolerances {} times as large the worst case would, too",
                    plain_number(std::floor(100 * y.limit / largest) / 100, 2));
      fact(say("{} within {}", quantity.name, shown(quantity.kind, y.limit)), text,
           always ? Verdict::good : Verdict::plain);
    }
    if (std::isfinite(r_.transmission))
      fact("minimum transmission angle",
           say("{} of {} at {}", degrees_of(r_.transmission).fixed(1), r_.transmission_group,
               where(r_.transmission_row)),
           r_.transmission < poor_transmission ? Verdict::bad : Verdict::plain);
  }

  // The largest size of a quantity without errors.
  double largest_value(std::size_t q) const {
    const ToleranceQuantity& quantity = r_.quantities[q];
    double out = 0;
    for (const SensitivitySample& row : r_.linear) {
      const double first = row.values[quantity.first],
                   size = quantity.size == 2 ? std::hypot(first, row.values[quantity.first + 1])
                                             : std::abs(first);
      if (size > out) out = size;
    }
    return out;
  }
  // The few that make most of the worst case, and what the first of them is worth.
  void tighten(std::size_t q) {
    const ToleranceQuantity& quantity = r_.quantities[q];
    const std::size_t row = quantity.worst_row;
    Sentence text;
    std::size_t told = 0;
    const std::vector<std::size_t> order = r_.by_share(q);
    for (const std::size_t k : order) {
      const double part = r_.contribution(row, q, k) / worst(q);
      if (told == 4 || part < 0.005) break;
      text += say("{}{} ({}{})", told ? ", " : "", r_.tolerances[k], percent(part).fixed(0),
                  told ? "" : " of the worst case");
      ++told;
    }
    const double less = range(order[0]) / 10;
    text += say("; {} less for {} takes off {}", millimetres(less, 3), r_.tolerances[order[0]],
                shown(quantity.kind, r_.contribution(row, q, order[0]) / 10));
    fact("tighten first for " + quantity.name, text);
  }

  void warnings() {
    const auto told = [&](auto&& bad, std::string_view what, std::string hint) {
      std::size_t count = 0, first = 0;
      for (std::size_t row = rows(); row-- > 0;)
        if (bad(r_.linear[row].status)) ++count, first = row;
      if (count > 0)
        warn(say("{} of {} positions, the first at {}, {}", count, rows(), where(first), what),
             std::move(hint));
    };
    told([](Status s) { return s != Status::done && s != Status::infeasible; },
         "have no answer: the linkage does not assemble there or is at a dead point",
         "sweep over a range where it moves; the analysis of planar.linkage reports that range");
    told([](Status s) { return s == Status::infeasible; },
         "are at the end of the motion: linkages with the least errors do not assemble there",
         "end the sweep before them");
    if (r_.transmission < poor_transmission)
      warn(say("the transmission angle of {} falls to {} at {}: near a dead point errors grow without bound",
               r_.transmission_group, degrees_of(r_.transmission).fixed(2), where(r_.transmission_row)));
    if (r_.random.draws < s_.draws)
      warn(fmt::format("only {} of {} random linkages were drawn ({})", r_.random.draws, s_.draws,
                       to_string(r_.random.status)));
    const auto apart =
        std::count_if(r_.random.missed.begin(), r_.random.missed.end(), [](int m) { return m > 0; });
    if (apart > 0) {
      std::size_t least = 0;
      for (std::size_t row = 0; row < rows(); ++row)
        if (r_.linear[row].status != Status::no_assembly &&
            (r_.linear[least].status == Status::no_assembly ||
             r_.random.samples[row].assembled < r_.random.samples[least].assembled))
          least = row;
      warn(say("{} of {} random linkages do not assemble everywhere; at {} {} of them do not", apart,
               r_.random.draws, where(least), r_.random.draws - r_.random.samples[least].assembled),
           "they count as beyond every limit; all other figures of random linkages are about the rest");
    }
    for (std::size_t q = 0; q < quantities(); ++q) linearity(q);
  }
  // Root mean square of the random linkages beside that of the first order.
  void linearity(std::size_t q) {
    const ToleranceQuantity& quantity = r_.quantities[q];
    if (!quantity.any || r_.random.draws < 2) return;
    double largest = 0;
    for (std::size_t row = 0; row < rows(); ++row)
      if (r_.linear[row].status == Status::done) largest = std::max(largest, r_.root_mean_square(row, q));
    std::size_t count = 0, farthest = 0;
    double most = 0;
    for (std::size_t row = 0; row < rows(); ++row) {
      const MonteCarloSample& m = r_.random.samples[row];
      const double linear = r_.root_mean_square(row, q);
      // Rows where the first order hardly deviates are left out: there the second one is all there is, and
      // small.
      if (r_.linear[row].status != Status::done || m.assembled < 2 || linear < 0.05 * largest) continue;
      double squares = 0;
      for (std::size_t i = quantity.first; i < quantity.first + quantity.size; ++i)
        squares += std::pow(m.deviation[i], 2) + std::pow(m.mean[i] - r_.linear[row].values[i], 2);
      const double off = std::abs(std::sqrt(squares) / linear - 1);
      if (off <= poor_linearity + 4 / std::sqrt(2.0 * m.assembled)) continue;
      ++count;
      if (off > most) most = off, farthest = row;
    }
    if (count > 0)
      warn(say("{}: the errors of the random linkages differ from the linear theory at {} of {} positions, "
               "by {} (root mean square) at {}",
               quantity.name, count, rows(), percent(most).fixed(0), where(farthest)),
           "take the random linkages there; worst case and budget are of the linear theory");
  }

  void headline() {
    const ToleranceQuantity& main = r_.quantities[0];
    if (!main.any) {
      result_.headline =
          "No position of the sweep has an answer: the linkage does not assemble or is at "
          "dead points.";
      return;
    }
    std::string name = main.name;
    if (name[0] >= 'a' && name[0] <= 'z' && main.kind != Kind::point)
      name[0] = static_cast<char>(name[0] - 'a' + 'A');
    Sentence& text = result_.headline;
    text = say("{} deviates by at most {} (worst case, at {})", name, shown(main.kind, worst(0)),
               where(main.worst_row));
    if (std::isfinite(nearly_[0]))
      text += say("; {} of {} random linkages stay within {}", percent(nearly_all, 6), r_.random.draws,
                  shown(main.kind, nearly_[0]));
    if (worst(0) > 0) {
      const std::size_t first = r_.by_share(0)[0];
      text +=
          say("; {} of the worst case comes from {}",
              percent(r_.contribution(main.worst_row, 0, first) / worst(0)).fixed(0), r_.tolerances[first]);
    }
    text += ".";
    for (const Yield& y : yields_)
      text += say(" {} keep {} within {}.", percent(y.share.value, 3), r_.quantities[y.quantity].name,
                  shown(r_.quantities[y.quantity].kind, y.limit));
  }

  const ToleranceStudy& s_;
  ToleranceRecording r_;
  std::vector<PathBand> bands_;
  std::vector<double> nearly_;  ///< one a quantity
  std::vector<Yield> yields_;
  double scale_ = 1;
  study::Result result_;
  const study::AddFact fact{result_.facts};
  const study::AddWarning warn{result_.diagnostics};
};

}  // namespace

study::Result report_tolerances(const ToleranceStudy& study, ToleranceRecording recording) {
  return ToleranceReporter(study, std::move(recording)).report();
}

}  // namespace linkwright::clearance
