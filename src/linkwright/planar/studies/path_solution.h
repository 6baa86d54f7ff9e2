#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/study/result.h"

// Four-bars in reports of path synthesis.
namespace linkwright::planar {

/// A design as an answer of a study, the `number`-th from 1: numbers with their bounds, errors,
/// classification, defects, and the study of its motion. Its scene is "solution-<number>".
study::Solution path_solution(const PathProblem& problem, const PathDesign& design, std::size_t number,
                              int samples);

/// Tables "points" and "motion" with their diagrams, of each design beside its solution in the result. The
/// best design's have plain names, those of the others carry the number of the solution.
void add_design_tables(study::Result& result, const PathProblem& problem,
                       const std::vector<PathDesign>& designs, int samples);

/// "crank-rocker (open branch)"
std::string called(const PathDesign& design);

/// Least transmission angle (rad) that a design is judged by: over the whole motion where the crank has to
/// rotate fully, else over what the path uses.
double judged_transmission(const PathProblem& problem, const PathDesign& design);
study::Fact transmission_fact(const PathProblem& problem, const PathDesign& design);

}  // namespace linkwright::planar
