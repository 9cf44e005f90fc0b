// SPDX-License-Identifier: Apache-2.0
// The mesh of a scan goes into a file named by its hash: scenes, recordings and replays name a file, and none is
// overwritten by another mesh.
#include "app/session/scan_scene.h"

#include <system_error>
#include <utility>

#include "app/session/session.h"
#include "app/text/formatted.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/sim/tissue.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetre = 1e-3;

/// Two meshes of one scan do not take each other's place: a recording may name either.
fs::path file_for(const OrganJob& job, const TetMesh& mesh) {
  std::string stem = fs::path(job.input).filename().string();
  stem = stem.substr(0, stem.find('.'));
  std::error_code code;
  return fs::temp_directory_path(code) / formatted("incise-{}-{:016x}.msh", stem, mesh.hash());
}

void note_materials(const OrganJob& job, const Organ& organ, std::vector<std::string>& notes) {
  for (const image::LabelOutcome& label : organ.made.labels) {
    const auto name = organ.names.find(label.label);
    const Tissue* tissue = name == organ.names.end() ? nullptr : tissue_of_region_name(name->second);
    const std::string called = name == organ.names.end() ? "" : " (" + name->second + ")";
    notes.push_back(formatted("{}: region {}{} is made of {}", job.input, label.label, called,
                              tissue == nullptr ? "soft tissue, since no name says more" : std::string(tissue->name)));
  }
}

}  // namespace

Result<ScanScene> make_scan_scene(const OrganJob& job, fs::path mesh, const Vec3& up) {
  Result<OrganInput> input = read_organ(job);
  if (!input.ok()) return input.error();
  Result<Organ> organ = mesh_organ(job, *input);
  if (!organ.ok()) return organ.error();
  const TetMesh& tets = organ->made.mesh;
  ScanScene made;
  for (const std::string& note : input->file.notes) made.notes.push_back(job.input + ": " + note);
  made.notes.insert(made.notes.end(), organ->notes.begin(), organ->notes.end());
  note_materials(job, *organ, made.notes);
  made.mesh = mesh.empty() ? file_for(job, tets) : std::move(mesh);
  io::MeshData data = io::to_mesh_data(tets, find_components(tets));
  data.region_names = organ->names;
  io::WriteOptions options;
  options.msh = io::MshVariant::k41Binary;
  if (const Status status = io::write_mesh(made.mesh, data, options); !status.ok()) return status.error();
  made.scene = scene_of_mesh(made.mesh, rest_bounds(tets), up);
  made.scene.name = fs::path(job.input).filename().string();
  made.scene.options.body.length_unit = kMillimetre;
  return made;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
