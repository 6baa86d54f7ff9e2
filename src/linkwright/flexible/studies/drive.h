// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "linkwright/flexible/beam_form.h"
#include "linkwright/flexible/input_shaping.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/driven_law.h"
#include "linkwright/study/kind.h"

// Drives of hubs and hinges, in files and ready for use.
namespace linkwright::flexible {

inline constexpr Field start_angle_field = field::angle("angle", "at the start").between(-1e4, 1e4);

struct SpinUpForm {
  SpinUp law;
};
template <class Visitor>
void fields(Visitor&& visit, SpinUpForm& f) {
  visit(field::speed_angular("speed", "that is reached").required(), f.law.rate);
  visit(field::time("duration", "within which it is reached").positive().required(), f.law.duration);
}
constexpr Word choice_word(const SpinUpForm&) {
  return {"spin_up", "from rest to a steady speed without a jump of the acceleration"};
}

struct SinePulseForm {
  SinePulse law;
  double angle = 0;
};
template <class Visitor>
void fields(Visitor&& visit, SinePulseForm& f) {
  visit(field::torque("torque", "amplitude").required(), f.law.torque);
  visit(field::time("duration", "of the period, after which there is no torque").positive().required(),
        f.law.duration);
  visit(start_angle_field, f.angle);
}
constexpr Word choice_word(const SinePulseForm&) {
  return {"sine_torque", "one period of a sine as torque, then none"};
}

struct TorqueTableForm {
  TorqueTable law;
  double angle = 0;
};
template <class Visitor>
void fields(Visitor&& visit, TorqueTableForm& f) {
  visit(field::time("times", "increasing times").not_negative().required(), f.law.times);
  visit(field::torque("torques", "torque at each time").required(), f.law.torques);
  visit(start_angle_field, f.angle);
}
constexpr Word choice_word(const TorqueTableForm&) {
  return {"torque_table", "torque in straight lines between rows, none before the first and after the last"};
}

struct FreeForm {
  double angle = 0, speed = 0;
};
template <class Visitor>
void fields(Visitor&& visit, FreeForm& f) {
  visit(start_angle_field, f.angle);
  visit(field::speed_angular("speed", "at the start"), f.speed);
}
constexpr Word choice_word(const FreeForm&) { return {"none", "no drive: it swings or turns freely"}; }

template <class... Laws>
std::variant<SpinUpForm, Laws..., SinePulseForm, TorqueTableForm, FreeForm> drive_laws(std::variant<Laws...>);
/// Every motion law of joints, the spin-up, torques, or none.
using DriveLaw = decltype(drive_laws(study::RotaryLaw()));

/// Says what keeps the law from being one, with the keys of its table. False if anything does, keys that are
/// missing among it, which the reader reports.
bool check_drive(study::ObjectReader& table, const DriveLaw& law);

struct ShapingForm {
  Shaper shaper = Shaper::zv;
  std::optional<double> frequency;
  double damping = 0;
  int mode = 1;
};
template <class Visitor>
void fields(Visitor&& visit, ShapingForm& f) {
  visit(field::entry("shaper", "which impulses"), f.shaper);
  visit(field::entry("mode", "vibration that is not to be excited").between(1, 5), f.mode);
  visit(field::frequency("frequency", "of the vibration; default: computed for the mode").positive(),
        f.frequency);
  visit(field::entry("damping", "ratio of the vibration").between(0, 0.99), f.damping);
}

/// The drive of one joint: a motion that is given, a torque, or (neither) nothing.
struct JointDrive {
  std::function<HubMotion(double)> motion;
  std::function<double(double)> torque;
  std::vector<double> breaks;      ///< s, where it jumps or kinks before the end of the simulation
  std::optional<double> quiet{0};  ///< s, from when on it is even, or without torque; nothing if never
  double angle = 0, rate = 0;      ///< at the start (rad, rad/s)
  double last = 0;                 ///< angle at the end of a given motion, else that at the start (rad)

  bool free() const { return !motion && !torque; }
};
/// The drive by a law without problem, up to `end` (s).
JointDrive joint_drive(const DriveLaw& law, double end);

}  // namespace linkwright::flexible
