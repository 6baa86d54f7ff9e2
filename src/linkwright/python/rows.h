// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/status.h"

namespace linkwright::python {

/// Named rows of equal length where a computation has left them, and how each sample ended.
struct Rows {
  std::shared_ptr<const void> owner;
  std::vector<std::pair<std::string, std::span<const double>>> rows;
  std::span<const Status> status;
};

}  // namespace linkwright::python
