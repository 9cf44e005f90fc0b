// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/jobs/batch_plan.h"
#include "incise/core/log.h"
#include "incise/core/result.h"
#include "incise/version.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Who computes, as lines name it: results of two versions may differ.
inline constexpr const char* kBatchProgram = "incise " INCISE_VERSION;

/// The files of an item as its line names them, seen from the folder: the mesh before its cuts, whose hash that is, the
/// strokes, and the mesh after.
[[nodiscard]] std::string before_file(const BatchPlan& plan, std::uint64_t hash);
[[nodiscard]] std::string strokes_file(const BatchItem& item);
[[nodiscard]] std::string after_file(const BatchPlan& plan, const BatchItem& item);

/// How an item is computed, whatever it is.
struct BatchItemJob {
  std::filesystem::path folder;   ///< where its files go; empty: none is written, and the line is the same
  std::string worker = "worker";  ///< names files until they are whole: different for workers that share a folder
  unsigned threads = 1;           ///< the result does not depend on them
  LogSink log = {};
  std::function<bool()> should_stop = {};  ///< asked before each frame of a scene; may be empty
  /// Asked once the mesh is read, before anything is computed or written: whether a mesh of this key is the one that
  /// is meant. May be empty.
  std::function<bool(std::uint64_t input_key)> takes_input = {};
};

/// What an item came to.
struct BatchItemResult {
  std::string line;          ///< of JSON, with its newline; see docs/batches.md. It depends on the item alone
  bool has_failed = false;   ///< the line says why
  bool was_stopped = false;  ///< by `should_stop`; there is no line
  bool was_refused = false;  ///< by `takes_input`; there is no line
  /// Of the mesh before its cuts: of all that its file says, names of regions and numbers of vertices among it; 0 where
  /// it could not be read.
  std::uint64_t input_key = 0;
  std::uint64_t hash = 0;        ///< of the mesh at the end
  std::uint64_t state_hash = 0;  ///< of the body, of a scene; else 0
};

/// Computes an item of a plan, and writes its files: each beside its place and renamed, so that whoever has the line
/// has the files whole.
///
/// An item that cannot be computed as the plan says (a bad mesh, a stroke that is out of reach) has failed, and its
/// line tells. Errors are those of the machine alone: kIo where a file cannot be written, kOutOfMemory. Cost: that of
/// `run_cut` or `run_simulate`.
[[nodiscard]] Result<BatchItemResult> run_item(const BatchPlan& plan, std::size_t index, const BatchItemJob& job);

}  // namespace app
}  // namespace v0
}  // namespace incise
