// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/app/examples.h"
#include "linkwright/core/value.h"

namespace linkwright::app {

/// Runs an example for a picture of it, on one thread, and puts the files that it reads into `folder`. Of a
/// long run this is what it has found after so many steps, so that the picture does not depend on the time.
/// The document has `name`, `title` and `text` of the example and `scene`, the first one that a report would
/// show; null where there is none.
Value example_scene(const Example& example, const std::string& folder);

}  // namespace linkwright::app
