// SPDX-License-Identifier: Apache-2.0
// Outputs are refused before the work by what their names tell; afterwards mesh, report and exit code follow from
// whether the validity contract held.
#include "job_output.h"

#include "app/text/text_file.h"
#include "command_support.h"
#include "input_kind.h"

namespace incise_cli {

using namespace incise;

namespace {

Status write_report(const ReportOutput& output, const app::JobReport& report, const Terminal& terminal) {
  if (!output.file.empty() && output.file != "-") {
    if (Status status = app::write_text_file(output.file, app::to_json(report)); !status.ok()) return status;
    terminal.wrote(output.file, "report");
  }
  return output.is_on_stdout() ? terminal.data(app::to_json(report)) : Status();
}

/// Whether a method has removed all tets; there is no file without one.
bool is_empty(const app::JobResult& result) {
  return result.report.after.tets == 0;
}

Status write_results(const MeshOutput& output, const ReportOutput& report, const app::JobResult& result,
                     const Terminal& terminal) {
  const WritingZone zone;
  if (output.is_wanted() && !is_empty(result) && (result.report.change.ok || result.report.broken)) {
    if (Status status = write_output(output, result.mesh, terminal); !status.ok()) return status;
  }
  return write_report(report, result.report, terminal);
}

/// Tets without volume are sound neighbours, so that the contract holds, but nobody can simulate on them.
void warn_of_flat(const app::JobReport& report, const Terminal& terminal) {
  const std::uint64_t before = report.quality_before.flat_tets, after = report.quality_after.flat_tets;
  if (after <= before) return;
  terminal.warning(std::to_string(after - before) +
                   " more tets than before are flat, which incise check calls invalid; --profile incise leaves none");
}

/// What became of a mesh that a job left invalid; `work` names the job.
std::string broken_text(const std::string& output, const std::string& work, const app::JobReport& report) {
  if (!report.broken) {
    return "the " + work +
           " broke the validity contract, so no mesh was written; see `validity` in the report (--report)";
  }
  const app::BrokenStroke& broken = *report.broken;
  const std::string name = broken.name.empty() ? "" : " \"" + broken.name + "\"";
  const std::string later = broken.index + 1 < report.strokes ? ", with those after it" : "";
  const std::string left = output.empty() ? "" : "; " + output + " has the mesh as it was before";
  return "stroke " + std::to_string(broken.index) + name + " broke the validity contract and was taken back" + later +
         left + "; see `validity` in the report (--report)";
}

}  // namespace

std::optional<ExitCode> refuse_outputs(const MeshOutput& mesh, bool has_json_on_stdout,
                                       const std::vector<std::string>& others, const Terminal& terminal) {
  std::optional<OutputProblem> problem = problem_of(mesh);
  if (!problem && mesh.is_stdout() && has_json_on_stdout) {
    problem =
        OutputProblem{"-o - writes the mesh to stdout, where the figures would go too; give either a file", kUsage};
  }
  for (const std::string& file : others) {
    if (!problem && !has_folder(file)) {
      problem = OutputProblem{file + ": its folder does not exist; create it first", kFailure};
    }
  }
  if (!problem) return std::nullopt;
  terminal.error(problem->text);
  return problem->code;
}

Result<io::LoadedMesh> load(const std::string& mesh, const Terminal& terminal) {
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("reading", 0);
  Result<io::LoadedMesh> loaded = io::load_mesh(input_of(mesh));
  bar.reset();
  if (!loaded.ok()) return explain_kind(loaded.error(), mesh, FileKind::kMesh);
  loaded->source.file = name_of_input(mesh);
  print_notes(loaded->source.notes, mesh, terminal);
  return loaded;
}

void warn_of_misses(const std::string& file, const std::vector<std::uint64_t>& missed,
                    const std::vector<std::string>& names, const Terminal& terminal) {
  if (missed.empty()) return;
  const std::size_t first = missed.front(), more = missed.size() - 1;
  const std::string name = first < names.size() ? names[first] : "";
  terminal.warning(file + ": stroke " + std::to_string(first) + (name.empty() ? "" : " \"" + name + "\"") +
                   (more > 0 ? " and " + std::to_string(more) + " more" : "") +
                   " cut nothing; does the blade meet the mesh, where it is whole? incise info tells its bounds");
}

int finish_job(const MeshOutput& output, const ReportOutput& report, const std::string& work,
               const app::JobResult& result, const Terminal& terminal) {
  if (const Status status = write_results(output, report, result, terminal); !status.ok()) {
    return fail(terminal, status.error(), status.error().code == ErrorCode::kBadArgument ? kUsage : kFailure);
  }
  if (!report.is_on_stdout()) terminal.summary(app::to_text(result.report), output.is_stdout());
  warn_of_flat(result.report, terminal);
  if (result.report.change.ok && output.is_wanted() && is_empty(result)) {
    return fail(terminal, "nothing is left of the mesh, so that " + output.file + " was not written", kFailure);
  }
  if (result.report.change.ok) return kDone;
  return fail(terminal, broken_text(output.file, work, result.report), kCheckFailed);
}

}  // namespace incise_cli
