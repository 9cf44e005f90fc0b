// SPDX-License-Identifier: Apache-2.0
// The memory of mesh and adjacency per tet: each mesh is loaded in a fresh process, which then tells its peak.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incise/io/mesh_file.h"
#include "incise/mesh/shapes.h"
#include "memory_probe.h"
#include "report.h"

namespace incise::bench {

namespace {

std::string number(double value) {
  return fmt::format("{:.1f}", value);
}

/// The peak of the sources below per tet: generated in memory, and read from files.
double measure_memory(std::uint32_t cells, const std::filesystem::path& program, const std::filesystem::path& folder) {
  Table table("memory",
              "Memory of mesh and adjacency, each in a fresh process; bytes per tet; peak includes loading and the "
              "program itself",
              {"tets", "source", "peak", "peak less program", "resident after", "mesh's own account"});
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::vector<std::pair<std::string, std::string>> sources = {{"generated", fmt::format("kuhn:{}", cells)}};
  std::vector<std::filesystem::path> temporary;
  {
    io::MeshData data;
    data.soup = kuhn_cube(cells);
    for (const char* extension : {".mesh", ".vtu"}) {
      const std::filesystem::path file = folder / (std::string("memory_probe") + extension);
      if (const Status written = io::write_mesh(file, data); written.ok()) {
        sources.emplace_back(std::string("file ") + extension, file.string());
        temporary.push_back(file);
      } else {
        std::fprintf(stderr, "left out: %s\n", written.error().message.c_str());
      }
    }
  }
  double worst = 0;
  for (const auto& [name, source] : sources) {
    const std::optional<MemoryFigures> m = probe_memory(program, source);
    if (!m || m->tets == 0) {
      continue;
    }
    const auto per_tet = [&](double mb) { return 1e6 * mb / static_cast<double>(m->tets); };
    table.add({std::to_string(m->tets), name, number(per_tet(m->peak_mb)), number(per_tet(m->peak_mb - m->baseline_mb)),
               number(per_tet(m->resident_mb)), number(per_tet(m->mesh_mb))});
    worst = std::max(worst, per_tet(m->peak_mb));
  }
  for (const std::filesystem::path& file : temporary) {
    std::filesystem::remove(file, error);
  }
  table.print();
  table.write_csv(folder);
  return worst;
}

std::filesystem::path own_path(const char* argv0) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path(argv0) : self;
}

constexpr const char* kUsage =
    "usage: bench_memory [--out FOLDER] [--quick]\n"
    "Measures the memory of a mesh of 3M tets, loading included; --quick takes 384k.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  std::uint32_t cells = 80;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--memory-probe" && i + 1 < argc) {
      return run_memory_probe(argv[i + 1]);
    }
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      cells = 40;
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
  const double worst = measure_memory(cells, own_path(argv[0]), folder);
  report_acceptance("memory",
                    {{"peak memory, loading and program included, worst source, bytes per tet", "≤ 100", "-",
                      number(worst), worst > 0 && worst <= 100.0}},
                    folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
