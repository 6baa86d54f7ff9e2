// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/pose_design.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {

bool defective(const PoseDesign& d) { return d.passage.defect != PoseDefect::none; }
bool rotary(const PoseDesign& d) { return d.driver.type == GuidingDyadType::rr; }

std::string type_of(const PoseDesign& d) {
  return fmt::format("{}+{}", name_of(d.driver.type), name_of(d.other.type));
}
std::string_view name_of_linkage(const PoseDesign& d) {
  const bool rr = d.driver.type == GuidingDyadType::rr && d.other.type == GuidingDyadType::rr;
  const bool pr = d.driver.type == GuidingDyadType::pr || d.other.type == GuidingDyadType::pr;
  const bool rp = d.driver.type == GuidingDyadType::rp || d.other.type == GuidingDyadType::rp;
  const bool link = d.driver.type == GuidingDyadType::rr || d.other.type == GuidingDyadType::rr;
  if (rr) return "four-bar";
  if (link) return pr ? "slider-crank" : "inverted slider-crank";
  return pr && rp ? "slide and sleeve" : pr ? "double slider" : "double sleeve";
}
std::string_view drive_of(const PoseDesign& d) {
  if (rotary(d)) return d.passage.drive_turns ? "a crank" : "a rocker";
  return d.driver.type == GuidingDyadType::pr ? "a slide" : "a cylinder";
}

Sentence defect_text(const PoseDesign& d) {
  switch (d.passage.defect) {
    case PoseDefect::none:
      return {};
    case PoseDefect::branch:
      if (d.passage.from == d.passage.to) return say("branch: at a dead point at pose {}", d.passage.to + 1);
      return say("branch: poses {} and {} are on both sides of a dead point", d.passage.from + 1,
                 d.passage.to + 1);
    case PoseDefect::circuit:
      return say("circuit: cannot move from pose {} to pose {} without leaving where it assembles",
                 d.passage.from + 1, d.passage.to + 1);
    case PoseDefect::order:
      break;
  }
  return "order: meets the poses in another order";
}

FourBar four_bar_of(const PoseDesign& d) {
  const std::complex<double> ground = d.other.fixed - d.driver.fixed,
                             coupler = d.other.moving - d.driver.moving;
  const std::complex<double> point = -d.driver.moving * std::conj(coupler) / std::abs(coupler);
  return {.ground = std::abs(ground),
          .crank = d.driver.length,
          .coupler = std::abs(coupler),
          .rocker = d.other.length,
          .coupler_u = point.real(),
          .coupler_v = point.imag(),
          .pivot_x = d.driver.fixed.real(),
          .pivot_y = d.driver.fixed.imag(),
          .frame_angle = std::arg(ground),
          .branch = d.passage.side > 0 ? Branch::open : Branch::crossed};
}

std::vector<double> shown_inputs(const PoseDesign& d, int samples) {
  const double from = d.passage.drive.front();
  double to = d.passage.drive.back();
  if (d.passage.drive_turns) to = from + std::copysign(2 * pi, to - from);
  std::vector<double> out(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) out[static_cast<std::size_t>(i)] = from + (to - from) * i / (samples - 1);
  return out;
}

}  // namespace linkwright::planar
