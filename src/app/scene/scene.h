// SPDX-License-Identifier: Apache-2.0
// Scenes: a body, what holds it, and what is done to it over time, as data (docs/scenes.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/scene/exercise.h"
#include "app/scene/half_space.h"
#include "app/scene/hand_preset.h"
#include "app/scene/scene_stroke.h"
#include "app/scene/scene_view.h"
#include "incise/core/result.h"
#include "incise/engine/simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A generated box of Kuhn tets; see `kuhn_box` and `jitter`.
struct SceneBox {
  std::array<std::uint32_t, 3> cells{5, 5, 5};
  Vec3 size = Vec3::Ones();
  Vec3 origin = Vec3::Zero();  ///< its least corner
  double jitter = 0;           ///< as `fraction` of `jitter`, in [0, 0.15]; with the scene's seed
};

/// A part of space.
using ScenePlace = std::variant<Box, BallTool, HalfSpace>;

/// Gives all tets whose centroid lies somewhere a region label, and the region a name.
struct RegionPaint {
  std::int32_t region = 0;
  std::string name;  ///< may be empty
  ScenePlace where;
};

/// Another body of the same scene.
struct SceneBody {
  std::string file;  ///< as that of the model; empty: the box
  SceneBox box;
  Vec3 move = Vec3::Zero();            ///< by which it is put elsewhere, length unit
  std::optional<std::int32_t> region;  ///< of all its tets; unset: as they come
};

struct SceneModel {
  std::string file;     ///< seen from the scene's folder, or as it stands; empty: the box
  std::string surface;  ///< likewise: a fine triangle surface that is drawn in the place of the skin; empty: none
  SceneBox box;
  std::vector<SceneBody> bodies;     ///< beside it
  std::vector<RegionPaint> regions;  ///< in order: later ones paint over earlier ones
};

/// The material of a region that is known by its name until the model is there.
struct NamedMaterial {
  std::string region;
  Material material;
};

/// Holds the vertices whose rest position lies somewhere.
struct Attachment {
  ScenePlace where;
  bool surface_only = false;
  double stiffness = std::numeric_limits<double>::infinity();  ///< N/m per vertex; infinite: rigidly
  double strength = std::numeric_limits<double>::infinity();   ///< N per vertex, above 0; of springs alone
  bool tears = false;                                          ///< beyond its strength; else it slips
};

/// What presses on the body: from the first of its key times to the last, or always where it has one key and no time.
struct SceneTool {
  std::string name;
  std::vector<double> times;  ///< s, strictly increasing
  std::vector<Tool> keys;     ///< one per time, all of the same kind, which is none of `FlatTool`
};

/// A hook that takes hold at the first of its key times and lets go after the last.
struct SceneHook {
  std::string name;
  double radius = 0;                                          ///< length unit, above 0
  double stiffness = 100;                                     ///< N/m per vertex, above 0
  double strength = std::numeric_limits<double>::infinity();  ///< N in all, above 0
  bool tears = false;                                         ///< beyond its strength; else it slips
  std::vector<double> times;                                  ///< s, strictly increasing
  std::vector<Vec3> positions;                                ///< one per time
};

/// A suture between two places of the body at rest; see `Suture`.
struct SceneSuture {
  std::string name;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< length unit, apart from each other
  double stiffness = 200;                       ///< N/m, above 0
  double rest_length = 0;                       ///< length unit, at least 0
  bool pushes = true;
  double strength = std::numeric_limits<double>::infinity();  ///< N, above 0
  double start = 0;                                           ///< s, at least 0: when it is put in
};

/// How long the body comes to rest before the first frame; see `Simulation::settle`.
struct SceneSettle {
  std::uint32_t frames = 0;  ///< at most
  double speed = 1e-4;       ///< m/s
};

/// Regions that a tool under a person's hand does not cut.
struct SpareRule {
  std::optional<ToolKind> tool;         ///< one that cuts; none: each of them
  std::vector<std::int32_t> stop_at;    ///< regions that its edge is held outside of, see `RegionGuard`
  std::vector<std::string> stop_names;  ///< more of them, until `take_model` knows their numbers
};

struct Scene {
  std::string name;
  std::filesystem::path folder;  ///< that `model.file` is seen from
  SceneModel model;
  SimulationOptions options;                   ///< its threads and log are not part of scenes
  std::vector<NamedMaterial> named_materials;  ///< see `take_model`
  bool has_materials_by_name = false;          ///< other regions whose names speak of a tissue are made of it
  Vec3 stretch = Vec3::Ones();  ///< shares by which the body is drawn out about its middle before it is held
  std::vector<Attachment> attachments;
  std::vector<SceneTool> tools;
  std::vector<SceneHook> hooks;
  std::vector<SceneSuture> sutures;
  std::vector<SceneStroke> strokes;  ///< in order of time, at least two frames between them
  std::vector<SpareRule> spare;      ///< of tools under a hand; the strokes have their own
  std::uint64_t frames = 0;
  SceneSettle settle;
  std::uint64_t seed = 0;
  std::optional<SceneView> view;     ///< how it is first seen; unset: as every body without a word about it
  std::optional<HandPreset> hand;    ///< what a person begins with
  std::optional<Exercise> exercise;  ///< what a trainee shall do
};

/// Bounds on what a scene may hold.
inline constexpr std::uint64_t kMaxSceneFrames = 10'000'000;
inline constexpr std::size_t kMaxSceneItems = 1000;  ///< attachments, tools, hooks, sutures, paintings, blades

/// Parses a scene: JSON of format "incise-scene", version 1, whose keys `docs/scenes.md` lists.
///
/// @param json       the file's content, at most 64 MiB.
/// @param file_name  stands for FILE in messages.
/// @param folder     that blade files and the model are seen from; where they are not there, paths are taken as they
///                   stand.
/// @return a scene whose numbers are in range and whose blade files have been read; its model may not exist.
/// Errors: kBadFile "FILE:LINE: PATH what; remedy", for instance for an unknown key. Thread-safe.
[[nodiscard]] Result<Scene> parse_scene(std::string_view json, std::string_view file_name,
                                        const std::filesystem::path& folder = {});

/// Reads a scene file; see `parse_scene`. Errors: also kBadFile where it cannot be opened.
[[nodiscard]] Result<Scene> read_scene(const std::filesystem::path& path);

/// The whole scene as JSON on one line, defaults and the strokes of blade files included: `parse_scene` gives the same
/// scene again, bit for bit, seen from the same folder.
[[nodiscard]] std::string to_json(const Scene& scene);

/// The regions that the blade of a frame stops at; none without a blade. Cost: O(strokes).
[[nodiscard]] std::vector<std::int32_t> scene_stops(const Scene& scene, std::uint64_t frame);

/// What the hands do in one frame, counted from 0: all that is there at its end, after (frame + 1) · frame_seconds.
///
/// Between key times points move linearly. What begins within a frame stands at its first key at the frame's end, and
/// what ends within it at its last. A pure function. Cost: O(points + log times).
[[nodiscard]] FrameInput scene_input(const Scene& scene, std::uint64_t frame);

}  // namespace app
}  // namespace v0
}  // namespace incise
