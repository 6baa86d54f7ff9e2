// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/drive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace linkwright::flexible {
namespace {

template <class Form>
constexpr bool is_motion_law = requires(const Form& form) {
  math::MotionLaw(form);
};

// Each: whether the law can be asked. Where keys are missing it cannot, and they are reported as such.
bool check(study::ObjectReader&, const SpinUpForm& form) { return form.law.duration > 0; }
bool check(study::ObjectReader&, const SinePulseForm& form) { return form.law.duration > 0; }
bool check(study::ObjectReader&, const FreeForm&) { return true; }
bool check(study::ObjectReader& table, const TorqueTableForm& form) {
  const TorqueTable& law = form.law;
  if (law.times.empty() || law.torques.empty()) return false;
  if (law.times.size() != law.torques.size()) {
    table.error("torques", fmt::format("has {} torques for {} times", law.torques.size(), law.times.size()),
                "give one torque for each time");
    return false;
  }
  for (std::size_t i = 1; i < law.times.size(); ++i)
    if (law.times[i] <= law.times[i - 1]) {
      table.error("times", fmt::format("must increase, but {} s follows {} s (row {})", law.times[i],
                                       law.times[i - 1], i + 1));
      return false;
    }
  return true;
}
bool check(study::ObjectReader& table, const math::MotionLaw& law) {
  const auto bad = problem(law);
  const auto* rows = std::get_if<math::MotionTable>(&law);
  if (bad && !(rows && (rows->times.empty() || rows->values.empty())))
    table.error(bad->key, bad->message, bad->hint);
  return !bad;
}

JointDrive ready(const SpinUpForm& form, double end) {
  return {.motion = form.law,
          .breaks = {form.law.duration},
          .quiet = form.law.duration,
          .last = form.law(end).angle};
}
JointDrive ready(const SinePulseForm& form, double) {
  return {.torque = form.law,
          .breaks = {form.law.duration},
          .quiet = form.law.duration,
          .angle = form.angle,
          .last = form.angle};
}
JointDrive ready(const TorqueTableForm& form, double) {
  return {.torque = form.law,
          .breaks = form.law.times,
          .quiet = form.law.times.back(),
          .angle = form.angle,
          .last = form.angle};
}
JointDrive ready(const FreeForm& form, double) {
  return {.angle = form.angle, .rate = form.speed, .last = form.angle};
}
JointDrive ready(const math::MotionLaw& law, double end) {
  const math::MotionCurve curve(law);
  JointDrive out{.motion = [curve](double t) {
    const math::Motion m = curve(t);
    return HubMotion{m.value, m.rate, m.acceleration};
  }};
  out.breaks = breaks(law, 0, end);
  out.quiet = even_from(law);
  if (out.quiet) out.quiet = std::max(*out.quiet, 0.0);
  out.angle = curve(0).value;
  out.rate = curve(0).rate;
  out.last = curve(end).value;
  return out;
}

}  // namespace

bool check_drive(study::ObjectReader& table, const DriveLaw& law) {
  return std::visit(
      [&]<class Form>(const Form& form) {
        if constexpr (is_motion_law<Form>)
          return check(table, math::MotionLaw(form));
        else
          return check(table, form);
      },
      law);
}

JointDrive joint_drive(const DriveLaw& law, double end) {
  return std::visit(
      [end]<class Form>(const Form& form) {
        if constexpr (is_motion_law<Form>)
          return ready(math::MotionLaw(form), end);
        else
          return ready(form, end);
      },
      law);
}

}  // namespace linkwright::flexible
