// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace linkwright::serve {

/// The page of the workbench without an engine (web/workbench.mjs), in the format of gzip; empty when the
/// viewer was not built (LINKWRIGHT_REPORT_VIEWER=OFF).
std::string_view workbench_page();

}  // namespace linkwright::serve
