#include "linkwright/suspension/studies.h"

#include "linkwright/suspension/direct_study.h"
#include "linkwright/suspension/indirect_study.h"
#include "linkwright/suspension/sweep_study.h"

namespace linkwright::suspension {

std::vector<study::Kind> studies() { return {sweep_kind(), indirect_kind(), direct_kind()}; }

}  // namespace linkwright::suspension
