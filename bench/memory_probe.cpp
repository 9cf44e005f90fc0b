// SPDX-License-Identifier: Apache-2.0
#include "memory_probe.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "incise/io/mesh_loader.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

namespace {

constexpr double kBytesPerMb = 1e6;

/// A line of /proc/self/status in megabytes (of 10^6 bytes); 0 where the system has none.
double status_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word == key + ":") {
      double kibibytes = 0;
      status >> kibibytes;
      return kibibytes * 1024.0 / kBytesPerMb;
    }
  }
  return 0;
}

Result<TetMesh> make_mesh(const std::string& source) {
  if (source.rfind("kuhn:", 0) == 0) {
    return TetMesh::build(kuhn_cube(static_cast<std::uint32_t>(std::strtoul(source.c_str() + 5, nullptr, 10))));
  }
  Result<io::LoadedMesh> loaded = io::load_mesh(source);
  if (!loaded) {
    return loaded.error();
  }
  return std::move(loaded->mesh);
}

}  // namespace

int run_memory_probe(const std::string& source) {
  const double baseline = status_mb("VmRSS");
  const Result<TetMesh> mesh = make_mesh(source);
  if (!mesh) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    return 1;
  }
  std::printf("%zu %.3f %.3f %.3f %.3f\n", mesh->tet_count(), baseline, status_mb("VmHWM"), status_mb("VmRSS"),
              static_cast<double>(mesh->memory_bytes()) / kBytesPerMb);
  return 0;
}

std::optional<MemoryFigures> probe_memory(const std::filesystem::path& program, const std::string& source) {
  const std::string command = "\"" + program.string() + "\" --memory-probe \"" + source + "\"";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  MemoryFigures figures;
  unsigned long long tets = 0;
  if (!pipe || std::fscanf(pipe.get(), "%llu %lf %lf %lf %lf", &tets, &figures.baseline_mb, &figures.peak_mb,
                           &figures.resident_mb, &figures.mesh_mb) != 5) {
    return std::nullopt;
  }
  figures.tets = tets;
  return figures;
}

}  // namespace incise::bench
