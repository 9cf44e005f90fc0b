// SPDX-License-Identifier: Apache-2.0
// From a segmented scan, or a surface, to tets with named regions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incise/core/result.h"
#include "incise/image/image_file.h"
#include "incise/image/layers.h"
#include "incise/image/mesh_labels.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The voxels of one label go to another.
struct LabelMerge {
  std::int32_t from = 0, to = 0;
};

/// What is made of a scan or a surface, and how.
struct OrganJob {
  std::string input;  ///< a label image, or a triangle surface, by its extension
  std::string names;  ///< a file for `read_label_names`; may be empty
  double size = 0, smooth = 0.7, grade = 0.5;
  int halvings = 2;
  std::vector<LabelMerge> merges;       ///< done first, in order
  std::vector<std::int32_t> labels;     ///< the others become background; empty: all stay
  std::vector<image::Layer> layers;     ///< from the surface inwards
  std::vector<std::int32_t> layers_in;  ///< labels that give their voxels to layers; empty: all
  unsigned threads = 1;                 ///< in [1, 256]
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// What is to be meshed.
struct OrganInput {
  image::ImageFile file;        ///< its labels as chosen
  std::vector<double> volumes;  ///< as in `MeshLabelsOptions`
  io::RegionNames names;        ///< of labels
  bool is_scan = true;          ///< not a surface
};

/// Tets, and what else there is to say about them.
struct Organ {
  image::LabelMesh made;
  io::RegionNames names;                      ///< of regions, layers included
  std::vector<std::int32_t> layers;           ///< labels of the layers
  std::array<std::size_t, 3> finer{1, 1, 1};  ///< as in `image::LayeredImage`
  std::vector<std::string> notes;             ///< what the user may want to know, in words
  std::vector<std::int32_t> lost;             ///< labels of which less than half came out; a note says so of each
};

/// Whether a file is a triangle surface, or a label image, by its extension (also before `.gz`).
[[nodiscard]] bool is_surface_file(const std::filesystem::path& file);
[[nodiscard]] bool is_image_file(const std::filesystem::path& file);

/// "2=1"; nothing where it is something else.
[[nodiscard]] std::optional<LabelMerge> parse_merge(const std::string& text);
/// "skin=1.5"; nothing where it is something else. Its thickness may be out of range.
[[nodiscard]] std::optional<image::Layer> parse_layer(const std::string& text);

/// What is wrong with layers as given on a command line, with the option's name, or nothing: each needs a name of its
/// own (case does not count) and a thickness.
[[nodiscard]] std::string problem_of_layers(const std::vector<std::string>& layers);
/// What is wrong with one label of a list, or nothing.
[[nodiscard]] std::string problem_of_label(const std::string& text);

/// Reads names and image, or samples the surface, and chooses labels.
/// Errors: of the readers; kBadFile for a label that is not there. They name the file.
[[nodiscard]] Result<OrganInput> read_organ(const OrganJob& job);
/// Grows layers and makes tets. `input` is left with the voxels that were meshed. Errors: as `grow_layers` and
/// `mesh_labels`.
[[nodiscard]] Result<Organ> mesh_organ(const OrganJob& job, OrganInput& input);

}  // namespace app
}  // namespace v0
}  // namespace incise
