// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/spectrum.h"
#include "linkwright/planar/studies/elastic.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// Share of the length of a beam: a larger deflection makes the straight theory of its bending wrong by some
// per cent.
constexpr double far_bent = 0.1;
// Explicit steps of a fast vibration: at least so many a period.
constexpr double steps_a_period = 2;

double hertz(double frequency) { return frequency / (2 * pi); }

std::string_view in_words(math::OdeMethod method) {
  switch (method) {
    case math::OdeMethod::explicit_runge_kutta_5:
      return "Runge-Kutta of order 5";
    case math::OdeMethod::explicit_runge_kutta_8:
      return "Runge-Kutta of order 8";
    case math::OdeMethod::adams:
      return "Adams-Moulton";
    case math::OdeMethod::bdf:
      return "backward differentiation";
  }
  return {};
}

class ElasticReporter {
 public:
  ElasticReporter(const LinkageSimulationStudy& s, const ElasticRecording& r) : s_(s), r_(r) {}

  study::Result run() {
    if (r_.elastic.status != Status::done) {
      result_.status = r_.elastic.status;
      const Sentence why =
          r_.rigid_message.empty() ? Sentence(to_string(r_.elastic.status)) : r_.rigid_message;
      result_.headline = say("The linkage does not start: {}.", why);
      warn(why);
      return std::move(result_);
    }
    result_.status = r_.report.status;
    result_.tables = {r_.motion, r_.rigid};
    add_spectrum();
    result_.scenes.push_back(elastic_scene(s_.linkage, s_.plan, r_.elastic.pieces, scene_records(), s_.traces,
                                           s_.deflection_scale));
    plots();
    facts();
    headline();
    return std::move(result_);
  }

 private:
  const std::string& name_of_beam(const ElasticPieces& p) const {
    return s_.linkage.bodies[at(p.beam.body)].name;
  }
  std::string beam_key(std::size_t e) const { return identifier(name_of_beam(r_.elastic.pieces[e])); }
  bool is_free(std::size_t k) const { return !s_.drives[k].law; }

  void add_spectrum() {
    const double step = (s_.to - s_.from) / (s_.samples - 1);
    Table table{.name = "spectrum"};
    for (std::size_t e = 0; e < r_.beams.size(); ++e) {
      math::Spectrum lines = math::spectrum(r_.beams[e].middle, step);
      if (lines.frequency.empty()) return;
      if (e == 0) table.add("frequency_Hz", "frequency (Hz)", std::move(lines.frequency));
      table.add(beam_key(e) + "_middle_deflection_m", name_of_beam(r_.elastic.pieces[e]) + " amplitude (m)",
                std::move(lines.amplitude));
    }
    result_.tables.push_back(std::move(table));
  }

  std::vector<ElasticRecord> scene_records() const {
    const std::size_t most = std::max<std::size_t>(2, at(s_.scene_samples)),
                      stride = std::max<std::size_t>(1, (r_.records.size() + most - 2) / (most - 1));
    std::vector<ElasticRecord> out;
    for (std::size_t i = 0; i < r_.records.size(); i += stride) out.push_back(r_.records[i]);
    return out;
  }

  void plots() {
    const study::AddPlot plot{result_, {.table = "motion", .x = "time_s", .scene = "motion"}},
        beside_rigid{result_, {.table = "motion", .x = "time_s", .scene = "motion", .baseline = "rigid"}},
        spectrum{result_, {.table = "spectrum", .x = "frequency_Hz", .logarithmic_y = true}};
    for (std::size_t e = 0; e < r_.beams.size(); ++e) {
      const std::string key = beam_key(e), &name = name_of_beam(r_.elastic.pieces[e]);
      plot(key + "-deflection", "Deflection of " + name + ", middle and largest",
           {key + "_middle_deflection_m", key + "_largest_deflection_m"});
      plot(key + "-stress", "Stress of " + name + " at its worst section",
           {key + "_stress_Pa", key + "_bending_stress_Pa"});
      spectrum(key + "-spectrum", "Spectrum of the deflection of " + name, {key + "_middle_deflection_m"});
    }
    for (const auto& [of, name, title] :
         {std::tuple{OutputError::Of::angle, "angle-error", "Angle against the rigid linkage"},
          std::tuple{OutputError::Of::displacement, "displacement-error",
                     "Displacement against the rigid linkage"},
          std::tuple{OutputError::Of::path, "path-error", "Distance from the rigid path"}}) {
      std::vector<std::string> keys;
      for (const OutputError& e : r_.errors)
        if (e.of == of && keys.size() < 8) keys.push_back(e.key);
      plot(name, title, keys);
    }
    const Linkage& l = s_.linkage;
    std::vector<std::string> torques, drive_forces, sizes;
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k) {
      const std::string key = identifier(input_joint(l, k).name);
      if (!is_free(k))
        (s_.plan.rotary[k] ? torques : drive_forces)
            .push_back(key + (s_.plan.rotary[k] ? "_drive_torque_N_m" : "_drive_force_N"));
    }
    beside_rigid("torque", "Drive torque, pale: rigid linkage", torques);
    beside_rigid("drive-force", "Drive force, pale: rigid linkage", drive_forces);
    for (const LinkageJoint& j : l.joints)
      if (!has_teeth(j.type) && sizes.size() < 6) sizes.push_back(identifier(j.name) + "_N");
    beside_rigid("reactions", "Joint forces, pale: rigid linkage", sizes);
    plot("energies", "Energies", {"kinetic_energy_J", "potential_energy_J", "work_J"});
    plot("energy-audit", "Energy audit: imbalance", {"energy_drift_J"});
  }

  // Largest size in a column that a table may have; NaN when there is none.
  static double largest(const Column* c) { return c ? std::abs(study::largest(c->values).value) : nan; }
  Sentence place_text(const ElasticPieces& p, double place) const {
    const auto& points = s_.linkage.bodies[at(p.beam.body)].points;
    return say("{} from {}", at_place("distance", millimetres(place)), points[at(p.beam.from)].name);
  }
  Measured time_of(std::size_t row) const { return at_place("time", seconds(r_.times[row])); }
  static Measured size_of(const OutputError& e, double value) {
    return study::angle_or_length(value, e.of == OutputError::Of::angle, 3);
  }

  void facts() {
    result_.statistics = Value::object();
    for (std::size_t e = 0; e < r_.beams.size(); ++e) beam_facts(e);
    for (std::size_t i = 0; i < r_.errors.size(); ++i)
      if (const study::Extreme most = study::largest(r_.errors[i].values); most.any())
        fact("largest " + r_.errors[i].label.substr(0, r_.errors[i].label.rfind(" (")),
             say("{} at {}", size_of(r_.errors[i], std::abs(most.value)), time_of(most.row)));
    against_rigid();
    integration();
  }
  void beam_facts(std::size_t e) {
    const ElasticPieces& p = r_.elastic.pieces[e];
    const std::string& name = name_of_beam(p);
    const BeamRows& v = r_.beams[e];
    const double first = first_frequency(p.beam, p.length);
    if (const study::Extreme most = study::largest(v.largest); most.any()) {
      const double share = std::abs(most.value) / p.length;
      fact(name + ": largest deflection",
           say("{} at {}", millimetres(std::abs(most.value)), time_of(most.row)));
      if (share > far_bent)
        warn(say("{} bends by {} of its length", name, plain_number(share, 3)),
             "the error of a beam theory without stretching is about the square of it");
    }
    if (const study::Extreme most = study::largest(v.stress); most.any() && p.beam.fibre_distance > 0)
      fact(name + ": largest stress",
           say("{} at {}, {}; bending alone {}", measured("MPa", most.value), time_of(most.row),
               place_text(p, v.place[most.row]),
               measured("MPa", *std::max_element(v.bending.begin(), v.bending.end()))));
    fact(name + ": first frequency on two pins",
         say("{}{}; {} segments", measured("Hz", hertz(first)),
             r_.largest_rate > 0
                 ? say(", {} times the largest input speed", plain_number(first / r_.largest_rate, 3))
                 : Sentence(),
             p.beam.segments));
    result_.statistics[identifier(name) + "_first_frequency_Hz"] = hertz(first);
    if (const int n = p.beam.segments; too_few_segments(n)) {
      const SegmentErrors missed = segment_errors(n), better = segment_errors(enough_segments());
      warn(say("{} segment{} of {}: bending moment and stress are up to {} too low, as the springs miss the "
               "worst section, and the first frequency is {} too low",
               n, n == 1 ? "" : "s", name, percent(missed.moment, 3), percent(missed.frequency, 3)),
           say("segments = {} leaves {} and {}", enough_segments(), percent(better.moment, 2),
               percent(better.frequency, 2)));
    }
    const double nyquist = (s_.samples - 1) / (2 * (s_.to - s_.from));
    if (hertz(first) > nyquist)
      warn(say("rows are {} apart, too far to show the first vibration of {} of {}",
               seconds(0.5 / nyquist, 3), name, measured("Hz", hertz(first))),
           say("simulation.samples = {} shows it",
               static_cast<long>(std::ceil(8 * hertz(first) * (s_.to - s_.from))) + 1));
  }
  void against_rigid() {
    const Table &motion = result_.tables[0], &rigid = result_.tables[1];
    double most = 0;
    Sentence where;
    for (const LinkageJoint& j : s_.linkage.joints) {
      const std::string key = identifier(j.name) + "_N";
      const double bent = largest(motion.find(key)), stiff = largest(rigid.find(key));
      if (!(stiff > 0) || !(bent / stiff > most)) continue;
      most = bent / stiff;
      where = say("{} in {}, {} times {}", newtons(bent), j.name, plain_number(most), newtons(stiff));
    }
    if (most > 0) fact("joint force that grew most over the rigid linkage", where);
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k) {
      const std::string& joint = input_joint(s_.linkage, k).name;
      const std::string key =
          identifier(joint) + (s_.plan.rotary[k] ? "_drive_torque_N_m" : "_drive_force_N");
      const double bent = largest(motion.find(key)), stiff = largest(rigid.find(key));
      const bool rotary = s_.plan.rotary[k];
      if (std::isfinite(bent))
        fact(fmt::format("largest drive {} at {}", rotary ? "torque" : "force", joint),
             say("{}, of the rigid linkage {}", study::torque_or_force(bent, rotary, 4),
                 study::torque_or_force(stiff, rotary, 4)));
    }
  }
  double fastest() const {
    double out = 0;
    for (const ElasticPieces& p : r_.elastic.pieces) out = std::max(out, highest_frequency(p.beam, p.length));
    return out;
  }
  void integration() {
    using Verdict = study::Fact::Verdict;
    const study::EnergyBalance balance{r_.report.largest_drift, r_.report.peak_energy};
    result_.statistics["energy_drift_share"] = balance.share();
    if (!r_.times.empty())
      fact("energy balance", balance.text(), balance.poor() ? Verdict::bad : Verdict::good);
    if (balance.poor()) warn("the energies do not balance: " + balance.text(), "take a smaller rtol");
    if (s_.settle > 0) fact("settled", say("{} before the first row", seconds(s_.settle)));
    fact("integration", say("{}{}; {} steps, {} evaluations", in_words(s_.options.method),
                            s_.method_reason.empty() ? ", as the study says" : ", as " + s_.method_reason,
                            r_.report.steps, r_.report.evaluations));
    if (r_.report.status == Status::done) return;
    Sentence hint;
    if (r_.report.status == Status::not_converged) {
      const double needed = steps_a_period * hertz(fastest()) * (s_.to - s_.from + s_.settle);
      hint =
          say("the fastest vibration of the pieces has {}, which explicit steps must follow: about {} steps; "
              "take "
              "fewer segments, more max_steps, or stiffness_damping with method = \"bdf\"",
              measured("Hz", hertz(fastest()), 3), plain_number(needed, 2));
    }
    warn(r_.report.message, hint);
  }

  void headline() {
    if (r_.times.empty()) {
      result_.headline = "The linkage does not start: " + r_.report.message + ".";
      return;
    }
    Sentence text;
    for (std::size_t e = 0; e < r_.beams.size(); ++e) {
      const ElasticPieces& p = r_.elastic.pieces[e];
      const study::Extreme bent = study::largest(r_.beams[e].largest),
                           stressed = study::largest(r_.beams[e].stress);
      if (!bent.any()) continue;
      std::string name = name_of_beam(p);
      if (text.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
      text +=
          say("{}{} bends by up to {}", text.empty() ? "" : "; ", name, millimetres(std::abs(bent.value), 3));
      if (p.beam.fibre_distance > 0 && stressed.any())
        text += say(" and bears up to {} {}", measured("MPa", stressed.value, 3),
                    place_text(p, r_.beams[e].place[stressed.row]));
    }
    for (std::size_t i = 0; i < r_.errors.size(); ++i)
      if (const study::Extreme most = study::largest(r_.errors[i].values); most.any()) {
        text += say("; {} up to {}", r_.errors[i].label.substr(0, r_.errors[i].label.rfind(" (")),
                    size_of(r_.errors[i], std::abs(most.value)));
        break;
      }
    result_.headline = text + ".";
    if (r_.report.status != Status::done)
      result_.headline += say(" It ends at {}, before {}: {}.", seconds(r_.times.back()), seconds(s_.to),
                              to_string(r_.report.status));
  }

  const LinkageSimulationStudy& s_;
  const ElasticRecording& r_;
  study::Result result_;
  const study::AddFact fact{result_.facts};
  const study::AddWarning warn{result_.diagnostics};
};

}  // namespace

study::Result report_elastic_simulation(const LinkageSimulationStudy& study,
                                        const ElasticRecording& recording) {
  return ElasticReporter(study, recording).run();
}

}  // namespace linkwright::planar
