// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/samples.h"

#include "linkwright/planar/linkage/samples.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::app {

std::vector<Sample> samples() {
  std::vector<Sample> all;
  for (const planar::LinkageSample& sample : planar::linkage_samples())
    all.push_back({sample.name, sample.summary, {"planar.linkage", "clearance.linkage"}, "Planar linkages"});
  for (const suspension::CornerSample& sample : suspension::corner_samples())
    all.push_back({sample.name, sample.summary, {"suspension.corner"}, "Wheel suspensions"});
  return all;
}

}  // namespace linkwright::app
