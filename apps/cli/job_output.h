// SPDX-License-Identifier: Apache-2.0
// What the commands that work on one mesh share: where it comes from, and where results go.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/jobs/cut_job.h"
#include "incise/io/mesh_loader.h"
#include "mesh_output.h"
#include "terminal.h"

namespace incise_cli {

inline constexpr const char* kNoBudgetAsPaper =
    "--budget-us has no effect with --profile paper, which maintains the mesh in one go";

/// Where a job's figures go.
struct ReportOutput {
  std::string file;  // "-": stdout; empty: nowhere
  bool as_json = false;

  [[nodiscard]] bool is_on_stdout() const { return as_json || file == "-"; }
};

/// Whether outputs can be written, as far as their names tell; else says why and gives the exit code.
std::optional<ExitCode> refuse_outputs(const MeshOutput& mesh, bool has_json_on_stdout,
                                       const std::vector<std::string>& others, const Terminal& terminal);

/// Reads a mesh to work on, and says what was mended on the way.
incise::Result<incise::io::LoadedMesh> load(const std::string& mesh, const Terminal& terminal);

/// Warns of strokes of `file` that opened nothing, by number; `names`: of the strokes, as far as they have any.
void warn_of_misses(const std::string& file, const std::vector<std::uint64_t>& missed,
                    const std::vector<std::string>& names, const Terminal& terminal);

/// Writes what a job gave and says how it went; `work` names it in messages. Returns the exit code.
int finish_job(const MeshOutput& output, const ReportOutput& report, const std::string& work,
               const incise::app::JobResult& result, const Terminal& terminal);

}  // namespace incise_cli
