// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::parallel {
namespace {

struct ModeForm {
  std::optional<std::vector<int>> working_mode;
};
template <class Visitor>
void fields(Visitor&& visit, ModeForm& m) {
  visit(field::entry("working_mode",
                     "one sign a leg, of (rod . direction in which the arm turns): 1 = the elbow of a DELTA "
                     "outside; default: elbows outside")
            .between(-1, 1),
        m.working_mode);
}

Robot robot_of(const HexaForm& form) { return hexa(form.dimensions); }

/// The four lengths, or three tables of legs.
std::optional<Robot> robot_of(study::ObjectReader& mechanism, const DeltaForm& form) {
  if (mechanism.has("leg")) {
    for (const char* key : {"base_radius", "platform_radius", "arm", "rod"})
      if (mechanism.has(key)) {
        mechanism.error(key, "is given for all legs and for single legs",
                        "keep the tables [[mechanism.leg]], or the four lengths");
        return std::nullopt;
      }
    if (form.legs.size() != 3) {
      mechanism.error("leg", fmt::format("a DELTA has 3 legs, got {}", form.legs.size()));
      return std::nullopt;
    }
    Robot out{.freedom = Freedom::space_translation};
    for (int i = 0; i < 3; ++i) {
      const DeltaLegForm& l = form.legs[static_cast<std::size_t>(i)];
      out.leg[i] = delta({l.base_radius, l.platform_radius, l.arm, l.rod, {l.azimuth, 0, 0}}).leg[0];
      out.leg[i].base.z = l.base_height;
    }
    return out;
  }
  bool complete = true;
  const auto needed = [&](const char* key, const std::optional<double>& value) {
    if (!value && !mechanism.has(key))
      mechanism.error(key, fmt::format("'{}' is missing", key), fmt::format("write {}_mm = ...", key));
    complete = complete && value;
    return value.value_or(0);
  };
  const DeltaDimensions d{.base_radius = needed("base_radius", form.base_radius),
                          .platform_radius = needed("platform_radius", form.platform_radius),
                          .arm = needed("arm", form.arm),
                          .rod = needed("rod", form.rod)};
  return complete ? std::optional(delta(d)) : std::nullopt;
}

std::optional<Robot> robot_of(study::ObjectReader& mechanism, const PlanarForm& form, bool offsets) {
  if (form.legs.empty() && !mechanism.has("leg")) return std::nullopt;  // reported as missing
  if (form.legs.size() != 2) {
    mechanism.error("leg", fmt::format("a planar robot has 2 legs, got {}", form.legs.size()));
    return std::nullopt;
  }
  auto tables = mechanism.tables("leg");
  std::array<PlanarLeg, 2> legs;
  for (std::size_t i = 0; i < 2; ++i) {
    const PlanarLegForm& l = form.legs[i];
    if (l.platform.has_value() != offsets) {
      tables[i].error("platform",
                      offsets ? "'platform' is missing" : "the rods of a five-bar meet in the platform point",
                      offsets ? "write platform_mm = [x, y], seen from the platform point"
                              : "leave it out, or take parallel.constant_orientation");
      return std::nullopt;
    }
    const auto at = l.platform.value_or(std::array{0.0, 0.0});
    legs[i] = {l.base[0], l.base[1], l.arm, l.rod, at[0], at[1]};
  }
  return planar(legs[0], legs[1]);
}

/// Elbows away from each other: those of spatial robots outwards, those of planar ones to both sides.
WorkingMode usual_mode(const Robot& robot) {
  if (robot.freedom != Freedom::plane_translation) return all_positive;
  const bool first_left = robot.leg[0].base.x <= robot.leg[1].base.x;
  WorkingMode out = all_positive;
  out[first_left ? 0 : 1] = -1;
  return out;
}

std::optional<WorkingMode> read_mode(study::ObjectReader& mechanism, const Robot& robot) {
  ModeForm form;
  mechanism.read(form);
  if (!form.working_mode) return usual_mode(robot);
  WorkingMode out = all_positive;
  bool good = static_cast<int>(form.working_mode->size()) == robot.legs();
  for (std::size_t i = 0; good && i < form.working_mode->size(); ++i) {
    out[i] = (*form.working_mode)[i];
    good = out[i] == 1 || out[i] == -1;
  }
  if (good) return out;
  mechanism.error("working_mode", fmt::format("must be {} signs, each 1 or -1", robot.legs()));
  return std::nullopt;
}

/// Keys that belong to the other type of drive.
bool check_keys(study::ObjectReader& table, DriveType type) {
  const bool pi_joint = type == DriveType::pi_joint;
  bool good = true;
  const auto refuse = [&](const char* key, const char* instead) {
    if (!table.has(key)) return;
    good = false;
    table.error(key, fmt::format("a drive of type {} has no '{}'", name_of(type), key),
                instead ? fmt::format("write {}", instead) : std::string());
  };
  if (pi_joint) {
    refuse("gear_ratio", "lead_mm");
    refuse("step_angle", "step_mm");
    refuse("stiffness_angular", "stiffness_N_per_m");
    refuse("torque_limit", "force_limit_N");
    refuse("speed_limit", "rate_limit_m_per_s");
  } else {
    refuse("ratio", nullptr);
    refuse("mounting", nullptr);
    refuse("mirrored", nullptr);
    refuse("lead", "gear_ratio");
    refuse("step", "step_angle_deg");
    refuse("stiffness", "stiffness_angular_N_m_per_rad");
    refuse("force_limit", "torque_limit_N_m");
    refuse("rate_limit", "speed_limit_rpm");
  }
  return good;
}

std::optional<DriveRead> drive_of(study::ObjectReader& table, const DriveForm& form) {
  if (!check_keys(table, form.type)) return std::nullopt;
  const bool pi_joint = form.type == DriveType::pi_joint;
  constexpr double right = pi / 2;
  DriveRead out;
  Drive& d = out.drive;
  d.type = form.type;
  d.ratio = form.ratio;
  d.mounting = form.mounting;
  d.mirror = form.mirrored ? -1 : 1;
  if (pi_joint) d.lowest = -right, d.highest = right;
  if (form.travel) {
    d.lowest = (*form.travel)[0];
    d.highest = (*form.travel)[1];
    if (!(d.lowest < d.highest)) {
      table.error("travel", "its first angle must be below its second one");
      return std::nullopt;
    }
    if (pi_joint && (d.lowest < -right || d.highest > right)) {
      table.error("travel", "a Pi-joint turns between -90 and 90 deg, less at both ends");
      return std::nullopt;
    }
  }
  PiDrive& m = out.motor;
  m.screw = {pi_joint ? form.lead.value_or(0) : 2 * pi / form.gear_ratio.value_or(1), form.efficiency};
  const auto& force = pi_joint ? form.force_limit : form.torque_limit;
  const auto& rate = pi_joint ? form.rate_limit : form.speed_limit;
  if (force) m.force_limit = *force;
  if (rate) m.rate_limit = *rate;
  out.known = force || rate;
  if (form.motor) {
    auto motor = table.table("motor");
    if (pi_joint && !form.lead) {
      table.error("lead", "a motor drives the Pi-joint by a screw, whose lead is missing",
                  "write lead_mm = ...");
      return std::nullopt;
    }
    const auto read = motor_of(*motor, *form.motor);
    if (!read) return std::nullopt;
    m.motor = *read;
    if (const auto wrong = problem(m)) {
      motor->error(form.motor->speeds.empty() ? "torque" : "speeds", *wrong);
      return std::nullopt;
    }
    out.known = true;
  }
  const auto& step = pi_joint ? form.step : form.step_angle;
  const auto& stiffness = pi_joint ? form.stiffness : form.stiffness_angular;
  d.quantum = step ? *step : m.screw.lead > 0 ? quantum(m) : 0;
  if (stiffness) d.stiffness = *stiffness;
  return out;
}

}  // namespace

std::optional<PiMotor> motor_of(study::ObjectReader& table, const MotorForm& form) {
  if (form.torque && !form.speeds.empty()) {
    table.error("torque", "is given together with a curve", "keep torque, or speeds and torques");
    return std::nullopt;
  }
  if (form.speeds.size() != form.torques.size()) {
    table.error(form.speeds.empty() ? "speeds" : "torques",
                fmt::format("{} speeds with {} torques", form.speeds.size(), form.torques.size()),
                "one torque for each speed");
    return std::nullopt;
  }
  PiMotor out;
  out.steps_per_turn = form.steps_per_turn.value_or(0);
  if (form.top_speed) out.top_speed = *form.top_speed;
  if (form.torque) out.torque = {{0, *form.torque}};
  for (std::size_t i = 0; i < form.speeds.size(); ++i)
    out.torque.push_back({form.speeds[i], form.torques[i]});
  return out;
}

std::optional<std::vector<DriveRead>> read_drives(study::ObjectReader& mechanism, int count,
                                                  std::string_view owners, Value& canonical) {
  const auto wanted = static_cast<std::size_t>(count);
  std::vector<study::ObjectReader> tables;
  std::vector<DriveForm> forms;
  if (mechanism.is_table(field::entry("drive"))) {
    forms.emplace_back();
    mechanism(field::entry("drive"), forms.front());
    if (auto table = mechanism.table("drive")) tables.push_back(*table);
  } else if (mechanism.has("drive")) {
    if (!mechanism(field::entry("drive"), forms)) return std::nullopt;
    tables = mechanism.tables("drive");
    if (forms.size() != wanted) {
      mechanism.error("drive", fmt::format("{} drives for {} {}", forms.size(), count, owners),
                      fmt::format("write one table [mechanism.drive] for all, or {} tables "
                                  "[[mechanism.drive]], one for each",
                                  count));
      return std::nullopt;
    }
  }
  if (tables.size() != forms.size()) return std::nullopt;
  std::vector<DriveRead> out;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const auto one = drive_of(tables[i], forms[i]);
    if (!one) return std::nullopt;
    out.push_back(*one);
  }
  const DriveRead usual = out.empty() ? DriveRead{} : out.front();
  out.resize(wanted, usual);
  constexpr std::array<std::string_view, 3> of_pi_joints = {"ratio", "mounting", "mirrored"};
  Value::Array written;
  for (const DriveForm& form : forms)
    written.push_back(form.type == DriveType::pi_joint ? study::write_fields(form)
                                                       : without(study::write_fields(form), of_pi_joints));
  // One for all stays one for all.
  if (forms.size() == wanted)
    canonical["drive"] = Value(std::move(written));
  else if (!forms.empty())
    canonical["drive"] = std::move(written.front());
  return out;
}

void describe_drives(study::SchemaWriter& mechanism) {
  mechanism.property(field::entry("drive", "what turns the arms: one for all, or one for each arm"),
                     study::schema_any_of({study::schema_fields<DriveForm>(),
                                           study::schema_array(study::schema_fields<DriveForm>())}));
}

Value without(Value table, std::span<const std::string_view> bases) {
  std::erase_if(table.as_object(), [&](const Value::Member& member) {
    const auto parts = split_unit(member.key);
    return std::any_of(bases.begin(), bases.end(), [&](std::string_view base) {
      return member.key == base || (parts && parts->base == base);
    });
  });
  return table;
}

Value home_written(const PoseForm& form, bool turns) {
  constexpr std::array<std::string_view, 1> rotation = {"rotation"};
  return turns ? study::write_fields(form) : without(study::write_fields(form), rotation);
}

Pose pose_of(const PoseForm& form) { return {vec(form.position), math::turn_about(vec(form.rotation))}; }

std::optional<RobotDescription> read_robot(study::ObjectReader& document, std::string_view type,
                                           Value& canonical) {
  auto mechanism = document.table(field::entry("mechanism").required());
  if (!mechanism) return std::nullopt;
  RobotDescription out{.type = std::string(type)};
  std::optional<Robot> robot;
  Value written;
  const auto take = [&](auto form, auto&& make) {
    mechanism->read(form);
    robot = make(form);
    written = study::write_fields(form);
  };
  if (type == "parallel.delta")
    take(DeltaForm{}, [&](const DeltaForm& f) { return robot_of(*mechanism, f); });
  else if (type == "parallel.hexa")
    take(HexaForm{}, [&](const HexaForm& f) { return std::optional(robot_of(f)); });
  else
    take(PlanarForm{}, [&](const PlanarForm& f) {
      return robot_of(*mechanism, f, type == "parallel.constant_orientation");
    });
  if (!robot || document.document().has_errors()) return std::nullopt;
  out.robot = *robot;
  if (const auto wrong = problem(out.robot)) {
    mechanism->error(wrong->find("arm") != std::string::npos   ? "arm"
                     : wrong->find("rod") != std::string::npos ? "rod"
                                                               : "base",
                     *wrong, "lengths must be above 0");
    return std::nullopt;
  }
  // The four lengths of a DELTA replace its legs.
  constexpr std::array<std::string_view, 1> leg = {"leg"};
  if (!mechanism->has("leg")) written = without(std::move(written), leg);
  const auto mode = read_mode(*mechanism, out.robot);
  const auto drives = read_drives(*mechanism, out.robot.legs(), "legs", written);
  if (!mode || !drives) return std::nullopt;
  for (std::size_t i = 0; i < drives->size(); ++i) {
    const DriveRead& one = (*drives)[i];
    out.drives[i] = one.drive;
    out.motors[i] = one.motor;
    out.motors_known = out.motors_known || one.known;
  }
  out.mode = *mode;
  Value::Array signs;
  for (int i = 0; i < out.robot.legs(); ++i) signs.emplace_back(static_cast<std::int64_t>(out.mode[i]));
  written["working_mode"] = signs;
  canonical["mechanism"] = written;
  return out;
}

void describe_robot(study::SchemaWriter& document, std::string_view type) {
  study::SchemaWriter mechanism;
  const auto describe = [&](auto form) {
    fields(mechanism, form);
    ModeForm mode;
    fields(mechanism, mode);
    describe_drives(mechanism);
  };
  if (type == "parallel.delta")
    describe(DeltaForm{});
  else if (type == "parallel.hexa")
    describe(HexaForm{});
  else
    describe(PlanarForm{});
  document.property(field::entry("mechanism", "the robot").required(), std::move(mechanism).finish());
}

}  // namespace linkwright::parallel
