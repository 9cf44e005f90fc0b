// SPDX-License-Identifier: Apache-2.0
// The same figures twice, from one struct: JSON for programs, lines for people.
#include "mesh_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/text/formatted.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/version.h"
#include "input_kind.h"

namespace incise_cli {
namespace {

using namespace incise;
using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

std::string name_of(const MeshReport& report, std::int32_t label) {
  const io::RegionNames& names = report.organ->names;
  const auto found = names.find(label);
  return found == names.end() ? "" : found->second;
}

double relative_error(const image::LabelOutcome& label) {
  return label.image_volume > 0 ? label.volume / label.image_volume - 1 : 0;
}

Json input_json(const MeshReport& report) {
  const image::LabelImage& image = report.input->file.image;
  return {{"file", name_of_input(report.arguments->input)},
          {"format", report.input->file.format_name},
          {"placed_by", report.input->file.placed_by},
          {"voxels", {image.size[0], image.size[1], image.size[2]}},
          {"spacing_mm", to_json(image.spacing())},
          {"finer", report.organ->finer},
          {"notes", report.input->file.notes}};
}

bool is_among(const std::vector<std::int32_t>& labels, std::int32_t label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

Json labels_of(const MeshReport& report) {
  Json labels = Json::array();
  for (const image::LabelOutcome& l : report.organ->made.labels) {
    labels.push_back({{"label", l.label},
                      {"name", name_of(report, l.label)},
                      {"voxels", l.voxels},
                      {"image_volume_mm3", l.image_volume},
                      {"tets", l.tets},
                      {"volume_mm3", l.volume},
                      {"relative_error", relative_error(l)},
                      {"is_lost", is_among(report.organ->lost, l.label)}});
  }
  return labels;
}

Json layers_of(const MeshReport& report) {
  Json layers = Json::array();
  for (std::size_t l = 0; l < report.organ->layers.size(); ++l) {
    const std::int32_t label = report.organ->layers[l];
    layers.push_back({{"label", label}, {"name", name_of(report, label)}, {"thickness", report.layers[l].thickness}});
  }
  return layers;
}

Json quality_of(const QualityStats& q) {
  return {{"lr_min", q.lr_min},
          {"lr_mean", q.lr_mean},
          {"lr_p99", q.lr_p99},
          {"lr_max", q.lr_max},
          {"dihedral_min_deg", q.dihedral_min_deg},
          {"dihedral_max_deg", q.dihedral_max_deg}};
}

}  // namespace

std::string to_json(const MeshReport& report) {
  const MeshArguments& a = *report.arguments;
  const image::LabelMesh& made = report.organ->made;
  const TetMesh& mesh = made.mesh;
  const Box box = rest_bounds(mesh);
  Json json = {{"format", "incise-mesh-report"},
               {"version", 1},
               {"program", "incise " INCISE_VERSION},
               {"input", input_json(report)},
               {"options",
                {{"size", a.size},
                 {"smooth", a.smooth},
                 {"grade", a.grade},
                 {"halvings", a.halvings},
                 {"labels", a.labels},
                 {"merge", a.merges},
                 {"layers", a.layers},
                 {"layers_in", a.layers_in},
                 {"may_lose", a.may_lose},
                 {"threads", a.threads}}},
               {"coordinates", report.input->is_scan ? "RAS, mm" : "of the surface"},
               {"mesh",
                {{"vertices", mesh.vertex_count()},
                 {"tets", mesh.tet_count()},
                 {"components", find_components(mesh).count()},
                 {"bounds", {to_json(box.lo), to_json(box.hi)}}}},
               {"labels", labels_of(report)},
               {"lost_labels", report.organ->lost},
               {"layers", layers_of(report)},
               {"island_voxels", made.island_voxels},
               {"relabelled_tets", made.relabelled_tets},
               {"pinched_points", made.pinched_points},
               {"quality", quality_of(measure_quality(mesh))},
               {"validity", {{"ok", report.is_valid}}},
               {"time_ms", {{"read", report.read_ms}, {"mesh", report.mesh_ms}}},
               {"hash", app::formatted("{:016x}", mesh.hash())}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const MeshReport& report) {
  const image::LabelMesh& made = report.organ->made;
  const QualityStats q = measure_quality(made.mesh);
  const image::LabelImage& image = report.input->file.image;
  const MeshOutput& output = report.arguments->output;
  const Vec3 spacing = image.spacing();
  std::string out =
      app::formatted("{}: {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g}{}, placed by {}\n",
                     report.input->file.format_name, image.size[0], image.size[1], image.size[2], spacing.x(),
                     spacing.y(), spacing.z(), report.input->is_scan ? " mm" : "", report.input->file.placed_by);
  out += app::formatted("{}: {} tets, {} vertices{}; dihedral angles {:.1f} to {:.1f} degrees, worst L/r {:.1f}\n",
                        output.is_stdout() ? "stdout" : output.file, made.mesh.tet_count(), made.mesh.vertex_count(),
                        report.input->is_scan ? ", in RAS mm" : "", q.dihedral_min_deg, q.dihedral_max_deg, q.lr_max);
  for (const image::LabelOutcome& l : made.labels) {
    const std::string name = name_of(report, l.label);
    if (l.tets == 0) {
      out += app::formatted("  {}{}{}: no tets, too thin for their size\n", l.label, name.empty() ? "" : " ", name);
      continue;
    }
    out += app::formatted("  {}{}{}: {} tets, volume {:.5g}{}, {:+.2f} % off\n", l.label, name.empty() ? "" : " ", name,
                          l.tets, l.volume, report.input->is_scan ? " mm3" : "", 100 * relative_error(l));
  }
  return out;
}

}  // namespace incise_cli
