#include "linkwright/clearance/studies.h"

#include "linkwright/clearance/clearance_study.h"

namespace linkwright::clearance {

std::vector<study::Kind> studies() { return {clearance_kind()}; }

}  // namespace linkwright::clearance
