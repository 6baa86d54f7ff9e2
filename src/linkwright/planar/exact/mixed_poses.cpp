#include "linkwright/planar/exact/mixed_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
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

std::array<GuidingDyad, 2> dyads_of(const SystemPoint<FourBarPoses>& z, const BodyPose& first) {
  const auto place = [&](std::size_t i) { return real_place<FourBarPoses>(z, i); };
  return {link(place(pin_x), place(pivot_a), first), link(place(pin_y), place(pivot_b), first)};
}
std::array<GuidingDyad, 2> dyads_of(const SystemPoint<SliderPoses>& z, const BodyPose& first) {
  const auto place = [&](std::size_t i) { return real_place<SliderPoses>(z, i); };
  GuidingDyad slide;
  slide.type = GuidingDyadType::pr;
  slide.moving = seen_from_body(place(slider_y), first);
  slide.normal = std::polar(1.0, 0.5 * std::arg(standard_complex(z[guide_nu])));
  slide.offset = (std::conj(slide.normal) * (first.origin + place(slider_y))).real();
  return {link(place(slider_x), place(slider_a), first), slide};
}

template <class C, class System>
struct CurveOf;
template <class C>
struct CurveOf<C, FourBarPoses> {
  using Type = CurveEquation<C>;
};
template <class C>
struct CurveOf<C, SliderPoses> {
  using Type = SliderCurveEquation<C>;
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
  out.status = solutions.status;
  out.finite = static_cast<int>(solutions.found.size());
  out.infinite = solutions.infinite;
  out.lost = solutions.lost;
  out.singular = solutions.singular;
  for (const SystemPoint<System>& z : solutions.found) {
    if (!is_real_solution<System>(z, size)) continue;
    const auto [one, other] = dyads_of(z, first);
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
  std::sort(out.real.begin(), out.real.end(), [](const GuidedPair& a, const GuidedPair& b) {
    return std::pair(a.first.moving.real(), a.first.moving.imag()) <
           std::pair(b.first.moving.real(), b.first.moving.imag());
  });
}

}  // namespace

std::optional<MixedPoseLinkage> linkage_of(const MixedPoses& target) {
  const std::size_t poses = poses_first(target).poses, points = target.poses.size() - poses;
  if (poses < 2 || points == 0) return std::nullopt;
  const std::size_t conditions = 2 * (poses - 1) + points;
  if (conditions == four_bar_unknowns) return MixedPoseLinkage::four_bar;
  if (conditions == slider_crank_unknowns) return MixedPoseLinkage::slider_crank;
  return std::nullopt;
}

std::size_t mixed_pose_solutions(MixedPoseLinkage linkage, std::size_t poses) {
  constexpr std::size_t four_bars[] = {1112, 201, 30}, slider_cranks[] = {202, 42, 6};
  LINKWRIGHT_REQUIRE(poses >= 2 && poses <= 4, "{} poses", poses);
  return linkage == MixedPoseLinkage::four_bar ? four_bars[poses - 2] : slider_cranks[poses - 2];
}

MixedPoseSolutions solve_mixed_poses(const MixedPoses& target, RunContext& context) {
  LINKWRIGHT_REQUIRE(target.demands.size() == target.poses.size(), "{} demands for {} poses",
                     target.demands.size(), target.poses.size());
  const auto linkage = linkage_of(target);
  LINKWRIGHT_REQUIRE(linkage, "{} poses and points have no finite number of linkages", target.poses.size());
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
  out.whole = static_cast<int>(mixed_pose_solutions(*linkage, poses_first(target).poses));
  if (*linkage == MixedPoseLinkage::four_bar)
    solve_mixed<FourBarPoses>(target, out, context);
  else
    solve_mixed<SliderPoses>(target, out, context);
  return out;
}

}  // namespace linkwright::planar
