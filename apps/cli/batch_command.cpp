// SPDX-License-Identifier: Apache-2.0
// The command `incise batch`.
#include <cstdlib>
#include <memory>
#include <optional>

#include "app/jobs/batch_job.h"
#include "app/text/counted.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "input_kind.h"

namespace incise_cli {
namespace {

using namespace incise;

constexpr std::size_t kMaxTold = 5;  // of a list, to people

struct BatchArguments {
  std::string plan, folder;
  std::optional<std::string> shard;
  bool merge = false, retry = false, as_json = false;
  std::uint64_t verify = 0;  // items; 0: none
  std::uint64_t seed = 0;
  unsigned threads = 1;
};

std::string usage_problem(const BatchArguments& a) {
  if (is_stdin(a.plan)) return "a plan names meshes beside it and is read by each worker; give a file";
  const bool runs = !a.merge && a.verify == 0;
  if (!runs && a.shard) return "--shard says what to compute; leave it out beside --merge and --verify";
  if (!runs && a.retry) return "--retry goes with computing; leave it out beside --merge and --verify";
  if (a.merge && a.verify > 0 && a.as_json)
    return "--merge and --verify would both print JSON; run one after the other";
  return {};
}

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

/// As asked for, else that of the task of a Slurm array job, else all.
Result<app::Shard> shard_of(const BatchArguments& a) {
  if (a.shard) return app::parse_shard(*a.shard);
  const auto task = app::slurm_shard(environment);
  if (!task.ok()) return task.error();
  return task->value_or(app::Shard());
}

void tell(const Terminal& terminal, const std::vector<std::string>& list, const std::string& what) {
  for (std::size_t i = 0; i < list.size() && i < kMaxTold; ++i) terminal.warning(what + list[i]);
  if (list.size() > kMaxTold) terminal.warning(what + "and " + std::to_string(list.size() - kMaxTold) + " more");
}

Status print(const BatchArguments& a, const Terminal& terminal, const std::string& json, const std::string& text) {
  if (a.as_json) return terminal.data(json);
  terminal.summary(text, false);
  return {};
}

int compute(const BatchArguments& a, const app::BatchPlan& plan, const Terminal& terminal) {
  const Result<app::Shard> shard = shard_of(a);
  if (!shard.ok()) return fail(terminal, shard.error(), kUsage);
  const WritingZone zone;  // an interrupt ends the run between two items, or two frames
  std::optional<ProgressBar> bar(std::in_place, terminal, "items");
  app::BatchJob job{a.folder, *shard, a.retry, a.threads, terminal.log_sink()};
  job.progress = [&bar](std::size_t done, std::size_t total) { bar->show(done, total); };
  job.should_stop = interrupt_waits;
  const Result<app::BatchReport> report = app::run_batch(plan, job);
  bar.reset();
  if (!report.ok()) return fail(terminal, report.error(), exit_of(report.error()));
  if (report->was_stopped) return kInterrupted;
  tell(terminal, report->failed, "failed: ");
  const std::string name = a.shard ? *a.shard : std::to_string(shard->index) + "/" + std::to_string(shard->count);
  const std::string text = app::counted(report->items, "item") + " of shard " + name + ": " +
                           std::to_string(report->done) + " computed, " + std::to_string(report->skipped) +
                           " there before, " + std::to_string(report->failed.size()) + " failed\n";
  const int code = finish(terminal, print(a, terminal, app::to_json(*report), text));
  return code == kDone && !report->failed.empty() ? int{kFailure} : code;
}

int merge(const BatchArguments& a, const app::BatchPlan& plan, const Terminal& terminal) {
  const WritingZone zone;
  const Result<app::MergeReport> report = app::merge_batch(plan, a.folder);
  if (!report.ok()) return fail(terminal, report.error(), exit_of(report.error()));
  tell(terminal, report->missing, "missing: ");
  tell(terminal, report->contradictory, "computed more than once, with different results: ");
  tell(terminal, report->broken_files, "missing, or not as it was written: ");
  if (report->repeated > 0) terminal.note(app::counted(report->repeated, "result") + " computed more than once");
  if (report->failed > 0) terminal.note(app::counted(report->failed, "item") + " failed; their lines say why");
  const std::string text = app::counted(report->items, "item") + " of " + app::counted(report->shards, "shard") + "\n";
  const int code = finish(terminal, print(a, terminal, app::to_json(*report), report->is_whole() ? text : ""));
  if (report->is_whole()) {
    terminal.wrote(report->file.string(), "results");
    return code;
  }
  return fail(
      terminal,
      a.folder +
          ": the batch is not whole, so nothing was merged; run its shards again, with --retry where files are broken",
      kCheckFailed);
}

int verify(const BatchArguments& a, const app::BatchPlan& plan, const Terminal& terminal) {
  const WritingZone zone;
  std::optional<ProgressBar> bar(std::in_place, terminal, "items");
  app::VerifyJob job{a.folder, a.verify, a.seed, a.threads, terminal.log_sink()};
  job.progress = [&bar](std::size_t done, std::size_t total) { bar->show(done, total); };
  job.should_stop = interrupt_waits;
  const Result<app::VerifyReport> report = app::verify_batch(plan, job);
  bar.reset();
  if (!report.ok()) return fail(terminal, report.error(), exit_of(report.error()));
  if (report->was_stopped) return kInterrupted;
  const std::string text = app::counted(report->items, "item") +
                           " computed again: " + std::to_string(report->differences.size()) + " came out differently\n";
  const int code = finish(terminal, print(a, terminal, app::to_json(*report), text));
  if (report->differences.empty()) return code;
  tell(terminal, report->differences, "");
  return fail(terminal, a.folder + ": results differ; did another version, or a mesh that was changed, make them?",
              kCheckFailed);
}

int run_batch(const BatchArguments& arguments, const Terminal& terminal) {
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (!has_folder(arguments.folder)) {
    return fail(terminal, arguments.folder + ": the folder that it is in does not exist; create it first", kFailure);
  }
  const Result<app::BatchPlan> plan = app::read_batch_plan(arguments.plan);
  if (!plan.ok()) {
    return fail(terminal, explain_kind(plan.error(), arguments.plan, FileKind::kPlan), kBadInput);
  }
  if (!arguments.merge && arguments.verify == 0) return compute(arguments, *plan, terminal);
  const int code = arguments.merge ? merge(arguments, *plan, terminal) : int{kDone};
  return code == kDone && arguments.verify > 0 ? verify(arguments, *plan, terminal) : code;
}

}  // namespace

Command add_batch(CLI::App& root) {
  const auto arguments = std::make_shared<BatchArguments>();
  CLI::App* words =
      add_command(root, "batch", "Many cuts by a plan, on as many machines as there are (docs/batches.md)",
                  "  incise batch plan.json -o out\n"
                  "  seq 4 | xargs -P 4 -I{} incise batch plan.json -o out --shard {}/4\n"
                  "  incise batch plan.json -o out --merge\n"
                  "  incise batch plan.json -o out --verify 10");
  BatchArguments& a = *arguments;
  words->add_option("PLAN", a.plan, "Plan: JSON of format incise-plan")->required();
  words->add_option("-o,--output", a.folder, "Folder for results, which all workers share; what is there stays")
      ->required();
  words->add_option(
      "--shard", a.shard,
      "I/N: compute the I-th of N parts alone (I from 0 to N - 1, or from 1 to N); in a Slurm array job its "
      "task's part, else all");
  words->add_flag("--merge", a.merge, "Write results.jsonl in the plan's order; exit 4 where something is missing");
  words->add_option("--verify", a.verify, "Compute this many items again; exit 4 where a line differs")
      ->check(CLI::Range(std::uint64_t{1}, app::kMaxBatchItems));
  add_seed(*words, a.seed, "Which items --verify takes");
  words->add_flag(
      "--retry", a.retry,
      "Compute items again that have failed, whose files are not as they were written, or whose line is no result");
  add_json(*words, a.as_json);
  add_threads(*words, a.threads);
  return {words, [arguments](const Terminal& terminal) { return run_batch(*arguments, terminal); }};
}

}  // namespace incise_cli
