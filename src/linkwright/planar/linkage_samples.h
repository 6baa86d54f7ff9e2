#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/linkage.h"

namespace linkwright::planar {

/// A canned linkage with its drive, ready to be analysed: every body has its mass, and every pair with two
/// assembly modes has its mode.
struct LinkageSample {
  std::string name;     ///< "jansen_leg"
  std::string summary;  ///< what it is and what to look at
  Linkage linkage;
  /// Inputs of the motion to look at: all inputs run from `from` to `to` (rad or m) together.
  std::vector<double> from, to;
  double speed = 1;               ///< of the first input (rad/s or m/s)
  std::vector<BodyPoint> traces;  ///< points whose paths are worth drawing
};

LinkageSample four_bar_sample();
LinkageSample slider_crank_sample();         ///< in line
LinkageSample offset_slider_crank_sample();  ///< offset, inclined guide
LinkageSample inverted_slider_crank_sample();
LinkageSample scotch_yoke_sample();
LinkageSample whitworth_sample();

/// All of them.
std::vector<LinkageSample> linkage_samples();

}  // namespace linkwright::planar
