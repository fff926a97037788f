/// @file
/// How much memory it takes to show a mesh that is in one file.
#pragma once

#include "dovetail/core/number_text.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <unistd.h>

namespace dovetail::app {

/// Over the size of an MSH or VTU file without compression: what was measured, and something for the system.
inline constexpr double memory_over_file = 3.5;

/// Of this machine, in bytes; 0: not known.
inline double memory_of_machine() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? static_cast<double>(pages) * static_cast<double>(bytes) : 0;
}

/// What is to be said before a file of so many bytes is read; empty: it fits.
inline std::string text_of_memory(std::uintmax_t file, double memory) {
  const double needed = memory_over_file * static_cast<double>(file);
  if (memory <= 0 || needed <= memory)
    return {};
  const auto gigabytes = [](double bytes) { return number_text(std::ceil(1e-9 * bytes), 6) + " GB"; };
  return "it takes about " + gigabytes(needed) + " of memory to show this file, and this machine has " +
         gigabytes(memory) +
         "; a mesh in several files, as of 'dovetail mesh --format vtu', is read piece by piece";
}

} // namespace dovetail::app
