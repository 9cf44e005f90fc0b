// SPDX-License-Identifier: Apache-2.0
// Bodies that need no file: what a person meets first. The skin is a box of layers; organs are drawn as voxels in
// code and meshed as scans are.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "app/scene/scene.h"
#include "incise/image/label_image.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class StartingBody : std::uint8_t { kSkin, kLiver, kVein, kVertebra, kCount };

struct StartingBodyRow {
  const char* name;  ///< for people: "skin"
  const char* few;   ///< a few words that fit below the name
  const char* text;  ///< more of them: the title of its scene
};

/// In the order of `StartingBody`.
inline constexpr std::array<StartingBodyRow, static_cast<std::size_t>(StartingBody::kCount)> kStartingBodies = {{
    {"skin", "fat and muscle", "Skin over fat and muscle, on drapes"},
    {"liver", "soft, two lobes", "A soft organ with two lobes"},
    {"vein", "a thin wall", "A tube with a thin wall, held at both ends"},
    {"vertebra", "spongy bone", "Spongy bone with an arch and processes"},
}};

inline constexpr double kVeinRadius = 9.5;  ///< mm, of the vein outside; its middle lies at y = `vein_bend`, z = 0
/// How far the vein is bent aside at a place along it, both in mm.
[[nodiscard]] double vein_bend(double x);

/// The patch: skin over fat over muscle, 84 × 60 × 24 mm. After two seconds its script makes an incision and draws it
/// open, as a demonstration.
[[nodiscard]] Scene skin_patch();

/// The voxels of an organ, which is none of `kSkin` and `kCount`: label 1 in millimetres.
[[nodiscard]] image::LabelImage voxels_of(StartingBody organ);

/// The scene of a body. The mesh of an organ goes to `folder`, by default the one for temporary files, under a name
/// that its content decides: recordings name it. Errors: as `mesh_labels` and `io::write_mesh`. Cost: up to a second.
[[nodiscard]] Result<Scene> scene_of(StartingBody body, const std::filesystem::path& folder = {});

}  // namespace app
}  // namespace v0
}  // namespace incise
