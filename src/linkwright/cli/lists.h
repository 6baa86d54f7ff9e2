// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/cli/arguments.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/reproduction.h"

/// The commands that list what there is, and write a file of it for a start. Each returns the exit code.
namespace linkwright::cli {

int list_catalogue(const Arguments& arguments, std::span<const study::Kind> kinds);
int list_samples(const Arguments& arguments);
/// Lists the examples, or copies one.
int list_examples(const Arguments& arguments);
/// Writes the template of a kind, with the line by which editors find its schema.
int make_study(const Arguments& arguments, std::span<const study::Kind> kinds);
/// Lists the columns that a study, or the template of a kind, will have.
int list_columns(const Arguments& arguments, std::span<const study::Kind> kinds);
int print_schema(const Arguments& arguments, std::span<const study::Kind> kinds);
int reproduce(const Arguments& arguments, std::span<const study::Reproduction> all);

}  // namespace linkwright::cli
