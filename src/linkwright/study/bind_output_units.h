// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/field.h"
#include "linkwright/core/value.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// How `units` of `[output]` is read, written and described.
namespace linkwright::study {

bool read_value(ObjectReader& reader, const ObjectReader::Found& found, const Field& field,
                OutputUnits& member);
Value write_value(const OutputUnits& member);
Value schema_value(const Field& field, const OutputUnits& member);

}  // namespace linkwright::study
