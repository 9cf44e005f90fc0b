// SPDX-License-Identifier: Apache-2.0
// Recordings of simulations: a scene, and what the hands did frame by frame, as lines of JSON (docs/formats.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "app/recording/recording.h"
#include "app/scene/scene.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a recorded simulation started from.
struct SimulationHeader {
  std::string program;          ///< that recorded, with its version; left empty, a writer puts this one
  Scene scene;                  ///< its model's file seen from the recording's folder
  std::uint64_t mesh_hash = 0;  ///< `TetMesh::hash` of the model
};

/// The calls of `Simulation` that change its state.
enum class SimulationCallKind : std::uint8_t { kSettle, kFrame, kUndo, kRedo, kSuture, kUnpick };

/// A suture that is set or taken out.
struct SutureCall {
  std::array<Vec3, 2> ends = {Vec3::Zero(), Vec3::Zero()};  ///< places of the rest shape, length unit
  Suture suture;
  std::uint32_t id = 0;  ///< as the simulation gave it
};

/// One call with its arguments and what it left. Arguments of other kinds of calls are at their defaults.
struct SimulationCall {
  SimulationCallKind kind = SimulationCallKind::kFrame;
  FrameInput input;                   ///< of frame
  SceneSettle settle;                 ///< of settle
  SutureCall suture;                  ///< of suture; of unpick its id alone
  std::optional<ErrorCode> error;     ///< how the call failed, if it did; never kBadArgument
  std::optional<std::uint64_t> hash;  ///< `Simulation::hash` after the call, where it was taken
  std::uint32_t line = 0;             ///< in its file, from 1; the header is line 1. Set by readers
};

/// The name of a call in recordings and messages.
[[nodiscard]] const char* name_of(SimulationCallKind kind);

/// One line, with a newline at the end. Doubles read back bit for bit and must be finite. Cost: O(points).
[[nodiscard]] std::string to_line(const SimulationHeader& header);
[[nodiscard]] std::string to_line(const SimulationCall& call);

/// How the lines of a simulation are read; see `SimulationReader`.
struct SimulationCodec {
  using Header = SimulationHeader;
  using Call = SimulationCall;
  static Result<Header> parse_header(std::string_view text, std::string_view file_name,
                                     const std::filesystem::path& folder);
  static Result<Call> parse_call(std::string_view text, std::string_view file_name, std::uint32_t line);
};

using SimulationWriter = BasicRecordingWriter<SimulationCodec>;
using SimulationReader = BasicRecordingReader<SimulationCodec>;

/// Whether the first line of a recording says that it is one of a simulation.
[[nodiscard]] bool is_simulation_header(std::string_view line);

}  // namespace app
}  // namespace v0
}  // namespace incise
