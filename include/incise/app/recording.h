// SPDX-License-Identifier: Apache-2.0
// Recordings of sessions: what was asked of an engine, call by call, as lines of JSON (docs/formats.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/engine/engine.h"

namespace incise::inline v0 {
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
  std::optional<std::uint64_t> stop_ask;  ///< of maintain: it was told to stop when it had asked so often; unset: never
  std::uint64_t work_units = 0;           ///< of maintain and improve: spent
  std::optional<ErrorCode> error;         ///< how the call failed, if it did; never kBadArgument
  std::uint64_t hash = 0;                 ///< `TetMesh::hash` after the call
  std::uint32_t line = 0;                 ///< in its file, from 1; the header is line 1. Set by readers
};

/// Writes a recording while it is made: after each call its line is in the hands of the operating system.
///
/// A program that is killed loses at most the line that it was writing. (A computer that loses power may lose more:
/// nothing waits for the disk.) The file takes its place with the first call, header and line at once; what had its
/// name before is whole until then. Not thread-safe.
class RecordingWriter {
 public:
  /// Opens nothing yet. Cost: O(1).
  RecordingWriter(std::filesystem::path path, const RecordingHeader& header);
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  ~RecordingWriter();

  /// Appends one call as one line, in one write. Doubles read back bit for bit; those of a pose or stroke must be
  /// finite. Errors: kIo, naming the file; all later calls then fail likewise, since a line may be missing.
  /// Cost: O(points), about 0.1 ms per 1000.
  Status write(const RecordedCall& call);

 private:
  class File;
  std::unique_ptr<File> file_;
  std::string header_;  // until it has been written
};

class LineSource;

/// Reads a recording line by line, so that it may be longer than memory.
///
/// The last line may be cut off anywhere: it is left out, and `is_cut_off` says so. All else is strict.
class RecordingReader {
 public:
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  /// Opens a file and reads its header. Errors: kBadFile "FILE:LINE: what; remedy" where it cannot be read, the header
  /// is not whole, of another format or version, or has an unknown key. Cost: O(1).
  static Result<RecordingReader> open(const std::filesystem::path& path);
  /// The same for text in memory or elsewhere; `file_name` stands for FILE in messages.
  static Result<RecordingReader> open(std::unique_ptr<std::istream> text, std::string file_name);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] const std::string& file_name() const;
  /// Bytes of the file that were read so far.
  [[nodiscard]] std::uint64_t bytes() const;

  /// The next call, or nothing at the end. Errors: kBadFile "FILE:LINE: what", for instance for an unknown call or key,
  /// a number that is not finite, or a line of more than 1 GiB. Cost: O(line).
  Result<std::optional<RecordedCall>> next();
  /// Whether the end, once it was reached, was within a line.
  [[nodiscard]] bool is_cut_off() const;

 private:
  explicit RecordingReader(LineSource lines);
  static Result<RecordingReader> open(LineSource lines);

  std::unique_ptr<LineSource> lines_;
  RecordingHeader header_;
};

}  // namespace app
}  // namespace incise::inline v0
