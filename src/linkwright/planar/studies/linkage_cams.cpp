// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_cams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/table.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/detail/cam_follower.h"
#include "linkwright/planar/linkage/strut.h"
#include "linkwright/planar/studies/cam.h"
#include "linkwright/planar/studies/linkage_rows.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;
using math::Motion;

Measured programme_place(double angle) { return at_place("cam_angle", degrees_of(angle, 6)); }

// Contact forces of a cam over a sweep of one input at constant speed.
class ContactSweep {
 public:
  ContactSweep(const LinkageStudy& study, std::size_t cam)
      : s_(study), cam_(cam), rate_(study.drives[0].rate), motion_(study.plan) {
    constexpr int most = 3600;
    const InputSamples& axis = std::get<InputGrid>(s_.sweep).inputs[0];
    const int steps = std::min(axis.samples - 1, most);
    for (int k = 0; k <= steps; ++k) inputs_.push_back(axis.from + (axis.to - axis.from) * k / steps);
  }

  double rate() const { return rate_; }
  // The contact at a value of the input: NaN where it does not assemble.
  CamContact contact(double input, double rate) {
    const InputMotion now{input, rate, 0};
    solve_motion(s_.plan, std::span(&now, 1), motion_);
    solve_forces(s_.linkage, s_.plan, motion_, 0, input, forces_);
    return forces_.status == Status::done ? forces_.cams[cam_] : CamContact{.force = nan, .lever = nan};
  }
  // The force of the contact; negative where the other flank, or the second disc, carries.
  double force(double input) {
    const CamContact c = contact(input, rate_);
    return c.on_second ? -c.force : c.force;
  }

  // The ranges of the input in which the force is negative, and where it changes its sign.
  struct Signs {
    std::vector<double> changes;
    std::vector<CamRange> negative;
  };
  Signs signs() {
    Signs out;
    std::optional<double> open;
    double last = force(inputs_[0]);
    if (last < 0) open = inputs_[0];
    for (std::size_t k = 1; k < inputs_.size(); ++k) {
      const double now = force(inputs_[k]);
      if (std::isfinite(last) && std::isfinite(now) && (last < 0) != (now < 0)) {
        const double place =
            math::zero_between([this](double x) { return force(x); }, inputs_[k - 1], inputs_[k]);
        out.changes.push_back(place);
        if (open) out.negative.push_back({*open, place});
        open = now < 0 ? std::optional(place) : std::nullopt;
      }
      last = now;
    }
    if (open) out.negative.push_back({*open, inputs_.back()});
    return out;
  }

  // The speed at which the contact first loses its force, and where. The force at rest and what the speed
  // adds with its square meet there.
  struct LiftOff {
    double rate = infinity, input = 0;  // no rate: it never does
  };
  LiftOff lift_off() {
    const auto square = [this](double input) {
      const double rest = contact(input, 0).force, gain = force(input) - rest;
      return gain < 0 ? std::max(rest, 0.0) / -gain : infinity;
    };
    LiftOff out;
    double least = infinity;
    std::vector<double> all;
    for (const double input : inputs_) all.push_back(square(input));
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double before = k > 0 ? all[k - 1] : infinity,
                   behind = k + 1 < all.size() ? all[k + 1] : infinity;
      if (!(all[k] <= before && all[k] <= behind) || !std::isfinite(all[k])) continue;
      double value = all[k], place = inputs_[k];
      if (std::isfinite(before + behind)) {
        const math::Minimum refined = math::minimum_about(square, inputs_[k - 1], inputs_[k], inputs_[k + 1],
                                                          {.absolute = 1e-9, .relative = 0, .sections = 80});
        if (refined.value < value) value = refined.value, place = refined.at;
      }
      // Of a rise and a return that are alike the return counts.
      if (!(value <= least * (1 + 1e-9))) continue;
      least = std::min(least, value);
      out = LiftOff{std::abs(rate_) * std::sqrt(value), place};
    }
    return out;
  }

  // The effort on the moved joint, in the sense in which the cam pushes, that would hold the contact.
  struct Need {
    double effort = 0, input = 0;
  };
  Need need() {
    Need out{-infinity, 0};
    for (const double input : inputs_) {
      const CamContact c = contact(input, rate_);
      if (const double effort = -c.force * std::abs(c.lever); effort > out.effort) out = {effort, input};
    }
    return out;
  }

 private:
  const LinkageStudy& s_;
  std::size_t cam_;
  double rate_;
  LinkageMotion motion_;
  LinkageForces forces_;
  std::vector<double> inputs_;
};

class CamReporter {
 public:
  CamReporter(const LinkageStudy& study, std::size_t cam, study::Result& result)
      : s_(study),
        cam_(study.linkage.cams[cam]),
        pair_(study.plan.cams[cam]),
        index_(cam),
        rotary_(!pair_.slide),
        result_(result),
        fact_{result.facts},
        warn_{result.diagnostics} {}

  void report() {
    std::vector<double> offsets;
    for (const CamPair& pair : s_.plan.cams) offsets.push_back(pair.offset);
    const int cam = static_cast<int>(index_);
    CamFollower follower(s_.linkage, cam, offsets);
    disc(follower, pair_.roller);
    programme();
    if (cam_.form == CamForm::conjugate) {
      CamFollower second(with_second_roller(s_.linkage, cam), cam, offsets);
      of_ = " second disc";
      disc(second, pair_.second_roller);
      of_.clear();
    }
    if (has_forces()) forces();
  }

 private:
  std::string label(const std::string& what) const { return fmt::format("{} of {}{}", what, cam_.name, of_); }

  // A disc against a roller of the follower.
  void disc(CamFollower& follower, double roller) {
    table(follower, roller);
    found_ = linkage_cam_extremes(s_.plan, static_cast<int>(index_), follower, roller);
    contour(follower.distance(pair_.offset), roller);
  }

  void table(CamFollower& follower, double roller) {
    constexpr int samples = 361;
    std::vector<double> angles;
    std::vector<Motion> motions;
    std::vector<CamState> states;
    for (int k = 0; k < samples; ++k) {
      angles.push_back(pair_.programme.breaks().back() * k / (samples - 1));
      motions.push_back(pair_.programme(angles.back()));
      states.push_back(follower.contour(pair_.offset, motions.back(), angles.back()));
    }
    const std::string name = "cam_" + identifier(cam_.name + of_);
    result_.tables.push_back(contour_table(
        name, {rotary_, roller, pair_.is_flat, s_.plan.size, "contact along the face from its point (m)"},
        angles, motions, states));
    const study::AddPlot plot{result_, {.table = name, .x = "cam_angle_rad", .scene = ""}};
    const std::string key = identifier(cam_.name + of_) + "-";
    plot(key + "programme", "Programme of " + cam_.name + of_, {follower_key(rotary_, "")});
    plot(key + "pressure-angle", "Pressure angle of " + cam_.name + of_, {"pressure_angle_rad"});
    plot(key + "profile", "Profile of " + cam_.name + of_, {"profile_x_m", "profile_y_m"},
         study::Plot::Style::polar);
  }

  void programme() {
    for (const ProgrammeFinding& f : findings(cam_.programme))
      if (f.issue == ProgrammeIssue::jump_of_acceleration)
        warn_(say("the second derivative of the programme of '{}' jumps by {} at {}", cam_.name,
                  study::angle_or_length(f.size, rotary_, 5), programme_place(f.angle)),
              "laws without acceleration at their ends, such as cycloidal or polynomial_345, do not shock");
  }

  void contour(double prime, double roller) {
    fact_(label("base circle"), millimetres(std::abs(prime) - roller, 6));
    const CamExtreme& most = std::abs(found_.greatest_pressure.value) > std::abs(found_.least_pressure.value)
                                 ? found_.greatest_pressure
                                 : found_.least_pressure;
    fact_(label("largest pressure angle"),
          say("{} at {}", degrees_of(std::abs(most.value), 5), programme_place(most.angle)));
    if (const auto& least = found_.least_convex_profile)
      fact_(label("least radius of the profile"),
            say("{} at {}", millimetres(least->value, 5), programme_place(least->angle)));
    if (found_.least_contact)
      fact_(label("contact along the face"),
            say("{} to {} from its point", millimetres(found_.least_contact->value, 5),
                millimetres(found_.greatest_contact->value, 5)));
    for (const CamRange& r : found_.undercut) {
      const Sentence where = say("the profile of '{}' is undercut from {} to {}", cam_.name + of_,
                                 programme_place(r.from), programme_place(r.to));
      if (pair_.is_flat)
        warn_(where, "take a larger base circle or a longer segment");
      else
        warn_(say("{}: the pitch curve has a radius of {}, the roller one of {}", where,
                  millimetres(found_.least_convex_pitch->value), millimetres(roller)),
              say("take a roller below {}, or a larger base circle",
                  millimetres(found_.least_convex_pitch->value)));
    }
    if (cam_.form == CamForm::groove && found_.least_concave_pitch &&
        found_.least_concave_pitch->value < roller)
      warn_(say("the outer flank of '{}' is undercut at {}: the pitch curve has a hollow radius of {}, the "
                "roller one of {}",
                cam_.name, programme_place(found_.least_concave_pitch->angle),
                millimetres(found_.least_concave_pitch->value), millimetres(roller)),
            "take a smaller roller, or a larger base circle");
    if (found_.gouge)
      warn_(say("at {} the roller would also cut {} into '{}' at {}", programme_place(found_.gouge->angle),
                millimetres(found_.gouge->depth, 3), cam_.name + of_, programme_place(found_.gouge->other)),
            "take a smaller roller, or a wider valley");
    const bool whole = found_.undercut.empty() && !found_.gouge;
    fact_(label("undercut"), whole ? "none" : "see the warnings", whole ? Verdict::good : Verdict::bad);
  }

  bool has_forces() const {
    return s_.quantities.reactions && s_.plan.has_masses && !over_time(s_) && s_.plan.inputs() == 1 &&
           s_.drives[0].rate != 0 && s_.drives[0].acceleration == 0;
  }
  // Forces that change with the speed otherwise than by its square.
  bool depends_on_speed() const {
    const Linkage& l = s_.linkage;
    const auto by_speed = [](const auto& load) { return goes_by(load, LoadArgument::speed); };
    return std::any_of(l.springs.begin(), l.springs.end(), [](const auto& s) { return s.damping > 0; }) ||
           std::any_of(l.torsion_springs.begin(), l.torsion_springs.end(),
                       [](const auto& s) { return s.damping > 0; }) ||
           std::any_of(l.forces.begin(), l.forces.end(), by_speed) ||
           std::any_of(l.torques.begin(), l.torques.end(), by_speed) ||
           std::any_of(l.struts.begin(), l.struts.end(), by_speed) ||
           std::any_of(l.joints.begin(), l.joints.end(), [](const auto& j) { return loses_power(j); });
  }
  Measured place(double input) const { return input_place(s_.linkage, s_.plan, 0, input, 6); }
  Measured speed(double rate) const {
    return s_.plan.rotary[0] ? measured("rpm", rate, 6) : measured("m/s", rate, 6);
  }

  void forces() {
    ContactSweep sweep(s_, index_);
    const ContactSweep::Signs signs = sweep.signs();
    if (cam_.form != CamForm::outside) {
      const bool is_groove = cam_.form == CamForm::groove;
      Sentence places;
      for (const double input : signs.changes)
        places += (places.empty() ? Sentence() : Sentence(", ")) + Sentence(place(input));
      fact_(label(is_groove ? "changes of the flank" : "changes of the carrying disc"),
            signs.changes.empty() ? Sentence(is_groove ? "none: one flank carries all of the time"
                                                       : "none: one disc carries all of the time")
                                  : places);
      return;
    }
    ContactSweep::LiftOff lift_off;
    if (!depends_on_speed()) lift_off = sweep.lift_off();
    if (std::isfinite(lift_off.rate))
      fact_(label("lift-off speed"), say("{}, first at {}", speed(lift_off.rate), place(lift_off.input)),
            signs.negative.empty() ? Verdict::good : Verdict::bad);
    if (signs.negative.empty()) return;
    for (const CamRange& r : signs.negative)
      fact_(label("contact lost"), say("{} to {}", place(r.from), place(r.to)), Verdict::bad);
    const ContactSweep::Need need = sweep.need();
    const Sentence hint =
        say("{} more on joint '{}' would hold it; contact forces below 0 are those of a "
            "cam that could pull",
            study::torque_or_force(need.effort, rotary_, 5), s_.linkage.joints[at(cam_.moves)].name);
    if (std::isfinite(lift_off.rate))
      warn_(say("the follower of '{}' lifts off at {} above {}, and the drive has {}", cam_.name,
                place(lift_off.input), speed(lift_off.rate), speed(std::abs(sweep.rate()))),
            hint);
    else
      warn_(say("the follower of '{}' loses contact from {}", cam_.name, place(signs.negative[0].from)),
            hint);
  }

  const LinkageStudy& s_;
  const LinkageCam& cam_;
  const CamPair& pair_;
  std::size_t index_;
  std::string of_;  // " second disc" of a conjugate cam
  bool rotary_;
  study::Result& result_;
  CamExtremes found_;
  const study::AddFact fact_;
  const study::AddWarning warn_;
};

}  // namespace

void add_cams(const LinkageStudy& study, study::Result& result) {
  for (std::size_t k = 0; k < study.linkage.cams.size(); ++k) CamReporter(study, k, result).report();
}

}  // namespace linkwright::planar
