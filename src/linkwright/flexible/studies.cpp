#include "linkwright/flexible/studies.h"

#include "linkwright/flexible/arm_study.h"
#include "linkwright/flexible/hub_link_study.h"
#include "linkwright/flexible/vibration_study.h"

namespace linkwright::flexible {

std::vector<study::Kind> studies() { return {arm_kind(), hub_link_kind(), vibration_kind()}; }

}  // namespace linkwright::flexible
