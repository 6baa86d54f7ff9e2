// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/seven_pose_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/indirect/seven_poses.h"
#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {
namespace {

/// m: a rod of seven positions with errors below this fits all the others as well.
constexpr double fits_all = 1e-8;
constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};
double coordinate_of(const Vec3& v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// The name of the link of the task in whose boxes a rod lies; "-" of a rod that lies in none.
std::string place_of(const IndirectStudy& s, const CornerLink& rod) {
  for (const LinkTask& task : s.task.links) {
    if ((task.type != LinkType::US && task.type != LinkType::SS) || task.moved_by_rack != rod.moved_by_rack)
      continue;
    CornerLink as_asked = rod;
    as_asked.type = task.type;
    if (LinkCoordinates(task).inside(as_asked)) return task.name;
  }
  return "-";
}

}  // namespace

void add_seven_poses(study::Result& result, const IndirectStudy& s, const CarrierTargets& targets) {
  const bool right = s.description.suspension.side == Side::right;
  const auto seen = [&](const Vec3& p) { return right ? math::mirrored(p) : p; };
  Table rods{.name = "seven_pose_rods"}, arms{.name = "seven_pose_arms"};
  constexpr std::array<std::string_view, 2> ends{"body", "carrier"};
  std::vector<double> moved, number, is_real, rms, largest;
  std::array<std::array<std::vector<double>, 6>, 2> parts;  // [end][x, y, z, imaginary x, y, z]
  std::array<std::vector<double>, 9> arm_points;
  std::vector<double> arm_moved;
  for (const bool by_rack : {false, true}) {
    const bool asked = std::any_of(s.task.links.begin(), s.task.links.end(), [&](const LinkTask& l) {
      return (l.type == LinkType::US || l.type == LinkType::SS) && l.moved_by_rack == by_rack &&
             !LinkCoordinates(l).free().empty();
    });
    if (!asked || link_motion(targets, by_rack).size() < 6) continue;
    const SevenPoseReport found = seven_pose_rods(targets, by_rack);
    int fitting = 0;
    for (std::size_t i = 0; i < found.all.size(); ++i) {
      const SevenPoseSolution& one = found.all[i];
      const bool real = one.rod >= 0;
      const SevenPoseRod* rod = real ? &found.rods[static_cast<std::size_t>(one.rod)] : nullptr;
      rods.names.push_back(rod ? place_of(s, rod->link) : std::string("-"));
      moved.push_back(by_rack);
      number.push_back(static_cast<double>(i + 1));
      is_real.push_back(real);
      rms.push_back(rod ? rod->rms : WheelParameters::missing);
      largest.push_back(rod ? rod->largest : WheelParameters::missing);
      fitting += rod && rod->rms <= fits_all;
      for (std::size_t end = 0; end < 2; ++end)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::complex<double> at = (end == 0 ? one.body : one.carrier)[k];
          const double sign = right && k == 1 ? -1 : 1;
          parts[end][k].push_back(sign * at.real());
          parts[end][3 + k].push_back(real ? 0 : sign * at.imag());
        }
    }
    for (const CornerLink& arm : found.arms) {
      arms.names.emplace_back(name_of(arm.type));
      const bool wishbone = arm.type == LinkType::RS;
      const auto &ball = wishbone ? arm.carrier : arm.body, &hinge = wishbone ? arm.body : arm.carrier;
      std::size_t column = 0;
      for (const Vec3& p : {ball[0], hinge[0], hinge[1]})
        for (std::size_t k = 0; k < 3; ++k) arm_points[column++].push_back(coordinate_of(seen(p), k));
      arm_moved.push_back(by_rack);
    }
    result.facts.push_back({fmt::format("rods through seven positions{}", by_rack ? ", on the rack" : ""),
                            say("{} solutions, {} of them real; {} fit all positions{}", found.solutions,
                                found.rods.size(), fitting,
                                found.arms.empty() ? Sentence()
                                                   : say("; {} hinged arms (RS, SR) whose rods form families",
                                                         found.arms.size()))});
  }
  if (!rods.names.empty()) {
    rods.add("number", "number", std::move(number));
    rods.add("moved_by_rack", "on the rack (1 = yes)", std::move(moved));
    rods.add("is_real", "real (1 = yes)", std::move(is_real));
    rods.add("structural_error_rms_m", "structural error at all positions, root mean square (m)",
             std::move(rms));
    rods.add("structural_error_max_m", "structural error at all positions, largest (m)", std::move(largest));
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t k = 0; k < 6; ++k)
        rods.add(fmt::format("{}_{}{}_m", ends[end], axis_names[k % 3], k < 3 ? "" : "_imaginary"),
                 fmt::format("{} {}{} (m)", ends[end], axis_names[k % 3], k < 3 ? "" : ", imaginary part"),
                 std::move(parts[end][k]));
    result.tables.push_back(std::move(rods));
  }
  if (arms.names.empty()) return;
  constexpr std::array<std::string_view, 3> points{"ball", "hinge_1", "hinge_2"};
  constexpr std::array<std::string_view, 3> words{"ball joint", "hinge 1", "hinge 2"};
  arms.add("moved_by_rack", "on the rack (1 = yes)", std::move(arm_moved));
  for (std::size_t c = 0; c < arm_points.size(); ++c)
    arms.add(fmt::format("{}_{}_m", points[c / 3], axis_names[c % 3]),
             fmt::format("{} {} (m)", words[c / 3], axis_names[c % 3]), std::move(arm_points[c]));
  result.tables.push_back(std::move(arms));
}

}  // namespace linkwright::suspension
