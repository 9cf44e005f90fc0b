// SPDX-License-Identifier: Apache-2.0
// `incise replay`: the job does the work; here its end becomes notes, a mesh and an exit code.
#include <memory>
#include <optional>

#include "app/jobs/replay_job.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "input_kind.h"
#include "mesh_output.h"

namespace incise_cli {
namespace {

using namespace incise;

struct ReplayArguments {
  std::string recording;
  MeshOutput output;
  bool verify = false;
  bool as_json = false;
};

/// Says where a replay ended, if not where it should.
void note_end(const app::ReplayResult& result, const std::string& recording, const Terminal& terminal) {
  const std::string after = recording + ": after " + std::to_string(result.calls) + " calls ";
  if (result.is_cut_off) terminal.note(after + "the recording is cut off; its whole lines have been replayed");
  if (result.is_in_stroke) terminal.note(after + "a stroke is still under way; the mesh is as its last step left it");
}

int report_difference(const app::ReplayDifference& d, const std::string& recording, const Terminal& terminal) {
  return fail(terminal,
              recording + ":" + std::to_string(d.line) + ": the call \"" + d.call +
                  "\" came out differently: expected " + d.expected + ", found " + d.found +
                  "; no mesh was written. Did another version record it?",
              kCheckFailed);
}

Result<app::ReplayResult> replay(const ReplayArguments& a, const Terminal& terminal) {
  ProgressBar bar(terminal, "kB");
  bar.show_stage("reading", 0);
  app::ReplayJob job{input_of(a.recording), a.verify, a.output.is_wanted(), terminal.log_sink()};
  job.progress = [&bar](std::size_t done, std::size_t total) {
    if (total == 0) return bar.show_stage("replaying", 0);  // from stdin
    bar.show(done, total);
  };
  Result<app::ReplayResult> result = app::run_replay(job);
  if (!result.ok()) return explain_kind(result.error(), a.recording, FileKind::kRecording);
  return result;
}

Status print(const ReplayArguments& a, const app::ReplayResult& result, const Terminal& terminal) {
  if (a.as_json) return terminal.data(app::to_json(result));
  if (!result.difference) terminal.summary(app::to_text(result), a.output.is_stdout());
  return {};
}

int run_replay(const ReplayArguments& arguments, const Terminal& terminal) {
  if (const auto problem = problem_of(arguments.output)) return fail(terminal, problem->text, problem->code);
  if (arguments.output.is_stdout() && arguments.as_json) {
    return fail(terminal, "-o - writes the mesh to stdout, where --json would print too; name a file", kUsage);
  }
  const Result<app::ReplayResult> result = replay(arguments, terminal);
  if (!result.ok()) return fail(terminal, result.error(), exit_of(result.error()));
  note_end(*result, name_of_input(arguments.recording), terminal);
  const WritingZone zone;
  if (arguments.output.is_wanted() && !result->difference) {
    const Status status = write_output(arguments.output, result->mesh, terminal);
    if (!status.ok()) return fail(terminal, status.error(), kFailure);
  }
  const int code = finish(terminal, print(arguments, *result, terminal));
  return result->difference ? report_difference(*result->difference, name_of_input(arguments.recording), terminal)
                            : code;
}

}  // namespace

Command add_replay(CLI::App& root) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* words = add_command(root, "replay", "Repeat what --record has recorded; exit 4 where the result differs",
                                "  incise replay cut.jsonl --verify\n  incise replay cut.jsonl -o cut.vtu\n"
                                "  zcat cut.jsonl.gz | incise replay -");
  words
      ->add_option("REC", arguments->recording,
                   "Recording: JSON lines of format incise-recording or incise-simulation; - for stdin")
      ->required();
  words->add_flag("--verify", arguments->verify, "Compare after every step or frame, not only at the end");
  add_output(*words, arguments->output);
  add_json(*words, arguments->as_json);
  return {words, [arguments](const Terminal& terminal) { return run_replay(*arguments, terminal); }};
}

}  // namespace incise_cli
