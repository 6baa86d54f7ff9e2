// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/mixed_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <type_traits>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/exact/detail/path_systems.h"
#include "linkwright/planar/exact/detail/solve_points.h"

namespace linkwright::planar {
namespace {

// Poses in their order, then points: places in the list of all.
struct PosesFirst {
  std::vector<std::size_t> order;
  std::size_t poses = 0;
};
PosesFirst poses_first(const MixedPoses& target) {
  PosesFirst out;
  for (const bool angle : {true, false})
    for (std::size_t k = 0; k < target.poses.size(); ++k)
      if (target.demands[k].angle == angle) {
        out.order.push_back(k);
        out.poses += angle;
      }
  return out;
}

std::complex<double> seen_from_body(const std::complex<double>& place, const BodyPose& pose) {
  return place * std::polar(1.0, -pose.angle);
}

GuidingDyad link(const std::complex<double>& pin, const std::complex<double>& pivot, const BodyPose& first) {
  GuidingDyad out;
  out.type = GuidingDyadType::rr;
  out.fixed = first.origin + pivot;
  out.moving = seen_from_body(pin, first);
  out.length = std::abs(pin - pivot);
  return out;
}

template <class System>
std::array<GuidingDyad, 2> dyads_of(const SystemPoint<System>& z, const BodyPose& first) {
  const auto place = [&](std::size_t i) { return real_place<System>(z, i); };
  if constexpr (std::is_same_v<System, FourBarPoses>) {
    return {link(place(pin_x), place(pivot_a), first), link(place(pin_y), place(pivot_b), first)};
  } else {
    const std::complex<double> normal = std::polar(1.0, 0.5 * std::arg(standard_complex(z[guide_nu]))),
                               y = place(slider_y);
    GuidingDyad slide;
    if constexpr (std::is_same_v<System, SliderPoses>) {
      slide.type = GuidingDyadType::pr;
      slide.moving = seen_from_body(y, first);
      slide.normal = normal;
      slide.offset = (std::conj(normal) * (first.origin + y)).real();
    } else {
      slide.type = GuidingDyadType::rp;
      slide.fixed = first.origin + y;
      slide.normal = seen_from_body(normal, first);
      slide.offset = (std::conj(normal) * y).real();
    }
    return {link(place(slider_x), place(slider_a), first), slide};
  }
}

template <class C, class System>
struct CurveOf;
template <class C, template <class> class Curve, class Bars>
struct CurveOf<C, PosesAndPoints<Curve, Bars>> {
  using Type = Curve<C>;
};

template <class System>
void solve_mixed(const MixedPoses& target, MixedPoseSolutions& out, RunContext& context) {
  const PosesFirst sorted = poses_first(target);
  const BodyPose& first = target.poses[sorted.order[0]];
  const System system{.poses = sorted.poses - 1};
  const auto starts = kept_starts<System>(static_cast<std::size_t>(out.whole), context, system);
  if (starts->status != Status::done) {
    out.status = starts->status;
    return;
  }
  SystemData<System> data{};
  double size = 0;
  for (std::size_t j = 1; j < sorted.order.size(); ++j) {
    const BodyPose& pose = target.poses[sorted.order[j]];
    data[j - 1] = complex_number(pose.origin - first.origin);
    data[System::half + j - 1] = math::conj(data[j - 1]);
    size = std::max(size, std::abs(pose.origin - first.origin));
    if (j < sorted.poses)
      data[2 * System::half + j - 1] = complex_number(std::polar(1.0, pose.angle - first.angle));
  }
  const PointSolutions<System> solutions = solve_points<System>(*starts, data, context, "solutions", system);
  solutions.count(out);
  for (const SystemPoint<System>& z : solutions.found) {
    if (!is_real_solution<System>(z, size)) continue;
    const auto [one, other] = dyads_of<System>(z, first);
    GuidedPair pair{one, other, {target.poses.begin(), target.poses.end()}};
    for (std::size_t j = sorted.poses; j < sorted.order.size(); ++j) {
      const typename CurveOf<ComplexNumber, System>::Type curve(z.data(), data[j - 1],
                                                                data[System::half + j - 1]);
      BodyPose& point = pair.poses[sorted.order[j]];
      const double turned = first.angle + std::arg(real_turn(curve));
      point.angle += math::wrap_angle(turned - point.angle);
    }
    out.real.push_back(std::move(pair));
  }
  sort_by_place(out.real, [](const GuidedPair& s) { return s.first.moving; });
}

}  // namespace

std::span<const MixedPoseLinkage> linkages_of(const MixedPoses& target) {
  static constexpr MixedPoseLinkage all[] = {MixedPoseLinkage::four_bar, MixedPoseLinkage::slider_crank,
                                             MixedPoseLinkage::inverted_slider_crank};
  const std::size_t poses = poses_first(target).poses, points = target.poses.size() - poses;
  if (poses < 2 || points == 0) return {};
  const std::size_t conditions = 2 * (poses - 1) + points;
  if (conditions == four_bar_unknowns) return std::span(all).first(1);
  if (conditions == slider_crank_unknowns) return std::span(all).last(2);
  return {};
}

std::size_t mixed_pose_solutions(MixedPoseLinkage linkage, std::size_t poses) {
  constexpr std::size_t solutions[][3] = {{1112, 201, 30}, {202, 42, 6}, {448, 56, 6}};
  LINKWRIGHT_REQUIRE(poses >= 2 && poses <= 4, "{} poses", poses);
  return solutions[static_cast<std::size_t>(linkage)][poses - 2];
}

MixedPoseSolutions solve_mixed_poses(const MixedPoses& target, MixedPoseLinkage linkage,
                                     RunContext& context) {
  LINKWRIGHT_REQUIRE(target.demands.size() == target.poses.size(), "{} demands for {} poses",
                     target.demands.size(), target.poses.size());
  const auto finite = linkages_of(target);
  LINKWRIGHT_REQUIRE(std::find(finite.begin(), finite.end(), linkage) != finite.end(),
                     "{} poses and points have no finite number of these linkages", target.poses.size());
  for (std::size_t i = 0; i < target.poses.size(); ++i) {
    LINKWRIGHT_REQUIRE(
        std::isfinite(std::abs(target.poses[i].origin)) && std::isfinite(target.poses[i].angle),
        "pose {} is not finite", i + 1);
    // Two poses may differ by their rotation alone.
    for (std::size_t j = 0; j < i; ++j)
      LINKWRIGHT_REQUIRE(target.poses[i].origin != target.poses[j].origin ||
                             (target.demands[i].angle && target.demands[j].angle),
                         "point {} repeats point {}", i + 1, j + 1);
  }
  MixedPoseSolutions out;
  out.whole = static_cast<int>(mixed_pose_solutions(linkage, poses_first(target).poses));
  switch (linkage) {
    case MixedPoseLinkage::four_bar:
      solve_mixed<FourBarPoses>(target, out, context);
      break;
    case MixedPoseLinkage::slider_crank:
      solve_mixed<SliderPoses>(target, out, context);
      break;
    case MixedPoseLinkage::inverted_slider_crank:
      solve_mixed<InvertedPoses>(target, out, context);
      break;
  }
  return out;
}

}  // namespace linkwright::planar
