// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/catalogue.h"
#include "linkwright/cli/program.h"

int main(int argc, char** argv) {
  return linkwright::cli::program(argc, argv, linkwright::app::catalogue(), linkwright::app::reproductions());
}
