// SPDX-License-Identifier: Apache-2.0
// The pipeline from a file to tets: labels are read or sampled from a surface, merged, kept or left out, and layers
// are put under the skin; then it is meshed, and what did not come out as asked is noted.
#include "app/model/organ.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "app/model/extension.h"
#include "app/model/label_names.h"
#include "incise/image/surface_labels.h"
#include "incise/io/numbers.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

/// Voxels that a surface is sampled at, as a share of the tets' size, and of the thinnest layer.
constexpr double kVoxelShare = 1.0 / 3, kVoxelShareOfLayer = 1.0 / 2;

bool is_among(const std::string& what, std::initializer_list<const char*> list) {
  return std::any_of(list.begin(), list.end(), [&](const char* item) { return what == item; });
}

double voxel_for_surface(const OrganJob& job) {
  double voxel = kVoxelShare * job.size;
  for (const image::Layer& layer : job.layers) {
    if (layer.thickness > 0) voxel = std::min(voxel, kVoxelShareOfLayer * layer.thickness);
  }
  return voxel;
}

Result<image::ImageFile> read_surface_labels(const OrganJob& job, std::vector<double>& volumes) {
  Result<io::SurfaceSoup> surface = io::read_surface(job.input);
  if (!surface.ok()) return surface.error();
  const std::size_t triangles = surface->triangles.size();
  Result<image::SurfaceLabels> labels =
      image::label_surface(std::move(surface).value(), voxel_for_surface(job), job.threads);
  if (!labels.ok()) return Error{labels.error().code, job.input + ": " + labels.error().message};
  image::ImageFile file;
  file.image = std::move(labels->image);
  file.format_name = "surface of " + std::to_string(triangles) + " triangles, sampled by winding numbers";
  file.placed_by = "its own coordinates";
  file.notes = std::move(labels->notes);
  if (job.merges.empty() && job.labels.empty()) volumes = std::move(labels->volumes);
  return file;
}

/// Says which label is not there.
Status check_there(const OrganJob& job, const image::LabelImage& image, std::int32_t label) {
  if (label != 0 && image.find_label(label) != image.labels.size()) return {};
  std::string there;
  for (const std::int32_t l : image.labels) there += l != 0 && there.size() < 60 ? " " + std::to_string(l) : "";
  return Error{ErrorCode::kBadFile, job.input + ": has no label " + std::to_string(label) + "; there are" +
                                        (there.empty() ? " none" : there)};
}

/// Merges labels, then keeps those that are asked for.
Status choose_labels(const OrganJob& job, image::LabelImage& image) {
  for (const LabelMerge& merge : job.merges) {
    if (Status status = check_there(job, image, merge.from); !status.ok()) return status;
    image::merge_label(image, merge.from, merge.to);
  }
  for (const std::int32_t label : job.labels) {
    if (Status status = check_there(job, image, label); !status.ok()) return status;
  }
  if (!job.labels.empty()) image::keep_labels(image, job.labels);
  for (const std::int32_t label : job.layers_in) {
    if (Status status = check_there(job, image, label); !status.ok()) return status;
  }
  return {};
}

/// What the user may want to know of the layers.
void note_layers(const OrganJob& job, const image::LayeredImage& layered, Organ& organ) {
  const auto& finer = layered.finer;
  if (finer != std::array<std::size_t, 3>{1, 1, 1}) {
    organ.notes.push_back(job.input + ": each voxel was made " + std::to_string(finer[0]) + " x " +
                          std::to_string(finer[1]) + " x " + std::to_string(finer[2]) + " for the thinnest layer");
  }
  if (layered.cut_off > 0) {
    organ.notes.push_back(job.input + ": " + std::to_string(layered.cut_off) +
                          " voxels touch the border of the image, which cuts the body off: no layer grows there");
  }
  for (const std::int32_t label : layered.swallowed) {
    organ.notes.push_back(job.input + ": label " + std::to_string(label) +
                          " lies in the layers wholly, and is no more; name the labels that layers may grow in");
  }
}

/// The volumes of labels that layers took from are no longer known.
void forget_volumes(const image::LabelImage& before, const image::LabelImage& now, std::vector<double>& volumes) {
  if (volumes.empty()) return;
  const std::vector<std::uint64_t> old_counts = before.count_voxels(), counts = now.count_voxels();
  volumes.resize(now.labels.size(), 0);
  for (std::size_t l = 0; l < volumes.size(); ++l) {
    if (l >= old_counts.size() || old_counts[l] != counts[l]) volumes[l] = 0;
  }
}

Status add_layers(const OrganJob& job, OrganInput& input, Organ& organ, double& smooth) {
  if (job.layers.empty()) return {};
  image::LayerOptions options;
  options.layers = job.layers;
  options.within = job.layers_in;
  options.smooth = job.smooth;
  options.size = job.size;
  options.most_halvings = job.halvings;
  options.threads = job.threads;
  Result<image::LayeredImage> layered = image::grow_layers(input.file.image, options);
  if (!layered.ok()) return Error{layered.error().code, job.input + ": " + layered.error().message};
  note_layers(job, *layered, organ);
  const bool is_as_fine = layered->image.voxels.size() == input.file.image.voxels.size();
  if (is_as_fine) forget_volumes(input.file.image, layered->image, input.volumes);
  if (!is_as_fine) input.volumes.clear();
  input.file.image = std::move(layered->image);
  organ.layers = std::move(layered->labels);
  organ.finer = layered->finer;
  smooth = layered->smooth;
  for (std::size_t l = 0; l < organ.layers.size(); ++l) organ.names[organ.layers[l]] = job.layers[l].name;
  return {};
}

/// Labels that did not come out as the image has them. What islands lost counts for those that are lost, not for those
/// that are off: specks are noise.
void note_labels(const OrganJob& job, const image::LabelImage& image, Organ& organ) {
  constexpr double kMostLost = 0.05, kLost = 0.5;  // of a label's volume
  constexpr std::size_t kMostTold = 8;
  const std::vector<std::uint64_t> counts = image.count_voxels();
  std::size_t told = 0;
  for (const image::LabelOutcome& label : organ.made.labels) {
    const std::size_t index = image.find_label(label.label);
    if (index == counts.size() || counts[index] == 0) continue;  // layers took all of it
    const double had = std::max(label.image_volume, static_cast<double>(counts[index]) * image.voxel_volume());
    if (label.volume < kLost * had) organ.lost.push_back(label.label);
    const double error = label.image_volume > 0 ? label.volume / label.image_volume - 1 : 0;
    const std::string which = job.input + ": label " + std::to_string(label.label);
    if (label.tets > 0 && std::abs(error) <= kMostLost) continue;
    if (++told > kMostTold) continue;
    if (label.tets == 0) {
      organ.notes.push_back(which + " is too small or too thin to be there; use a smaller --size, or a finer image");
    } else {
      organ.notes.push_back(which + " is " + std::to_string(std::lround(100 * std::abs(error))) + " % " +
                            (error > 0 ? "larger" : "smaller") +
                            " than in the image; use a smaller --size, or more --halvings");
    }
  }
  if (told > kMostTold) {
    organ.notes.push_back(job.input + ": and so are " + std::to_string(told - kMostTold) +
                          " more labels; the report names all (--report)");
  }
}

void note_mesh(const OrganJob& job, Organ& organ) {
  if (organ.made.island_voxels > 0) {
    organ.notes.push_back(job.input + ": " + std::to_string(organ.made.island_voxels) +
                          " voxels of islands too small for this size joined what is around them");
  }
  if (organ.made.pinched_points > 0) {
    organ.notes.push_back(job.input + ": a label touches itself in " + std::to_string(organ.made.pinched_points) +
                          " points; use a smaller --size, or merge labels");
  }
}

bool parse_label(const std::string& text, std::int32_t& out) {
  std::int64_t value = 0;
  if (!io::parse_int(text, value)) return false;
  out = static_cast<std::int32_t>(value);
  return out == value;
}

}  // namespace

bool is_surface_file(const fs::path& file) {
  return is_among(extension_of(file), {".stl", ".obj", ".ply", ".off"});
}

bool is_image_file(const fs::path& file) {
  return is_among(extension_of(file), {".nii", ".hdr", ".img", ".nrrd", ".nhdr", ".mha", ".mhd", ".inr"});
}

std::optional<LabelMerge> parse_merge(const std::string& text) {
  const std::size_t equals = text.find('=');
  LabelMerge merge;
  if (equals == std::string::npos || !parse_label(text.substr(0, equals), merge.from) ||
      !parse_label(text.substr(equals + 1), merge.to)) {
    return std::nullopt;
  }
  return merge;
}

std::optional<image::Layer> parse_layer(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  image::Layer layer;
  if (equals == std::string::npos || equals == 0 || !io::parse_double(text.substr(equals + 1), layer.thickness)) {
    return std::nullopt;
  }
  layer.name = text.substr(0, equals);
  return layer;
}

std::string problem_of_layers(const std::vector<std::string>& layers) {
  std::vector<std::string> names;
  for (const std::string& text : layers) {
    const std::optional<image::Layer> layer = parse_layer(text);
    if (!layer) return "--layers " + text + ": a name and a thickness in mm are needed, as in --layers skin=1.5,fat=8";
    std::string name = layer->name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      return "--layers " + text + ": there is a layer of this name already; give each a name of its own";
    }
    names.push_back(std::move(name));
  }
  return {};
}

std::string problem_of_label(const std::string& text) {
  std::int32_t label = 0;
  return parse_label(text, label) ? "" : "'" + text + "' is no label: whole numbers are needed, as in 1,3";
}

Result<OrganInput> read_organ(const OrganJob& job) {
  OrganInput input;
  input.is_scan = !is_surface_file(job.input);
  if (!job.names.empty()) {
    Result<io::RegionNames> names = read_label_names(job.names);
    if (!names.ok()) return names.error();
    input.names = std::move(names).value();
  }
  Result<image::ImageFile> file =
      input.is_scan ? image::read_labels(job.input) : read_surface_labels(job, input.volumes);
  if (!file.ok()) return file.error();
  input.file = std::move(file).value();
  if (const Status status = choose_labels(job, input.file.image); !status.ok()) return status.error();
  return input;
}

Result<Organ> mesh_organ(const OrganJob& job, OrganInput& input) {
  Organ organ;
  organ.names = input.names;
  double smooth = job.smooth;
  if (const Status status = add_layers(job, input, organ, smooth); !status.ok()) return status.error();
  image::MeshLabelsOptions options;
  options.size = job.size;
  options.smooth = smooth;
  options.grade = job.grade;
  options.most_halvings = job.halvings;
  options.threads = job.threads;
  options.volumes = input.volumes;
  options.progress = job.progress;
  Result<image::LabelMesh> made = image::mesh_labels(input.file.image, options);
  if (!made.ok()) return Error{made.error().code, job.input + ": " + made.error().message};
  organ.made = std::move(made).value();
  note_labels(job, input.file.image, organ);
  note_mesh(job, organ);
  return organ;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
