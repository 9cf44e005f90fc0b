// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace incise::bench {

/// What loading one mesh cost, measured in a process of its own.
struct MemoryFigures {
  std::uint64_t tets = 0;
  double baseline_mb = 0;  ///< resident before anything was loaded
  double peak_mb = 0;      ///< most that was ever resident, loading included
  double resident_mb = 0;  ///< resident once the mesh stands and the input is gone
  double mesh_mb = 0;      ///< the mesh's own account of its arrays
};

/// The entry point of the child process: makes one mesh and prints its figures.
/// @param source  "kuhn:N" for a generated cube, else a mesh file.
int run_memory_probe(const std::string& source);

/// Starts `program --memory-probe source` afresh and reads its figures; nothing where that fails.
std::optional<MemoryFigures> probe_memory(const std::filesystem::path& program, const std::string& source);

}  // namespace incise::bench
