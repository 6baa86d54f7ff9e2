// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup core Core
/// The vocabulary of all modules: statuses, diagnostics, sentences, quantities, units, tables and the context
/// of a run. Numbers are in SI units and radians everywhere; a unit appears only where a number is read or
/// shown.
///
/// @code
/// using namespace linkwright;
/// const Sentence said = say("the crank turns at {}", measured("rad_per_s", 31.4));
/// std::printf("%s\n", to_string(said).c_str());
/// Table table{.name = "sweep"};
/// const Quantity angle{.key = "crank_angle", .words = "crank angle", .dimension = Dimension::angle};
/// table.add(angle, {0, pi / 2, pi});
/// std::printf("%s", to_csv(table).c_str());
/// @endcode

/// @namespace linkwright
/// All of the library; the modules have namespaces of their own in it.

/// @namespace linkwright::field
/// Fields by what they measure, with the bounds of that dimension.

/// @namespace linkwright::tolerance
/// Named tolerances. Lengths are relative to a characteristic length of the thing measured, angles in
/// radians.

#include "linkwright/core/check.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
