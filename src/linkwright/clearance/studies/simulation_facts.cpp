// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <string_view>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/remarks.h"

namespace linkwright::clearance {
namespace {

// share of the radius of the pin: depths beyond it are outside of the law of contact
constexpr double deep_share = 0.1;
// share of the coefficient of restitution: a law with a larger error is reported
constexpr double far_restitution = 0.25;

Measured force_by_size(double force) { return force < 1e4 ? newtons(force) : measured("kN", force); }

class Facts {
 public:
  Facts(const ClearanceStudy& s, const ClearanceRecording& r, const PathErrors& errors, study::Result& result)
      : s_(s), r_(r), errors_(errors), result_(result) {}

  void add() {
    if (r_.regime) regime_facts();
    if (s_.model == PinModel::automatic) switch_fact();
    if (real())
      contact_facts();
    else
      continuous_facts();
    if (errors_.path.any())
      fact("path error",
           say("at most {} from the ideal path ({}{})", millimetres(errors_.path.value), errors_.point,
               errors_.place.any() ? say(", {} from its ideal place", millimetres(errors_.place.value))
                                   : Sentence()));
    if (rows() > 0) {
      const study::EnergyBalance balance{r_.largest_drift, r_.peak_energy};
      fact("energy balance", balance.text(), balance.poor() ? Verdict::bad : Verdict::good);
      if (balance.poor()) warn("the energies do not balance: " + balance.text(), "take a smaller rtol");
    }
    fact("integration", say("{} steps, {} evaluations of the equations of motion", r_.steps, r_.evaluations));
    if (r_.sections.size() == ClearanceRecording::max_sections)
      warn(say("of {} periods of the drives the first {} have a row in the sections",
               count_of(std::floor((r_.time - s_.from) / s_.period) + 1), r_.sections.size()),
           "a shorter simulation has a row for each of them");
    if (!r_.message.empty()) warn(r_.message, "");
  }
  void headline() {
    Sentence& text = result_.headline;
    if (rows() == 0) {
      const bool interrupted = r_.status == Status::cancelled || r_.status == Status::deadline;
      text =
          (interrupted ? "Ended before its first row: " : "The linkage does not start: ") + r_.message + ".";
      return;
    }
    if (r_.regime) text = regime_headline();
    text += motion_headline();
    if (errors_.path.any())
      text += say("; {} leaves its path by up to {}", errors_.point, millimetres(errors_.path.value));
    text += ".";
    if (r_.status != Status::done && !(r_.regime && r_.time >= s_.to()))
      text += say(" It ends at {}, before {}: {}.", seconds(r_.time, 6), seconds(s_.to(), 6),
                  to_string(r_.status));
  }

 private:
  using Verdict = study::Fact::Verdict;
  double duration() const { return r_.time - r_.from; }
  std::size_t rows() const { return r_.rows.size(); }
  const std::string& name(std::size_t pin) const { return s_.pin_name(pin); }
  // True if there was real contact.
  bool real() const { return s_.model == PinModel::contact || r_.went_over(); }

  void regime_facts() {
    const ClearanceRegime& regime = *r_.regime;
    if (regime.orbit) orbit_facts(*regime.orbit);
    if (regime.turns > 0 && regime.waited > 0)
      fact("periodic regime",
           say("repeats every {} ({}) after {}, within {}", periods(regime.turns),
               seconds(regime.turns * s_.period, 6), periods(regime.waited), plain_number(regime.change, 2)),
           Verdict::good);
    else if (regime.turns == 0)
      fact("periodic regime",
           std::isnan(regime.change) ? "not found"
                                     : say("not found within {}: the last one changed the motion by {}",
                                           periods(regime.waited), plain_number(regime.change, 3)),
           Verdict::bad);
  }
  static Sentence periods(int count) { return count == 1 ? "turn" : say("{} turns", count); }
  void orbit_facts(const JointOrbit& orbit) {
    const bool taken = r_.regime->waited == 0;
    if (orbit.status != Status::done) {
      fact("shooting", "no periodic motion in continuous contact: " + orbit.message);
      return;
    }
    fact(taken ? "periodic regime" : "shooting",
         say("{}, in continuous contact; found in {} steps of Newton's method, a period changes it by {}{}",
             seconds(s_.period, 6), orbit.iterations, plain_number(orbit.residual, 2),
             taken ? "" : "; but pins separate on it, or it is unstable"),
         taken ? Verdict::good : Verdict::plain);
    Sentence multipliers;
    for (const std::complex<double>& m : orbit.multipliers)
      multipliers += say("{}{}{}i", multipliers.empty() ? "" : ", ", plain_number(m.real()).fixed(6),
                         plain_number(m.imag()).fixed(6).with_sign());
    const bool unstable = orbit.stability == OrbitStability::unstable;
    fact("stability",
         say("{}: {}; Floquet multipliers {}", name_of(orbit.stability), summary_of(orbit.stability),
             multipliers),
         unstable ? Verdict::bad : Verdict::good);
    if (unstable && taken)
      warn("the periodic motion is unstable: a real linkage leaves it",
           "model = \"automatic\" follows it, turn after turn, until it repeats");
  }
  static std::string_view summary_of(OrbitStability stability) {
    for (const auto& word : names(OrbitStability{}))
      if (word.value == stability) return word.summary;
    return {};
  }
  // The value of the first input when pins parted: "O2 at 71 deg".
  Sentence where_switched() const {
    if (r_.switched_inputs.empty()) return {};
    const bool turns = s_.plan.rotary[0];
    const double value = r_.switched_inputs[0].value;
    const std::string& joint = planar::input_joint(s_.linkage, 0).name;
    return say(", {} at {}", joint,
               at_place(identifier(joint),
                        study::angle_or_length(turns ? math::wrap_angle(value) : value, turns, 4).spelled()));
  }
  void switch_fact() {
    if (!(duration() > 0)) return;
    if (!r_.went_over()) {
      fact("model", "continuous contact holds throughout", Verdict::good);
      return;
    }
    fact("model", say("pin {} separated from its bush at {}{}; from there on real contact{}",
                      name(at(r_.parted)), at_place("time", seconds(r_.switched, 6)), where_switched(),
                      s_.pins() > 1 ? " of all clearance joints" : ""));
  }
  void contact_facts() {
    if (!(duration() > 0)) return;
    double shortest = infinity;
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      const ContactTotals of = k < r_.contacts.size() ? r_.contacts[k] : ContactTotals();
      const double touching = (r_.went_over() ? std::max(r_.switched - r_.from, 0.0) : 0) + of.touching;
      shortest = std::min(shortest, of.shortest);
      fact(fmt::format("contacts of {}", name(k)),
           of.contacts == 0
               ? "none: the pin stays free in its bush"
               : say("{}, {} of the time in contact; at most {}, {} deep, approach of {}", of.contacts,
                     percent(touching / duration(), 3), force_by_size(of.force),
                     measured("um", of.depth, 3).spelled(), measured("m_per_s", of.approach, 3)));
      largest_force_ = std::max(largest_force_, of.force);
      too_deep(k, of.depth);
      poor_restitution(k);
    }
    if (r_.more_contacts_than_listed())
      warn(fmt::format("of {} contacts the first {} are listed; counts and largest values are those of all",
                       r_.all_contacts(), r_.events.size()),
           "a shorter simulation lists all of them");
    if (rows() < 2) return;
    const double interval = (r_.rows.back().time - r_.rows.front().time) / double(rows() - 1);
    if (shortest < interval)
      fact("shortest contact",
           say("{}, less than the {} between rows: plots and spectrum miss peaks of the forces, the table of "
               "contacts has them",
               seconds(shortest, 3), seconds(interval, 3)));
    else if (std::isfinite(shortest))
      fact("shortest contact", say("{}, rows every {}", seconds(shortest, 3), seconds(interval, 3)));
  }
  // The law is one of depths that are small against the bodies; deeper, it is a number without a meaning.
  void too_deep(std::size_t k, double depth) {
    const ContactJoint& c = s_.contacts[k];
    const double pin = c.bush_radius - c.clearance;
    if (depth <= deep_share * pin) return;
    fact(fmt::format("depth in the bush of {}", name(k)),
         say("{}, {} of the radius of the pin of {}", millimetres(depth), percent(depth / pin, 3),
             millimetres(pin)),
         Verdict::bad);
    warn(fmt::format("the pin of '{}', {:.4g} mm in radius, is pressed {:.4g} mm into its bush{}: the law of "
                     "contact holds for depths of a few per cent",
                     name(k), 1e3 * pin, 1e3 * depth,
                     depth > c.bush_radius ? ", which is more than the bush is wide" : ""),
         "stiffer bodies (modulus, stiffness), less mass or less speed; real bodies would yield or break");
  }
  // A law that does not give the given coefficient of restitution.
  void poor_restitution(std::size_t k) {
    const ContactLaw& law = s_.contacts[k].law;
    const ImpactShape shape = impact_shape(law);
    if (std::abs(shape.restitution - law.restitution) <= far_restitution * law.restitution) return;
    warn(fmt::format(
             "restitution = {:g} of '{}': by {} an impact gives back {:.3g} of its speed, with {:.3g} "
             "times the force and {:.3g} times the depth of an elastic one",
             law.restitution, name(k), name_of(law.damping), shape.restitution, shape.force, shape.depth),
         fmt::format("from {:g} on the law is within {:g} % of the given value",
                     min_restitution(law.damping, far_restitution), 100 * far_restitution));
  }
  void continuous_facts() {
    if (!(duration() > 0)) return;
    for (std::size_t k = 0; k < r_.validity.size(); ++k) {
      const ContactValidity& v = r_.validity[k];
      const bool lost = !std::isnan(v.first_separation);
      lost_ = lost_ || lost;
      if (!lost) {
        fact(fmt::format("contact of {}", name(k)), say("kept: minimum tension {}", newtons(v.min_tension)),
             Verdict::good);
        continue;
      }
      fact(
          fmt::format("contact of {}", name(k)),
          say("lost at {}; without contact {} of the time, minimum tension {}",
              at_place("time", seconds(v.first_separation)), percent(v.separated, 3), newtons(v.min_tension)),
          Verdict::bad);
      warn(fmt::format(
               "the pin of '{}' is taken to touch its bush always, but they separate at {:.4g} s: what "
               "follows is outside of the model",
               name(k), v.first_separation),
           "model = \"contact\" computes flights and impacts, model = \"automatic\" from there on");
    }
  }

  Sentence regime_headline() const {
    const ClearanceRegime& regime = *r_.regime;
    if (regime.turns == 0)
      return say("The motion did not become periodic within {} turns: ", s_.periodic()->max_turns);
    if (regime.waited == 0) return say("The periodic motion is {}: ", name_of(regime.orbit->stability));
    return say("The motion repeats every {} after {}: ", periods(regime.turns), periods(regime.waited));
  }
  Sentence motion_headline() const {
    const bool begins = result_.headline.empty();
    if (r_.went_over())
      return say("{} {} separates from its bush at {}{}, and {} contacts with up to {} follow",
                 begins ? "Pin" : "pin", name(at(r_.parted)), seconds(r_.switched), where_switched(),
                 r_.all_contacts(), force_by_size(largest_force_));
    if (real())
      return say("{} {} {} contacts of pin and bush, with up to {}", begins ? "In" : "in",
                 seconds(duration()), r_.all_contacts(), force_by_size(largest_force_));
    if (lost_)
      return begins ? "Pin and bush do not stay in contact: the motion is outside of the model"
                    : "pin and bush do not stay in contact, so it is outside of the model";
    return say("{} and bush stay in contact for all {}", begins ? "Pin" : "pin", seconds(duration()));
  }

  const ClearanceStudy& s_;
  const ClearanceRecording& r_;
  const PathErrors& errors_;
  study::Result& result_;
  const study::AddFact fact{result_.facts};
  const study::AddWarning warn{result_.diagnostics};
  double largest_force_ = 0;
  bool lost_ = false;
};

}  // namespace

void add_facts(const ClearanceStudy& study, const ClearanceRecording& recording, const PathErrors& errors,
               study::Result& result) {
  Facts facts(study, recording, errors, result);
  facts.add();
  facts.headline();
}

}  // namespace linkwright::clearance
