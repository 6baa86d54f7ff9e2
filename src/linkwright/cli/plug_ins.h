// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

// Parts of the program that are loaded when they are needed.
namespace linkwright::cli {

/// A part that is asked for is not there; `what` says which and where it should be.
struct PartMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The library of this name, "mpi.so", in lib/linkwright beside the program as it is built and installed, or
/// of the folder of the system's libraries; null with `problem` where it cannot be loaded.
void* load_plug_in(const std::string& name, std::string& problem);

}  // namespace linkwright::cli
