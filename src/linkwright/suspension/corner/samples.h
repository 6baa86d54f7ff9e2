// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// A built-in wheel suspension.
struct CornerSample {
  std::string name;     ///< "2RS-US": a basic mechanism; or that of a published example
  std::string summary;  ///< description in one line
  Suspension suspension;
};

/// All samples: the twelve basic mechanisms, one realistic left wheel each, movable by at least 80 mm both
/// ways and five of them steered; then the four examples of Poznanovic 2016 (sections 6.1 to 6.4).
std::span<const CornerSample> corner_samples();
/// The sample of this name; throws ContractError when there is none.
const CornerSample& corner_sample(std::string_view name);

}  // namespace linkwright::suspension
