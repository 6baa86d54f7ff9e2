// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/studies/cam.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;
using math::Motion;

Measured cam_place(double angle) { return at_place("cam_angle", degrees_of(angle, 6)); }

// Radii beyond this, in prime radii, are those of straight parts.
constexpr double straight = 1e6;

class CamReport {
 public:
  CamReport(const CamStudy& study, const study::Common& common)
      : s_(study), common_(common), curve_(study.programme), rotary_(study.is_oscillating()) {}

  study::Result make() {
    found_ = cam_extremes(s_.cam, curve_);
    const double whole = curve_.breaks().back();
    for (int k = 0; k < common_.output.samples; ++k)
      angles_.push_back(whole * k / (common_.output.samples - 1));
    table();
    result_.scenes = cam_scenes(s_, curve_, angles_);
    plots();
    programme_findings();
    pressure_findings();
    radius_findings();
    if (s_.load) force_findings();
    headline();
    return std::move(result_);
  }

 private:
  Measured value_text(double value) const { return study::angle_or_length(value, rotary_, 5); }
  Measured effort_text(double value) const { return study::torque_or_force(value, rotary_, 5); }
  std::string motion_key(std::string_view suffix) const { return follower_key(rotary_, suffix); }

  void table() {
    std::vector<Motion> motions;
    std::vector<CamState> states;
    for (const double angle : angles_) {
      motions.push_back(curve_(angle));
      states.push_back(cam_state(s_.cam, motions.back(), angle));
    }
    const FollowerKind follower{
        rotary_, s_.cam.roller(), !s_.cam.has_pitch_curve(), s_.cam.prime_radius(), {}};
    Table table = contour_table("cam", follower, angles_, motions, states);
    const auto add = [&](std::string key, std::string label, const auto& number) {
      std::vector<double> values;
      for (std::size_t k = 0; k < angles_.size(); ++k) values.push_back(number(motions[k], states[k]));
      table.add(std::move(key), std::move(label), std::move(values));
    };
    if (s_.cutter_radius) {
      const double radius = *s_.cutter_radius;
      add("cutter_x_m", "centre of the cutter x (m)",
          [=](const Motion&, const CamState& s) { return cutter_centre(s, radius).x; });
      add("cutter_y_m", "centre of the cutter y (m)",
          [=](const Motion&, const CamState& s) { return cutter_centre(s, radius).y; });
    }
    if (s_.load) add_forces(add);
    result_.tables.push_back(std::move(table));
  }

  template <class Add>
  void add_forces(const Add& add) const {
    const FollowerLoad& load = *s_.load;
    add(rotary_ ? "effort_N_m" : "effort_N",
        rotary_ ? "torque of the cam about the pivot of the follower (N m)"
                : "force of the cam along the guide (N)",
        [&](const Motion& m, const CamState& s) { return follower_forces(s, m, load).effort; });
    add("contact_force_N", "contact force, negative where contact is lost (N)",
        [&](const Motion& m, const CamState& s) { return follower_forces(s, m, load).contact; });
    add("cam_torque_N_m", "torque on the cam in its sense (N m)",
        [&](const Motion& m, const CamState& s) { return follower_forces(s, m, load).torque; });
    add("contact_lost", "1 where contact is lost", [&](const Motion& m, const CamState& s) {
      return follower_forces(s, m, load).effort < 0 ? 1.0 : 0.0;
    });
  }

  void plots() {
    const study::AddPlot plot{result_, {.table = "cam", .x = "cam_angle_rad", .scene = "motion"}};
    plot("programme", rotary_ ? "Swing" : "Lift", {motion_key("")});
    plot("rate", "First derivative by the cam angle", {motion_key("_rate")});
    plot("second-rate", "Second derivative by the cam angle", {motion_key("_second_rate")});
    plot("third-rate", "Third derivative by the cam angle", {motion_key("_third_rate")});
    plot("pressure-angle", "Pressure angle", {"pressure_angle_rad"});
    if (s_.cam.has_pitch_curve())
      plot("profile", "Profile", {"profile_x_m", "profile_y_m", "pitch_x_m", "pitch_y_m"},
           study::Plot::Style::polar);
    else
      plot("radius", "Radius of curvature of the profile", {"profile_radius_m"});
    plot("contact", "Contact along the face", {"contact_m"});
    plot("contact-force", "Contact force", {"contact_force_N"});
    plot("cam-torque", "Torque on the cam", {"cam_torque_N_m"});
  }

  // Steps of the second and third derivative; those of lower order are errors of the study.
  void programme_findings() {
    std::size_t jerks = 0;
    ProgrammeFinding largest;
    for (const ProgrammeFinding& f : findings(s_.programme)) {
      if (f.issue == ProgrammeIssue::jump_of_acceleration)
        warn_("mechanism.segment",
              say("the second derivative of the programme jumps by {} at {}", value_text(f.size),
                  cam_place(f.angle)),
              "laws without acceleration at their ends, such as cycloidal or polynomial_345, do not shock");
      if (f.issue != ProgrammeIssue::jump_of_jerk) continue;
      ++jerks;
      if (std::abs(f.size) > std::abs(largest.size)) largest = f;
    }
    if (jerks > 0)
      fact_("steps of the third derivative",
            say("{}, the largest by {} at {}", jerks, value_text(largest.size), cam_place(largest.angle)));
  }

  void pressure_findings() {
    const std::optional<double>& limit = s_.limits.pressure_angle;
    const std::optional<double> limit_return =
        s_.limits.pressure_angle_return ? s_.limits.pressure_angle_return : limit;
    const auto report = [&](const char* label, const char* phase, const CamExtreme& e,
                            const std::optional<double>& most) {
      if (e.value == 0) return;
      // A cam that was designed to the limit meets it but for rounding.
      const bool exceeds = most && e.value > *most + 1e-9;
      fact_(label, say("{} at {}", degrees_of(e.value, 5), cam_place(e.angle)),
            !most     ? Verdict::plain
            : exceeds ? Verdict::bad
                      : Verdict::good);
      if (exceeds)
        warn_(
            "limits",
            say("the pressure angle of the {} is {} at {}, more than {}", phase, degrees_of(e.value),
                cam_place(e.angle), degrees_of(*most)),
            "take a larger base circle, a longer segment, or another offset; kind = \"synthesis\" finds the "
            "smallest cam within the limit");
    };
    report("largest pressure angle of the rise", "rise", found_.largest_in_rise, limit);
    report("largest pressure angle of the return", "return", found_.largest_in_return, limit_return);
  }

  void radius_findings() {
    const auto radius = [&](const char* label, const std::optional<CamExtreme>& e, Verdict verdict) {
      if (e) fact_(label, say("{} at {}", millimetres(e->value, 5), cam_place(e->angle)), verdict);
    };
    const std::optional<double>& limit = s_.limits.radius;
    const auto& least = found_.least_convex_profile;
    const bool is_sharp = limit && least && least->value < *limit - 1e-9 * s_.cam.prime_radius();
    if (s_.cam.roller() > 0)
      radius("least radius of the pitch curve", found_.least_convex_pitch, Verdict::plain);
    radius("least radius of the profile", least,
           !limit     ? Verdict::plain
           : is_sharp ? Verdict::bad
                      : Verdict::good);
    radius("least hollow radius of the profile", found_.least_concave_profile, Verdict::plain);
    if (is_sharp)
      warn_("limits",
            say("the least radius of the profile is {} at {}, less than {}", millimetres(least->value),
                cam_place(least->angle), millimetres(*limit)),
            "take a larger base circle or a longer segment");
    if (found_.least_contact)
      fact_("contact along the face",
            say("{} to {} from the {}, a face of {} at least", millimetres(found_.least_contact->value, 5),
                millimetres(found_.greatest_contact->value, 5), rotary_ ? "pivot" : "cam's axis",
                millimetres(found_.greatest_contact->value - found_.least_contact->value, 5)));
    if (!s_.cam.has_pitch_curve() && !rotary_ && !s_.programme.is_sector) breadth();
    undercut_findings();
  }

  // The breadth of a cam between two parallel faces, which a yoke needs to be constant.
  void breadth() {
    constexpr int looks = 720;  // of half a turn
    double least = infinity, greatest = 0;
    for (int k = 0; k < looks; ++k) {
      const double angle = pi * k / looks;
      const double across = 2 * s_.cam.base_radius + curve_(angle).value + curve_(angle + pi).value;
      least = std::min(least, across), greatest = std::max(greatest, across);
    }
    const bool is_constant = greatest - least <= 1e-9 * greatest;
    fact_("breadth between parallel faces",
          is_constant ? say("{}, constant: two faces enclose the cam", millimetres(greatest, 6))
                      : say("{} to {}: two faces cannot enclose the cam", millimetres(least, 6),
                            millimetres(greatest, 6)));
  }

  void undercut_findings() {
    for (const CamRange& r : found_.undercut) {
      const Sentence where = say("the profile is undercut from {} to {}", cam_place(r.from), cam_place(r.to));
      if (!s_.cam.has_pitch_curve()) {
        warn_("mechanism", where, "take a larger base circle or a longer segment");
        continue;
      }
      const auto whole =
          smallest_cam(s_.cam, {s_.cam.offset, s_.cam.offset},
                       {.pressure_angle = {}, .pressure_angle_return = {}, .radius = 0}, curve_);
      warn_("mechanism",
            say("{}: the pitch curve has a radius of {}, the roller one of {}", where,
                millimetres(found_.least_convex_pitch->value), millimetres(s_.cam.roller_radius)),
            whole ? say("take a roller below {}, or a base circle above {}",
                        millimetres(found_.least_convex_pitch->value), millimetres(whole->cam.base_radius))
                  : say("take a roller below {}", millimetres(found_.least_convex_pitch->value)));
    }
    if (found_.gouge)
      warn_("mechanism",
            say("at {} the roller would also cut {} into the cam at {}", cam_place(found_.gouge->angle),
                millimetres(found_.gouge->depth, 3), cam_place(found_.gouge->other)),
            "take a smaller roller, or a wider valley");
    fact_("undercut",
          found_.undercut.empty() && !found_.gouge ? Sentence("none") : Sentence("see the warnings"),
          found_.undercut.empty() && !found_.gouge ? Verdict::good : Verdict::bad);
  }

  void force_findings() {
    const FollowerLoad& load = *s_.load;
    const auto forces = [&](const Motion& m, double angle) {
      return follower_forces(cam_state(s_.cam, m, angle), m, load);
    };
    const CamExtreme contact =
        greatest_over(curve_, [&](const Motion& m, double a) { return forces(m, a).contact; });
    fact_("greatest contact force", say("{} at {}", newtons(contact.value, 5), cam_place(contact.angle)));
    const CamExtreme torque =
        greatest_over(curve_, [&](const Motion& m, double a) { return std::abs(forces(m, a).torque); });
    fact_("greatest torque on the cam",
          say("{} at {}", newton_metres(torque.value, 5), cam_place(torque.angle)));
    const auto lost = ranges_without_contact(curve_, load);
    const CamExtreme preload = needed_preload(curve_, load);
    if (const auto lift_off = lift_off_speed(curve_, load)) {
      fact_("lift-off speed",
            say("{}, first at {}", measured("rpm", lift_off->value, 6), cam_place(lift_off->angle)),
            lost.empty() ? Verdict::good : Verdict::bad);
      if (!lost.empty())
        warn_("forces",
              say("the follower lifts off at {} above {}, and the cam turns with {}",
                  cam_place(lift_off->angle), measured("rpm", lift_off->value), measured("rpm", load.speed)),
              say("a preload of {} would hold it", effort_text(preload.value)));
    }
    fact_("needed preload", say("{}, for the contact at {}", effort_text(std::max(preload.value, 0.0)),
                                cam_place(preload.angle)));
    for (const CamRange& r : lost)
      fact_("contact lost", say("{} to {}", cam_place(r.from), cam_place(r.to)), Verdict::bad);
    result_.statistics["lost_contact_ranges"] = static_cast<double>(lost.size());
  }

  void headline() {
    const double pressure =
        std::max(std::abs(found_.greatest_pressure.value), std::abs(found_.least_pressure.value));
    const Sentence size = say("base circle of {}", millimetres(s_.cam.base_radius, 6));
    const bool is_whole = found_.undercut.empty() && !found_.gouge;
    if (!is_whole)
      result_.headline = say("The cam with a {} is undercut.", size);
    else if (s_.cam.has_pitch_curve() || rotary_)
      result_.headline = say("The cam with a {} has a pressure angle of {} at most{}.", size,
                             degrees_of(pressure, 4), least_radius_text());
    else
      result_.headline =
          say("The cam with a {} needs a face of {}{}.", size,
              millimetres(found_.greatest_contact->value - found_.least_contact->value), least_radius_text());
  }
  Sentence least_radius_text() const {
    const auto& least = found_.least_convex_profile;
    return least ? say(" and has a least profile radius of {}", millimetres(least->value)) : Sentence();
  }

  const CamStudy& s_;
  const study::Common& common_;
  ProgrammeCurve curve_;
  const bool rotary_;
  CamExtremes found_;
  std::vector<double> angles_;
  study::Result result_;
  const study::AddFact fact_{result_.facts};
  const study::AddWarning warn_{result_.diagnostics};
};

Sentence bound_words(CamBound bound) {
  switch (bound) {
    case CamBound::pressure_angle:
      return "the pressure angle decides";
    case CamBound::curvature:
      return "the curvature of the profile decides";
    case CamBound::geometry:
      break;
  }
  return "the reach of the follower decides";
}

}  // namespace

std::string follower_key(bool rotary, std::string_view suffix) {
  return fmt::format("{}{}{}", rotary ? "swing" : "lift", suffix,
                     rotary ? (suffix.empty() ? "_rad" : "") : "_m");
}

Table contour_table(std::string name, const FollowerKind& follower, const std::vector<double>& angles,
                    const std::vector<Motion>& motions, const std::vector<CamState>& states) {
  Table table{.name = std::move(name)};
  const bool rotary = follower.rotary;
  const auto add = [&](std::string key, std::string label, const auto& number) {
    std::vector<double> values;
    for (std::size_t k = 0; k < angles.size(); ++k) values.push_back(number(motions[k], states[k]));
    table.add(std::move(key), std::move(label), std::move(values));
  };
  const double most = straight * follower.size;
  const auto bounded = [most](double radius) { return std::abs(radius) < most ? radius : nan; };
  const std::string what = rotary ? "swing" : "lift", unit = rotary ? "" : " (m)";
  table.add("cam_angle_rad", "cam angle (rad)", angles);
  add(follower_key(rotary, ""), what + (rotary ? " (rad)" : " (m)"),
      [](const Motion& m, auto&) { return m.value; });
  add(follower_key(rotary, "_rate"), "first derivative of the " + what + " by the cam angle" + unit,
      [](const Motion& m, auto&) { return m.rate; });
  add(follower_key(rotary, "_second_rate"), "second derivative of the " + what + " by the cam angle" + unit,
      [](const Motion& m, auto&) { return m.acceleration; });
  add(follower_key(rotary, "_third_rate"), "third derivative of the " + what + " by the cam angle" + unit,
      [](const Motion& m, auto&) { return m.jerk; });
  add("pressure_angle_rad", "pressure angle (rad)",
      [](const Motion&, const CamState& s) { return s.pressure_angle; });
  if (follower.roller > 0)
    add("pitch_radius_m", "radius of curvature of the pitch curve, positive = convex (m)",
        [&](const Motion&, const CamState& s) { return bounded(1 / s.pitch_curvature); });
  add("profile_radius_m", "radius of curvature of the profile, positive = convex (m)",
      [&](const Motion&, const CamState& s) { return bounded(s.profile_radius); });
  if (follower.is_flat)
    add("contact_m",
        follower.contact_label.empty() ? rotary ? "contact along the face from the pivot (m)"
                                                : "contact along the face from the cam's axis (m)"
                                       : follower.contact_label,
        [](const Motion&, const CamState& s) { return s.contact; });
  add("profile_x_m", "profile x (m)", [](const Motion&, const CamState& s) { return s.profile.x; });
  add("profile_y_m", "profile y (m)", [](const Motion&, const CamState& s) { return s.profile.y; });
  if (follower.roller > 0) {
    add("pitch_x_m", "pitch curve x (m)", [](const Motion&, const CamState& s) { return s.pitch.x; });
    add("pitch_y_m", "pitch curve y (m)", [](const Motion&, const CamState& s) { return s.pitch.y; });
  }
  return table;
}

study::Result run_cam(const CamStudy& study, const study::Common& common) {
  return CamReport(study, common).make();
}

study::Result run_cam_synthesis(const CamStudy& study, const study::Common& common) {
  const auto found = smallest_cam(study.cam, study.offset, study.limits, ProgrammeCurve(study.programme));
  if (!found) {
    study::Result none;
    none.status = Status::infeasible;
    none.headline = "No cam of this follower meets the limits.";
    study::AddWarning{none.diagnostics}(
        "limits", "no base circle of this follower meets the limits",
        "allow a larger pressure angle, give the segments more angle, or change arm and pivot");
    return none;
  }
  CamStudy whole = study;
  whole.cam = found->cam;
  study::Result result = run_cam(whole, common);
  const bool is_translating = whole.cam.motion == FollowerMotion::translating;
  study::Solution out;
  out.label = "smallest cam";
  out.parameters.push_back({"base_radius_m", "base radius", whole.cam.base_radius, 0, infinity});
  if (is_translating && whole.cam.has_pitch_curve())
    out.parameters.push_back(
        {"offset_m", "offset", whole.cam.offset, study.offset.lower, study.offset.upper});
  out.objectives["base_radius_m"] = whole.cam.base_radius;
  out.objectives["prime_radius_m"] = whole.cam.prime_radius();
  out.classification["decided_by"] = std::string(name_of(found->bound));
  out.scene = "motion";
  out.study = whole.canonical;
  Value mechanism;
  mechanism["type"] = "planar.cam";
  for (const Value::Member& member : whole.canonical.find("mechanism")->as_object())
    mechanism[member.key] = member.value;
  write_cam_size(whole.cam, mechanism);
  out.study["mechanism"] = std::move(mechanism);
  result.solutions.push_back(std::move(out));
  const Sentence size = is_translating && whole.cam.has_pitch_curve()
                            ? say("base circle of {} and an offset of {}",
                                  millimetres(whole.cam.base_radius, 6), millimetres(whole.cam.offset, 5))
                            : say("base circle of {}", millimetres(whole.cam.base_radius, 6));
  result.headline = say("The smallest cam has a {}; {}.", size, bound_words(found->bound));
  return result;
}

}  // namespace linkwright::planar
