// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linkwright/planar/studies/balancing.h"

namespace linkwright::planar {

/// A study in which only masses are designed: forces are linear in the base parameters of the links, so that
/// a design is evaluated without any motion, and the best one may be the answer of a cone programme.
class MassStudy;

/// The study as one of masses alone; nothing, and `why` gives the reason, when something else is designed.
std::shared_ptr<const MassStudy> mass_study(const BalancingStudy& study, std::string& why);

/// Columns of one design, as `design_table` has them, if all of them are forces or torques; else nothing.
std::function<Table(std::span<const double> x)> mass_table(std::shared_ptr<const MassStudy> masses,
                                                           const std::vector<std::string>& columns);

/// The cone programme, where mass centres may lie in any direction; empty otherwise, and `why` says so.
ExactBalancing exact_balancing(std::shared_ptr<const MassStudy> masses, const BalancingProblem& problem,
                               std::string& why);

}  // namespace linkwright::planar
