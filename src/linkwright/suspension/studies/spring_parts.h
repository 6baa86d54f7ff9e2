// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "linkwright/suspension/studies/corner.h"

// Rockers, springs, dampers, bars and stops of a wheel suspension in a file.
namespace linkwright::suspension {

/// Place of a hard point that a key names; nothing where that has been reported.
using NamedPoint =
    std::function<std::optional<Vec3>(study::ObjectReader& table, std::string_view key, const std::string&)>;

/// Reads rockers, springs, dampers, bars and stops of the mechanism, whose links are known; problems go to
/// the reader.
void read_spring_parts(study::ObjectReader& mechanism, const study::Common& common, const CornerForm& form,
                       const NamedPoint& named, CornerDescription& out);

/// Name of a part in files: "body", "carrier", or that of a link or a rocker.
std::string part_name(const Suspension& suspension, const CornerPart& part);

/// Puts the forms of what `read_spring_parts` read into the form of a canonical study.
void write_spring_parts(const CornerDescription& description, CornerForm& form);
/// Takes the keys out of the canonical table that name nothing.
void drop_empty_spring_keys(Value& mechanism);

/// The name of the rocker that is the arm of the anti-roll bar.
inline constexpr std::string_view bar_arm = "anti-roll bar";

}  // namespace linkwright::suspension
