#include "linkwright/parallel/motion_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linkwright/math/angles.h"
#include "linkwright/parallel/robot_scene.h"
#include "linkwright/parallel/tool_table.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::parallel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_instants = 200000;
/// A scene is for looking at: so many samples at most.
constexpr std::size_t most_scene_samples = 1200;

Vec3 vec(const Coordinates& c) { return {c[0], c[1], c[2]}; }

/// One instant of the motion.
struct Instant {
  double time = 0;
  ToolState tool;
  Status status = Status::done;
  ArmAngles angles;
  Quality quality;
  double swing = 0, least_elbow = 0, largest_elbow = 0;  ///< of all legs (rad)
  int assembly = 0;
  DrivesState drives;
  DynamicLoads loads;  ///< NaN without masses or out of reach
};

/// What was asked of the drives at most, against what they have.
struct Use {
  double share = 0;  ///< of the limit
  double value = 0, limit = 0;
  double time = 0;
  std::string what;  ///< "speed of drive 2"
};

class Judge {
 public:
  Judge(const RobotDescription& d, const QualityLimits& limits, const MotionStudy& study)
      : d_(d), limits_(limits), study_(study) {}

  /// Notes what is wrong at an instant, each kind of trouble once, where it begins.
  void look(const Instant& at, int home_assembly) {
    if (at.status != Status::done) {
      fail("reach", at, at.status, reason(at.angles));
      return;
    }
    if (const Singularity s = singularity(d_.robot, at.quality); s != Singularity::none)
      fail("singular", at, Status::singular, fmt::format("singularity {}", name_of(s)));
    else if (home_assembly != 0 && at.assembly != home_assembly)
      fail("singular", at, Status::singular,
           "the path has passed a singularity of type 2: here the platform belongs to another assembly");
    for (int i = 0; i < d_.robot.legs(); ++i) {
      const DriveAt& drive = at.drives.drive[i];
      if (drive.status == Status::done) continue;
      fail(fmt::format("travel {}", i), at, Status::limit_reached,
           fmt::format("{} {} would be at {:.2f} deg, travel {:.2f} to {:.2f} deg",
                       d_.drives[i].type == DriveType::pi_joint ? "Pi-joint" : "arm", i + 1,
                       math::degrees(drive.angle), math::degrees(d_.drives[i].lowest),
                       math::degrees(d_.drives[i].highest)));
    }
    if (at.quality.transmission < limits_.transmission)
      fail("transmission", at, Status::limit_reached,
           fmt::format("transmission index {:.3f}, at least {:.3f} is asked for", at.quality.transmission,
                       limits_.transmission));
    if (1 / at.quality.condition < limits_.conditioning)
      fail("conditioning", at, Status::limit_reached,
           fmt::format("local conditioning index {:.3f}, at least {:.3f} is asked for",
                       1 / at.quality.condition, limits_.conditioning));
    if (limits_.rod_swing && at.swing > *limits_.rod_swing)
      fail("swing", at, Status::limit_reached,
           fmt::format("a rod leans {:.2f} deg out of the plane of its arm, allowed are {:.2f} deg",
                       math::degrees(at.swing), math::degrees(*limits_.rod_swing)));
    if ((limits_.least_elbow && at.least_elbow < *limits_.least_elbow) ||
        (limits_.largest_elbow && at.largest_elbow > *limits_.largest_elbow))
      fail("elbow", at, Status::limit_reached,
           fmt::format("arms and rods stand at {:.2f} to {:.2f} deg, beyond the limits",
                       math::degrees(at.least_elbow), math::degrees(at.largest_elbow)));
    for (int i = 0; i < d_.robot.legs(); ++i)
      if (at.drives.drive[i].transmission < limits_.drive_transmission)
        fail("drive transmission", at, Status::limit_reached,
             fmt::format("sine of the angle between diagonal and arm of Pi-joint {} is {:.3f}, at least "
                         "{:.3f} is asked for",
                         i + 1, at.drives.drive[i].transmission, limits_.drive_transmission));
    for (int i = 0; i < d_.robot.legs(); ++i) drive(at, i);
  }

  struct Failure {
    std::string kind;
    double time = 0;
    Status status = Status::done;
    std::string text;
  };
  const std::vector<Failure>& failures() const { return failures_; }
  const std::vector<Use>& uses() const { return uses_; }

 private:
  void fail(std::string kind, const Instant& at, Status status, const std::string& why) {
    for (const Failure& f : failures_)
      if (f.kind == kind) return;
    failures_.push_back(
        {std::move(kind), at.time, status, fmt::format("{}: {}", study_.motion.where(at.time), why)});
  }

  void use(const Instant& at, std::string what, double value, double limit, std::string_view unit) {
    if (!std::isfinite(limit) || !std::isfinite(value)) return;
    auto found = std::find_if(uses_.begin(), uses_.end(), [&](const Use& u) { return u.what == what; });
    if (found == uses_.end()) found = uses_.insert(uses_.end(), Use{.share = -1, .what = what});
    const double share = limit > 0 ? value / limit : std::numeric_limits<double>::infinity();
    if (share > found->share) *found = {share, value, limit, at.time, what};
    if (share > 1)
      fail(what, at, Status::limit_reached,
           fmt::format("{} is {:.4g} {}, the limit is {:.4g} {}", what, value, unit, limit, unit));
  }

  void drive(const Instant& at, int i) {
    if (!d_.motors_known) return;
    const PiDrive& motor = d_.motors[i];
    const bool pi = d_.drives[i].type == DriveType::pi_joint;
    const double rate = at.loads.drive_speed[i], effort = at.loads.drive_effort[i];
    const bool geared = motor.screw.lead > 0;
    const double fastest = geared ? top_rate(motor) : motor.rate_limit;
    use(at, fmt::format("speed of drive {}", i + 1), std::abs(rate), fastest, pi ? "m/s" : "rad/s");
    const PowerFlow flow = effort * rate < 0 ? PowerFlow::load_drives : PowerFlow::motor_drives;
    // Beyond its speed a motor has no force: the speed is told, then.
    const double most =
        !geared || std::abs(rate) > fastest ? motor.force_limit : available_force(motor, rate, flow);
    use(at, fmt::format("{} of drive {}", pi ? "screw force" : "torque", i + 1), std::abs(effort), most,
        pi ? "N" : "N m");
  }

  const RobotDescription& d_;
  const QualityLimits& limits_;
  const MotionStudy& study_;
  std::vector<Failure> failures_;
  std::vector<Use> uses_;
};

void passive_angles(const Robot& robot, const Jacobians& at, Instant& out) {
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  out.least_elbow = std::numbers::pi;
  for (int i = 0; i < robot.legs(); ++i) {
    const Vec3 axis = cross(robot.leg[i].ahead, robot.leg[i].aside), rod = unit(at.rod[i]);
    out.swing = std::max(out.swing, std::abs(std::numbers::pi / 2 - angle(dot(rod, axis))));
    const double elbow = angle(-dot(rod, at.arm[i]));
    out.least_elbow = std::min(out.least_elbow, elbow);
    out.largest_elbow = std::max(out.largest_elbow, elbow);
  }
}

Instant instant(const RobotDescription& d, const std::optional<RobotMasses>& masses, const MotionStudy& study,
                double time) {
  Instant out{.time = time, .tool = study.motion(time)};
  const Pose pose{out.tool.position, out.tool.rotation};
  out.angles = inverse(d.robot, pose, d.mode);
  out.status = out.angles.status;
  if (out.status != Status::done) return out;
  const Jacobians at = jacobians(d.robot, pose, out.angles.angle);
  out.quality = quality(d.robot, at, platform_size(d.robot));
  passive_angles(d.robot, at, out);
  const double det = determinant(d.robot, at);
  out.assembly = det > 0 ? 1 : det < 0 ? -1 : 0;
  out.drives = drives_at(d.robot, d.drives, out.angles.angle);
  const DynamicState state{pose,
                           {out.tool.velocity, out.tool.angular_velocity},
                           {out.tool.acceleration, out.tool.angular_acceleration}};
  RobotMasses with_load = masses.value_or(RobotMasses{});
  out.loads = inverse_dynamics(d.robot, d.drives, with_load, d.mode, state,
                               {vec(study.form.force), vec(study.form.moment)});
  return out;
}

/// All instants as a table, out of reach NaN.
Table motion_table(const RobotDescription& d, const std::vector<Instant>& instants, bool forces) {
  Table table{.name = "motion"};
  const auto add = [&](std::string key, std::string label, auto&& value, bool always = false) {
    std::vector<double> values;
    for (const Instant& i : instants) values.push_back(always || i.status == Status::done ? value(i) : nan);
    table.add(std::move(key), std::move(label), std::move(values));
  };
  const bool planar = d.robot.freedom == Freedom::plane_translation;
  add(
      "time_s", "time (s)", [](const Instant& i) { return i.time; }, true);
  const auto add_vector = [&](const char* key, const char* label, const char* unit, const char* unit_text,
                              auto&& get) {
    for (int k = 0; k < (planar ? 2 : 3); ++k)
      add(
          fmt::format("{}{}_{}", key, "xyz"[k], unit), fmt::format("{}{} ({})", label, "xyz"[k], unit_text),
          [&](const Instant& i) {
            const Vec3 v = get(i);
            return k == 0 ? v.x : k == 1 ? v.y : v.z;
          },
          true);
  };
  add_vector("", "", "m", "m", [](const Instant& i) { return i.tool.position; });
  if (d.tool_turns())
    add_vector("rotation_", "rotation vector ", "rad", "rad",
               [](const Instant& i) { return math::turn_of(i.tool.rotation); });
  add(
      "tool_speed_m_per_s", "speed of the tool (m/s)", [](const Instant& i) { return norm(i.tool.velocity); },
      true);
  add(
      "tool_acceleration_m_per_s2", "acceleration of the tool (m/s2)",
      [](const Instant& i) { return norm(i.tool.acceleration); }, true);
  const auto by_leg = [&](std::string_view key, std::string_view unit, std::string_view label,
                          std::string_view unit_text, auto&& get) {
    for (int k = 0; k < d.robot.legs(); ++k)
      add(fmt::format("{}_{}_{}", key, k + 1, unit), fmt::format("{} {} ({})", label, k + 1, unit_text),
          [&](const Instant& i) { return get(i, k); });
  };
  const DriveWords words = words_of(d.drives[0].type);
  const bool pi = d.drives[0].type == DriveType::pi_joint;
  by_leg("arm_angle", "rad", "arm angle", "rad", [](const Instant& i, int k) { return i.angles.angle[k]; });
  if (pi) {
    by_leg("pi_angle", "rad", "angle of Pi-joint", "rad",
           [](const Instant& i, int k) { return i.drives.drive[k].angle; });
    by_leg("diagonal", "m", "diagonal", "m", [](const Instant& i, int k) { return i.drives.drive[k].value; });
  }
  by_leg("arm_speed", "rad_per_s", "speed of arm", "rad/s",
         [](const Instant& i, int k) { return i.loads.arm_speed[k]; });
  if (pi)
    by_leg(words.rate_key, words.rate_unit, "rate of diagonal", "m/s",
           [](const Instant& i, int k) { return i.loads.drive_speed[k]; });
  if (forces) {
    by_leg("arm_torque", "N_m", "torque at arm", "N m",
           [](const Instant& i, int k) { return i.loads.arm_torque[k]; });
    if (pi)
      by_leg("screw_force", "N", "screw force", "N",
             [](const Instant& i, int k) { return i.loads.drive_effort[k]; });
    by_leg("power", "W", "power of drive", "W",
           [](const Instant& i, int k) { return i.loads.drive_power[k]; });
    by_leg("rod_force", "N", "force in rod", "N",
           [](const Instant& i, int k) { return i.loads.rod_force[k]; });
    if (d.motors_known && d.motors[0].screw.lead > 0) {
      by_leg("motor_speed", "rad_per_s", "speed of motor", "rad/s", [&](const Instant& i, int k) {
        return motor_speed_of(d.motors[k].screw, i.loads.drive_speed[k]);
      });
      by_leg("motor_torque", "N_m", "torque of motor", "N m", [&](const Instant& i, int k) {
        return motor_torque(d.motors[k].screw, i.loads.drive_effort[k], i.loads.drive_speed[k]);
      });
    }
  }
  add("transmission", "transmission index", [](const Instant& i) { return i.quality.transmission; });
  add("local_conditioning", "local conditioning index",
      [](const Instant& i) { return 1 / i.quality.condition; });
  add("rod_swing_rad", "largest angle between a rod and the plane of its arm (rad)",
      [](const Instant& i) { return i.swing; });
  add("least_elbow_rad", "least angle between arm and rod (rad)",
      [](const Instant& i) { return i.least_elbow; });
  add("largest_elbow_rad", "largest angle between arm and rod (rad)",
      [](const Instant& i) { return i.largest_elbow; });
  if (std::any_of(instants.begin(), instants.end(),
                  [](const Instant& i) { return i.status != Status::done; }))
    for (const Instant& i : instants) table.status.emplace_back(to_string(i.status));
  return table;
}

Table uses_table(const std::vector<Use>& uses) {
  Table table{.name = "drive_limits"};
  std::vector<double> value, limit, share, time;
  for (const Use& u : uses) {
    table.names.push_back(u.what);
    value.push_back(u.value);
    limit.push_back(u.limit);
    share.push_back(100 * u.share);
    time.push_back(u.time);
  }
  table.add("largest", "largest (SI units)", value);
  table.add("limit", "limit then (SI units)", limit);
  table.add("use_percent", "use (%)", share);
  table.add("time_s", "at (s)", time);
  return table;
}

void add_plots(study::Result& result, const RobotDescription& d, bool forces) {
  const auto plot = [&](std::string name, std::string title, const char* key, const char* unit) {
    std::vector<std::string> columns;
    for (int k = 0; k < d.robot.legs(); ++k) columns.push_back(fmt::format("{}_{}_{}", key, k + 1, unit));
    result.plots.push_back({.name = std::move(name),
                            .title = std::move(title),
                            .table = "motion",
                            .x = "time_s",
                            .y = columns,
                            .scene = "motion"});
  };
  const auto single = [&](std::string name, std::string title, std::vector<std::string> columns) {
    result.plots.push_back({.name = std::move(name),
                            .title = std::move(title),
                            .table = "motion",
                            .x = "time_s",
                            .y = std::move(columns),
                            .scene = "motion"});
  };
  const bool pi = d.drives[0].type == DriveType::pi_joint;
  single("tool-speed", "Speed of the tool", {"tool_speed_m_per_s"});
  single("tool-acceleration", "Acceleration of the tool", {"tool_acceleration_m_per_s2"});
  if (pi) {
    plot("diagonals", "Diagonals of the Pi-joints", "diagonal", "m");
    plot("diagonal-rates", "Rates of the diagonals", "diagonal_rate", "m_per_s");
  } else {
    plot("arm-angles", "Arm angles", "arm_angle", "rad");
    plot("arm-speeds", "Speeds of the arms", "arm_speed", "rad_per_s");
  }
  if (forces) {
    plot("arm-torques", "Torques at the arms", "arm_torque", "N_m");
    if (pi) plot("screw-forces", "Screw forces", "screw_force", "N");
    plot("powers", "Powers of the drives", "power", "W");
    if (d.motors_known && d.motors[0].screw.lead > 0) {
      plot("motor-torques", "Torques of the motors", "motor_torque", "N_m");
      plot("motor-speeds", "Speeds of the motors", "motor_speed", "rad_per_s");
    }
  }
  single("transmission", "Transmission and conditioning", {"transmission", "local_conditioning"});
}

}  // namespace

std::optional<MotionStudy> read_motion(study::ObjectReader& document, const study::Common& common,
                                       const RobotDescription& d, const Pose& home, Value& canonical) {
  auto table = document.table("motion");
  if (!table) return std::nullopt;
  MotionForm form;
  table->read(form);
  auto steps = table->tables("step");
  for (std::size_t i = 0; i < form.path.steps.size() && i < steps.size(); ++i) {
    auto* points = std::get_if<ToolTable>(&form.path.steps[i].form);
    if (!points || points->file.empty()) continue;
    const auto text = study::read_beside(steps[i], "file", common.folder, points->file);
    if (!text) continue;
    Diagnostics problems;
    const auto read = read_tool_table(*text, points->file, problems);
    for (const Diagnostic& one : problems) steps[i].error("file", to_string(one));
    if (!read) continue;
    points->times = read->times;
    points->points = read->points;
    points->rotations = read->rotations;
    points->file.clear();  // the canonical study holds the points themselves
  }
  if (document.document().has_errors()) return std::nullopt;
  if (const auto wrong = problem(form.path, form.limits, home)) {
    const bool of_step = wrong->step >= 0 && wrong->step < static_cast<int>(steps.size());
    study::ObjectReader& where = of_step ? steps[static_cast<std::size_t>(wrong->step)] : *table;
    where.error(wrong->key.empty() ? "step" : wrong->key, wrong->message, wrong->hint);
    return std::nullopt;
  }
  MotionStudy out{form, ToolMotion(form.path, form.limits, home)};
  if (out.motion.duration() / form.interval > static_cast<double>(most_instants)) {
    table->error("interval",
                 fmt::format("makes {:.0f} instants of {:.4g} s, at most {} are allowed",
                             out.motion.duration() / form.interval, out.motion.duration(), most_instants));
    return std::nullopt;
  }
  for (int i = 0; i < 3; ++i)
    if (!d.tool_turns() && form.moment[static_cast<std::size_t>(i)] != 0) {
      table->error("moment", "the platform of this robot does not turn: no drive feels it", "leave it out");
      return std::nullopt;
    }
  canonical["motion"] = study::write_fields(form);
  return out;
}

void describe_motion(study::SchemaWriter& document) {
  document.property(Field{.key = "motion", .summary = "what the tool does, from home"},
                    study::schema_fields<MotionForm>());
}

void add_motion(study::Result& result, const RobotDescription& d, const std::optional<RobotMasses>& masses,
                const QualityLimits& limits, const MotionStudy& study, const Pose& home,
                RunContext& context) {
  const auto samples = study.motion.samples(study.form.interval);
  const int side = assembly_at(d.robot, home, d.mode);
  Judge judge(d, limits, study);
  std::vector<Instant> instants;
  instants.reserve(samples.size());
  for (const auto& sample : samples) {
    if (instants.size() % 256 == 0 && context.interruption() != Status::done) break;
    instants.push_back(instant(d, masses, study, sample.time));
    judge.look(instants.back(), side);
  }
  if (instants.size() < samples.size()) result.status = context.interruption();
  if (instants.empty()) {
    result.headline = "Interrupted before the first instant.";
    return;
  }
  const auto& f = study.form;
  const bool forces = masses.has_value() || norm(vec(f.force)) > 0 || norm(vec(f.moment)) > 0;
  result.tables.push_back(motion_table(d, instants, forces));
  if (!judge.uses().empty()) result.tables.push_back(uses_table(judge.uses()));
  add_plots(result, d, forces);

  using Verdict = study::Fact::Verdict;
  const auto fact = [&](std::string label, std::string text, Verdict verdict = Verdict::plain) {
    result.facts.push_back({std::move(label), std::move(text), verdict});
  };
  fact("duration of the path", fmt::format("{:.4g} s", study.motion.duration()));
  const Instant* tightest = nullptr;
  for (const Instant& i : instants)
    if (i.status == Status::done && (!tightest || i.quality.transmission < tightest->quality.transmission))
      tightest = &i;
  if (tightest)
    fact("least transmission index",
         fmt::format("{:.3f} ({})", tightest->quality.transmission, study.motion.where(tightest->time)));
  for (const Use& u : judge.uses()) {
    // Of all drives the one that is used most; the others are in the table.
    const std::string kind = u.what.substr(0, u.what.find(" of drive"));
    const bool most = std::all_of(judge.uses().begin(), judge.uses().end(), [&](const Use& other) {
      return !other.what.starts_with(kind) || other.share < u.share || &other == &u ||
             (other.share == u.share && &other > &u);
    });
    if (most)
      fact(kind + ", most used",
           fmt::format("{:.1f} % of the limit ({}, {})", 100 * u.share, u.what.substr(u.what.find("drive")),
                       study.motion.where(u.time)),
           u.share <= 1 ? Verdict::good : Verdict::bad);
  }
  for (const auto& failure : judge.failures()) {
    fact("fails", failure.text, Verdict::bad);
    if (result.status == Status::done) result.status = failure.status;
  }
  const Use* most = nullptr;
  for (const Use& u : judge.uses())
    if (!most || u.share > most->share) most = &u;
  const std::string tight = most ? fmt::format(" The tightest limit is the {}: {:.0f} % of it is used.",
                                               most->what, 100 * most->share)
                                 : "";
  if (judge.failures().empty()) {
    const bool whole = instants.size() == samples.size();
    result.headline =
        whole ? fmt::format("It works: the path takes {:.4g} s.{}", study.motion.duration(), tight)
              : fmt::format("Interrupted after {:.4g} s of the path.", instants.back().time);
  } else {
    const auto first = std::min_element(judge.failures().begin(), judge.failures().end(),
                                        [](const auto& a, const auto& b) { return a.time < b.time; });
    result.headline = fmt::format("It fails: {}.", first->text);
  }
  if (!d.motors_known) fact("limits of the drives", "none are known: speeds and forces are not judged");
  if (!masses) fact("masses", "none are given: forces are those of the process alone");

  std::vector<RobotSample> drawn;
  std::vector<double> times;
  const std::size_t stride = (instants.size() + most_scene_samples - 1) / most_scene_samples;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (i % stride != 0 && i + 1 != instants.size()) continue;
    const Instant& at = instants[i];
    drawn.push_back({at.status, {at.tool.position, at.tool.rotation}, at.angles.angle, at.tool.velocity});
    times.push_back(at.time);
  }
  result.scenes.push_back(
      robot_scene(d.robot, d.drives, {"motion", "motion along the path", "time_s", "time"}, times, drawn));
}

}  // namespace linkwright::parallel
