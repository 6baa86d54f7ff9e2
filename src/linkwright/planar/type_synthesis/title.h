// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {

/// The title of a type in words: "Six-bar linkage of Watt, traced point on the second bar of the last pair".
std::string title_of(const PointProgram& program);

/// The short name of a type: "Watt I b", "eight-bar 13-15 b" with the links that the second and the third
/// pair join, and the traced bar of the last one.
std::string short_name_of(const PointProgram& program);

}  // namespace linkwright::planar
