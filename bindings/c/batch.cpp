// SPDX-License-Identifier: Apache-2.0
// Batches (docs/batches.md): plans are read-only, so that any thread may use one, and several at once.
#include <filesystem>
#include <functional>
#include <memory>

#include "app/jobs/batch_job.h"
#include "app/jobs/batch_plan.h"
#include "handles.h"

using namespace incise;

/// A call keeps what it works on: the handle may be freed meanwhile.
struct incise_plan {
  std::shared_ptr<const app::BatchPlan> plan;
};

namespace incise::c {
namespace {

constexpr const char* kNoPlan = "the plan is null; read or parse one first";

incise_batch_options default_options() {
  incise_batch_options options{};
  options.size = sizeof(options);
  options.shard_count = 1;
  options.threads = 1;
  options.verify_items = 1;
  return options;
}

/// Of an argument that has to be there.
Result<app::BatchPlan> no_plan(const char* what) {
  return Error{ErrorCode::kBadArgument, what, {}};
}

incise_status create(incise_plan** out, const auto& read) {
  if (out == nullptr) return refuse("there is no place for the plan: the last argument is null");
  *out = nullptr;
  return guarded([&]() -> incise_status {
    Result<app::BatchPlan> plan = read();
    if (!plan.ok()) return fail(plan.error());
    *out = new incise_plan{std::make_shared<const app::BatchPlan>(std::move(plan).value())};
    return INCISE_OK;
  });
}

/// What C programs call while a batch runs. Other than 0 from `should_stop` is remembered: it is not asked again.
struct Callbacks {
  const incise_batch_options& options;
  bool has_stopped = false;

  [[nodiscard]] LogSink log() const { return log_to(options.log, options.log_user); }
  [[nodiscard]] std::function<bool()> should_stop() {
    if (options.should_stop == nullptr) return {};
    return [this] {
      has_stopped = has_stopped || options.should_stop(options.user) != 0;
      return has_stopped;
    };
  }
  [[nodiscard]] std::function<void(std::size_t, std::size_t)> progress() const {
    if (options.progress == nullptr) return {};
    return [this](std::size_t done, std::size_t total) { options.progress(options.user, done, total); };
  }
};

incise_status told(const std::string& json, incise_told tell, void* user) {
  if (tell != nullptr) tell(user, json.c_str());
  return INCISE_OK;
}

incise_status run(const app::BatchPlan& plan, const char* folder, const incise_batch_options& options, incise_told tell,
                  void* user) {
  if (options.shard_count == 0 || options.shard_count > app::kMaxShards || options.shard_index >= options.shard_count) {
    return refuse("shard_index must lie in [0, shard_count), and shard_count in [1, 99999]");
  }
  Callbacks callbacks{options};
  app::BatchJob job{folder,
                    {options.shard_index, options.shard_count},
                    options.retry != 0,
                    options.threads,
                    callbacks.log(),
                    callbacks.progress(),
                    callbacks.should_stop()};
  const Result<app::BatchReport> report = app::run_batch(plan, job);
  return report.ok() ? told(app::to_json(*report), tell, user) : fail(report.error());
}

incise_status verify(const app::BatchPlan& plan, const char* folder, const incise_batch_options& options,
                     incise_told tell, void* user) {
  if (options.verify_items == 0) return refuse("verify_items is 0; the number of items to compute again is wanted");
  Callbacks callbacks{options};
  app::VerifyJob job{folder,          options.verify_items, options.verify_seed,    options.threads,
                     callbacks.log(), callbacks.progress(), callbacks.should_stop()};
  const Result<app::VerifyReport> report = app::verify_batch(plan, job);
  return report.ok() ? told(app::to_json(*report), tell, user) : fail(report.error());
}

/// Calls with a plan, a folder and options, null ones as by default.
incise_status with(const incise_plan* plan, const char* folder, const incise_batch_options* given, const auto& call) {
  if (plan == nullptr) return refuse(kNoPlan);
  if (folder == nullptr) return refuse("the folder of the batch is null");
  incise_batch_options options = default_options();
  if (given != nullptr) {
    if (const incise_status bad = take(given, options, "incise_batch_options")) return bad;
  }
  if (options.threads < 1 || options.threads > 256) return refuse("threads must lie in [1, 256]");
  return guarded([&] {
    const std::shared_ptr<const app::BatchPlan> kept = plan->plan;
    return call(*kept, options);
  });
}

}  // namespace
}  // namespace incise::c

extern "C" {

incise_status incise_plan_read(const char* path, incise_plan** plan) {
  return c::create(
      plan, [&] { return path == nullptr ? c::no_plan("the name of the plan is null") : app::read_batch_plan(path); });
}

incise_status incise_plan_parse(const char* json, const char* folder, incise_plan** plan) {
  return c::create(plan, [&] {
    const std::filesystem::path seen_from = folder == nullptr ? "" : folder;
    return json == nullptr ? c::no_plan("the plan's text is null") : app::parse_batch_plan(json, "plan", seen_from);
  });
}

incise_status incise_plan_free(incise_plan* plan) {
  delete plan;
  return INCISE_OK;
}

incise_status incise_plan_count(const incise_plan* plan, uint64_t* count) {
  if (plan == nullptr) return c::refuse(c::kNoPlan);
  if (count != nullptr) *count = plan->plan->items.size();
  return INCISE_OK;
}

incise_status incise_plan_name(const incise_plan* plan, uint64_t item, char* text, uint64_t room, uint64_t* count) {
  if (plan == nullptr) return c::refuse(c::kNoPlan);
  const std::vector<app::BatchItem>& items = plan->plan->items;
  if (item >= items.size()) {
    return c::refuse("the plan has " + std::to_string(items.size()) + " items; there is no number " +
                     std::to_string(item));
  }
  return c::give_text(items[item].name, text, room, count);
}

incise_status incise_default_batch_options(incise_batch_options* options, uint32_t size) {
  return c::give_default(c::default_options(), options, size, "incise_batch_options");
}

incise_status incise_batch_run(const incise_plan* plan, const char* folder, const incise_batch_options* options,
                               incise_told tell, void* user) {
  return c::with(plan, folder, options, [&](const app::BatchPlan& kept, const incise_batch_options& taken) {
    return c::run(kept, folder, taken, tell, user);
  });
}

incise_status incise_batch_merge(const incise_plan* plan, const char* folder, incise_told tell, void* user) {
  return c::with(plan, folder, nullptr, [&](const app::BatchPlan& kept, const incise_batch_options&) -> incise_status {
    const Result<app::MergeReport> report = app::merge_batch(kept, folder);
    return report.ok() ? c::told(app::to_json(*report), tell, user) : c::fail(report.error());
  });
}

incise_status incise_batch_verify(const incise_plan* plan, const char* folder, const incise_batch_options* options,
                                  incise_told tell, void* user) {
  return c::with(plan, folder, options, [&](const app::BatchPlan& kept, const incise_batch_options& taken) {
    return c::verify(kept, folder, taken, tell, user);
  });
}

}  // extern "C"
