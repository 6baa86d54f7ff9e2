// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Colours for values: from dark blue over green to light yellow in steps that look equally large. They grow
/// lighter all the way, so that they can be distinguished in grey print and by the colour-blind, too.
namespace linkwright::report {

/// Number of classes of colour. More cannot be distinguished, and neighbours of one class are drawn as one.
inline constexpr int colour_classes = 24;

/// Class of a value between low and high, 0 for low, colour_classes - 1 for high and whenever the two are
/// the same; values outside have the class of the nearer end. `value` must not be NaN.
int colour_class(double value, double low, double high);

/// Colour in the middle of a class: "#2c206b".
std::string class_colour(int colour_class);

}  // namespace linkwright::report
