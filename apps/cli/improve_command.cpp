// SPDX-License-Identifier: Apache-2.0
// The command `incise improve`.
#include <memory>
#include <optional>
#include <utility>

#include "app/jobs/improve_job.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "job_output.h"

namespace incise_cli {
namespace {

using namespace incise;

struct ImproveArguments {
  std::string mesh, report;
  MeshOutput output;
  bool as_json = false;
  std::string profile = "incise";
  std::uint64_t budget_us = 0;  // 0: none
};

int run_improve(const ImproveArguments& arguments, const Terminal& terminal) {
  const ReportOutput report{arguments.report, arguments.as_json};
  const std::string clash = clash_of({{"--report", arguments.report}}, {arguments.mesh, arguments.output.file});
  if (!clash.empty()) return fail(terminal, clash, kUsage);
  if (const auto code = refuse_outputs(arguments.output, report.is_on_stdout(), {arguments.report}, terminal)) {
    return *code;
  }
  if (arguments.profile == "paper" && arguments.budget_us > 0) terminal.note(kNoBudgetAsPaper);
  Result<io::LoadedMesh> loaded = load(arguments.mesh, terminal);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  std::optional<ProgressBar> bar(std::in_place, terminal);
  app::ImproveJob job;
  job.engine.cut.profile = profile_of(arguments.profile);
  job.engine.log = terminal.log_sink();
  job.budget_us = arguments.budget_us;
  job.stage = [&bar](std::string_view name, unsigned percent) { bar->show_stage(name, percent); };
  const Result<app::JobResult> result = app::run_improve(std::move(loaded).value(), job, arguments.output.is_wanted());
  bar.reset();
  if (!result.ok()) return fail(terminal, result.error(), kFailure);
  return finish_job(arguments.output, report, "improvement", *result, terminal);
}

}  // namespace

Command add_improve(CLI::App& root) {
  const auto arguments = std::make_shared<ImproveArguments>();
  CLI::App* improve =
      add_command(root, "improve", "Maintain a whole mesh: merge short edges and make the worst tets better",
                  "  incise improve liver.msh -o better.msh\n"
                  "  incise improve cut.vtu -o better.vtu --report better.json\n"
                  "  incise improve liver.msh --budget-us 500000 -o better.msh\n"
                  "  incise improve liver.msh --profile paper --report -");
  improve->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  add_output(*improve, arguments->output);
  add_profile(*improve, arguments->profile);
  add_report(*improve, arguments->report, arguments->as_json);
  add_budget(
      *improve, arguments->budget_us,
      "Microseconds for the work, 1 to 3600000000; the worst tets come first, what is not done is left as it was");
  return {improve, [arguments](const Terminal& terminal) { return run_improve(*arguments, terminal); }};
}

}  // namespace incise_cli
