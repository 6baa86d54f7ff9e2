// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/memory.h"

#include <fmt/core.h>

#include "linkwright/core/memory.h"

namespace linkwright::study {

double table_bytes(double rows, double columns) {
  constexpr double number = 130;
  return number * rows * columns;
}

double population_bytes(double population, double variables) {
  // Members, candidates, two more generations of them that methods keep, velocities and best places of
  // swarms; costs and violations of each. The state for the checkpoint is as large again, before and after a
  // generation, and is written as text: 28 numbers a variable were measured of a swarm of 400 000.
  constexpr double copies = 28, of_costs = 8;
  return sizeof(double) * population * (copies * variables + of_costs);
}

bool require_memory(ObjectReader& table, std::string_view key, double bytes, std::string_view what,
                    std::string_view mend) {
  const auto problem = memory_problem(bytes, what);
  if (problem) table.unreadable(key, *problem, fmt::format("{}, {}", mend, memory_hint));
  return !problem;
}

}  // namespace linkwright::study
