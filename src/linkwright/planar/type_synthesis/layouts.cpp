// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/layouts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {
namespace {

constexpr int turn_angles = 720;

/// What is measured of one layout along a rotation of the crank, from its ground link.
class LayoutMeasure {
 public:
  LayoutMeasure(const FourBar& original, bool same_timing, std::optional<CrankPart> part)
      : original_(original), same_timing_(same_timing), part_(part) {}

  MachineLayout measure() {
    MachineLayout out{.linkage = {}, .same_timing = same_timing_, .min_pair_angle = pi / 2};
    for (int k = 0; k < turn_angles; ++k) {
      const double angle =
          part_ ? part_->from + part_->range * k / (turn_angles - 1) : 2 * pi * k / turn_angles;
      const FourBarPosition found = position(original_, angle);
      const FourBar linkage = at(angle);
      if (k == 0) {
        out.linkage = linkage;
        add(crank_pivot(linkage)), add(rocker_pivot(linkage));
      }
      const FourBarPosition pose = position(linkage, same_timing_ ? angle : found.coupler_angle);
      for (const std::complex<double>& p : {pose.crank_pin, pose.coupler_pin, pose.coupler_point}) add(p);
      out.min_pair_angle = std::min(out.min_pair_angle, pose.transmission_angle);
      out.apart = std::max(out.apart, std::abs(pose.coupler_point - found.coupler_point));
    }
    out.size = std::max(right_ - left_, top_ - bottom_);
    return out;
  }

 private:
  /// The cognate of this timing, on its branch at the crank angle.
  FourBar at(double angle) const {
    for (const Cognate& cognate : cognates(original_, angle))
      if (cognate.same_timing == same_timing_) return cognate.linkage;
    return original_;
  }
  void add(const std::complex<double>& p) {
    left_ = std::min(left_, p.real()), right_ = std::max(right_, p.real());
    bottom_ = std::min(bottom_, p.imag()), top_ = std::max(top_, p.imag());
  }

  const FourBar& original_;
  bool same_timing_;
  std::optional<CrankPart> part_;
  double left_ = infinity, right_ = -infinity, bottom_ = infinity, top_ = -infinity;
};

}  // namespace

FourBar four_bar_of(const FittedMachine& machine, const SampledStroke& target) {
  const PointProgram& p = *machine.shape.program;
  LINKWRIGHT_REQUIRE(p.family == MachineFamily::four_bar, "a machine of {} links, must be a four-bar",
                     p.links);
  const std::span<const double> x = machine.shape.x;
  const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
  const auto complex_at = [&](int i) { return std::complex<double>(at(i), at(i + 1)); };
  const std::complex<double> scale = target.size * complex_at(p.scale()),
                             pivot = target.centre + target.size * complex_at(p.place());
  FourBar out{.pivot_x = pivot.real(), .pivot_y = pivot.imag()};
  out.crank = std::abs(scale);
  for (const PointStep& step : p.steps) {
    if (step.operation == PointOperation::ground_on_axis) {
      out.ground = out.crank * std::abs(at(step.parameter));
      out.frame_angle = std::arg(scale * at(step.parameter));
    } else if (step.operation == PointOperation::pair) {
      const double first = at(step.parameter), second = at(step.parameter + 1);
      out.coupler = out.crank * std::abs(first), out.rocker = out.crank * std::abs(second);
      const bool right = (machine.shape.signs >> static_cast<unsigned>(step.sign) & 1u) != 0;
      out.branch = right != (first * second < 0) ? Branch::crossed : Branch::open;
    } else if (step.operation == PointOperation::plate) {
      const std::complex<double> point = out.coupler * complex_at(step.parameter);
      out.coupler_u = point.real(), out.coupler_v = point.imag();
    }
  }
  return out;
}

std::vector<MachineLayout> layouts_of(const FittedMachine& machine, const SampledStroke& target,
                                      std::optional<CrankPart> part) {
  std::vector<MachineLayout> out;
  if (machine.shape.program->family != MachineFamily::four_bar) return out;
  const FourBar original = four_bar_of(machine, target);
  if (part) {
    const PointProgram& p = *machine.shape.program;
    const auto s = static_cast<std::size_t>(p.scale());
    const double turned = std::arg(std::complex<double>(machine.shape.x[s], machine.shape.x[s + 1]));
    part->from += turned - original.frame_angle;
  }
  for (const Cognate& cognate : cognates(original, part ? part->from : 0))
    out.push_back(LayoutMeasure(original, cognate.same_timing, part).measure());
  return out;
}

}  // namespace linkwright::planar
