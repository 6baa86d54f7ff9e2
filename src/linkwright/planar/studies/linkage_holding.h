// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/studies/linkage.h"

// `[holding]` of an analysis: the drive, or a load, with which friction holds the linkage at rest.
namespace linkwright::planar {

/// Reads the table and writes it into `canonical` unless that is null; nothing when it is absent, or there
/// are problems, which go to the reader.
std::optional<LinkageHolding> read_holding(study::ObjectReader& document, const Linkage& linkage,
                                           const LinkagePlan& plan, Value* canonical);
void describe_holding(study::SchemaWriter& document);

/// Adds the columns of least and greatest holding force and the self-locking margin. The study must outlive
/// them.
void add_holding_columns(const LinkageStudy& study, std::vector<LinkageColumn>& columns);

/// Adds the facts: where it locks by itself, and the range that holds, from the first table of the result.
void add_holding_facts(const LinkageStudy& study, study::Result& result);

}  // namespace linkwright::planar
