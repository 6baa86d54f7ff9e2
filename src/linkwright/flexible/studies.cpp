#include "linkwright/flexible/studies.h"

#include "linkwright/flexible/hub_link_study.h"

namespace linkwright::flexible {

std::vector<study::Kind> studies() { return {hub_link_kind()}; }

}  // namespace linkwright::flexible
