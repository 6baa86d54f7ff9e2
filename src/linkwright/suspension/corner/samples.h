// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// A built-in wheel suspension.
struct CornerSample {
  std::string name;       ///< "2RS-US": a basic mechanism; or that of a published example
  std::string summary;    ///< description in one line
  Suspension suspension;  ///< the suspension
};

/// All samples: the twelve basic mechanisms, one realistic left wheel each, movable by at least 80 mm both
/// ways and five of them steered; then the four examples of Poznanovic 2016 (sections 6.1 to 6.4).
///
/// @returns the samples; they exist as long as the program
std::span<const CornerSample> corner_samples();

/// The sample of a name.
///
/// @param name name of the sample
/// @returns the sample
/// @throws ContractError if there is no sample of that name
const CornerSample& corner_sample(std::string_view name);

}  // namespace linkwright::suspension
