// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/jobs/report.h"
#include "app/recording/engine_recording.h"
#include "incise/io/mesh_data.h"
#include "incise/io/mesh_loader.h"

namespace incise {
inline namespace v0 {
namespace app {

struct ReplayJob {
  std::filesystem::path recording;
  bool verify = false;  ///< compare after every call, not only at the end
  bool wants_mesh = false;
  LogSink log = {};      ///< hears what the engine has to say
  unsigned threads = 1;  ///< as in `EngineOptions`
  /// Called before the first call and after each: kilobytes of the recording that are replayed, and that it has, 0
  /// where that cannot be told. May be empty.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// The first place where a replay did not do what was recorded.
struct ReplayDifference {
  std::uint32_t line = 0;  ///< of the recording
  std::string call;        ///< its name, for instance "step"
  std::string expected;    ///< "hash 0123456789abcdef", "12 work units" or "error internal"
  std::string found;       ///< likewise; "success" where no error was found
};

/// What a replay came to.
struct ReplayResult {
  io::MeshSource source;
  MeshCounts before, after;
  std::uint64_t calls = 0;    ///< that were made
  std::uint64_t strokes = 0;  ///< that stand at the end: undone ones not counted
  std::uint64_t hash = 0;     ///< of the mesh at the end; of a simulation's mesh and body
  bool is_cut_off = false;    ///< the recording ends within a line, which was left out
  bool is_in_stroke = false;  ///< the recording ends within a stroke
  std::optional<ReplayDifference> difference;
  /// As in `JobResult`, a simulation's as it stands; empty where not asked for, or where there is a difference.
  io::MeshData mesh;
};

/// Makes one recorded call on an engine.
///
/// @param verify     compare hash and work units, too; how a call ends, in success or which error, is always compared.
/// @param file_name  stands for FILE in messages.
/// @return the difference, if there is one.
/// Errors: kBadFile "FILE:LINE: what" for a call that the engine refuses, such as a step without a stroke.
/// Cost: the call's, plus one hash of the mesh with `verify`.
Result<std::optional<ReplayDifference>> replay_call(Engine& engine, const RecordedCall& call, bool verify,
                                                    std::string_view file_name);

/// Does what was recorded again, with an engine or in a simulation, on the mesh that the recording names: looked for
/// from the recording's folder first, then as its path stands.
///
/// With `verify` it stops at the first difference; without, the hash is compared after the last call alone. A recording
/// whose last line was cut off is replayed up to the line before.
/// Errors: kBadFile, naming file and line, for a bad recording, a mesh that is not there or not the one that was
/// recorded; others as `io::load_mesh`. Cost: the calls', plus one hash of the mesh for each with `verify`.
[[nodiscard]] Result<ReplayResult> run_replay(const ReplayJob& job);

/// A few lines for people.
[[nodiscard]] std::string to_text(const ReplayResult& result);

/// The result as JSON, format "incise-replay" version 1, with a newline at the end; `difference` is null where there is
/// none.
[[nodiscard]] std::string to_json(const ReplayResult& result);

}  // namespace app
}  // namespace v0
}  // namespace incise
