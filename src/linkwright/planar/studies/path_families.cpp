// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_families.h"

#include <array>
#include <span>
#include <string_view>

namespace linkwright::planar {
namespace {

using study::Absent;

constexpr std::string_view one_objective =
    "not for four-bars: a front needs two objectives, and the stroke belongs to a slider; limit the "
    "transmission angle instead, or take planar.slider_crank";

constexpr std::array not_of_four_bars{
    Absent{"mechanism.branch", "forward",
           "not for four-bars: their branch is the side of the coupler-rocker pin, open or crossed"},
    Absent{"mechanism.branch", "backward",
           "not for four-bars: their branch is the side of the coupler-rocker pin, open or crossed"},
    Absent{"mechanism.parameters.rod", {}, "not for four-bars: the link at the crank pin is the coupler"},
    Absent{"mechanism.parameters.point_distance",
           {},
           "not for four-bars: coupler_u and coupler_v place the tracing point"},
    Absent{"mechanism.parameters.point_angle",
           {},
           "not for four-bars: coupler_u and coupler_v place the tracing point"},
    Absent{"mechanism.parameters.guide_angle",
           {},
           "not for four-bars: they have no guide; frame_angle is the direction of the ground link"},
    Absent{"mechanism.parameters.offset",
           {},
           "not for four-bars: they have no guide; rocker_pivot_x and rocker_pivot_y place the rocker pivot"},
    Absent{"target.point", "rod", "not for four-bars: their tracing point is one of the coupler"},
    Absent{"objective.type", "slider.stroke", one_objective},
    Absent{"constraint.type", "pressure_angle",
           "not for four-bars: write transmission_angle, which is 90 deg less the pressure angle"},
    Absent{
        "constraint.type", "stroke",
        "not for four-bars: they have no slider; bounds of crank and rocker limit how far the rocker swings"},
    Absent{"optimiser.front", {}, one_objective},
    Absent{"optimiser.method", "nsga2", one_objective},
    Absent{"optimiser.method", "moead", one_objective},
};

constexpr std::array not_of_slider_cranks{
    Absent{"mechanism.branch", "open",
           "not for slider-cranks: their branch is the side of the slider, forward or backward"},
    Absent{"mechanism.branch", "crossed",
           "not for slider-cranks: their branch is the side of the slider, forward or backward"},
    Absent{"mechanism.parameters.ground",
           {},
           "not for slider-cranks: they have no ground link; guide_angle and offset place the guide"},
    Absent{"mechanism.parameters.coupler", {}, "not for slider-cranks: the link at the crank pin is the rod"},
    Absent{"mechanism.parameters.rocker",
           {},
           "not for slider-cranks: they have a guide in its place; guide_angle and offset place it"},
    Absent{"mechanism.parameters.coupler_u",
           {},
           "not for slider-cranks: point_distance and point_angle place the tracing point"},
    Absent{"mechanism.parameters.coupler_v",
           {},
           "not for slider-cranks: point_distance and point_angle place the tracing point"},
    Absent{"mechanism.parameters.frame_angle",
           {},
           "not for slider-cranks: they have no ground link; guide_angle is the direction of the guide"},
    Absent{"mechanism.parameters.rocker_pivot_x",
           {},
           "not for slider-cranks: they have one fixed pivot; guide_angle and offset place the guide"},
    Absent{"mechanism.parameters.rocker_pivot_y",
           {},
           "not for slider-cranks: they have one fixed pivot; guide_angle and offset place the guide"},
    Absent{"target.point", "coupler", "not for slider-cranks: their tracing point is one of the rod"},
    Absent{"constraint.type", "transmission_angle",
           "not for slider-cranks: write pressure_angle, which is 90 deg less the transmission angle"},
    Absent{"constraint.type", "packaging",
           "not for slider-cranks: they have one fixed pivot; give pivot_x and pivot_y as ranges, and limit "
           "the travel of the slider by a stroke"},
};

}  // namespace

std::span<const Absent> absent_from_four_bar_paths() { return not_of_four_bars; }
std::span<const Absent> absent_from_slider_crank_paths() { return not_of_slider_cranks; }

}  // namespace linkwright::planar
