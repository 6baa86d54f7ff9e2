#include "linkwright/planar/linkage/columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {
std::string group_key(std::string name) {
  for (std::size_t i; (i = name.find(" + ")) != std::string::npos;) name.replace(i, 3, "_");
  return identifier(name);
}

const std::vector<Word>& linkage_quantity_words() {
  static const std::vector<Word> words = {
      {"position", "angles and origins of the bodies, displacements of the slides, traced points"},
      {"rates", "their speeds and accelerations"},
      {"reactions", "forces and moments in the joints"},
      {"drive", "torques and forces of the drives"},
      {"shaking", "force and moments of the linkage on the ground"},
      {"transmission_angle", "of every dyad, folded to 0..90 deg: sine of the angle of force transmission"},
      {"power", "of drives, weight and loads, and the rate of the kinetic energy"}};
  return words;
}
LinkageQuantities chosen_quantities(const std::vector<std::string>& listed) {
  const auto has = [&](std::string_view word) {
    return listed.empty() || std::find(listed.begin(), listed.end(), word) != listed.end();
  };
  return {.position = has("position"),
          .rates = has("rates"),
          .reactions = has("reactions"),
          .drive = has("drive"),
          .shaking = has("shaking"),
          .transmission_angle = has("transmission_angle"),
          .power = has("power")};
}

void unwrap(const LinkageColumn& column, std::span<double> rows) {
  if (column.angle && !column.counted) math::unwrap_angles(rows);
}

double value_of(const LinkageColumn& column, const LinkageInstant& instant) {
  using Needs = LinkageColumn::Needs;
  const Status status = instant.motion->status;
  const bool known = column.needs == Needs::nothing || status == Status::done ||
                     (column.needs == Needs::pose && status == Status::singular);
  return known ? column.value(instant) : nan;
}

const LinkageJoint& input_joint(const Linkage& l, std::size_t input) { return l.joints[at(l.driven[input])]; }
namespace {
/// True if a body has the name of a driven joint: the columns of both would be called alike.
bool shares_name(const Linkage& l, std::size_t input) {
  const std::string name = identifier(input_joint(l, input).name);
  return std::any_of(l.bodies.begin(), l.bodies.end(),
                     [&](const LinkageBody& body) { return identifier(body.name) == name; });
}

std::string input_axis(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return identifier(input_joint(l, input).name) + (shares_name(l, input) ? "_joint" : "") +
         (plan.rotary[input] ? "_angle" : "_displacement");
}
}  // namespace

std::string input_key(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return input_axis(l, plan, input) + (plan.rotary[input] ? "_rad" : "_m");
}
std::string input_label(const Linkage& l, const LinkagePlan& plan, std::size_t input) {
  return fmt::format("{}{} {}", shares_name(l, input) ? "joint " : "", input_joint(l, input).name,
                     plan.rotary[input] ? "angle (rad)" : "displacement (m)");
}
Measured input_place(const Linkage& l, const LinkagePlan& plan, std::size_t input, double value, int digits) {
  return at_place(input_axis(l, plan, input),
                  plan.rotary[input] ? degrees_of(value, digits) : millimetres(value, digits));
}

std::string moment_centre_name(const Linkage& l) {
  if (l.moment_centre == std::complex<double>()) return "the origin";
  for (const LinkagePoint& p : l.bodies[0].points)
    if (p.at == l.moment_centre) return p.name;
  return fmt::format("({:.6g}, {:.6g}) m", l.moment_centre.real(), l.moment_centre.imag());
}

namespace {

// The angle of a body, in the turn that its joints count where drives and gears alone turn it.
double angle_with_turns(const LinkagePlan& plan, const LinkageInstant& instant, int body) {
  const double angle = angle_of(body_state(plan, *instant.motion, body).direction);
  const BodyOnPart& on = plan.bodies[at(body)];
  const auto& driven = plan.turned[at(on.part)];
  if (!driven) return angle;
  double counted = math::wrap_angle(driven->angle + angle_of(on.turn));
  for (std::size_t k = 0; k < driven->gains.size(); ++k)
    counted += driven->gains[k] * instant.inputs[k].value;
  return angle + full_turn * std::round((counted - angle) / full_turn);
}

}  // namespace

std::vector<LinkageColumn> linkage_columns(const Linkage& l, const LinkagePlan& plan,
                                           const LinkageQuantities& q, const std::vector<BodyPoint>& traces) {
  std::vector<LinkageColumn> out;
  const auto add = [&](std::string key, std::string label,
                       std::function<double(const LinkageInstant&)> value) {
    out.push_back({std::move(key), std::move(label), std::move(value)});
  };
  const auto moving = [&](auto&& each) {
    for (int b = 1; b < static_cast<int>(l.bodies.size()); ++b)
      if (plan.bodies[at(b)].part != 0) each(b, identifier(l.bodies[at(b)].name), l.bodies[at(b)].name);
  };
  const auto traced = [&](auto&& each) {
    for (const BodyPoint& t : traces) {
      const LinkageBody& body = l.bodies[at(t.body)];
      const LinkagePoint& point = body.points[at(t.point)];
      each(t.body, point.at, identifier(body.name) + "_" + identifier(point.name),
           body.name + "." + point.name);
    }
  };
  // A slide's displacement and its rates, second point from first along the slide.
  const auto slides = [&](auto&& each) {
    for (std::size_t j = 0; j < l.joints.size(); ++j)
      if (l.joints[j].type == JointType::prismatic) each(j, identifier(l.joints[j].name), l.joints[j].name);
  };
  const auto way = [&plan, &l](const LinkageInstant& i, std::size_t j, int order) {
    const LinkageJoint& joint = l.joints[j];
    const auto place = [&](const BodyPoint& p) {
      return point_motion(plan, *i.motion, p.body, l.bodies[at(p.body)].points[at(p.point)].at);
    };
    const PartState<double> first = body_state(plan, *i.motion, joint.first.body);
    const Vec<double> along = rotate(first.direction, unit(joint.slide_first));
    const PointMotion a = place(joint.first), b = place(joint.second);
    if (order == 0) return dot(along, b.position - a.position);
    const Vec<double> slip = b.velocity - velocity_at(first, b.position);
    if (order == 1) return dot(along, slip);
    return dot(along, b.acceleration - acceleration_at(first, b.position));
  };
  if (q.position) {
    moving([&](int b, const std::string& key, const std::string& name) {
      add(key + "_angle_rad", name + " angle (rad)",
          [&plan, b](const LinkageInstant& i) { return angle_with_turns(plan, i, b); });
      out.back().angle = true;
      out.back().counted = plan.turned[at(plan.bodies[at(b)].part)].has_value();
      add(key + "_x_m", name + " origin x (m)",
          [&plan, b](const LinkageInstant& i) { return body_state(plan, *i.motion, b).origin.x; });
      add(key + "_y_m", name + " origin y (m)",
          [&plan, b](const LinkageInstant& i) { return body_state(plan, *i.motion, b).origin.y; });
    });
    slides([&](std::size_t j, const std::string& key, const std::string& name) {
      if (std::find(l.driven.begin(), l.driven.end(), static_cast<int>(j)) != l.driven.end()) return;
      add(key + "_displacement_m", name + " displacement (m)",
          [way, j](const LinkageInstant& i) { return way(i, j, 0); });
    });
    traced([&](int b, std::complex<double> p, const std::string& key, const std::string& name) {
      add(key + "_x_m", name + " x (m)",
          [&plan, b, p](const LinkageInstant& i) { return point_motion(plan, *i.motion, b, p).position.x; });
      add(key + "_y_m", name + " y (m)",
          [&plan, b, p](const LinkageInstant& i) { return point_motion(plan, *i.motion, b, p).position.y; });
    });
  }
  for (LinkageColumn& c : out) c.needs = LinkageColumn::Needs::pose;
  if (q.rates) {
    moving([&](int b, const std::string& key, const std::string& name) {
      add(key + "_speed_rad_per_s", name + " speed (rad/s)",
          [&plan, b](const LinkageInstant& i) { return body_state(plan, *i.motion, b).speed; });
      add(key + "_acceleration_rad_per_s2", name + " acceleration (rad/s2)",
          [&plan, b](const LinkageInstant& i) {
            return body_state(plan, *i.motion, b).angular_acceleration;
          });
    });
    slides([&](std::size_t j, const std::string& key, const std::string& name) {
      add(key + "_speed_m_per_s", name + " speed (m/s)",
          [way, j](const LinkageInstant& i) { return way(i, j, 1); });
      add(key + "_acceleration_m_per_s2", name + " acceleration (m/s2)",
          [way, j](const LinkageInstant& i) { return way(i, j, 2); });
    });
    traced([&](int b, std::complex<double> p, const std::string& key, const std::string& name) {
      add(key + "_speed_x_m_per_s", name + " speed x (m/s)",
          [&plan, b, p](const LinkageInstant& i) { return point_motion(plan, *i.motion, b, p).velocity.x; });
      add(key + "_speed_y_m_per_s", name + " speed y (m/s)",
          [&plan, b, p](const LinkageInstant& i) { return point_motion(plan, *i.motion, b, p).velocity.y; });
      add(key + "_acceleration_x_m_per_s2", name + " acceleration x (m/s2)",
          [&plan, b, p](const LinkageInstant& i) {
            return point_motion(plan, *i.motion, b, p).acceleration.x;
          });
      add(key + "_acceleration_y_m_per_s2", name + " acceleration y (m/s2)",
          [&plan, b, p](const LinkageInstant& i) {
            return point_motion(plan, *i.motion, b, p).acceleration.y;
          });
    });
  }
  if (q.reactions)
    for (std::size_t j = 0; j < l.joints.size(); ++j) {
      const LinkageJoint& joint = l.joints[j];
      const std::string key = identifier(joint.name);
      const std::string pair =
          fmt::format("{} on {}", l.bodies[at(joint.first.body)].name, l.bodies[at(joint.second.body)].name);
      if (joint.type != JointType::gear) {
        add(key + "_x_N", fmt::format("{} x, {} (N)", joint.name, pair),
            [j](const LinkageInstant& i) { return i.forces->joints[j].force.x; });
        add(key + "_y_N", fmt::format("{} y, {} (N)", joint.name, pair),
            [j](const LinkageInstant& i) { return i.forces->joints[j].force.y; });
        add(key + "_N", fmt::format("{} (N)", joint.name),
            [j](const LinkageInstant& i) { return norm(i.forces->joints[j].force); });
      }
      const auto meshes = [j](const Group& g) {
        const Gear* gear = g.as<Gear>();
        return gear && gear->joint == static_cast<int>(j) && gear->mesh;
      };
      if (std::any_of(plan.groups.begin(), plan.groups.end(), meshes)) {
        add(key + "_tangential_N", fmt::format("{} along the teeth, {} (N)", joint.name, pair),
            [j](const LinkageInstant& i) { return i.forces->joints[j].tangential; });
        add(key + "_separating_N", fmt::format("{} that presses the wheels apart (N)", joint.name),
            [j](const LinkageInstant& i) { return i.forces->joints[j].separating; });
        add(key + "_tooth_N", fmt::format("{} of the teeth (N)", joint.name),
            [j](const LinkageInstant& i) { return norm(i.forces->joints[j].force); });
      }
      if (joint.type == JointType::prismatic || joint.type == JointType::fixed ||
          joint.type == JointType::gear)
        add(key + "_moment_N_m", fmt::format("{} moment, {} (N m)", joint.name, pair),
            [j](const LinkageInstant& i) { return i.forces->joints[j].moment; });
    }
  if (q.drive)
    for (std::size_t k = 0; k < plan.inputs(); ++k) {
      const std::string& name = input_joint(l, k).name;
      add(identifier(name) + (plan.rotary[k] ? "_drive_torque_N_m" : "_drive_force_N"),
          fmt::format("drive {} at {}", plan.rotary[k] ? "torque (N m)" : "force (N)", name),
          [k](const LinkageInstant& i) { return i.forces->drives[k]; });
    }
  if (q.shaking) {
    add("shaking_force_x_N", "shaking force x (N)",
        [](const LinkageInstant& i) { return i.forces->shaking_force.x; });
    add("shaking_force_y_N", "shaking force y (N)",
        [](const LinkageInstant& i) { return i.forces->shaking_force.y; });
    add("shaking_force_N", "shaking force (N)",
        [](const LinkageInstant& i) { return norm(i.forces->shaking_force); });
    const std::string about = "shaking moment about " + moment_centre_name(l);
    add("shaking_moment_N_m", about + ", without drive torques (N m)",
        [](const LinkageInstant& i) { return i.forces->shaking_moment; });
    add("shaking_moment_with_drive_N_m", about + ", with the drives (N m)",
        [](const LinkageInstant& i) { return i.forces->shaking_moment_with_drive; });
  }
  if (q.transmission_angle)
    for (std::size_t g = 0; g < plan.groups.size(); ++g)
      if (plan.groups[g].as<Dyad>())
        add(group_key(plan.groups[g].name) + "_transmission_angle_rad",
            plan.groups[g].name + " transmission angle (rad)", [g](const LinkageInstant& i) {
              return std::asin(std::min(1.0, std::abs(i.motion->groups[g].sine)));
            });
  if (q.power) {
    add("drive_power_W", "power of the drives (W)",
        [](const LinkageInstant& i) { return i.forces->drive_power; });
    add("weight_power_W", "power of the weight (W)",
        [](const LinkageInstant& i) { return i.forces->weight_power; });
    add("load_power_W", "power of springs and loads (W)",
        [](const LinkageInstant& i) { return i.forces->load_power; });
    add("kinetic_power_W", "rate of the kinetic energy (W)",
        [](const LinkageInstant& i) { return i.forces->kinetic_power; });
  }
  add("closure_residual_m", "closure residual (m)",
      [](const LinkageInstant& i) { return i.motion->closure_residual; });
  return out;
}

}  // namespace linkwright::planar
