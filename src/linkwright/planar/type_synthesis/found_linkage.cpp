// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/found_linkage.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/type_synthesis/curve.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

/// Names of the bodies by link number; machines of pairs with more than two bars number them.
std::string body_name(const PointProgram& p, std::size_t link) {
  if (link == 0) return "ground";
  if (link == 1) return "crank";
  const auto pin = static_cast<std::size_t>(p.bodies[link].points[1]);
  if (p.steps[pin].operation == PointOperation::slide || p.steps[pin].operation == PointOperation::sleeve)
    return "rod";
  switch (p.family) {
    case MachineFamily::four_bar:
      return link == 2 ? "coupler" : "rocker";
    case MachineFamily::geared_five_bar:
      return link == 2 ? "coupler" : "link";
    default:
      return fmt::format("bar{}", link);
  }
}

/// Writes the linkage of one machine.
class LinkageWriter {
 public:
  LinkageWriter(const FittedMachine& machine, const SampledStroke& target)
      : p_(*machine.shape.program), shape_(machine.shape) {
    const double* v = shape_.x.data() + p_.place();
    place_ = target.centre + target.size * Complex(v[0], v[1]);
    scale_ = target.size * Complex(v[2], v[3]);
    start_ = machine.angle.front();
    name_points();
  }

  FoundLinkage write() {
    FoundLinkage out;
    out.crank_angle = std::arg(scale_);
    ground(out.linkage);
    if (p_.group >= 0)
      group_bodies(out.linkage);
    else
      bodies(out.linkage);
    joints(out.linkage);
    const std::size_t traced = p_.steps.size() - 1;
    const auto bar = static_cast<std::size_t>(p_.traced_bar);
    const bool in_sleeve = step(traced).operation == PointOperation::sleeve;
    out.traced = p_.output == MachineOutput::slide ? "slider." + names_[traced]
                 : in_sleeve                       ? body_name(p_, bar) + ".S"
                                                   : full_name(traced, bar);
    return out;
  }

 private:
  const PointStep& step(std::size_t i) const { return p_.steps[i]; }
  double value(std::size_t i, int k) const {
    return shape_.x[static_cast<std::size_t>(step(i).parameter + k)];
  }
  Complex complex_value(std::size_t i, int k = 0) const { return {value(i, k), value(i, k + 1)}; }
  bool bit(std::size_t i) const { return (shape_.signs >> static_cast<unsigned>(step(i).sign) & 1u) != 0; }

  /// The pins get letters in the order of the program; the traced point is C.
  void name_points() {
    const std::string letters = "ABDEFGHIJKLMNPQRSTUVWXYZ";
    for (std::size_t i = 0; i < p_.steps.size(); ++i)
      names_.push_back(i + 1 == p_.steps.size() ? "C" : std::string(1, letters[i]));
  }

  std::string full_name(std::size_t point, std::size_t link) const {
    return body_name(p_, link) + "." + names_[point];
  }

  bool is_ground(PointOperation operation) const {
    return operation == PointOperation::ground_on_axis || operation == PointOperation::ground;
  }

  void ground(Linkage& linkage) const {
    std::vector<LinkagePoint> points{{"O", place_}};
    for (std::size_t i = 0; i < p_.steps.size(); ++i) {
      if (step(i).operation == PointOperation::ground_on_axis)
        points.push_back({names_[i], place_ + scale_ * value(i, 0)});
      if (step(i).operation == PointOperation::ground)
        points.push_back({names_[i], place_ + scale_ * complex_value(i)});
      if (step(i).operation == PointOperation::slide)
        points.push_back({"S", place_ + scale_ * Complex(0, value(i, 1))});
      if (step(i).operation == PointOperation::sleeve) points.push_back({"G", place_ + scale_ * value(i, 0)});
      if (step(i).operation == PointOperation::geared_crank)
        points.push_back({"O2", place_ + scale_ * complex_value(i)});
    }
    linkage = grounded(std::move(points));
  }

  /// Length of a bar between its pins, in cranks.
  double bar_length(std::size_t link) const {
    const auto pin = static_cast<std::size_t>(p_.bodies[link].points[1]);
    if (step(pin).operation == PointOperation::slide) return value(pin, 0);
    if (step(pin).operation == PointOperation::sleeve) return 1;
    return value(pin, p_.bodies[link].points[0] == step(pin).first ? 0 : 1);
  }

  void bodies(Linkage& linkage) const {
    const double size = std::abs(scale_);
    for (std::size_t link = 1; link < p_.bodies.size(); ++link) {
      const std::vector<int>& on = p_.bodies[link].points;
      std::vector<LinkagePoint> points;
      if (link == 1) points.push_back({"O", 0});
      const double length = link == 1 ? 1 : bar_length(link);
      for (std::size_t k = 0; k < on.size(); ++k) {
        const auto i = static_cast<std::size_t>(on[k]);
        Complex at = k == 0 ? (link == 1 ? 1.0 : 0.0) : k == 1 && link > 1 ? 1.0 : complex_value(i);
        // The unit step of a rod through a sleeve is no pin.
        if (step(i).operation == PointOperation::sleeve) continue;
        points.push_back({names_[i], size * length * at});
      }
      if (p_.family == MachineFamily::inverted_slider && link == 2) {
        const auto i = static_cast<std::size_t>(on[1]);
        points.push_back({"S", size * Complex(0, -value(i, 1))});
      }
      add_body(linkage, body_name(p_, link), std::move(points));
    }
  }

  /// The links of a group of four and the crank, where they are at the first crank angle: a group without
  /// closed form is followed from there.
  void group_bodies(Linkage& linkage) const {
    const std::vector<Complex> at = own_points();
    add_body(linkage, "crank", {{"O", 0}, {names_[0], std::abs(scale_)}});
    set_start(linkage, "crank", place_, start_ + std::arg(scale_));
    for (std::size_t link = 2; link < p_.bodies.size(); ++link) {
      const std::vector<int>& on = p_.bodies[link].points;
      const auto global = [&](std::size_t k) {
        return place_ + scale_ * at[static_cast<std::size_t>(on[k])];
      };
      const Complex origin = global(0), along = global(1) - origin, turn = along / std::abs(along);
      std::vector<LinkagePoint> points;
      for (std::size_t k = 0; k < on.size(); ++k)
        points.push_back({names_[static_cast<std::size_t>(on[k])], (global(k) - origin) / turn});
      add_body(linkage, body_name(p_, link), std::move(points));
      set_start(linkage, body_name(p_, link), origin, std::arg(turn));
    }
  }

  /// All points in the machine's own plane at the first crank angle.
  std::vector<Complex> own_points() const {
    constexpr std::size_t count = 8;
    std::array<double, count> angle, quality, worst;
    angle.fill(start_);
    std::vector<double> points(2 * p_.steps.size() * count);
    compute_curve({.program = &p_,
                   .x = shape_.x.data(),
                   .signs = shape_.signs,
                   .angle = angle.data(),
                   .count = count,
                   .quality = quality.data(),
                   .worst = worst.data(),
                   .points = points.data()});
    std::vector<Complex> out;
    for (std::size_t i = 0; i < p_.steps.size(); ++i)
      out.emplace_back(points[2 * i * count], points[(2 * i + 1) * count]);
    return out;
  }

  void group_joints(Linkage& linkage) const {
    pin_to(linkage, p_.steps[static_cast<std::size_t>(p_.group)].first, 2);
    pin_to(linkage, 0, 3);
    for (int k = 0; k < 4; ++k) pin_to(linkage, p_.group + k, static_cast<std::size_t>(4 + k % 2));
  }

  void joints(Linkage& linkage) const {
    add_pin(linkage, "O", "ground.O", "crank.O");
    add_drive(linkage, "O");
    if (p_.group >= 0) group_joints(linkage);
    for (std::size_t i = 0; i < p_.steps.size(); ++i) {
      switch (step(i).operation) {
        case PointOperation::pair:
          pair(linkage, i);
          break;
        case PointOperation::slide:
          slide(linkage, i);
          break;
        case PointOperation::sleeve:
          sleeve(linkage, i);
          break;
        case PointOperation::geared_crank:
          geared_crank(linkage, i);
          break;
        default:
          break;
      }
    }
  }

  /// Link on which a point lies that a new bar is pinned to: the one that had it first.
  std::size_t carrier_of(int point) const {
    for (std::size_t link = 0; link < p_.bodies.size(); ++link)
      for (const int at : p_.bodies[link].points)
        if (at == point) return link;
    return 0;
  }

  void pin_to(Linkage& linkage, int point, std::size_t bar) const {
    const auto i = static_cast<std::size_t>(point);
    const std::string carrier = step(i).operation == PointOperation::geared_crank
                                    ? "crank2." + names_[i]
                                    : full_name(i, carrier_of(point));
    add_pin(linkage, fmt::format("{}{}", names_[i], bar), carrier, full_name(i, bar));
  }

  void pair(Linkage& linkage, std::size_t i) const {
    std::size_t first = 0, second = 0;
    for (std::size_t link = 2; link < p_.bodies.size(); ++link) {
      if (p_.bodies[link].points[1] != static_cast<int>(i)) continue;
      (p_.bodies[link].points[0] == step(i).first && first == 0 ? first : second) = link;
    }
    pin_to(linkage, step(i).first, first);
    pin_to(linkage, step(i).second, second);
    add_pin(linkage, names_[i], full_name(i, first), full_name(i, second));
    set_mode(linkage, body_name(p_, first), body_name(p_, second),
             bit(i) ? AssemblyMode::minus : AssemblyMode::plus);
  }

  void slide(Linkage& linkage, std::size_t i) const {
    std::size_t rod = 2;
    while (p_.bodies[rod].points[1] != static_cast<int>(i)) ++rod;
    add_body(linkage, "slider", {{names_[i], 0}});
    pin_to(linkage, step(i).first, rod);
    add_slide(linkage, "slide", "ground.S", "slider." + names_[i], std::arg(scale_), 0);
    add_pin(linkage, names_[i], full_name(i, rod), "slider." + names_[i]);
    set_mode(linkage, "rod", "slider", AssemblyMode::plus);
  }

  void sleeve(Linkage& linkage, std::size_t i) const {
    add_body(linkage, "sleeve", {{"G", 0}});
    pin_to(linkage, step(i).first, 2);
    add_slide(linkage, "slide", "rod.S", "sleeve.G");
    add_pin(linkage, "G", "ground.G", "sleeve.G");
    set_mode(linkage, "rod", "sleeve", bit(i) ? AssemblyMode::minus : AssemblyMode::plus);
  }

  void geared_crank(Linkage& linkage, std::size_t i) const {
    const Complex crank = complex_value(i, 2);
    add_body(linkage, "crank2", {{"O2", 0}, {names_[i], std::abs(scale_ * crank)}});
    add_pin(linkage, "O2", "ground.O2", "crank2.O2");
    const double phase = std::arg(crank) + std::arg(scale_) * (1 - p_.gear_ratio);
    add_gear(linkage, "gears", "crank", "crank2", p_.gear_ratio, std::remainder(phase, 2 * pi));
  }

  const PointProgram& p_;
  const MachineShape& shape_;
  Complex place_, scale_;
  double start_ = 0;  ///< crank angle of the program at the first sample of the target (rad)
  std::vector<std::string> names_;
};

}  // namespace

FoundLinkage found_linkage(const FittedMachine& machine, const SampledStroke& target) {
  return LinkageWriter(machine, target).write();
}

}  // namespace linkwright::planar
