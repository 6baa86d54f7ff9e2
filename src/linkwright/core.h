#pragma once

// Includes every header that all modules share: tables, statuses, diagnostics, units, random numbers,
// checkpoints.

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/closing_row.h"
#include "linkwright/core/csv.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/finite.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/kernels.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/memory.h"
#include "linkwright/core/npy.h"
#include "linkwright/core/number_lists.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity.h"
#include "linkwright/core/quantity_columns.h"
#include "linkwright/core/random.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
