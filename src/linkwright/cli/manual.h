// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace linkwright::cli {

/// The page of the manual, section 1, as roff: made from what --help prints.
std::string manual_page();

}  // namespace linkwright::cli
