// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/study/bind.h"

// Path synthesis has one grammar for all mechanisms. What the mechanism itself makes different is listed
// here, with the reason: messages, schema and reference say it, and a test compares both schemas.
namespace linkwright::planar {

/// The keys and words of slider-crank studies that those of four-bars lack, with the reasons.
std::span<const study::Absent> absent_from_four_bar_paths();

/// The other way round.
std::span<const study::Absent> absent_from_slider_crank_paths();

}  // namespace linkwright::planar
