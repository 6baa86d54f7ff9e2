// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/names.h"

#include <fmt/core.h>

#include <bit>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

// Number of sliding joints of a link.
int slides_of(const std::vector<JointEnds>& joints, std::uint32_t sliders, int link) {
  int out = 0;
  for (std::size_t k = 0; k < joints.size(); ++k)
    out += (sliders >> k & 1) != 0 && (joints[k][0] == link || joints[k][1] == link);
  return out;
}

std::string one_slider_name(const std::vector<JointEnds>& joints, const Marking& marking) {
  if (!marking.ground) return "slider-crank chain";
  return slides_of(joints, marking.sliders, *marking.ground) == 1 ? "slider-crank" : "inverted slider-crank";
}

std::string two_slider_name(const std::vector<JointEnds>& joints, const Marking& marking) {
  bool adjacent = false;
  for (int link = 0; link < 4; ++link) adjacent = adjacent || slides_of(joints, marking.sliders, link) == 2;
  if (!adjacent) return marking.ground ? "Rapson slide" : "Rapson chain";
  if (!marking.ground) return "double-slider chain";
  constexpr const char* names[] = {"Oldham coupling", "Scotch yoke", "trammel"};
  return names[slides_of(joints, marking.sliders, *marking.ground)];
}

std::string four_link_name(const ChainGraph& graph, const Marking& marking) {
  const std::vector<JointEnds> joints = joints_of(graph);
  switch (std::popcount(marking.sliders)) {
    case 0:
      return marking.ground ? "four-bar" : "four-bar chain";
    case 1:
      return one_slider_name(joints, marking);
    case 2:
      return two_slider_name(joints, marking);
    default:
      return {};
  }
}

bool ternary_links_are_joined(const ChainGraph& graph) {
  for (const auto& [a, b] : joints_of(graph))
    if (graph.degree(a) == 3 && graph.degree(b) == 3) return true;
  return false;
}

std::string six_link_name(const ChainGraph& graph, const Marking& marking) {
  const bool watt = ternary_links_are_joined(graph);
  if (!marking.ground) return watt ? "Watt chain" : "Stephenson chain";
  const int ground = *marking.ground;
  if (watt) return graph.degree(ground) == 2 ? "Watt I" : "Watt II";
  if (graph.degree(ground) == 3) return "Stephenson III";
  for (int link = 0; link < graph.links; ++link)
    if (graph.joined(ground, link) && graph.degree(link) == 2) return "Stephenson II";
  return "Stephenson I";
}

}  // namespace

std::string common_name(const ChainGraph& graph, const Marking& marking) {
  const int freedom = freedoms(graph);
  const bool pins = marking.sliders == 0 && !marking.gear;
  if (graph.links == 4 && freedom == 1) return four_link_name(graph, marking);
  if (graph.links == 6 && freedom == 1 && pins) return six_link_name(graph, marking);
  if (graph.links != 5 || freedom != 2 || marking.sliders != 0) return {};
  return std::string(marking.gear ? "geared five-bar" : "five-bar") + (marking.ground ? "" : " chain");
}

std::string mechanism_name(const Chain& chain, const Marking& marking) {
  std::string out = chain.name;
  const std::vector<JointEnds> joints = joints_of(chain.graph);
  if (marking.sliders != 0) out += "/sliders";
  for (std::size_t k = 0; k < joints.size(); ++k)
    if ((marking.sliders >> k & 1) != 0) out += fmt::format(" {}-{}", joints[k][0] + 1, joints[k][1] + 1);
  if (const auto& gear = marking.gear)
    out += fmt::format("/gears {}-{} on {}", gear->first + 1, gear->second + 1, gear->carrier + 1);
  if (marking.ground) out += fmt::format("/ground {}", *marking.ground + 1);
  if (marking.driver) out += fmt::format("/driver {}", driven_link(chain.graph, marking) + 1);
  return out;
}

}  // namespace linkwright::planar
