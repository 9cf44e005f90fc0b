// SPDX-License-Identifier: Apache-2.0
// Recordings of simulations: a scene, and what the hands did frame by frame, as lines of JSON (docs/formats.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "incise/app/scene.h"
#include "incise/core/result.h"

namespace incise::inline v0 {
namespace app {

/// What a recorded simulation started from.
struct SimulationHeader {
  std::string program;          ///< that recorded, with its version; left empty, a writer puts this one
  Scene scene;                  ///< its model's file seen from the recording's folder
  std::uint64_t mesh_hash = 0;  ///< `TetMesh::hash` of the model
};

/// The calls of `Simulation` that change its state.
enum class SimulationCallKind : std::uint8_t { kSettle, kFrame, kUndo, kRedo };

/// One call with its arguments and what it left. Arguments of other kinds of calls are at their defaults.
struct SimulationCall {
  SimulationCallKind kind = SimulationCallKind::kFrame;
  FrameInput input;                   ///< of frame
  SceneSettle settle;                 ///< of settle
  std::optional<ErrorCode> error;     ///< how the call failed, if it did; never kBadArgument
  std::optional<std::uint64_t> hash;  ///< `Simulation::hash` after the call, where it was taken
  std::uint32_t line = 0;             ///< in its file, from 1; the header is line 1. Set by readers
};

/// Writes a recording while it is made, as `RecordingWriter` does: after each call its line is in the hands of the
/// operating system. Not thread-safe.
class SimulationWriter {
 public:
  /// Opens nothing yet. Cost: O(size of the scene).
  SimulationWriter(std::filesystem::path path, const SimulationHeader& header);
  SimulationWriter(SimulationWriter&&) noexcept;
  SimulationWriter& operator=(SimulationWriter&&) noexcept;
  ~SimulationWriter();

  /// Appends one call as one line, in one write. Doubles read back bit for bit and must be finite.
  /// Errors: kIo, naming the file; all later calls then fail likewise. Cost: O(points).
  Status write(const SimulationCall& call);

 private:
  class File;
  std::unique_ptr<File> file_;
  std::string header_;  // until it has been written
};

/// Reads a recording line by line. The last line may be cut off anywhere: it is left out. All else is strict.
class SimulationReader {
 public:
  SimulationReader(SimulationReader&&) noexcept;
  SimulationReader& operator=(SimulationReader&&) noexcept;
  ~SimulationReader();

  /// Opens a file and reads its header. Errors: kBadFile "FILE:LINE: what; remedy". Cost: O(size of the scene).
  static Result<SimulationReader> open(const std::filesystem::path& path);
  /// The same for text in memory or elsewhere; `path` stands for FILE in messages, and its folder for the scene's.
  static Result<SimulationReader> open(std::unique_ptr<std::istream> text, const std::filesystem::path& path);

  [[nodiscard]] const SimulationHeader& header() const { return header_; }
  [[nodiscard]] const std::string& file_name() const;
  /// Bytes of the file that were read so far.
  [[nodiscard]] std::uint64_t bytes() const;

  /// The next call, or nothing at the end. Errors: kBadFile "FILE:LINE: what". Cost: O(line).
  Result<std::optional<SimulationCall>> next();
  /// Whether the end, once it was reached, was within a line.
  [[nodiscard]] bool is_cut_off() const;

 private:
  class Lines;
  explicit SimulationReader(std::unique_ptr<Lines> lines);
  static Result<SimulationReader> open(SimulationReader reader, const std::filesystem::path& folder);

  std::unique_ptr<Lines> lines_;
  SimulationHeader header_;
};

/// Whether a file begins as a recording of a simulation does. Whatever else it is, it is not read further.
[[nodiscard]] bool is_simulation_recording(const std::filesystem::path& path);

}  // namespace app
}  // namespace incise::inline v0
