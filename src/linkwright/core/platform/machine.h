// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

/// Every call of the operating system. This folder is the only place that knows which one it is, and the only
/// one that includes its headers.
namespace linkwright::platform {

/// Memory of the machine, or what of it a limit of the process allows (bytes); 0 where it does not say.
double memory();

/// Processors of the machine that are switched on, and how many of them this process may use; each at
/// least 1.
int processors();
int own_processors();

/// Name of the machine; empty where it has none.
std::string host_name();

/// Fills with random numbers of the system that nobody can guess, at most 256. Throws std::system_error where
/// it has none.
void fill_random(std::span<unsigned char> bytes);

}  // namespace linkwright::platform
