// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/planar/type_synthesis/search.h"

namespace linkwright::planar {

/// Not worse than another machine in links, error, pair angle, size and acceleration.
bool dominates(const FoundMachine& a, const FoundMachine& b);

/// Adds a machine to a list that is sorted by error and has at most `most` machines, without machines that
/// are alike up to what the polish leaves open or, in an archive, without dominated ones.
void insert_machine(std::vector<FoundMachine>& list, const FoundMachine& found, std::size_t most,
                    bool archive);

/// Machines of one family, best first: the best, and the best of those that are clearly kinder in another
/// respect.
std::vector<FoundMachine> chosen_of_family(const std::vector<FoundMachine>& archive);

/// Of the chosen machines of all families those that no other one dominates, best first.
std::vector<FoundMachine> chosen_of_all(const std::vector<FoundMachine>& all, std::size_t most);

}  // namespace linkwright::planar
