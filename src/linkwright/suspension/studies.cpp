#include "linkwright/suspension/studies.h"

#include "linkwright/suspension/sweep_study.h"

namespace linkwright::suspension {

std::vector<study::Kind> studies() { return {sweep_kind()}; }

}  // namespace linkwright::suspension
