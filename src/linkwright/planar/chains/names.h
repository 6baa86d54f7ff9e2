// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/planar/chains/markings.h"

namespace linkwright::planar {

/// The name that engineers use, empty where there is none: "four-bar", "slider-crank", "inverted
/// slider-crank", "trammel", "Scotch yoke", "Oldham coupling", "Rapson slide", "Watt I", "Stephenson III",
/// "geared five-bar"; without ground that of the chain: "Watt chain", "double-slider chain".
std::string common_name(const ChainGraph& graph, const Marking& marking = {});

/// The name of a mechanism in the tables of this program, links from 1: "8-07/ground 3/driver 5", where the
/// driver acts between links 3 and 5; "6-1/sliders 1-2 3-4/gears 2-5 on 1".
std::string mechanism_name(const Chain& chain, const Marking& marking);

}  // namespace linkwright::planar
