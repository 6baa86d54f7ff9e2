// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/linear_forces.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {
namespace {

// Four masses of a link that exist, whose forces make up its columns: a point at the own joint, points at
// `length` along and across the link line, and inertia without mass.
std::array<LinkMass, 4> probes(double length) {
  return {{{.mass = 1},
           {.mass = 1, .centre_distance = length},
           {.mass = 1, .centre_distance = length, .centre_angle = pi / 2},
           {.inertia = 1}}};
}

// From the forces of each probe on each link, when nothing else has mass or load: component c at sample i of
// probe k is at [k][c n + i].
void fill_factors(LinearForces& forces, double length, const std::vector<std::vector<double>>& probed) {
  const std::size_t n = forces.samples;
  for (std::size_t c = 0; c < forces.components.size(); ++c) {
    std::vector<double>& factors = forces.components[c].factors;
    factors.resize(probed.size() * n);
    for (std::size_t k = 0; k < probed.size(); k += 4)
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = [&](std::size_t probe) { return probed[k + probe][c * n + i]; };
        const double still = at(0) + length * length * at(3);
        double* out = factors.data() + k * n + i;
        out[0] = at(0);
        out[n] = (at(1) - still) / length;
        out[2 * n] = (at(2) - still) / length;
        out[3 * n] = at(3);
      }
  }
}

void set_names(LinearForces& forces, std::vector<std::string> names) {
  for (std::string& name : names)
    forces.components.push_back({std::move(name), {}, std::vector<double>(forces.samples)});
}

void note_failure(LinearForces& forces, Status status, std::size_t sample) {
  if (status == Status::done || forces.status != Status::done) return;
  forces.status = status;
  forces.failed_sample = sample;
}

}  // namespace

std::vector<const LinearComponent*> quantity(const LinearForces& forces, std::string_view name) {
  const auto find = [&](std::string_view wanted) -> const LinearComponent* {
    for (const LinearComponent& c : forces.components)
      if (c.name == wanted) return &c;
    return nullptr;
  };
  if (const LinearComponent* found = find(name)) return {found};
  if (name.ends_with("_N")) {
    const std::string stem(name.substr(0, name.size() - 2));
    const LinearComponent *x = find(stem + "_x_N"), *y = find(stem + "_y_N");
    if (x && y) return {x, y};
  }
  std::string known;
  for (const LinearComponent& c : forces.components) known += (known.empty() ? "" : ", ") + c.name;
  LINKWRIGHT_REQUIRE(false, "there is no quantity '{}'; there are {}, and magnitudes like O1_N", name, known);
  return {};
}

std::vector<double> values(const LinearForces& forces, std::string_view name,
                           std::span<const BaseParameters> links) {
  LINKWRIGHT_REQUIRE(links.size() == forces.links.size(), "{} base parameters for {} links", links.size(),
                     forces.links.size());
  const std::size_t n = forces.samples;
  const auto parts = quantity(forces, name);
  std::vector<double> out;
  for (const LinearComponent* part : parts) {
    std::vector<double> sum = part->constant;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const double p[] = {links[k].mass, links[k].moment.real(), links[k].moment.imag(), links[k].inertia};
      for (std::size_t j = 0; j < base_parameter_count; ++j) {
        const double* column = part->factors.data() + (base_parameter_count * k + j) * n;
        for (std::size_t i = 0; i < n; ++i) sum[i] += column[i] * p[j];
      }
    }
    if (parts.size() == 1) return sum;
    if (out.empty()) out.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) out[i] = std::hypot(out[i], sum[i]);
  }
  return out;
}

LinearForces linear_forces(const FourBarMachine& machine, double gravity, const SweepInput& crank) {
  LinearForces forces{.samples = crank.value.size(),
                      .links = {"crank", "coupler", "rocker"},
                      .initial = {machine.masses.crank, machine.masses.coupler, machine.masses.rocker}};
  set_names(forces, {"O1_x_N", "O1_y_N", "O2_x_N", "O2_y_N", "O3_x_N", "O3_y_N", "O4_x_N", "O4_y_N",
                     "O1_drive_torque_N_m", "shaking_force_x_N", "shaking_force_y_N", "shaking_moment_N_m",
                     "shaking_moment_with_drive_N_m"});
  FourBarSweep sweep({.directions = false, .rates = false});
  const double length = machine.linkage.ground;
  std::vector<std::vector<double>> probed;
  for (std::size_t link = 0; link < 3; ++link)
    for (const LinkMass& probe : probes(length)) {
      FourBarMasses masses;
      (link == 0 ? masses.crank : link == 1 ? masses.coupler : masses.rocker) = probe;
      sweep.run(machine.linkage, masses, gravity, crank);
      probed.emplace_back();
      for (std::size_t c = 0; c < forces.components.size(); ++c) {
        const std::span<const double> row =
            sweep.row(static_cast<FourBarRow>(static_cast<std::size_t>(FourBarRow::ground_on_crank_x) + c));
        probed.back().insert(probed.back().end(), row.begin(), row.end());
      }
    }
  fill_factors(forces, length, probed);
  for (std::size_t i = 0; i < forces.samples; ++i) note_failure(forces, sweep.status()[i], i);
  return forces;
}

LinearForces linear_forces(const SerialArm& arm, std::span<const math::Motion> motion, double gravity) {
  const std::vector<ArmElement> own = elements(arm);
  const std::size_t n = own.size();
  LINKWRIGHT_REQUIRE(motion.size() % n == 0 && !motion.empty(), "{} motions for {} links", motion.size(), n);
  LinearForces forces{.samples = motion.size() / n};
  std::vector<std::string> names;
  std::vector<ArmElement> bare = own;
  for (std::size_t k = 0; k < n; ++k) {
    const std::string joint = fmt::format("O{}", k + 1), link = fmt::format("link{}", k + 1);
    for (const char* key : {"_x_N", "_y_N"}) names.push_back(joint + key);
    for (const char* key : {"_torque_absolute_N_m", "_torque_joint_N_m"}) names.push_back(link + key);
    forces.links.push_back(link);
    forces.initial.push_back(arm.links[k].body);
    bare[k].base = base_parameters({}, arm.links[k].attached);
  }
  set_names(forces, std::move(names));
  std::vector<ArmLinkRates> rate(n);
  std::vector<ArmJointLoads> loads(n);
  const auto run = [&](std::span<const ArmElement> of, auto&& keep) {
    for (std::size_t i = 0; i < forces.samples; ++i) {
      rates(of, arm.base, motion.subspan(i * n, n), rate);
      reactions(of, rate, gravity, loads);
      for (std::size_t k = 0; k < n; ++k) {
        const double numbers[] = {loads[k].force.real(), loads[k].force.imag(), loads[k].absolute_torque,
                                  loads[k].joint_torque};
        for (std::size_t c = 0; c < 4; ++c) keep(4 * k + c, i, numbers[c]);
      }
    }
  };
  run(bare, [&](std::size_t c, std::size_t i, double v) { forces.components[c].constant[i] = v; });
  const double length = own[0].length;
  std::vector<std::vector<double>> probed;
  for (std::size_t link = 0; link < n; ++link)
    for (const LinkMass& probe : probes(length)) {
      std::vector<ArmElement> alone = own;
      for (ArmElement& e : alone) e.base = {};
      alone[link].base = base_parameters(probe);
      std::vector<double>& out = probed.emplace_back(forces.components.size() * forces.samples);
      run(alone, [&](std::size_t c, std::size_t i, double v) { out[c * forces.samples + i] = v; });
    }
  fill_factors(forces, length, probed);
  return forces;
}

namespace {

// Throws ContractError if forces are not linear in the masses.
void require_linear(const Linkage& linkage, const LinkagePlan& plan) {
  for (const LinkageJoint& j : linkage.joints)
    LINKWRIGHT_REQUIRE(j.efficiency == 1,
                       "gear '{}' has losses, with which forces are not linear in the masses", j.name);
  for (const LinkageJoint& j : linkage.joints)
    LINKWRIGHT_REQUIRE(!has_friction(j),
                       "joint '{}' has friction, with which forces are not linear in the masses", j.name);
  for (const LinkageJoint& j : linkage.joints)
    LINKWRIGHT_REQUIRE((j.type != JointType::rack && !j.curve) || j.pressure_angle == 0,
                       "'{}' has a pressure angle, with which forces are not linear in the masses", j.name);
  for (const Group& g : plan.groups)
    for (const PlanGear& gear : g.gears)
      LINKWRIGHT_REQUIRE(!gear.mesh || gear.mesh->tangent == 0,
                         "gear '{}' has a pressure angle, with which forces are not linear in the masses",
                         linkage.joints[static_cast<std::size_t>(gear.joint)].name);
}

std::vector<std::string> component_names(const Linkage& linkage, const LinkagePlan& plan) {
  std::vector<std::string> names;
  for (const LinkageJoint& j : linkage.joints) {
    const std::string key = identifier(j.name);
    names.insert(names.end(), {key + "_x_N", key + "_y_N", key + "_moment_N_m"});
  }
  for (std::size_t k = 0; k < plan.inputs(); ++k)
    names.push_back(identifier(input_joint(linkage, k).name) +
                    (plan.rotary[k] ? "_drive_torque_N_m" : "_drive_force_N"));
  names.insert(names.end(), {"shaking_force_x_N", "shaking_force_y_N", "shaking_moment_N_m",
                             "shaking_moment_with_drive_N_m"});
  return names;
}

}  // namespace

LinearForces linear_forces(const Linkage& linkage, const LinkagePlan& plan, std::span<const int> bodies,
                           std::span<const InputMotion> inputs, std::span<const double> times) {
  const std::size_t width = plan.inputs();
  LINKWRIGHT_REQUIRE(plan.bodies.size() == linkage.bodies.size(),
                     "the plan is of {} bodies, the linkage has {}", plan.bodies.size(),
                     linkage.bodies.size());
  LINKWRIGHT_REQUIRE(width > 0 && !inputs.empty() && inputs.size() % width == 0, "{} motions for {} inputs",
                     inputs.size(), width);
  LinearForces forces{.samples = inputs.size() / width};
  LINKWRIGHT_REQUIRE(times.empty() || times.size() == forces.samples, "{} times for {} samples", times.size(),
                     forces.samples);
  require_linear(linkage, plan);

  // `rest` is the linkage without the open masses, `bare` the linkage without any mass or load.
  Linkage rest = linkage, bare = linkage;
  for (const int b : bodies) {
    LINKWRIGHT_REQUIRE(b > 0 && static_cast<std::size_t>(b) < linkage.bodies.size(),
                       "body {} of {} has no mass to choose", b, linkage.bodies.size());
    const LinkageBody& body = linkage.bodies[static_cast<std::size_t>(b)];
    const BodyMass mass = body.mass.value_or(BodyMass{});
    LINKWRIGHT_REQUIRE(std::find(forces.links.begin(), forces.links.end(), body.name) == forces.links.end(),
                       "body '{}' is given twice", body.name);
    forces.links.push_back(body.name);
    forces.initial.push_back({mass.mass, mass.inertia, std::abs(mass.centre), std::arg(mass.centre)});
    rest.bodies[static_cast<std::size_t>(b)].mass = BodyMass{};
  }
  for (std::size_t b = 1; b < linkage.bodies.size(); ++b) {
    LINKWRIGHT_REQUIRE(rest.bodies[b].mass || plan.bodies[b].part == 0, "body '{}' has no mass",
                       linkage.bodies[b].name);
    bare.bodies[b].mass = BodyMass{};
    bare.bodies[b].attached.clear();
  }
  bare.springs.clear();
  bare.torsion_springs.clear();
  bare.forces.clear();
  bare.torques.clear();
  bare.struts.clear();
  bare.stops.clear();

  set_names(forces, component_names(linkage, plan));

  // One linkage a probe; the first is what stays.
  std::vector<Linkage> linkages = {rest};
  for (const int b : bodies)
    for (const LinkMass& probe : probes(plan.size)) {
      linkages.push_back(bare);
      linkages.back().bodies[static_cast<std::size_t>(b)].mass =
          BodyMass{probe.mass, probe.inertia, probe.centre_distance * std::polar(1.0, probe.centre_angle)};
    }
  std::vector<std::vector<PartMass>> masses;
  for (const Linkage& l : linkages) masses.push_back(part_masses(l, plan.bodies, plan.parts.size()));
  LinkagePlan massive = plan;
  massive.has_masses = true;
  massive.massless.clear();
  LinkageMotion motion(plan);
  LinkageForces f;
  const std::size_t n = forces.samples;
  std::vector<std::vector<double>> probed(linkages.size(), std::vector<double>(forces.components.size() * n));
  for (std::size_t i = 0; i < n; ++i) {
    solve_motion(plan, inputs.subspan(i * width, width), motion);
    for (std::size_t k = 0; k < linkages.size(); ++k) {
      massive.masses = masses[k];
      solve_forces(linkages[k], massive, motion, times.empty() ? 0 : times[i], inputs[i * width].value, f);
      double* out = probed[k].data() + i;
      const auto keep = [&](double v) { *std::exchange(out, out + n) = v; };
      for (const JointReaction& r : f.joints)
        for (const double v : {r.force.x, r.force.y, r.moment}) keep(v);
      for (const double v : f.drives) keep(v);
      for (const double v :
           {f.shaking_force.x, f.shaking_force.y, f.shaking_moment, f.shaking_moment_with_drive})
        keep(v);
    }
    note_failure(forces, f.status, i);
  }
  for (std::size_t c = 0; c < forces.components.size(); ++c)
    forces.components[c].constant.assign(probed[0].begin() + static_cast<std::ptrdiff_t>(c * n),
                                         probed[0].begin() + static_cast<std::ptrdiff_t>((c + 1) * n));
  probed.erase(probed.begin());
  fill_factors(forces, plan.size, probed);
  return forces;
}

}  // namespace linkwright::planar
