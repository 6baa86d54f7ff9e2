#include "linkwright/clearance/studies.h"

#include "linkwright/clearance/clearance_study.h"
#include "linkwright/clearance/tolerance_study.h"

namespace linkwright::clearance {

std::vector<study::Kind> studies() { return {clearance_kind(), tolerance_kind()}; }

}  // namespace linkwright::clearance
