// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/assembly_modes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <tuple>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/parallel/assembly_modes/platform_paths.h"
#include "linkwright/parallel/assembly_modes/platform_proof.h"
#include "linkwright/parallel/robot/robot.h"

namespace linkwright::parallel {
namespace {

constexpr double same_solution = 1e-8;  // distance of solutions that are one
constexpr double nearly_real = 1e-4;    // distance from the conjugate: worth a look among real poses
constexpr double way_to_pose = 1e-7;    // by the unit of length, rad: from there to the real pose
constexpr double same_singular = 1e-3;  // poses that are one where modes meet, known to half the digits
constexpr std::uint64_t start_seed = 2;

// A robot whose drives are held.
struct HeldRobot {
  const Robot& robot;
  std::span<const double> angles;
  double unit = 0;      // unit of length: mean rod
  PlatformLegs legs{};  // in that unit, seen from the first leg's joints
  Vec3 first_elbow;

  HeldRobot(const Robot& r, std::span<const double> a)
      : robot(r), angles(a), first_elbow(elbow(r.leg[0], a[0])) {
    for (const Leg& leg : robot.leg) unit += leg.rod / 6;
    for (int i = 0; i < 6; ++i) {
      const Leg& leg = robot.leg[i];
      const Vec3 base = (1 / unit) * (elbow(leg, angles[i]) - first_elbow);
      const Vec3 platform = (1 / unit) * (leg.platform - robot.leg[0].platform);
      const double b[] = {base.x, base.y, base.z}, p[] = {platform.x, platform.y, platform.z};
      for (int k = 0; k < 3; ++k) {
        legs.base[k].re[i] = b[k];
        legs.platform[k].re[i] = p[k];
      }
      const double first = i == 0 ? 0 : robot.leg[0].rod;
      legs.square.re[i] = (leg.rod - first) * (leg.rod + first) / (unit * unit);
    }
  }

  Pose pose(const std::array<double, 8>& x) const {
    const double w = x[0];
    const Vec3 v{x[1], x[2], x[3]}, h{x[5], x[6], x[7]};
    const double n = w * w + dot(v, v);
    const auto column = [&](const Vec3& b) {
      const Vec3 c = cross(v, b);
      return b + (2 / n) * (w * c + cross(v, c));
    };
    Pose out;
    out.rotation = transposed(Mat3{{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})}});
    const Vec3 shift = (1 / n) * (w * h - x[4] * v - cross(h, v));
    out.position = first_elbow + unit * shift - out.rotation * robot.leg[0].platform;
    return out;
  }
};

double between(const HeldRobot& held, const Pose& a, const Pose& b) {
  double out = norm(a.position - b.position) / held.unit;
  for (int i = 0; i < 3; ++i) out = std::max(out, norm(a.rotation.row[i] - b.rotation.row[i]));
  return out;
}

// The real mode at a distance of at most `way` from a point that is as good as real.
std::optional<AssemblyMode> mode_at(const HeldRobot& held, const std::array<double, 8>& x, double way) {
  const Pose start = held.pose(x);
  const Placed placed = direct_near(held.robot, held.angles, start);
  if (placed.status != Status::done || between(held, start, placed.pose) > way) return {};
  AssemblyMode out{.pose = placed.pose, .residual = placed.residual};
  const Jacobians at = jacobians(held.robot, out.pose, held.angles);
  out.determinant = determinant(held.robot, at);
  const auto output = quality(held.robot, at, platform_size(held.robot)).output;
  out.output = *std::min_element(output.begin(), output.end());
  return out;
}

// Made as real as it can be, with e of length 1.
std::array<double, 8> real_part(const PlatformPoint& x) {
  const auto largest = *std::max_element(x.begin(), x.begin() + 4, [](const Complex& a, const Complex& b) {
    return std::norm(a) < std::norm(b);
  });
  std::array<double, 8> out;
  double n = 0;
  for (int k = 0; k < 8; ++k) out[k] = (x[k] * std::conj(largest)).real();
  for (int k = 0; k < 4; ++k) n += out[k] * out[k];
  for (double& c : out) c /= std::sqrt(n);
  return out;
}

PlatformPoint as_point(const std::array<double, 8>& x) {
  PlatformPoint out;
  std::copy(x.begin(), x.end(), out.begin());
  return out;
}

// The generic platform in another form, which leads through other complex platforms to the same end: legs in
// another order, lengths times a complex number.
struct Start {
  PlatformLegs legs;
  std::vector<PlatformPoint> solutions;
};

Start start_for(std::uint64_t seed, std::uint32_t attempt) {
  static const SolvedPlatform generic = monodromy(start_seed);
  RandomStream random({seed, attempt});
  const Complex factor = std::polar(1.0, random.uniform(-pi, pi));
  Start out{scaled(generic.legs, factor), generic.solutions};
  for (PlatformPoint& x : out.solutions) x = scaled(x, factor);
  const auto swap = [&](Six& six, int i, int j) {
    std::swap(six.re[i], six.re[j]);
    std::swap(six.im[i], six.im[j]);
  };
  for (int i = 5; i > 1; --i) {  // the first leg keeps its place
    const int j = 1 + static_cast<int>(random.below(i));
    for (int k = 0; k < 3; ++k) {
      swap(out.legs.base[k], i, j);
      swap(out.legs.platform[k], i, j);
    }
    swap(out.legs.square, i, j);
  }
  return out;
}

bool knows(const std::vector<PlatformPoint>& solutions, const PlatformPoint& x,
           double within = same_solution) {
  return std::any_of(solutions.begin(), solutions.end(),
                     [&](const PlatformPoint& s) { return distance(s, x) < within; });
}

struct Found {
  std::vector<PlatformPoint> solutions, singular_ends;
  int infinite = 0, singular = 0, lost = 0;  // paths of the last attempt
  int paths = 0, ways = 0;
  bool conjugate_closed = true;

  void follow_all(const HeldRobot& held, const Start& start, double accuracy) {
    infinite = singular = lost = 0;
    ++ways;
    for (const PlatformPoint& x : start.solutions) {
      PlatformPath path = follow(start.legs, held.legs, x, accuracy);
      ++paths;
      // An end that cannot be proved to be simple is one of a set, unless it is nearly at infinity.
      if (path.end == PathEnd::regular && !prove(held.legs, path.point).unique &&
          !nearly_infinite(path.point))
        path.end = PathEnd::singular;
      if (path.end == PathEnd::regular && !knows(solutions, path.point)) solutions.push_back(path.point);
      if (path.end == PathEnd::singular) singular_ends.push_back(path.point);
      infinite += path.end == PathEnd::infinite;
      singular += path.end == PathEnd::singular;
      lost += path.end == PathEnd::lost;
    }
  }

  // Conjugates of solutions solve a real platform, too.
  void close() {
    const std::size_t followed = solutions.size();
    conjugate_closed = true;
    for (std::size_t i = 0; i < followed; ++i) {
      const PlatformPoint other = conjugate(solutions[i]);
      if (knows(solutions, other)) continue;
      conjugate_closed = false;
      solutions.push_back(other);
    }
  }
};

Found find(const HeldRobot& held, const AssemblyModesOptions& options) {
  Found out;
  std::size_t before = 0;
  double accuracy = 1e-4;
  for (int attempt = 0; attempt < options.attempts; ++attempt, accuracy /= 10) {
    out.follow_all(held, start_for(options.seed, attempt), accuracy);
    if (out.solutions.size() >= max_solutions) break;
    if (attempt > 0 && out.solutions.size() == before && out.lost == 0) break;
    before = out.solutions.size();
  }
  out.close();
  return out;
}

void prove_all(const HeldRobot& held, const std::vector<PlatformPoint>& points, std::size_t real,
               AssemblyModes& out) {
  std::vector<PlatformProof> proofs;
  bool decided = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    PlatformProof proof = prove(held.legs, points[i]);
    bool good = proof.unique && proof.finite;
    for (std::size_t j = 0; j < i && good; ++j)
      good = !proofs[j].unique || apart(points[i], proof, points[j], proofs[j]);
    if (!good) proof = {};
    proofs.push_back(proof);
    out.certified += good;
    if (i < real) out.modes[i].certified = good && proof.real;
    decided = decided && (i < real ? proof.real : proof.complex);
  }
  out.complete = decided && out.certified == static_cast<int>(max_solutions);
}

std::string note_on(const AssemblyModes& found, const Found& how) {
  if (found.finite >= static_cast<int>(max_solutions)) return {};
  std::string out = fmt::format("{} of 40 complex solutions were found", found.finite);
  if (how.infinite > 0) out += fmt::format("; {} paths went off to infinity", how.infinite);
  if (how.singular > 0) out += fmt::format("; {} paths met others at the end (singular)", how.singular);
  if (how.lost > 0) out += fmt::format("; {} paths were lost on the way", how.lost);
  return out + fmt::format(" (attempt {})", how.ways);
}

}  // namespace

AssemblyModes assembly_modes(const Robot& hexa, std::span<const double> arm_angles,
                             const AssemblyModesOptions& options) {
  LINKWRIGHT_REQUIRE(hexa.freedom == Freedom::space, "the robot has {} legs", hexa.legs());
  LINKWRIGHT_REQUIRE(!problem(hexa), "{}", *problem(hexa));
  LINKWRIGHT_REQUIRE(arm_angles.size() == 6, "{} arm angles", arm_angles.size());
  for (const double angle : arm_angles) LINKWRIGHT_REQUIRE(std::isfinite(angle), "arm angle {}", angle);
  LINKWRIGHT_REQUIRE(options.attempts > 0, "{} attempts", options.attempts);

  const HeldRobot held(hexa, arm_angles);
  Found found = find(held, options);
  AssemblyModes out;
  std::vector<std::pair<AssemblyMode, PlatformPoint>> real;
  std::vector<PlatformPoint> others;
  const auto take = [&](const PlatformPoint& x, double how_real, double way, double apart) {
    if (distance(x, conjugate(x)) > how_real) return false;
    const auto mode = mode_at(held, real_part(x), way);
    if (!mode || std::any_of(real.begin(), real.end(), [&](const auto& known) {
          return between(held, known.first.pose, mode->pose) < apart;
        }))
      return false;
    real.emplace_back(*mode, as_point(real_part(x)));
    return true;
  };
  for (const PlatformPoint& x : found.solutions)
    if (!take(x, nearly_real, way_to_pose, same_solution)) others.push_back(x);
  out.finite = static_cast<int>(real.size() + others.size());
  // Modes that coincide are known to half the digits: one of them stands for all.
  for (const PlatformPoint& x : found.singular_ends) take(x, same_singular, same_singular, same_singular);
  const auto height = [](const AssemblyMode& m) {
    const Vec3& p = m.pose.position;
    return std::tuple(p.z, p.x, p.y);
  };
  std::sort(real.begin(), real.end(),
            [&](const auto& a, const auto& b) { return height(a.first) < height(b.first); });
  std::vector<PlatformPoint> points;
  for (const auto& [mode, point] : real) {
    out.modes.push_back(mode);
    points.push_back(point);
  }
  points.insert(points.end(), others.begin(), others.end());
  out.real = static_cast<int>(real.size());
  out.paths = found.paths;
  out.infinite = found.infinite;
  out.singular = found.singular;
  out.conjugate_closed = found.conjugate_closed;
  prove_all(held, points, real.size(), out);
  if (constexpr int all = max_solutions; out.finite < all) {
    const bool explained = found.lost == 0 && out.finite + found.infinite + found.singular >= all;
    if (!explained || found.ways < 2)
      out.status = Status::not_converged;
    else if (found.singular > 0)
      out.status = Status::singular;
  }
  out.note = note_on(out, found);
  return out;
}

}  // namespace linkwright::parallel
