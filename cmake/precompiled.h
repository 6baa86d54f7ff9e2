// What most sources include, compiled once a target (LINKWRIGHT_PRECOMPILED_HEADERS). Sources still include what they use.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
#if __has_include(<Eigen/Dense>)  // found by the modules that link Eigen
#include <Eigen/Dense>
#endif
