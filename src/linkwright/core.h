// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What all modules share: statuses, diagnostics, sentences, quantities, units, tables and the context of a
// run.

#include "linkwright/core/check.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/kernels.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
