// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parameter_study/studies.h"

#include "linkwright/parameter_study/studies/sweep.h"

namespace linkwright::parameter_study {

std::vector<study::Kind> studies(std::span<const study::Kind> kinds) { return {sweep_kind(kinds)}; }

}  // namespace linkwright::parameter_study
