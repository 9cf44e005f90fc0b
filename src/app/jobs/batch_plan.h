// SPDX-License-Identifier: Apache-2.0
// Plans of batches: many cuts as data (docs/batches.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/jobs/random_strokes.h"
#include "app/scene/blade_file.h"
#include "app/scene/half_space.h"
#include "app/scene/scene.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/io/mesh_file.h"
#include "incise/lab/method.h"

namespace incise {
inline namespace v0 {
namespace app {

/// How an item is cut; what is not said is as `incise cut` has it, or as the item's scene says.
struct BatchOptions {
  std::optional<Profile> profile;
  std::optional<LabMethod> method;  ///< instead of a profile, and not in scenes
  std::optional<double> snap;
  std::optional<bool> merge, improve;
  std::optional<std::uint64_t> work_units;  ///< for maintenance, per stroke, or per frame of a scene
};

/// What an item cuts with; nothing where its scene has the strokes.
using BatchBlade = std::variant<std::monostate, HalfSpace, std::vector<BladeStroke>, RandomStrokes>;

/// One cut: of a mesh at rest, or of a body that a scene simulates.
struct BatchItem {
  /// Letters, digits and . _ - alone, different for each item, whatever the case: files are named by it.
  std::string name;
  std::string label;  ///< repeated in the results; may be empty
  std::string mesh;   ///< a mesh file, seen from the plan's folder, or as it stands; empty: the scene's own model
  BatchBlade blade;
  BatchOptions options;
  std::shared_ptr<const Scene> scene;  ///< empty: cut at rest
  /// A hash of all that the plan says about this item: results of two plans cannot be taken for each other.
  std::uint64_t key = 0;
  /// A hash of where its mesh comes from: items with equal ones begin with the same mesh.
  std::uint64_t source = 0;
};

/// What is written of each item beside its line.
struct BatchOutput {
  std::string format = "vtu";  ///< of meshes, a name of `io::write_options_named`; empty: no meshes
  io::WriteOptions mesh = {".vtu", io::MshVariant::k41, {}};  ///< what that name stands for
  bool before = true;                                         ///< each mesh before its cuts, once for all items
  bool strokes = true;                                        ///< the strokes, as a blade file
  bool as_it_stands = false;                                  ///< meshes of scenes deformed, not at rest
};

struct BatchPlan {
  std::string name;
  std::filesystem::path folder;  ///< that files are seen from
  BatchOutput output;
  std::vector<BatchItem> items;
};

/// Bounds on what a plan may hold.
inline constexpr std::uint64_t kMaxBatchItems = 1'000'000;
inline constexpr std::uint64_t kMaxRandomStrokes = 1000;  ///< of one item

/// Parses a plan: JSON of format "incise-plan", version 1, whose keys `docs/batches.md` lists.
///
/// @param json       the file's content, at most 64 MiB.
/// @param file_name  stands for FILE in messages.
/// @param folder     that scenes, blade files and meshes are seen from; where they are not there, paths are taken as
///                   they stand.
/// @return at least one item; scenes and blade files have been read, and every mesh file can be opened.
/// Errors: kBadFile "FILE:LINE: PATH what; remedy", for instance for an unknown key. Cost: O(items).
[[nodiscard]] Result<BatchPlan> parse_batch_plan(std::string_view json, std::string_view file_name,
                                                 const std::filesystem::path& folder = {});

/// Reads a plan; see `parse_batch_plan`. Errors: also kBadFile where it cannot be opened.
[[nodiscard]] Result<BatchPlan> read_batch_plan(const std::filesystem::path& path);

/// Where a file of a plan is: seen from the plan's folder, else as its path stands.
[[nodiscard]] std::filesystem::path find_in_plan(const std::filesystem::path& folder, const std::string& file);

/// A hash of a text's bytes; see `StateHash`.
[[nodiscard]] std::uint64_t hash_of_text(std::string_view text);

}  // namespace app
}  // namespace v0
}  // namespace incise
