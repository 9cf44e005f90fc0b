// SPDX-License-Identifier: Apache-2.0
// Recordings of sessions: what was asked of an engine, call by call, as lines of JSON (docs/formats.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/recording/recording.h"
#include "incise/core/result.h"
#include "incise/engine/engine.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a session started from.
struct RecordingHeader {
  std::string program;          ///< that recorded, with its version; left empty, a writer puts this one
  std::string mesh_file;        ///< seen from the recording's folder; empty: the mesh was in no file
  std::uint64_t mesh_hash = 0;  ///< `TetMesh::hash` before the first call
  CutOptions cut;
  MaintainOptions maintain;
  std::uint64_t seed = 0;  ///< repeated, as in reports
};

/// The calls of `Engine` that change its state.
enum class CallKind : std::uint8_t {
  kBegin,
  kStep,
  kEnd,
  kCut,
  kUndo,
  kRedo,
  kMaintain,
  kImprove,
  kPositions,
};

/// One call with its arguments and what it left. Arguments of other kinds of calls are at their defaults.
struct RecordedCall {
  CallKind kind = CallKind::kUndo;
  BladePose pose;                         ///< of begin and step
  Stroke stroke;                          ///< of cut
  std::vector<Vec3> positions;            ///< of positions: one per vertex slot, length unit of the mesh
  std::uint64_t limit = kUnlimitedWork;   ///< of maintain: the work units allowed
  std::optional<std::uint64_t> stop_ask;  ///< of maintain: it was told to stop at this ask; unset: never
  std::uint64_t work_units = 0;           ///< of maintain and improve: spent
  std::optional<ErrorCode> error;         ///< how the call failed, if it did; never kBadArgument
  std::uint64_t hash = 0;                 ///< `TetMesh::hash` after the call
  std::uint32_t line = 0;                 ///< in its file, from 1; the header is line 1. Set by readers
};

/// The name of a call in recordings and messages.
[[nodiscard]] const char* name_of(CallKind kind);

/// One line, with a newline at the end. Doubles read back bit for bit; those of a pose or stroke must be finite.
/// Cost: O(points), about 0.1 ms per 1000.
[[nodiscard]] std::string to_line(const RecordingHeader& header);
[[nodiscard]] std::string to_line(const RecordedCall& call);

/// How the lines of a session are read; see `RecordingReader`.
struct EngineCodec {
  using Header = RecordingHeader;
  using Call = RecordedCall;
  static Result<Header> parse_header(std::string_view text, std::string_view file_name,
                                     const std::filesystem::path& folder = {});
  static Result<Call> parse_call(std::string_view text, std::string_view file_name, std::uint32_t line);
};

using RecordingWriter = BasicRecordingWriter<EngineCodec>;
using RecordingReader = BasicRecordingReader<EngineCodec>;

}  // namespace app
}  // namespace v0
}  // namespace incise
