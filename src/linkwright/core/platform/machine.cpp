// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/machine.h"

#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif
#ifdef __APPLE__
#include <sys/random.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace linkwright::platform {

double memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
  const double machine = pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size) : 0;
  // A shell or a batch system may give less (ulimit -v).
  rlimit process{};
  if (::getrlimit(RLIMIT_AS, &process) != 0 || process.rlim_cur == RLIM_INFINITY) return machine;
  const auto allowed = static_cast<double>(process.rlim_cur);
  return machine > 0 ? std::min(machine, allowed) : allowed;
}

int processors() { return std::max(1, static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN))); }

int own_processors() {
#ifdef __linux__
  cpu_set_t own;
  CPU_ZERO(&own);
  if (::sched_getaffinity(0, sizeof own, &own) == 0) return std::max(1, CPU_COUNT(&own));
#endif
  return processors();
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string();
}

void fill_random(std::span<unsigned char> bytes) {
  if (::getentropy(bytes.data(), bytes.size()) != 0)
    throw std::system_error(errno, std::generic_category(), "no random numbers from the system");
}

}  // namespace linkwright::platform
