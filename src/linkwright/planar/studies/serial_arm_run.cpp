// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/serial_arm/serial_arm.h"
#include "linkwright/planar/studies/serial_arm.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

constexpr const char* scene_name = "motion";

struct Row {
  double time = 0;
  std::vector<double> angles;
  std::vector<ArmLinkRates> rates;
  std::vector<ArmJointLoads> loads;
  ArmPointMotion tip;
  ArmEnergy energy;
  double energy_rate = 0;

  double joint_speed(std::size_t k) const { return rates[k].speed - (k == 0 ? 0 : rates[k - 1].speed); }
  double power() const {
    double sum = 0;
    for (std::size_t k = 0; k < rates.size(); ++k) sum += loads[k].absolute_torque * rates[k].speed;
    return sum;
  }
};

double time_of(const study::TimeSamples& s, int i) { return s.from + (s.to - s.from) * i / (s.samples - 1); }

class Evaluation {
 public:
  explicit Evaluation(const SerialArmStudy& s)
      : study_(s), arm_(serial_arm(s.mechanism)), elements_(elements(arm_)), motion_(elements_.size()) {
    for (const ArmDrive& drive : s.drives) curves_.emplace_back(motion_law(drive.law));
  }

  // Absolute motion of the links.
  const std::vector<math::Motion>& move(double time) {
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      math::Motion& m = motion_[k] = curves_[k](time);
      if (k == 0 || study_.drives[k].angle != ArmAngle::joint) continue;
      m.value += motion_[k - 1].value;
      m.rate += motion_[k - 1].rate;
      m.acceleration += motion_[k - 1].acceleration;
    }
    return motion_;
  }

  Row operator()(double time) {
    const std::size_t n = elements_.size();
    Row row{.time = time,
            .angles{},
            .rates = std::vector<ArmLinkRates>(n),
            .loads = std::vector<ArmJointLoads>(n)};
    move(time);
    for (const math::Motion& m : motion_) row.angles.push_back(m.value);
    const double gravity = study_.environment.gravity;
    rates(elements_, arm_.base, motion_, row.rates);
    reactions(elements_, row.rates, gravity, row.loads);
    row.tip = point(row.rates.back(), elements_.back().length);
    row.energy = energy(elements_, row.rates, gravity);
    row.energy_rate = energy_rate(elements_, row.rates, gravity);
    return row;
  }

 private:
  const SerialArmStudy& study_;
  SerialArm arm_;
  std::vector<ArmElement> elements_;
  std::vector<math::MotionCurve> curves_;
  std::vector<math::Motion> motion_;
};

template <class Value>
std::vector<double> column(const std::vector<Row>& rows, Value&& value) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const Row& row : rows) out.push_back(value(row));
  return out;
}

std::string joint_name(std::size_t k) { return fmt::format("O{}", k + 1); }

// A name as people read it.
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

Table sweep_table(const SerialArmStudy& s, const std::vector<Row>& rows) {
  using enum Dimension;
  const ArmQuantities& q = s.quantities;
  const std::vector<ArmLinkEntry>& links = s.mechanism.links;
  Table table{.name = "sweep"};
  const auto add = [&](const Quantity& what, auto&& value) { table.add(what, column(rows, value)); };
  const auto each = [&](const Quantity& what, auto&& value) {
    for (std::size_t k = 0; k < links.size(); ++k)
      add({links[k].name + "_" + what.key, words(links[k].name) + " " + what.words, what.dimension},
          [&](const Row& r) { return value(r, k); });
  };
  add({"time", "time", time}, [](const Row& r) { return r.time; });
  if (q.position) each({"angle", "angle", angle}, [](const Row& r, std::size_t k) { return r.angles[k]; });
  if (q.rates) {
    each({"speed", "speed", speed_angular}, [](const Row& r, std::size_t k) { return r.rates[k].speed; });
    each({"acceleration", "acceleration", acceleration_angular},
         [](const Row& r, std::size_t k) { return r.rates[k].acceleration; });
  }
  if (q.reactions)
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::string joint = joint_name(k);
      const std::string on =
          fmt::format("{} on {}", k == 0 ? "ground" : words(links[k - 1].name), words(links[k].name));
      add({joint + "_x", joint + " x, " + on, force}, [k](const Row& r) { return r.loads[k].force.real(); });
      add({joint + "_y", joint + " y, " + on, force}, [k](const Row& r) { return r.loads[k].force.imag(); });
    }
  if (q.torques) {
    each({"torque_absolute", "torque, motor on the ground", torque},
         [](const Row& r, std::size_t k) { return r.loads[k].absolute_torque; });
    each({"torque_joint", "torque, motor in the joint", torque},
         [](const Row& r, std::size_t k) { return r.loads[k].joint_torque; });
  }
  if (q.power) {
    each({"power_absolute", "power, motor on the ground", power},
         [](const Row& r, std::size_t k) { return r.loads[k].absolute_torque * r.rates[k].speed; });
    each({"power_joint", "power, motor in the joint", power},
         [](const Row& r, std::size_t k) { return r.loads[k].joint_torque * r.joint_speed(k); });
    add({"power", "power of all motors", power}, [](const Row& r) { return r.power(); });
  }
  if (q.energy) {
    add({"kinetic_energy", "kinetic energy", energy}, [](const Row& r) { return r.energy.kinetic; });
    add({"potential_energy", "potential energy", energy}, [](const Row& r) { return r.energy.potential; });
  }
  if (q.position) {
    for (std::size_t k = 1; k < links.size(); ++k) {
      const std::string joint = joint_name(k);
      add({joint + "_x", joint + " x", length},
          [k](const Row& r) { return r.rates[k].joint.position.real(); });
      add({joint + "_y", joint + " y", length},
          [k](const Row& r) { return r.rates[k].joint.position.imag(); });
    }
    add({"tip_x", "tip x", length}, [](const Row& r) { return r.tip.position.real(); });
    add({"tip_y", "tip y", length}, [](const Row& r) { return r.tip.position.imag(); });
  }
  if (q.rates)
    add({"tip_speed", "speed of the tip", speed}, [](const Row& r) { return std::abs(r.tip.velocity); });
  if (q.reactions)
    for (std::size_t k = 0; k < links.size(); ++k)
      add({joint_name(k), joint_name(k), force}, [k](const Row& r) { return std::abs(r.loads[k].force); });
  return table;
}

// Attached masses at the end of their link, or without mass, need no drawing of their own.
bool drawn(const PointMass& mass, double length) {
  const std::complex<double> place = std::polar(1.0, mass.angle) * mass.distance;
  return mass.mass > 0 && std::abs(place - length) > 1e-3 * length && std::abs(place) > 1e-3 * length;
}

study::Scene arm_scene(const SerialArmStudy& s, const std::vector<Row>& rows) {
  using Body = study::Scene::BodyStyle;
  using Joint = study::Scene::JointStyle;
  const std::vector<ArmLinkEntry>& links = s.mechanism.links;
  study::Scene scene;
  scene.name = scene_name;
  scene.input_key = "time_s";
  scene.input_label = "time";
  scene.input = column(rows, [](const Row& r) { return r.time; });
  const auto add = [&](std::string name, auto&& place) {
    scene.points.push_back({std::move(name), column(rows, [&](const Row& r) { return place(r).real(); }),
                            column(rows, [&](const Row& r) { return place(r).imag(); })});
    return static_cast<int>(scene.points.size()) - 1;
  };
  for (std::size_t k = 0; k < links.size(); ++k) {
    const int joint = add(joint_name(k), [k](const Row& r) { return r.rates[k].joint.position; });
    scene.joints.push_back({joint_name(k), joint, k == 0 ? Joint::ground_pivot : Joint::pivot});
    scene.bodies.push_back({words(links[k].name), {joint, joint + 1}, Body::bar});
  }
  const int tip = add("tip", [](const Row& r) { return r.tip.position; });
  scene.joints.push_back({"tip", tip, Joint::tracer});
  using Measure = study::Scene::Handle::Measure;
  scene.handles = {{.key = "mechanism.base_x_m", .measure = Measure::x, .point = 0},
                   {.key = "mechanism.base_y_m", .measure = Measure::y, .point = 0}};
  for (int k = 0; k < static_cast<int>(links.size()); ++k)
    scene.handles.push_back({.key = fmt::format("mechanism.link[{}].length_m", k),
                             .measure = Measure::length,
                             .point = k + 1,
                             .from = k,
                             .held = true});
  scene.traces.push_back({tip, "path of the tip", false});
  for (std::size_t k = 0; k < links.size(); ++k)
    for (const PointMass& mass : links[k].attached) {
      if (!drawn(mass, links[k].length)) continue;
      const std::complex<double> place = std::polar(1.0, mass.angle) * mass.distance;
      const std::string name = fmt::format("{:.4g} kg", mass.mass);
      const int at = add(name, [&](const Row& r) { return point(r.rates[k], place).position; });
      scene.bodies.push_back({name, {static_cast<int>(k), at}, Body::bar});
      const int rim =
          add("", [&](const Row& r) { return point(r.rates[k], place + drawn_radius(mass.mass)).position; });
      scene.circles.push_back({name, at, rim});
    }
  return scene;
}

void add_plots(study::Result& result, const SerialArmStudy& s) {
  const ArmQuantities& q = s.quantities;
  const study::AddPlot over_time{result, {.table = "sweep", .x = "time_s", .scene = scene_name}};
  const auto of_links = [&](std::string_view key) {
    std::vector<std::string> keys;
    for (const ArmLinkEntry& link : s.mechanism.links) keys.push_back(fmt::format("{}_{}", link.name, key));
    return keys;
  };
  if (q.torques) {
    over_time("torques-joint", "Torques, motors in the joints", of_links("torque_joint_N_m"));
    over_time("torques-absolute", "Torques, motors on the ground", of_links("torque_absolute_N_m"));
  }
  if (q.reactions) {
    std::vector<std::string> sizes;
    for (std::size_t k = 0; k < s.mechanism.links.size(); ++k) sizes.push_back(joint_name(k) + "_N");
    over_time("reactions", "Joint forces", sizes);
  }
  if (q.power) {
    std::vector<std::string> keys = of_links("power_joint_W");
    keys.emplace_back("power_W");
    over_time("power", "Power of motors in the joints, and of all", std::move(keys));
  }
  if (q.energy) over_time("energy", "Energy", {"kinetic_energy_J", "potential_energy_J"});
  if (q.position) over_time("angles", "Absolute angles of the links", of_links("angle_rad"));
  if (q.rates) {
    over_time("speeds", "Speeds of the links", of_links("speed_rad_per_s"));
    over_time("accelerations", "Accelerations of the links", of_links("acceleration_rad_per_s2"));
    over_time("tip-speed", "Speed of the tip", {"tip_speed_m_per_s"});
  }
  if (q.reactions)
    for (std::size_t k = 0; k < s.mechanism.links.size(); ++k)
      result.plots.push_back({.name = joint_name(k) + "-hodograph",
                              .title = fmt::format("Force at {}, y over x", joint_name(k)),
                              .table = "sweep",
                              .x = joint_name(k) + "_x_N",
                              .y = {joint_name(k) + "_y_N"},
                              .style = study::Plot::Style::points});
}

struct Peak {
  double value = nan, time = nan;
};
// The value of greatest size.
template <class Value>
Peak peak(const std::vector<Row>& rows, Value&& value) {
  Peak out;
  for (const Row& row : rows) {
    const double v = value(row);
    if (!(std::abs(v) <= std::abs(out.value))) out = {v, row.time};
  }
  return out;
}
Sentence text(const Peak& p, std::string_view unit) {
  return say("{} at {}", measured(unit, p.value, 5), at_place("time", seconds(p.time)));
}
Peak peak_force(const std::vector<Row>& rows, std::size_t k) {
  return peak(rows, [k](const Row& r) { return std::abs(r.loads[k].force); });
}
Peak peak_torque(const std::vector<Row>& rows, std::size_t k, double ArmJointLoads::*torque) {
  return peak(rows, [=](const Row& r) { return r.loads[k].*torque; });
}

void add_facts(study::Result& result, const SerialArmStudy& s, const std::vector<Row>& rows) {
  const ArmQuantities& q = s.quantities;
  const std::vector<ArmLinkEntry>& links = s.mechanism.links;
  const study::AddFact fact{result.facts};
  fact("links", say("{}", links.size()));
  if (q.reactions)
    for (std::size_t k = 0; k < links.size(); ++k)
      fact(fmt::format("largest force at {}", joint_name(k)), text(peak_force(rows, k), "N"));
  // Both, since counterweights that unload the joints load the motors.
  if (q.torques)
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::string link = words(links[k].name);
      fact(fmt::format("largest torque of {}, motor in the joint", link),
           text(peak_torque(rows, k, &ArmJointLoads::joint_torque), "N_m"));
      fact(fmt::format("largest torque of {}, motor on the ground", link),
           text(peak_torque(rows, k, &ArmJointLoads::absolute_torque), "N_m"));
    }
  const Peak power = peak(rows, [](const Row& r) { return r.power(); });
  if (q.power) fact("largest power of all motors", text(power, "W"));
  if (q.energy)
    fact("largest kinetic energy", text(peak(rows, [](const Row& r) { return r.energy.kinetic; }), "J"));
  if (q.rates)
    fact("largest speed of the tip",
         text(peak(rows, [](const Row& r) { return std::abs(r.tip.velocity); }), "m_per_s"));
  // Two routes to the power, relative to the largest power of the sweep.
  const Peak residual = peak(rows, [](const Row& r) { return r.power() - r.energy_rate; });
  if (q.power && power.value != 0)
    fact("power balance",
         say("within {} of the largest power", plain_number(std::abs(residual.value / power.value), 2)));
}

}  // namespace

std::vector<math::Motion> arm_motion(const SerialArmStudy& s) {
  Evaluation evaluate(s);
  std::vector<math::Motion> out;
  for (int i = 0; i < s.sweep.time.samples; ++i) {
    const std::vector<math::Motion>& now = evaluate.move(time_of(s.sweep.time, i));
    out.insert(out.end(), now.begin(), now.end());
  }
  return out;
}

Table serial_arm_table(const SerialArmStudy& s) {
  Evaluation evaluate(s);
  std::vector<Row> rows;
  for (int i = 0; i < s.sweep.time.samples; ++i) rows.push_back(evaluate(time_of(s.sweep.time, i)));
  return sweep_table(s, rows);
}

Table empty_serial_arm_table(const SerialArmStudy& s) { return sweep_table(s, {}); }

study::Result run_serial_arm_study(const SerialArmStudy& s, RunContext& context) {
  study::Result result;
  Evaluation evaluate(s);
  const study::TimeSamples& time = s.sweep.time;
  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(time.samples));
  for (int i = 0; i < time.samples && result.status == Status::done; ++i) {
    rows.push_back(evaluate(time_of(time, i)));
    if (i % 1024 == 1023) result.status = context.interruption();
  }
  result.tables.push_back(sweep_table(s, rows));
  result.scenes.push_back(arm_scene(s, rows));
  add_plots(result, s);
  add_facts(result, s, rows);

  Peak force, torque;
  std::size_t joint = 0, motor = 0;
  for (std::size_t k = 0; k < s.mechanism.links.size(); ++k) {
    const Peak f = peak_force(rows, k), t = peak_torque(rows, k, &ArmJointLoads::joint_torque);
    if (!(f.value <= force.value)) force = f, joint = k;
    if (!(std::abs(t.value) <= std::abs(torque.value))) torque = t, motor = k;
  }
  result.headline =
      say("The joint forces reach {} in {}, the torques of motors in the joints {} at {}.", text(force, "N"),
          joint_name(joint), text(torque, "N_m"), words(s.mechanism.links[motor].name));
  return result;
}

}  // namespace linkwright::planar
