// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/flexible/continuum.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/statics.h"
#include "linkwright/flexible/studies/chain.h"
#include "linkwright/flexible/studies/vibration.h"
#include "linkwright/math/zero.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::flexible {
namespace {

/// Share of a frequency by which twice the divisions, or the continuum, may change it before it is reported.
constexpr double poor_frequency = 0.01;

Measured hertz(double rate) { return measured("Hz", rate / full_turn); }

class Analyst {
 public:
  Analyst(const VibrationStudy& s, RunContext& context)
      : s_(s),
        context_(context),
        chain_(discretise(s.mechanism.beam, s.vibration.divisions, s.vibration.kinematics)) {}

  study::Result analyse() {
    frequencies();
    shapes();
    if (s_.campbell) campbell_diagram();
    if (s_.load || s_.mechanism.beam.gravity > 0) deflection(s_.load.value_or(LoadForm{}));
    remarks();
    headline();
    return std::move(result_);
  }

 private:
  using Verdict = study::Fact::Verdict;
  const Beam& beam() const { return s_.mechanism.beam; }
  int count() const { return s_.vibration.modes; }
  Hub hub() const { return s_.vibration.hub; }
  std::string hint_for_cells() const {
    return s_.vibration.kinematics == Kinematics::chord_consistent
               ? "take more divisions"
               : "take kinematics = \"chord_consistent\", or more divisions";
  }

  // ---- at rest
  // ------------------------------------------------------------------------------------------------

  // Frequencies of the continuum, as many as the chain: bending, with the link's stretching, and 0 for a hub
  // that turns freely.
  std::vector<double> of_continuum() const {
    std::vector<double> out;
    if (found_.front().frequency == 0) out.push_back(0);
    const auto bending = continuum_frequencies(beam(), count(), hub());
    out.insert(out.end(), bending.begin(), bending.end());
    if (beam().extensible) {
      const auto axial = axial_frequencies(beam(), count());
      out.insert(out.end(), axial.begin(), axial.end());
    }
    std::sort(out.begin(), out.end());
    out.resize(found_.size());
    return out;
  }

  void frequencies() {
    found_ = modes(chain_, count(), {.hub = hub()});
    const auto finer = modes(discretise(beam(), 2 * s_.vibration.divisions, s_.vibration.kinematics), count(),
                             {.hub = hub()});
    const std::vector<double> exact = of_continuum();
    Table table{.name = "frequencies"};
    std::vector<double> number, rate, twice, continuum, by_twice, by_continuum;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const double w = found_[k].frequency;
      number.push_back(static_cast<double>(k + 1));
      rate.push_back(w);
      twice.push_back(finer[k].frequency);
      continuum.push_back(exact[k]);
      by_twice.push_back(w > 0 ? finer[k].frequency / w - 1 : 0);
      by_continuum.push_back(w > 0 && exact[k] > 0 ? w / exact[k] - 1 : 0);
    }
    fact("frequencies at rest", in_hertz(rate));
    fact("against the continuum",
         say("within {}; {} is what {} divisions change", percent(study::largest_size(by_continuum), 2),
             percent(study::largest_size(by_twice), 2), 2 * s_.vibration.divisions),
         study::largest_size(by_continuum) > poor_frequency ? Verdict::bad : Verdict::good);
    if (study::largest_size(by_continuum) > poor_frequency)
      for (std::size_t k = 0; k < found_.size(); ++k)
        if (std::abs(by_continuum[k]) > poor_frequency) {
          warn("vibration.divisions",
               say("mode {} is {} off the continuum, {} against {}", k + 1, percent(by_continuum[k], 2),
                   hertz(rate[k]), hertz(continuum[k])),
               "take more divisions");
          break;
        }
    const auto column = [](std::vector<double> v) {
      for (double& x : v) x /= full_turn;
      return v;
    };
    table.add("mode", "mode", number);
    table.add("frequency_Hz", "frequency (Hz)", column(rate));
    table.add("finer_Hz", fmt::format("with {} divisions (Hz)", 2 * s_.vibration.divisions), column(twice));
    table.add("continuum_Hz", "continuum (Hz)", column(continuum));
    table.add("frequency_rad_per_s", "frequency (rad/s)", std::move(rate));
    table.add("finer_change", "change by twice the divisions, relative", std::move(by_twice));
    table.add("continuum_error", "error against the continuum, relative", std::move(by_continuum));
    result_.tables.push_back(std::move(table));
  }

  void shapes() {
    const std::size_t nodes = chain_.cells.size() + 1;
    Table table{.name = "shapes"};
    std::vector<double> position{0};
    for (const Cell& cell : chain_.cells) position.push_back(position.back() + cell.length);
    table.add("position_m", "along the link (m)", position);
    std::vector<std::string> eta;
    std::vector<double> hub_angle;
    for (int k = 1; k <= count(); ++k) {
      const ModeShape found = mode_shape(chain_, k, {.hub = hub()});
      hub_angle.push_back(found.hub_angle);
      // Along the link, and rigid: nothing of it is across the link.
      const bool bends = std::any_of(found.link.eta.begin(), found.link.eta.end(),
                                     [](double e) { return std::abs(e) > 0.5 && std::abs(e) <= 1.5; });
      if (bends) eta.push_back(fmt::format("mode_{}_eta_m", k));
      table.add(fmt::format("mode_{}_eta_m", k), fmt::format("mode {} across the link (m)", k),
                found.link.eta);
      table.add(fmt::format("mode_{}_angle_rad", k), fmt::format("mode {} angle (rad)", k), found.link.angle);
      result_.scenes.push_back(scene_of(k, found, position, nodes));
    }
    result_.tables.push_back(std::move(table));
    if (hub() == Hub::free) result_.tables.front().add("hub_angle_rad", "turn of the hub (rad)", hub_angle);
    study::AddPlot{result_, {.table = "shapes", .x = "position_m"}}(
        "shapes", "Shapes of the modes, in axes of the hub", eta);
  }

  // One period of a mode, the largest deflection a seventh of the link.
  study::Scene scene_of(int k, const ModeShape& mode, const std::vector<double>& position,
                        std::size_t nodes) const {
    constexpr int samples = 73;
    study::Scene scene;
    scene.name = fmt::format("mode-{}", k);
    const double w = found_[static_cast<std::size_t>(k) - 1].frequency;
    scene.title = w > 0 ? say("mode {}, {}", k, hertz(w)) : say("mode {}: turns freely", k);
    scene.input_key = "phase_rad";
    scene.input_label = "phase";
    double reach = std::abs(mode.hub_angle) * (beam().hub_radius + beam().length);
    for (const double e : mode.link.eta) reach = std::max(reach, std::abs(e));
    const double scale = beam().length / 7 / std::max(reach, 1e-9);
    std::vector<study::Scene::Point> link(nodes);
    for (int i = 0; i < samples; ++i) {
      const double phase = full_turn * i / (samples - 1), by = scale * std::cos(phase);
      scene.input.push_back(phase);
      const double c = std::cos(by * mode.hub_angle), s = std::sin(by * mode.hub_angle);
      for (std::size_t j = 0; j < nodes; ++j) {
        const double x = beam().hub_radius + position[j], y = by * mode.link.eta[j];
        link[j].x.push_back(c * x - s * y);
        link[j].y.push_back(s * x + c * y);
      }
    }
    scene.points.push_back({"O", {0}, {0}});
    link.front().name = "weld";
    link.back().name = "tip";
    for (auto& p : link) scene.points.push_back(std::move(p));
    scene.points.push_back({"", {beam().hub_radius + beam().length}, {0}});
    for (std::size_t j = 0; j < nodes; ++j)
      if (j > 0 || beam().hub_radius > 0)
        scene.bodies.push_back({j == 0 ? "hub" : "link",
                                {static_cast<int>(j), static_cast<int>(j) + 1},
                                study::Scene::BodyStyle::bar});
    scene.bodies.push_back({"link at rest", {0, static_cast<int>(nodes) + 1}, study::Scene::BodyStyle::axis});
    scene.joints = {{"O", 0, study::Scene::JointStyle::ground_pivot},
                    {"tip", static_cast<int>(nodes), study::Scene::JointStyle::tracer}};
    return scene;
  }

  // ---- turning
  // ------------------------------------------------------------------------------------------------

  // True if the straight link turns steadily at a speed and is stable.
  bool steady(double speed) const {
    if (beam().extensible && speed != 0) {
      const Equilibrium stretched = equilibrium(chain_, {}, {.speed = speed});
      return stretched.status == Status::done && stretched.unstable == 0;
    }
    return modes_below(chain_, -1e-9 * std::pow(beam().frequency_scale(), 2),
                       {.speed = speed, .hub = hub()}) == 0;
  }
  double frequency(int mode, double speed) const {
    return modes(chain_, mode, {.speed = speed, .hub = hub()}).back().frequency;
  }

  void campbell_diagram() {
    const CampbellForm& c = *s_.campbell;
    std::vector<double> speeds;
    for (int i = 0; i < c.samples; ++i) speeds.push_back(c.from + (c.to - c.from) * i / (c.samples - 1));
    const auto bad = std::find_if(speeds.begin(), speeds.end(), [&](double speed) { return !steady(speed); });
    if (bad != speeds.end()) {
      lost_ = math::bisect([&](double speed) { return steady(speed); },
                           bad == speeds.begin() ? 0 : *(bad - 1), *bad, {.relative = 1e-9})
                  .outside;
      fact("loses stability",
           say("at {}, below the {} that are asked for", measured("rad_per_s", lost_, 5),
               measured("rad_per_s", c.to, 5)),
           Verdict::bad);
      warn("campbell.to",
           fmt::format(
               "the straight chain loses its stability at {:.5g} rad/s: real links do not, its {} cells are "
               "too long for the speed",
               lost_, chain_.cells.size()),
           hint_for_cells());
      result_.status = Status::singular;
      // A chain that stretches has no frequencies beyond it; the others continue with the modes that vibrate.
      if (beam().extensible) speeds.erase(bad, speeds.end());
    }
    if (speeds.empty()) return;
    Table table = campbell(chain_, speeds, count(), hub());
    std::vector<std::string> y;
    for (int k = 1; k <= count(); ++k) y.push_back(fmt::format("mode_{}_rad_per_s", k));
    for (const double order : c.orders) {
      std::vector<double> line;
      for (const double speed : speeds) line.push_back(order * speed);
      std::string name = fmt::format("{:g}", order);
      std::replace(name.begin(), name.end(), '.', '_');
      y.push_back(fmt::format("order_{}_rad_per_s", name));
      table.add(y.back(), fmt::format("{:g} x the speed (rad/s)", order), std::move(line));
    }
    result_.plots.push_back({.name = "campbell",
                             .title = "Campbell diagram: frequencies over the speed of the hub",
                             .table = "campbell",
                             .x = "speed_rad_per_s",
                             .y = y});
    for (int k = 1; k <= count(); ++k) {
      const auto& values = table.columns[static_cast<std::size_t>(k)].values;
      if (k == 1 && !std::isnan(values.back())) last_ = values.back();
    }
    crossings(table, speeds);
    result_.tables.push_back(std::move(table));
  }

  void crossings(const Table& table, const std::vector<double>& speeds) {
    if (s_.campbell->orders.empty()) return;
    Table out{.name = "crossings"};
    std::vector<double> order, mode, speed, rate;
    Sentence text;
    for (const double p : s_.campbell->orders)
      for (int k = 1; k <= count(); ++k) {
        if (context_.interrupted()) break;
        const auto& values = table.columns[static_cast<std::size_t>(k)].values;
        for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
          const double before = values[i] - p * speeds[i], after = values[i + 1] - p * speeds[i + 1];
          // At rest the rotation of a free hub meets every line.
          if (!(before * after <= 0) || after == 0 || values[i + 1] == 0) continue;
          const double at = before == 0
                                ? speeds[i]
                                : math::zero_between([&](double w) { return frequency(k, w) - p * w; },
                                                     speeds[i], speeds[i + 1]);
          order.push_back(p);
          mode.push_back(k);
          speed.push_back(at);
          rate.push_back(p * at);
          text += say("{}{} (mode {} by {} x)", text.empty() ? "" : ", ", measured("rad_per_s", at), k,
                      plain_number(p, 6));
        }
      }
    if (context_.interrupted()) result_.status = context_.interruption();
    crossed_ = text;
    fact("resonant speeds", text.empty() ? "none" : text, text.empty() ? Verdict::good : Verdict::bad);
    out.add("order", "multiple of the speed", std::move(order));
    out.add("mode", "mode", std::move(mode));
    out.add("speed_rad_per_s", "speed of the hub (rad/s)", std::move(speed));
    out.add("frequency_rad_per_s", "frequency (rad/s)", std::move(rate));
    result_.tables.push_back(std::move(out));
  }

  // ---- under load
  // ------------------------------------------------------------------------------------------------

  void deflection(const LoadForm& form) {
    const TipLoad load{{form.force[0], form.force[1]}, form.couple};
    const EquilibriumOptions options{.angle = form.angle, .speed = form.speed};
    const Equilibrium found = equilibrium(chain_, load, options);
    const ChainShape line = shape(chain_, found.state.q);
    const Deflection linear = linear_deflection(chain_, load);
    Table table{.name = "deflection"};
    std::vector<double> position{0}, along, across;
    for (const Cell& cell : chain_.cells) position.push_back(position.back() + cell.length);
    for (std::size_t j = 0; j < position.size(); ++j) {
      along.push_back(line.node[j].x - beam().hub_radius - position[j]);
      across.push_back(line.node[j].y);
    }
    const std::vector<std::string> status(position.size(), std::string(to_string(found.status)));
    table.add("position_m", "along the link (m)", position);
    table.add("eta_m", "across the link (m)", across);
    table.add("xi_m", "along the link, moved by (m)", along);
    table.add("angle_rad", "angle (rad)", line.angle);
    table.add("linear_eta_m", "across the link by the load at the tip, linear (m)", linear.eta);
    table.status = status;
    result_.tables.push_back(std::move(table));
    sections(found, load);
    study::AddPlot{result_, {.table = "deflection", .x = "position_m"}}(
        "deflection", "The link under its load", {"eta_m", "linear_eta_m"});
    tip_ = across.back();
    fact("tip under the load",
         say("{} across the link, {} along it, {}; linear {} across it", millimetres(across.back()),
             millimetres(along.back()), degrees_of(line.angle.back()), millimetres(linear.eta.back())));
    if (found.status == Status::done) {
      const Chain twice = discretise(beam(), 2 * s_.vibration.divisions, s_.vibration.kinematics);
      const Equilibrium finer = equilibrium(twice, load, options);
      if (finer.status == Status::done)
        fact(say("change of the tip with {} divisions", 2 * s_.vibration.divisions),
             millimetres(shape(twice, finer.state.q).node.back().y - across.back()));
    } else {
      result_.status = found.status;
      warn("load",
           fmt::format("the load could only be raised to {:.3g} % ({}); the results are for that load",
                       100 * found.share, to_string(found.status)),
           found.status == Status::singular ? "the link is about to buckle" : hint_for_cells());
    }
    if (found.unstable > 0)
      warn("load", "the link does not stay like that: it has buckled", "take a smaller load along it");
    if (const double kink = largest_kink(chain_, found.state.q); kink > kink_limit)
      warn("vibration.divisions",
           fmt::format("two bars meet at {:.2g} rad, more than {:g}: the cells are too long for "
                       "this curvature",
                       kink, kink_limit),
           "take more divisions");
  }

  void sections(const Equilibrium& found, const TipLoad& load) {
    ChainEquations equations(chain_);
    const TipLoad carried{found.share * load.force, found.share * load.couple};
    equations.evaluate(found.state, carried);
    Table table{.name = "sections"};
    std::vector<double> position, axial, shear, moment, stress;
    double largest = 0;
    for (const SectionForce& cut : equations.sections()) {
      position.push_back(cut.position);
      axial.push_back(cut.axial);
      shear.push_back(cut.shear);
      moment.push_back(cut.moment);
      largest = std::max(largest, std::abs(cut.moment));
      if (s_.mechanism.fibre_distance)
        stress.push_back(bending_stress(beam(), cut.moment, *s_.mechanism.fibre_distance));
    }
    table.add("position_m", "along the link (m)", std::move(position));
    table.add("axial_N", "tension (N)", std::move(axial));
    table.add("shear_N", "shear force (N)", std::move(shear));
    table.add("moment_N_m", "bending moment (N m)", std::move(moment));
    if (!stress.empty()) {
      table.add("bending_stress_Pa", "bending stress (Pa)", std::move(stress));
      fact("largest bending stress",
           measured("MPa", bending_stress(beam(), largest, *s_.mechanism.fibre_distance)));
    }
    result_.tables.push_back(std::move(table));
    study::AddPlot{result_, {.table = "sections", .x = "position_m"}}(
        "moment", "Bending moment along the link", {"moment_N_m"});
  }

  void remarks() {
    std::string left;
    const auto add = [&](bool there, const char* what) {
      if (there) left += fmt::format("{}{}", left.empty() ? "" : ", ", what);
    };
    add(beam().gravity > 0, "gravity");
    add(beam().mass_damping > 0 || beam().stiffness_damping > 0 || beam().hub_damping > 0, "damping");
    if (!left.empty()) fact("left out of the frequencies", left);
  }

  void headline() {
    Sentence& text = result_.headline;
    const auto first =
        std::find_if(found_.begin(), found_.end(), [](const Mode& m) { return m.frequency > 0; });
    text = first == found_.end() ? "The link has no frequency among the modes that are asked for"
                                 : say("The first frequency is {} at rest", hertz(first->frequency));
    if (s_.campbell && last_ > 0)
      text += say(" and {} at {}", hertz(last_), measured("rad_per_s", s_.campbell->to));
    text += ".";
    if (s_.campbell && !s_.campbell->orders.empty())
      text += crossed_.empty() ? " No multiple of the speed meets a frequency."
                               : say(" Resonant speeds: {}.", crossed_);
    if (lost_ > 0) text += say(" The chain loses its stability at {}.", measured("rad_per_s", lost_));
    if (!std::isnan(tip_))
      text += say(" Under the load the tip moves by {} across the link.", millimetres(std::abs(tip_)));
  }

  const VibrationStudy& s_;
  RunContext& context_;
  Chain chain_;
  std::vector<Mode> found_;
  double last_ = 0, lost_ = 0, tip_ = nan;
  Sentence crossed_;
  study::Result result_;
  const study::AddFact fact{result_.facts};
  const study::AddWarning warn{result_.diagnostics};
};

}  // namespace

study::Result run_vibration(const VibrationStudy& s, RunContext& context) {
  return Analyst(s, context).analyse();
}

}  // namespace linkwright::flexible
