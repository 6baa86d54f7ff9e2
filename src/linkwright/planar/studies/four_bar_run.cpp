#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/branch.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/studies/four_bar.h"
#include "linkwright/planar/studies/four_bar_scene.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

constexpr const char* scene_name = "motion";
constexpr JointNames joint_names = {"O1", "O2", "O3", "O4"};

// Below it a linkage is said to transmit force badly: reactions grow like its reciprocal.
constexpr double poor_transmission = 5 * pi / 180;

struct Row : FourBarInstant {
  double angle = 0;
  double closure = nan;  // m
  Status status = Status::done;
};

// From the angles as they are reported: what O1-O2-O3 and O1-O4-O3 say of O3.
double closure_residual(const FourBar& l, double angle, const FourBarPosition& pose) {
  const auto link = [&](double length, double direction) {
    return std::polar(length, l.frame_angle + direction);
  };
  return std::abs(link(l.crank, angle) + link(l.coupler, pose.coupler_angle) - link(l.ground, 0) -
                  link(l.rocker, pose.rocker_angle));
}

bool has_coupler_point(const FourBar& l) { return l.coupler_u != 0 || l.coupler_v != 0; }

// Velocity and acceleration of C, global: those of A and of C about A.
std::pair<std::complex<double>, std::complex<double>> coupler_point_motion(const ReactionsStudy& s,
                                                                           const Row& r) {
  const FourBar& l = s.mechanism.linkage;
  const std::complex<double> i(0, 1), crank = std::polar(l.crank, l.frame_angle + r.angle),
                                      arm = r.pose.coupler_point - r.pose.crank_pin;
  const double crank_speed = s.drive.speed, speed = r.rates.coupler_speed;
  return {i * crank_speed * crank + i * speed * arm,
          (i * s.drive.acceleration - crank_speed * crank_speed) * crank +
              (i * r.rates.coupler_acceleration - speed * speed) * arm};
}

std::vector<double> crank_angles(const CrankSamples& s) {
  std::vector<double> out(static_cast<std::size_t>(s.samples));
  for (int i = 0; i < s.samples; ++i)
    out[static_cast<std::size_t>(i)] = s.from + (s.to - s.from) * i / (s.samples - 1);
  return out;
}

FourBarBranch branch_of(const ReactionsStudy& s) {
  const CrankSamples& sweep = std::get<CrankGrid>(s.sweep.type).crank_angle;
  return {s.mechanism.linkage,
          s.quantities.dynamic() ? s.mechanism.masses : std::nullopt,
          s.environment.gravity,
          sweep.from,
          sweep.to,
          s.sweep.at_change_point};
}

Row evaluate(const ReactionsStudy& s, const FourBarBranch& branch, double angle) {
  Row row{branch.at(angle, s.drive.speed, s.drive.acceleration), angle};
  row.status = row.rates.status != Status::done ? row.rates.status : row.forces.status;
  if (!std::isnan(row.pose.coupler_angle))
    row.closure = closure_residual(s.mechanism.linkage, angle, row.pose);
  return row;
}

template <class Value>
std::vector<double> column(const std::vector<Row>& rows, Value&& value) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const Row& row : rows) out.push_back(value(row));
  return out;
}

std::complex<double> joint_force(const FourBarReactions& f, int joint) {
  switch (joint) {
    case 0:
      return f.ground_on_crank;
    case 1:
      return f.crank_on_coupler;
    case 2:
      return f.rocker_on_coupler;
    default:
      return f.ground_on_rocker;
  }
}

Table sweep_table(const ReactionsStudy& s, const std::vector<Row>& rows) {
  const ReactionsQuantities& q = s.quantities;
  Table table{.name = "sweep"};
  const auto add = [&](std::string key, std::string label, auto&& value) {
    table.add(std::move(key), std::move(label), column(rows, value));
  };
  add("crank_angle_rad", "crank angle (rad)", [](const Row& r) { return r.angle; });
  if (q.position) {
    add("coupler_angle_rad", "coupler angle (rad)", [](const Row& r) { return r.pose.coupler_angle; });
    math::unwrap_angles(table.columns.back().values);
    add("rocker_angle_rad", "rocker angle (rad)", [](const Row& r) { return r.pose.rocker_angle; });
    math::unwrap_angles(table.columns.back().values);
  }
  if (q.rates) {
    add("coupler_speed_rad_per_s", "coupler speed (rad/s)",
        [](const Row& r) { return r.rates.coupler_speed; });
    add("rocker_speed_rad_per_s", "rocker speed (rad/s)", [](const Row& r) { return r.rates.rocker_speed; });
    add("coupler_acceleration_rad_per_s2", "coupler acceleration (rad/s2)",
        [](const Row& r) { return r.rates.coupler_acceleration; });
    add("rocker_acceleration_rad_per_s2", "rocker acceleration (rad/s2)",
        [](const Row& r) { return r.rates.rocker_acceleration; });
  }
  if (q.reactions) {
    constexpr std::array<std::string_view, 4> who = {"ground on crank", "crank on coupler",
                                                     "rocker on coupler", "ground on rocker"};
    for (int k = 0; k < 4; ++k) {
      const std::string_view joint = joint_names[static_cast<std::size_t>(k)],
                             pair = who[static_cast<std::size_t>(k)];
      add(fmt::format("{}_x_N", joint), fmt::format("{} x, {} (N)", joint, pair),
          [k](const Row& r) { return joint_force(r.forces, k).real(); });
      add(fmt::format("{}_y_N", joint), fmt::format("{} y, {} (N)", joint, pair),
          [k](const Row& r) { return joint_force(r.forces, k).imag(); });
    }
  }
  if (q.drive_torque)
    add("drive_torque_N_m", "drive torque (N m)", [](const Row& r) { return r.forces.drive_torque; });
  if (q.shaking) {
    add("shaking_force_x_N", "shaking force x (N)",
        [](const Row& r) { return r.forces.shaking_force.real(); });
    add("shaking_force_y_N", "shaking force y (N)",
        [](const Row& r) { return r.forces.shaking_force.imag(); });
    add("shaking_moment_N_m", "shaking moment about O1, joint forces (N m)",
        [](const Row& r) { return r.forces.shaking_moment; });
    add("shaking_moment_with_drive_N_m", "shaking moment about O1, with the drive (N m)",
        [](const Row& r) { return r.forces.shaking_moment_with_drive; });
  }
  if (q.transmission_angle)
    add("transmission_angle_rad", "transmission angle (rad)",
        [](const Row& r) { return r.pose.transmission_angle; });
  add("closure_residual_m", "closure residual (m)", [](const Row& r) { return r.closure; });
  if (q.position) {
    const auto point = [&](const std::string& name, auto&& where) {
      add(name + "_x_m", name + " x (m)", [&](const Row& r) { return where(r).real(); });
      add(name + "_y_m", name + " y (m)", [&](const Row& r) { return where(r).imag(); });
    };
    point("O2", [](const Row& r) { return r.pose.crank_pin; });
    point("O3", [](const Row& r) { return r.pose.coupler_pin; });
    if (has_coupler_point(s.mechanism.linkage)) point("C", [](const Row& r) { return r.pose.coupler_point; });
  }
  if (q.rates && has_coupler_point(s.mechanism.linkage)) {
    const auto vector = [&](const std::string& name, const std::string& key_unit, const std::string& unit,
                            auto&& what) {
      add("C_" + name + "_x_" + key_unit, "C " + name + " x (" + unit + ")",
          [&](const Row& r) { return what(r).real(); });
      add("C_" + name + "_y_" + key_unit, "C " + name + " y (" + unit + ")",
          [&](const Row& r) { return what(r).imag(); });
    };
    vector("speed", "m_per_s", "m/s", [&](const Row& r) { return coupler_point_motion(s, r).first; });
    vector("acceleration", "m_per_s2", "m/s2",
           [&](const Row& r) { return coupler_point_motion(s, r).second; });
  }
  if (q.reactions)
    for (int k = 0; k < 4; ++k) {
      const std::string_view joint = joint_names[static_cast<std::size_t>(k)];
      add(fmt::format("{}_N", joint), fmt::format("{} (N)", joint),
          [k](const Row& r) { return std::abs(joint_force(r.forces, k)); });
    }
  if (q.shaking)
    add("shaking_force_N", "shaking force (N)",
        [](const Row& r) { return std::abs(r.forces.shaking_force); });
  for (const Row& row : rows) table.status.emplace_back(to_string(row.status));
  return table;
}

study::Scene motion_scene(const ReactionsStudy& s, const std::vector<Row>& rows) {
  const FourBar& linkage = s.mechanism.linkage;
  const ReactionsQuantities& q = s.quantities;
  std::vector<FourBarPosition> poses;
  for (const Row& row : rows) poses.push_back(row.pose);
  study::Scene scene =
      four_bar_scene(linkage, column(rows, [](const Row& r) { return r.angle; }), poses, scene_name,
                     "motion over the sweep", has_coupler_point(linkage), joint_names);
  std::vector<FourBarRates> rates;
  std::vector<FourBarReactions> forces;
  for (const Row& row : rows) {
    rates.push_back(row.rates);
    forces.push_back(row.forces);
  }
  if (q.dynamic() && s.mechanism.masses) add_mass_centres(scene, linkage, *s.mechanism.masses);
  if (q.reactions) add_joint_forces(scene, forces);
  if (q.shaking) add_shaking_force(scene, forces);
  if (q.drive_torque) add_drive_torque(scene, forces);
  if (q.rates) add_motion_arrows(scene, linkage, rates);
  return scene;
}

void add_plots(study::Result& result, const ReactionsQuantities& q) {
  const auto over_angle = [&](std::string name, std::string title, std::vector<std::string> y) {
    result.plots.push_back({.name = std::move(name),
                            .title = std::move(title),
                            .table = "sweep",
                            .x = "crank_angle_rad",
                            .y = std::move(y),
                            .scene = scene_name});
  };
  const auto hodograph = [&](std::string name, std::string title, const auto& forces) {
    study::Plot plot{.name = std::move(name),
                     .title = std::move(title),
                     .table = "sweep",
                     .x = "crank_angle_rad",
                     .y = {},
                     .style = study::Plot::Style::polar,
                     .scene = scene_name};
    for (const std::string_view force : forces)
      for (const char* component : {"_x_N", "_y_N"}) plot.y.push_back(std::string(force) + component);
    result.plots.push_back(std::move(plot));
  };
  if (q.drive_torque) over_angle("torque", "Drive torque", {"drive_torque_N_m"});
  if (q.reactions) over_angle("reactions", "Joint reactions", {"O1_N", "O2_N", "O3_N", "O4_N"});
  if (q.shaking) {
    over_angle("shaking-force", "Shaking force",
               {"shaking_force_x_N", "shaking_force_y_N", "shaking_force_N"});
    over_angle("shaking-moment", "Shaking moment about O1",
               {"shaking_moment_N_m", "shaking_moment_with_drive_N_m"});
    hodograph("shaking-hodograph", "Polar diagram of the shaking force",
              std::array<std::string_view, 1>{"shaking_force"});
  }
  if (q.reactions) hodograph("reaction-hodographs", "Polar diagram of the joint forces", joint_names);
  if (q.transmission_angle) over_angle("transmission", "Transmission angle", {"transmission_angle_rad"});
  if (q.position) over_angle("angles", "Coupler and rocker angle", {"coupler_angle_rad", "rocker_angle_rad"});
  if (q.rates) {
    over_angle("speeds", "Coupler and rocker speed", {"coupler_speed_rad_per_s", "rocker_speed_rad_per_s"});
    over_angle("accelerations", "Coupler and rocker acceleration",
               {"coupler_acceleration_rad_per_s2", "rocker_acceleration_rad_per_s2"});
  }
}

struct Peak {
  double value = nan, angle = nan;
};
// The value of greatest size among the rows that have one.
template <class Value>
Peak peak(const std::vector<Row>& rows, Value&& value) {
  Peak out;
  for (const Row& row : rows) {
    const double v = value(row);
    if (!std::isnan(v) && !(std::abs(v) <= std::abs(out.value))) out = {v, row.angle};
  }
  return out;
}
std::string text(const Peak& p, std::string_view unit) {
  return fmt::format("{:.5g} {} at {:.1f}°", p.value, unit, math::degrees(p.angle));
}

std::size_t count(const std::vector<Row>& rows, Status status) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const Row& r) { return r.status == status; }));
}

bool whole_turns(const std::vector<Row>& rows) {
  const double turns = (rows.back().angle - rows.front().angle) / (2 * pi);
  return std::abs(turns) > 0.5 && std::abs(turns - std::round(turns)) < 1e-9;
}

void add_facts(study::Result& result, const ReactionsStudy& s, const std::vector<Row>& rows) {
  using Verdict = study::Fact::Verdict;
  const ReactionsQuantities& q = s.quantities;
  const FourBarClass type = classify(s.mechanism.linkage);
  result.facts.push_back(
      {"type", fmt::format("{}, {}", in_words(type.type), name_of(s.mechanism.linkage.branch))});
  result.facts.push_back({"drive", fmt::format("{:.6g} rad/s ({:.5g} rpm), {:.6g} rad/s²", s.drive.speed,
                                               s.drive.speed * 30 / pi, s.drive.acceleration)});
  const bool complete = count(rows, Status::done) == rows.size();
  if (count(rows, Status::done) > 0) {
    if (q.drive_torque) {
      result.facts.push_back({"largest drive torque",
                              text(peak(rows, [](const Row& r) { return r.forces.drive_torque; }), "N m")});
      double squares = 0, work = 0, moved = 0;
      for (std::size_t i = 1; i < rows.size(); ++i) {
        const double a = rows[i - 1].forces.drive_torque, b = rows[i].forces.drive_torque;
        squares += b * b;
        work += (a + b) / 2 * (rows[i].angle - rows[i - 1].angle);
        moved += (std::abs(a) + std::abs(b)) / 2 * std::abs(rows[i].angle - rows[i - 1].angle);
      }
      if (complete && whole_turns(rows)) {
        const double rms = std::sqrt(squares / static_cast<double>(rows.size() - 1));
        result.facts.push_back({"drive torque, root mean square", fmt::format("{:.5g} N m", rms)});
        // At even speed a turn gives back what it takes.
        if (s.drive.acceleration == 0)
          result.facts.push_back({"work of the drive over the turn",
                                  fmt::format("{:.2g} J of {:.4g} J back and forth", work, moved),
                                  std::abs(work) <= 1e-3 * moved ? Verdict::good : Verdict::plain});
      }
    }
    if (q.reactions)
      for (int k = 0; k < 4; ++k)
        result.facts.push_back(
            {fmt::format("largest force at {}", joint_names[static_cast<std::size_t>(k)]),
             text(peak(rows, [k](const Row& r) { return std::abs(joint_force(r.forces, k)); }), "N")});
    if (q.shaking) {
      result.facts.push_back(
          {"largest shaking force",
           text(peak(rows, [](const Row& r) { return std::abs(r.forces.shaking_force); }), "N")});
      result.facts.push_back(
          {"largest shaking moment with the drive",
           text(peak(rows, [](const Row& r) { return r.forces.shaking_moment_with_drive; }), "N m")});
    }
  }
  // Change points are told of by themselves.
  const auto transmission = [](const Row& r) { return r.change_point ? nan : r.pose.transmission_angle; };
  const auto least = std::min_element(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    return transmission(a) < transmission(b) || std::isnan(transmission(b));
  });
  const double mu = transmission(*least);
  if (!std::isnan(mu)) {
    result.facts.push_back({"least transmission angle",
                            fmt::format("{:.1f}° at {:.1f}°", math::degrees(mu), math::degrees(least->angle)),
                            mu < poor_transmission ? Verdict::bad : Verdict::plain});
    if (mu < poor_transmission)
      result.diagnostics.push_back(
          {Diagnostic::Severity::warning,
           {},
           {},
           {},
           fmt::format("the transmission angle falls to {:.2f}° at a crank angle of {:.1f}°: near a dead "
                       "point forces grow without bound",
                       math::degrees(mu), math::degrees(least->angle)),
           {}});
  }
  const Peak closure = peak(rows, [](const Row& r) { return r.closure; });
  if (!std::isnan(closure.value))
    result.facts.push_back({"closure residual", fmt::format("{:.2g} m", closure.value)});
  if (q.dynamic() && count(rows, Status::done) > 0) {
    // Two routes to the power of the drive, relative to the largest power of the sweep.
    const Peak power = peak(rows, [&](const Row& r) { return r.forces.drive_torque * r.rates.crank_speed; });
    const Peak residual = peak(rows, [&](const Row& r) {
      return r.forces.drive_torque * r.rates.crank_speed -
             energy_rate(s.mechanism.linkage, *s.mechanism.masses, r.rates, s.environment.gravity);
    });
    if (power.value != 0)
      result.facts.push_back({"power balance", fmt::format("within {:.2g} of the largest power",
                                                           std::abs(residual.value / power.value))});
  }
}

// Rows that the linkage does not reach, and where it could.
void warn_of_rows(study::Result& result, const ReactionsStudy& s, const FourBarBranch& branch,
                  const std::vector<Row>& rows) {
  const auto is = [](Status status) {
    return [status](const Row& r) { return r.status == status && !r.change_point; };
  };
  const auto first = [&](Status status) { return std::find_if(rows.begin(), rows.end(), is(status)); };
  const auto count = [&](Status status) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), is(status)));
  };
  const study::AddWarning warn{result.diagnostics};
  if (const std::size_t n = count(Status::singular)) {
    const double angle = first(Status::singular)->angle;
    warn(fmt::format(
             "{} of {} positions stand at a dead point, the first at a crank angle of {:.6g}°: speeds and "
             "forces are not determined there",
             n, rows.size(), math::degrees(angle)),
         {});
  }
  if (const std::size_t n = count(Status::no_assembly)) {
    const auto row = first(Status::no_assembly);
    std::string intervals;
    for (const AngleInterval& i : classify(s.mechanism.linkage).inputs)
      intervals += fmt::format("{}{:.4f}° to {:.4f}°", intervals.empty() ? "" : " and ",
                               math::degrees(i.from), math::degrees(i.to));
    warn(fmt::format(
             "the linkage does not assemble at {} of {} positions, the first at a crank angle of {:.6g}° "
             "where {} are missing",
             n, rows.size(), math::degrees(row->angle), s.units.text(row->pose.gap, Dimension::length)),
         intervals.empty() ? "it assembles nowhere: one link is longer than the others together"
                           : "it assembles from " + intervals);
  }
  if (const std::size_t n = count(Status::limit_reached))
    warn(fmt::format("{} of {} positions have no answer, the first at a crank angle of {:.6g}°: the motion "
                     "stops at a change point before them",
                     n, rows.size(), math::degrees(first(Status::limit_reached)->angle)),
         {});
  const AtChangePoint policy = s.sweep.at_change_point;
  for (const Row& row : rows)
    if (row.change_point && row.status != Status::done) {
      warn(fmt::format("at a crank angle of {:.6g}° {}", math::degrees(row.angle),
                       policy == AtChangePoint::keep_sign
                           ? "the motion has a kink: the row holds the position alone"
                           : "the joint forces grow without bound: the row holds what stays finite"),
           {});
      break;
    }
  for (const double angle : branch.change_points())
    warn(
        fmt::format("at a crank angle of {:.6g}° both branches meet and cross: which way the linkage goes on "
                    "there is a choice",
                    math::degrees(angle)),
        policy == AtChangePoint::smooth
            ? "the rows go on smoothly; sweep.at_change_point = \"keep_sign\" takes the other branch"
        : policy == AtChangePoint::keep_sign
            ? "the rows take the branch with a kink; sweep.at_change_point = \"smooth\" is the other"
            : "the rows end there");
}

}  // namespace

Table reactions_table(const ReactionsStudy& s) {
  std::vector<Row> rows;
  const FourBarBranch branch = branch_of(s);
  for (double angle : crank_angles(std::get<CrankGrid>(s.sweep.type).crank_angle))
    rows.push_back(evaluate(s, branch, angle));
  return sweep_table(s, rows);
}

study::Result run_reactions_study(const ReactionsStudy& s, RunContext& context) {
  study::Result result;
  std::vector<Row> rows;
  const CrankSamples& sweep = std::get<CrankGrid>(s.sweep.type).crank_angle;
  const std::vector<double> angles = crank_angles(sweep);
  rows.reserve(angles.size());
  const FourBarBranch branch = branch_of(s);
  Status interruption = Status::done;
  for (std::size_t i = 0; i < angles.size() && interruption == Status::done; ++i) {
    rows.push_back(evaluate(s, branch, angles[i]));
    if (i % 1024 == 1023) interruption = context.interruption();
  }
  const auto incomplete = std::find_if(
      rows.begin(), rows.end(), [](const Row& r) { return r.status != Status::done && !r.change_point; });
  result.status = interruption != Status::done ? interruption
                  : incomplete != rows.end()   ? incomplete->status
                                               : Status::done;
  result.tables.push_back(sweep_table(s, rows));
  result.scenes.push_back(motion_scene(s, rows));
  add_plots(result, s.quantities);
  add_facts(result, s, rows);
  warn_of_rows(result, s, branch, rows);

  const std::size_t good = count(rows, Status::done);
  if (good == 0) {
    result.headline =
        "No position of the sweep has an answer: the linkage does not assemble or stands at dead points.";
  } else if (s.quantities.dynamic()) {
    const Peak torque = peak(rows, [](const Row& r) { return r.forces.drive_torque; });
    Peak force;
    std::string_view joint;
    for (int k = 0; k < 4; ++k) {
      const Peak p = peak(rows, [k](const Row& r) { return std::abs(joint_force(r.forces, k)); });
      if (!(p.value <= force.value)) force = p, joint = joint_names[static_cast<std::size_t>(k)];
    }
    result.headline = fmt::format("The drive torque reaches {} and the joint forces {} in {}.",
                                  text(torque, "N m"), text(force, "N"), joint);
  } else {
    result.headline = fmt::format("{} of {} positions from {:.6g}° to {:.6g}° computed.", good, rows.size(),
                                  math::degrees(sweep.from), math::degrees(sweep.to));
  }
  if (good != 0 && good != rows.size())
    result.headline += fmt::format(" {} of {} positions have no answer.", rows.size() - good, rows.size());
  return result;
}

}  // namespace linkwright::planar
