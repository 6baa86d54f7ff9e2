// SPDX-License-Identifier: BSD-3-Clause

// The program with the sample domain instead of the real ones; program_test runs it.
#include "linkwright/cli/program.h"
#include "tests/study/sample_kind.h"

int main(int argc, char** argv) {
  return linkwright::cli::program(argc, argv, linkwright::study::sample::kinds());
}
