// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/modes.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/linkage/general.h"

namespace linkwright::planar {
namespace {

constexpr double same = 1e-6;

class Enumeration {
 public:
  Enumeration(const LinkagePlan& plan, std::span<const double> inputs, const ModeSearch& search)
      : plan_(plan), search_(search), motion_(plan) {
    for (double v : inputs) inputs_.push_back({v, 0, 0});
    for (std::size_t k = 0; k < plan.groups.size(); ++k) {
      levels_.push_back(plan);
      levels_.back().groups.resize(k + 1);
    }
  }
  AssemblyModes run() {
    visit(0);
    const auto n = out_.found.size();
    out_.text = say("{} mode{}", n, n == 1 ? "" : "s");
    if (out_.starts > 0) out_.text += say(" from {} starts", out_.starts);
    if (!out_.complete) out_.text += ", there may be more";
    return std::move(out_);
  }

 private:
  // The groups up to k at the present modes; general groups before k keep the positions found.
  bool placed(std::size_t k) {
    solve_position(levels_[k], inputs_, motion_);
    // At a dead point everything is placed but the rates.
    return motion_.status == Status::done ||
           (motion_.status == Status::singular && at(motion_.failed_group) == k && assembled(k));
  }
  bool assembled(std::size_t k) const {
    return std::all_of(plan_.groups[k].parts.begin(), plan_.groups[k].parts.end(), [&](int p) {
      return std::isfinite(motion_.parts[at(p)].origin.x) && std::isfinite(motion_.parts[at(p)].direction.x);
    });
  }
  bool alike(const std::vector<PartState<double>>& a, const std::vector<PartState<double>>& b,
             const std::vector<int>& parts) const {
    return std::all_of(parts.begin(), parts.end(), [&](int p) {
      return norm(a[at(p)].origin - b[at(p)].origin) <= same * plan_.size &&
             norm(a[at(p)].direction - b[at(p)].direction) <= same;
    });
  }
  void visit(std::size_t k) {
    if (out_.found.size() >= search_.most) {
      out_.complete = false;
      return;
    }
    if (k == plan_.groups.size()) {
      AssembledMode one{motion_.modes, motion_.parts, motion_.closure_residual};
      for (std::size_t g = 0; g < k; ++g)
        if (!traits_of(plan_.groups[g]).closed_form)
          one.modes[g] = motion_.groups[g].sine < 0 ? -1 : 1;
        else if (!traits_of(plan_.groups[g]).has_modes)
          one.modes[g] = 1;
      out_.found.push_back(std::move(one));
      return;
    }
    const Group& g = plan_.groups[k];
    if (!traits_of(g).closed_form) return visit_general(k);
    if (!traits_of(g).has_modes) {
      if (placed(k)) visit(k + 1);
      return;
    }
    std::vector<PartState<double>> first;
    for (const double sign : {1.0, -1.0}) {
      motion_.modes[k] = sign;
      if (!placed(k) || (!first.empty() && alike(first, motion_.parts, g.parts))) continue;
      if (first.empty()) first = motion_.parts;
      visit(k + 1);
    }
  }
  void visit_general(std::size_t k) {
    const Group& g = plan_.groups[k];
    const std::vector<PartState<double>> before = motion_.parts;
    std::vector<std::vector<PartState<double>>> solutions;
    for (int start = 0; start < search_.starts; ++start) {
      motion_.parts = before;
      // The first start is the place that the model gives or the motion has.
      if (start > 0) {
        RandomStream random(
            {.seed = search_.seed, .run = static_cast<std::uint32_t>(out_.starts), .individual = 0});
        for (int p : g.parts) {
          PartState<double>& part = motion_.parts[at(p)];
          part.origin = {random.uniform(-2, 2) * plan_.size, random.uniform(-2, 2) * plan_.size};
          part.direction = math::unit(random.uniform(-pi, pi));
        }
      }
      ++out_.starts;
      if (!placed(k)) continue;
      if (std::any_of(solutions.begin(), solutions.end(),
                      [&](const auto& s) { return alike(s, motion_.parts, g.parts); }))
        continue;
      solutions.push_back(motion_.parts);
    }
    for (const auto& s : solutions) {
      motion_.parts = s;
      if (placed(k)) visit(k + 1);
    }
  }

  const LinkagePlan& plan_;
  const ModeSearch& search_;
  std::vector<LinkagePlan> levels_;
  std::vector<InputMotion> inputs_;
  LinkageMotion motion_;
  AssemblyModes out_;
};

}  // namespace

AssemblyModes assembly_modes(const LinkagePlan& plan, std::span<const double> inputs,
                             const ModeSearch& search) {
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     inputs.size());
  LINKWRIGHT_REQUIRE(search.starts >= 1 && search.most >= 1, "{} starts, at most {} modes", search.starts,
                     search.most);
  return Enumeration(plan, inputs, search).run();
}

}  // namespace linkwright::planar
