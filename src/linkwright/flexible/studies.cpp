// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies.h"

#include "linkwright/flexible/studies/arm.h"
#include "linkwright/flexible/studies/hub_link.h"
#include "linkwright/flexible/studies/vibration.h"

namespace linkwright::flexible {

std::vector<study::Kind> studies() { return {arm_kind(), hub_link_kind(), vibration_kind()}; }

}  // namespace linkwright::flexible
