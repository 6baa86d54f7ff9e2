// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/pose_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/dyads/family.h"
#include "linkwright/planar/dyads/solve.h"

namespace linkwright::planar {
namespace {

constexpr std::uint64_t chosen_from = 20261129;
constexpr int fives = 40;  // sets of five poses of more, each of which is met exactly
constexpr int slides_of_three = 40;
constexpr std::size_t most_pairs = 800;  // of a crank and another dyad that are looked at

BodyPose pose_at(const MotionTarget& target, std::size_t k) {
  return {.origin = {target.x[k], target.y[k]}, .angle = target.angle[k]};
}

/// The poses, which are sampled once or several times, one after the other.
std::vector<BodyPose> poses_of(const MotionTarget& target) {
  std::vector<BodyPose> out;
  for (std::size_t k = 0; k < target.count; ++k) {
    const BodyPose pose = pose_at(target, k);
    if (out.empty() || pose.origin != out.back().origin || pose.angle != out.back().angle)
      out.push_back(pose);
  }
  return out;
}

std::optional<GuidingDyadType> partner_of(MachineFamily family) {
  switch (family) {
    case MachineFamily::four_bar:
      return GuidingDyadType::rr;
    case MachineFamily::slider_crank:
      return GuidingDyadType::pr;
    case MachineFamily::inverted_slider:
      return GuidingDyadType::rp;
    default:
      return std::nullopt;
  }
}

/// A crank and the other dyad of its machine.
using DyadPair = std::array<GuidingDyad, 2>;

/// All pairs of dyads that hold the body in the same poses, or as many as are looked at by chance.
void add_pairs(const std::vector<GuidingDyad>& dyads, GuidingDyadType partner, RandomStream& random,
               std::vector<DyadPair>& out) {
  std::vector<GuidingDyad> cranks, partners;
  for (const GuidingDyad& dyad : dyads) {
    if (dyad.type == GuidingDyadType::rr) cranks.push_back(dyad);
    if (dyad.type == partner) partners.push_back(dyad);
  }
  if (cranks.empty() || partners.empty()) return;
  const auto is_same = [](const GuidingDyad& a, const GuidingDyad& b) {
    return a.type == b.type && a.fixed == b.fixed && a.moving == b.moving;
  };
  const auto add = [&](const GuidingDyad& crank, const GuidingDyad& other) {
    if (!is_same(crank, other)) out.push_back({crank, other});
  };
  if (cranks.size() * partners.size() <= most_pairs) {
    for (const GuidingDyad& crank : cranks)
      for (const GuidingDyad& other : partners) add(crank, other);
    return;
  }
  const auto one_of = [&](const std::vector<GuidingDyad>& list) {
    return list[random.below(static_cast<std::uint32_t>(list.size()))];
  };
  for (std::size_t k = 0; k < most_pairs; ++k) {
    const GuidingDyad crank = one_of(cranks);
    add(crank, one_of(partners));
  }
}

/// Slides through three poses: four have one, and so a fourth is taken at random.
void add_slides(std::vector<BodyPose> poses, GuidingDyadType type, RandomStream& random,
                std::vector<GuidingDyad>& out) {
  const BodyPose from = poses[0], to = poses[2];
  poses.emplace_back();
  for (int k = 0; k < slides_of_three; ++k) {
    const double share = random.uniform(-0.5, 1.5);
    poses[3] = {.origin = from.origin + share * (to.origin - from.origin) +
                          0.5 * std::complex<double>(random.normal(), random.normal()),
                .angle = from.angle + share * (to.angle - from.angle) + 0.5 * random.normal()};
    if (const std::optional<GuidingDyad> slide = slide_dyad(poses, type)) out.push_back(*slide);
  }
}

std::vector<DyadPair> pairs_of(const std::vector<BodyPose>& poses, GuidingDyadType partner,
                               const RunContext& context) {
  RandomStream random({.seed = chosen_from});
  std::vector<DyadPair> out;
  if (poses.size() < 3) return out;  // any hinge at the pole of the rotation meets two
  if (poses.size() <= 5) {
    std::vector<GuidingDyad> dyads = dyad_family(poses, {}, {}).dyads;
    if (poses.size() == 3 && partner != GuidingDyadType::rr) add_slides(poses, partner, random, dyads);
    add_pairs(dyads, partner, random, out);
    return out;
  }
  add_pairs(fit_dyads(poses).dyads, partner, random, out);
  for (int k = 0; k < fives && !context.interrupted(); ++k) {
    std::vector<BodyPose> left = poses, chosen;
    while (chosen.size() < 5) {
      const auto at = random.below(static_cast<std::uint32_t>(left.size()));
      chosen.push_back(left[at]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    const GuidingDyads solved = solve_dyads(chosen);
    add_pairs({solved.real().begin(), solved.real().end()}, partner, random, out);
  }
  return out;
}

/// The machine of a pair: parameters and signs on the branch of the first pose; none of pairs that are no
/// machine.
std::optional<FittedMachine> machine_of(const DyadPair& pair, MachineFamily family, const BodyPose& first) {
  const auto& [crank, other] = pair;
  const std::complex<double> pin = place(first, crank.moving), plate = other.moving - crank.moving;
  std::complex<double> along;  // of the real axis of the machine in the plane
  if (family == MachineFamily::slider_crank) {
    along = std::complex<double>(0, 1) * other.normal;
    if (((place(first, other.moving) - pin) * std::conj(along)).real() < 0) along = -along;
  } else {
    along = other.fixed - crank.fixed;
  }
  if (!(std::abs(along) > 0) || !(crank.length > 0)) return std::nullopt;
  const std::complex<double> scale = crank.length * along / std::abs(along);
  FittedMachine out;
  out.shape.program = programs_of(family).front();
  std::vector<double>& x = out.shape.x;
  std::complex<double> traced;
  bool second_side = false;
  const double ground = std::abs(along) / crank.length;
  if (family == MachineFamily::inverted_slider) {
    // The rod lies along the line of the body that passes the sleeve.
    std::complex<double> rod = std::complex<double>(0, -1) * other.normal;
    const std::complex<double> sleeve =
        std::polar(1.0, -first.angle) * (other.fixed - first.origin) - crank.moving;
    // Its direction is that from the crank pin to the sleeve.
    if ((std::conj(rod) * sleeve).real() < 0) rod = -rod;
    x = {ground, -(std::conj(rod) * sleeve).imag() / crank.length};
    traced = -crank.moving / rod / crank.length;
  } else {
    if (!(std::abs(plate) > 0)) return std::nullopt;
    traced = -crank.moving / plate;
    const std::complex<double> end = place(first, other.moving);
    if (family == MachineFamily::slider_crank) {
      x = {std::abs(plate) / crank.length, ((end - crank.fixed) / scale).imag()};
    } else {
      x = {ground, std::abs(plate) / crank.length, other.length / crank.length};
      second_side = ((end - pin) / (other.fixed - pin)).imag() < 0;
    }
  }
  x.insert(x.end(), {traced.real(), traced.imag(), crank.fixed.real(), crank.fixed.imag(), scale.real(),
                     scale.imag()});
  out.shape.signs = second_side ? 1u : 0u;
  if (!std::all_of(x.begin(), x.end(), [](double v) { return std::abs(v) < 1e9; })) return std::nullopt;
  return out;
}

/// Turns the crank to the samples, in the sense in which that takes the smaller rotation.
void turn_crank(const MotionTarget& target, const GuidingDyad& crank, FittedMachine& machine) {
  const auto s = static_cast<std::size_t>(machine.shape.program->scale());
  const std::complex<double> scale{machine.shape.x[s], machine.shape.x[s + 1]};
  double forward = 0, backward = 0;
  const auto angle_at = [&](std::size_t k) {
    return std::arg((place(pose_at(target, k), crank.moving) - crank.fixed) / scale);
  };
  // A sample that is there twice is no turn, nor is one that a rounding puts before the last one.
  const auto turned = [](double by) { return by - 2 * pi * std::floor((by + 1e-9) / (2 * pi)); };
  for (std::size_t k = 1; k < target.count; ++k) {
    const double by = angle_at(k) - angle_at(k - 1);
    forward += turned(by), backward += turned(-by);
  }
  machine.sense = forward <= backward ? 1 : -1;
  machine.angle[0] = angle_at(0);
  for (std::size_t k = 1; k < target.count; ++k)
    machine.angle[k] =
        machine.angle[k - 1] + machine.sense * turned(machine.sense * (angle_at(k) - angle_at(k - 1)));
  std::fill(machine.angle.begin() + static_cast<std::ptrdiff_t>(target.count), machine.angle.end(),
            machine.angle[target.count - 1]);
}

}  // namespace

std::vector<FittedMachine> pose_starts(const MotionTarget& target, const MachineLimits& limits,
                                       MachineFamily family, std::size_t count, const RunContext& context) {
  LINKWRIGHT_REQUIRE(target.oriented && !target.timed && target.output == MachineOutput::point,
                     "dyads are found for poses at any crank angles");
  const std::optional<GuidingDyadType> partner = partner_of(family);
  if (!partner) return {};
  MachineFitter fitter(target, limits);
  std::vector<std::pair<double, FittedMachine>> found;
  for (const DyadPair& pair : pairs_of(poses_of(target), *partner, context)) {
    if (context.interrupted()) break;
    std::optional<FittedMachine> machine = machine_of(pair, family, pose_at(target, 0));
    if (!machine) continue;
    turn_crank(target, pair[0], *machine);
    fitter.turn_body(*machine);
    FittedMachine measured = *machine;
    const MachineMeasures m = fitter.measure(measured);
    // Of machines that are as near, those come first that have least to be bent into the limits.
    const double beyond = std::max(0.0, limits.min_pair_angle - m.min_pair_angle) +
                          std::max(0.0, std::log(m.max_length / limits.max_length)) +
                          std::max(0.0, std::log(limits.min_length / std::max(m.min_length, 1e-12)));
    if (const double score = m.error + beyond; std::isfinite(score)) found.emplace_back(score, *machine);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FittedMachine> out;
  for (std::size_t i = 0; i < std::min(count, found.size()); ++i) out.push_back(std::move(found[i].second));
  return out;
}

}  // namespace linkwright::planar
