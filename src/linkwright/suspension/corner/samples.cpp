// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

enum Steered { held, moved };

CornerLink link(const char* name, LinkType type, std::vector<Vec3> body, std::vector<Vec3> carrier,
                Steered steered = held) {
  return {.name = name,
          .type = type,
          .body = std::move(body),
          .carrier = std::move(carrier),
          .length = {},
          .moved_by_rack = steered == moved};
}

CornerWheel wheel(const Vec3& centre, double toe_degrees, double camber_degrees, double tyre_diameter) {
  return {centre, math::radians(toe_degrees), math::radians(camber_degrees), tyre_diameter};
}

CornerSample sample(const char* name, const char* summary, const CornerWheel& wheel,
                    std::vector<CornerLink> links, std::optional<CornerSpring> spring = std::nullopt,
                    std::vector<Coupler> couplers = {}) {
  return {name,
          summary,
          {.wheel = wheel, .links = std::move(links), .couplers = std::move(couplers), .spring = spring}};
}

std::vector<CornerSample> basic_mechanisms() {
  using enum LinkType;
  return {
      sample("R", "semi-trailing arm", wheel({0, 0.74, 0}, 0.15, -1.2, 0.62),
             {link("trailing arm", R, {{0.34, 0.22, -0.055}, {0.43, 0.57, -0.03}}, {})},
             CornerSpring{{0.1, 0.5, 0.22}, {0.08, 0.52, -0.06}, -1}),
      sample("RR-US", "trapezoidal arm and rod", wheel({0, 0.745, 0}, 0.1, -0.8, 0.63),
             {link("trapezoidal arm", RR, {{0.16, 0.3, -0.085}, {-0.17, 0.32, -0.075}},
                   {{0.11, 0.685, -0.115}, {-0.12, 0.69, -0.112}}),
              link("upper rod", US, {{0.02, 0.41, 0.155}}, {{-0.01, 0.66, 0.17}})},
             CornerSpring{{0, 0.5, 0.25}, {0, 0.56, -0.1}, 0}),
      sample("S-2US", "trailing arm with two lateral rods", wheel({0, 0.75, 0}, 0.12, -1.0, 0.63),
             {link("trailing arm", S, {{0.47, 0.61, -0.03}}, {}),
              link("lower rod", US, {{-0.05, 0.12, -0.083}}, {{-0.06, 0.69, -0.105}}),
              link("upper rod", US, {{0.01, 0.38, 0.12}}, {{0, 0.66, 0.14}})},
             CornerSpring{{-0.03, 0.52, 0.28}, {-0.04, 0.6, -0.06}, -1}),
      sample(
          "2RS-US", "double wishbone, steered", wheel({0, 0.76, 0}, 0.1, -0.5, 0.64),
          {link("lower wishbone", RS, {{0.18, 0.37, -0.11}, {-0.17, 0.37, -0.1}}, {{0.008, 0.715, -0.13}}),
           link("upper wishbone", RS, {{0.12, 0.44, 0.165}, {-0.14, 0.44, 0.15}}, {{-0.022, 0.665, 0.215}}),
           link("tie rod", US, {{-0.125, 0.415, -0.047}}, {{-0.14, 0.7, -0.042}}, moved)},
          CornerSpring{{-0.01, 0.5, 0.33}, {0, 0.57, -0.105}, 0}),
      sample("RS-SR-US", "wishbone below, trailing blade above, rod", wheel({0, 0.75, 0}, 0.1, -0.9, 0.63),
             {link("lower wishbone", RS, {{0.15, 0.36, -0.1}, {-0.16, 0.37, -0.09}}, {{0.01, 0.7, -0.125}}),
              link("trailing blade", SR, {{0.43, 0.58, 0.08}}, {{0.02, 0.62, 0.155}, {0.015, 0.71, 0.16}}),
              link("rod", US, {{-0.16, 0.3, -0.033}}, {{-0.15, 0.69, -0.055}})},
             CornerSpring{{0.02, 0.5, 0.3}, {0, 0.56, -0.1}, 0}),
      sample("RS-SP-US", "strut with wishbone, steered", wheel({0, 0.755, 0}, 0.08, -0.4, 0.63),
             {link("wishbone", RS, {{0.05, 0.36, -0.085}, {-0.28, 0.36, -0.075}}, {{0.012, 0.71, -0.105}}),
              link("strut", SP, {{-0.035, 0.575, 0.54}}, {{-0.008, 0.612, 0.06}}),
              link("tie rod", US, {{-0.105, 0.288, 0.017}}, {{-0.135, 0.675, 0.005}}, moved)},
             CornerSpring{{-0.035, 0.575, 0.54}, {-0.008, 0.612, 0.06}, -1}),
      sample("2SR-US", "two trailing blades and a lateral rod", wheel({0, 0.74, 0}, 0.1, -0.7, 0.62),
             {link("upper blade", SR, {{0.46, 0.6, 0.1}}, {{0.05, 0.6, 0.17}, {0.05, 0.7, 0.17}}),
              link("lower blade", SR, {{0.48, 0.585, -0.12}}, {{0.04, 0.61, -0.1}, {0.045, 0.7, -0.105}}),
              link("lateral rod", US, {{-0.06, 0.12, -0.015}}, {{-0.07, 0.67, -0.045}})},
             CornerSpring{{-0.02, 0.52, 0.3}, {-0.02, 0.6, -0.03}, -1}),
      sample("SR-SP-US", "strut with trailing blade and lateral rod", wheel({0, 0.745, 0}, 0.1, -0.6, 0.62),
             {link("trailing blade", SR, {{0.45, 0.6, -0.05}}, {{0.03, 0.62, -0.09}, {0.03, 0.71, -0.095}}),
              link("strut", SP, {{0.02, 0.56, 0.5}}, {{0.01, 0.6, 0.07}}),
              link("lateral rod", US, {{-0.09, 0.12, -0.05}}, {{-0.1, 0.68, -0.09}})},
             CornerSpring{{0.02, 0.56, 0.5}, {0.01, 0.6, 0.07}, -1}),
      sample("RS-3US", "wishbone below, two rods above, steered", wheel({0, 0.765, 0}, 0.1, -0.5, 0.65),
             {link("lower wishbone", RS, {{0.17, 0.37, -0.12}, {-0.18, 0.37, -0.11}}, {{0.01, 0.72, -0.14}}),
              link("upper front rod", US, {{0.13, 0.45, 0.3}}, {{0.002, 0.66, 0.335}}),
              link("upper rear rod", US, {{-0.16, 0.46, 0.29}}, {{-0.03, 0.655, 0.333}}),
              link("tie rod", US, {{-0.13, 0.408, -0.053}}, {{-0.145, 0.705, -0.058}}, moved)},
             CornerSpring{{0.02, 0.5, 0.45}, {0, 0.58, -0.12}, 0}),
      sample("SR-3US", "trailing blade with three rods", wheel({0, 0.755, 0}, 0.15, -1.1, 0.64),
             {link("trailing blade", SR, {{0.46, 0.6, -0.02}}, {{0.05, 0.665, -0.09}, {0.052, 0.668, 0.03}}),
              link("lower rod", US, {{-0.01, 0.26, -0.1}}, {{-0.03, 0.7, -0.12}}),
              link("upper rod", US, {{0.02, 0.4, 0.14}}, {{0.01, 0.66, 0.155}}),
              link("front rod", US, {{0.11, 0.436, -0.083}}, {{0.1, 0.68, -0.095}})},
             CornerSpring{{-0.05, 0.5, 0.24}, {-0.06, 0.56, -0.09}, -1}),
      sample("SP-3US", "strut with two lower rods, steered", wheel({0, 0.77, 0}, -0.05, -0.3, 0.64),
             {link("lower front rod", US, {{0.28, 0.37, -0.06}}, {{0.03, 0.69, -0.085}}),
              link("lower rear rod", US, {{-0.07, 0.38, -0.115}}, {{-0.01, 0.7, -0.135}}),
              link("tie rod", US, {{0.085, 0.354, -0.07}}, {{0.135, 0.695, -0.09}}, moved),
              link("strut", SP, {{-0.05, 0.59, 0.5}}, {{-0.025, 0.645, 0.04}})},
             CornerSpring{{-0.05, 0.59, 0.5}, {-0.025, 0.645, 0.04}, -1}),
      sample("5US", "five-link front suspension, steered", wheel({0, 0.75, 0}, 0.12, -0.6, 0.65),
             {link("lower front rod", US, {{0.2, 0.36, -0.1}}, {{0.022, 0.7, -0.125}}),
              link("lower rear rod", US, {{-0.21, 0.37, -0.105}}, {{-0.018, 0.695, -0.128}}),
              link("tie rod", US, {{-0.125, 0.406, -0.018}}, {{-0.15, 0.69, -0.02}}, moved),
              link("upper front rod", US, {{0.14, 0.44, 0.28}}, {{-0.005, 0.655, 0.31}}),
              link("upper rear rod", US, {{-0.17, 0.45, 0.27}}, {{-0.035, 0.648, 0.308}})},
             CornerSpring{{0.02, 0.5, 0.42}, {0, 0.6, -0.11}, -1})};
}

// Poznanovic 2016, sections 6.1 to 6.4.
std::vector<CornerSample> published_examples() {
  using enum LinkType;
  return {sample("front_5US", "five-link front suspension (Poznanovic 2016, example 1)",
                 wheel({0, 0.768, 0}, 0, -0.7, 0.604),
                 {link("lower front rod", US, {{0.2115, 0.3845, -0.1}}, {{0.0025, 0.737, -0.134}}),
                  link("lower rear rod", US, {{-0.236, 0.388, -0.109}}, {{-0.005, 0.737, -0.13}}),
                  link("tie rod", US, {{-0.093, 0.366, 0.004}}, {{-0.188, 0.647, -0.023}}, moved),
                  link("upper rear rod", US, {{-0.303, 0.432, 0.295}}, {{-0.117, 0.636, 0.338}}),
                  link("upper front rod", US, {{-0.064, 0.413, 0.327}}, {{-0.064, 0.636, 0.345}})}),
          sample("strut_SP-3US", "strut with three rods (example 2, two points refined)",
                 wheel({0, 0.787, 0}, -0.26, 0.69, 0.604),
                 {link("lower front rod", US, {{0.2947, 0.3651, -0.0589}}, {{0.0255, 0.6912, -0.072}}),
                  link("lower rear rod", US, {{-0.0611, 0.3835, -0.1188}}, {{-0.00587, 0.6799, -0.1402}}),
                  link("tie rod", US, {{0.0737, 0.3534, -0.0767}}, {{0.1353, 0.6946, -0.0976}}, moved),
                  link("strut", SP, {{-0.0737, 0.5947, 0.4576}}, {{-0.0366043, 0.6755409, 0.0114}})}),
          sample("interconnected", "interconnected links (example 3)", wheel({0, 0.78, 0}, 0, 0, 0.604),
                 {link("upper rod", US, {{0, 0.431, 0.092}}, {{0.01, 0.716, 0.116}}),
                  link("lower rod", US, {{-0.107, 0.273, -0.136}}, {{-0.055, 0.729, -0.163}}),
                  link("trailing blade", SR, {{0.421, 0.721, -0.022}},
                       {{0.03, 0.677, -0.12}, {0.04583844403245363, 0.777, -0.12}})},
                 std::nullopt, {{"coupler", 0, 0.6149900163705148, 2, {0.2, 0.628, -0.058}}}),
          sample("rear_5US", "five-link rear suspension (example 4)", wheel({0, 0, 0}, 0, -1.25, 0.604),
                 {link("lower rear rod", US, {{-0.2096, -0.5271, -0.0882}}, {{-0.0251, -0.0638, -0.0951}}),
                  link("lower front rod", US, {{0.3244, -0.3821, -0.0462}}, {{0.0298, -0.0768, -0.1561}}),
                  link("front rod", US, {{0.1874, -0.4301, -0.0022}}, {{0.1809, -0.1409, -0.0273}}),
                  link("upper rear rod", US, {{-0.0716, -0.3501, 0.1338}}, {{0.0111, -0.053, 0.14}}),
                  link("upper front rod", US, {{0.2324, -0.3281, 0.1458}}, {{-0.0599, -0.056, 0.11}})})};
}

}  // namespace

std::span<const CornerSample> corner_samples() {
  static const std::vector<CornerSample> all = [] {
    std::vector<CornerSample> out = basic_mechanisms();
    for (CornerSample& sample : published_examples()) out.push_back(std::move(sample));
    return out;
  }();
  return all;
}

const CornerSample& corner_sample(std::string_view name) {
  const CornerSample* found = nullptr;
  std::string known;
  for (const CornerSample& sample : corner_samples()) {
    if (sample.name == name) found = &sample;
    known += (known.empty() ? "" : ", ") + sample.name;
  }
  LINKWRIGHT_REQUIRE(found, "no sample '{}'; there are {}", name, known);
  return *found;
}

}  // namespace linkwright::suspension
