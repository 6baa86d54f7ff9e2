// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "linkwright/core/number_lists.h"
#include "linkwright/core/table.h"
#include "linkwright/core/value.h"
#include "linkwright/study/reproduction.h"
#include "linkwright/study/result.h"
#include "linkwright/study/study.h"

namespace linkwright::app {

/// The data that differ between two runs of one study.
struct RunRecord {
  std::string started;  ///< UTC, "2026-02-03T04:05:06Z"
  double seconds = 0;   ///< wall-clock time of the run
  std::string host;
  int threads = 0;  ///< 0 = all
};

/// The result with its numbers - tables, parameters, objectives, statistics, troubles - in the units and with
/// the digits that `[output]` of the study asks for; what result.json and CSV hold.
study::Result presented(const study::Study& study, study::Result result);

/// The document of result.json, see result_schema.h, of a result as it is presented(). All of it but `run`
/// depends on the study and the program alone. `lists`: of the tables. Tables of more than `max_rows` are
/// named by their file (long_table_file) alone.
Value result_json(const study::Study& study, const study::Result& shown, const RunRecord& run,
                  const NumberLists& lists = {},
                  std::size_t max_rows = std::numeric_limits<std::size_t>::max());

/// The file of a table that is too long for result.json, CSV and the report: "trials.npy".
std::string long_table_file(const Table& table);

/// A result for its report: of tables with more than `max_rows`, each k-th row, so that no more than 10 000
/// are left, without the maps that are drawn of them.
study::Result with_short_tables(study::Result shown, std::size_t max_rows);

/// A published table with its numbers recomputed.
Value reproduction_json(const study::Reproduction& reproduction, const std::vector<study::Comparison>& rows);

}  // namespace linkwright::app
