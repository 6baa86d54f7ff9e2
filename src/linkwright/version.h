// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @ingroup core
/// The version of the library: "major.minor.patch". Until 1.0 a new minor version may change names; what is
/// renamed keeps its old name for one version.
#define LINKWRIGHT_VERSION "0.1.0"
