// SPDX-License-Identifier: Apache-2.0
#include "web_engine.h"

#include "app/scene/blade_file.h"
#include "folder.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"

namespace incise_web {

using incise::Engine;
using incise::Result;
using incise::StrokeReport;

namespace {

val to_value(const StrokeReport& report) {
  val value = val::object();
  value.set("stroke", report.stroke);
  value.set("cutTets", static_cast<double>(report.cut.cut_tets));
  value.set("createdTets", static_cast<double>(report.cut.created_tets));
  value.set("newVertices", static_cast<double>(report.cut.new_vertices));
  value.set("snappedVertices", static_cast<double>(report.cut.snapped_vertices));
  return value;
}

/// A step of the engine between each two times, as `incise cut --blade` does; then what a budget left undone.
Result<StrokeReport> cut_by_steps(Engine& engine, const incise::Stroke& stroke) {
  const Result<std::uint32_t> begun = engine.begin_stroke({stroke.edges.front()});
  if (!begun.ok()) return begun.error();
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
    const Result<incise::StepReport> step = engine.step({stroke.edges[i]});
    if (!step.ok()) return step.error();
  }
  Result<StrokeReport> report = engine.end_stroke();
  if (!report.ok() || !engine.has_maintenance()) return report;
  const Result<incise::MaintainReport> maintained = engine.maintain();
  if (!maintained.ok()) return maintained.error();
  return report;
}

}  // namespace

val WebEngine::open(const val& bytes, const std::string& name) {
  const Folder folder;
  if (const incise::Status status = folder.write(name, from_bytes(bytes)); !status.ok())
    return to_error(status.error());
  Result<incise::io::LoadedMesh> loaded = incise::io::load_mesh(folder.place_of(name));
  if (!loaded.ok()) return to_error(folder.named(loaded.error()));
  Result<Engine> engine = Engine::create(std::move(loaded->mesh));
  if (!engine.ok()) return to_error(engine.error());
  return val(std::make_shared<WebEngine>(std::move(engine).value(), std::move(loaded->file_vertex)));
}

val WebEngine::cut(const std::string& blade) {
  const Result<std::vector<incise::Stroke>> strokes = incise::app::parse_blade(blade, "the blade");
  if (!strokes.ok()) return to_error(strokes.error());
  const std::uint32_t before = engine_.stroke_count();
  val reports = val::array();
  for (const incise::Stroke& stroke : *strokes) {
    const Result<StrokeReport> report = cut_by_steps(engine_, stroke);
    if (!report.ok()) {
      while ((engine_.is_in_stroke() || engine_.stroke_count() > before) && engine_.undo()) continue;
      return to_error(report.error());
    }
    reports.call<void>("push", to_value(*report));
  }
  return reports;
}

val WebEngine::cut_plane(const val& normal, double offset) {
  const Result<incise::Vec3> direction = to_vec3(normal, "normal");
  if (!direction.ok()) return to_error(direction.error());
  const Result<incise::Stroke> stroke = incise::plane_stroke(incise::rest_bounds(engine_.mesh()), *direction, offset);
  if (!stroke.ok()) return to_error(stroke.error());
  const Result<StrokeReport> report = engine_.cut(*stroke);
  return report.ok() ? to_value(*report) : to_error(report.error());
}

val WebEngine::improve() {
  const auto report = engine_.improve();
  return report.ok() ? val::undefined() : to_error(report.error());
}

val WebEngine::write(const std::string& extension) const {
  const Result<std::string> bytes = incise::io::write_mesh_bytes(
      extension, incise::io::to_mesh_data(engine_.mesh(), incise::find_components(engine_.mesh()), file_vertex_));
  return bytes.ok() ? to_bytes(*bytes) : to_error(bytes.error());
}

val WebEngine::points() const {
  const incise::io::MeshData data =
      incise::io::to_mesh_data(engine_.mesh(), incise::find_components(engine_.mesh()), file_vertex_);
  std::vector<double> numbers;
  numbers.reserve(3 * data.soup.points.size());
  for (const auto& point : data.soup.points) numbers.insert(numbers.end(), {point[0], point[1], point[2]});
  return copy_of("Float64Array", numbers);
}

val WebEngine::tets() const {
  const incise::io::MeshData data =
      incise::io::to_mesh_data(engine_.mesh(), incise::find_components(engine_.mesh()), file_vertex_);
  std::vector<std::uint32_t> numbers;
  numbers.reserve(4 * data.soup.tets.size());
  for (const auto& tet : data.soup.tets) numbers.insert(numbers.end(), tet.begin(), tet.end());
  return copy_of("Uint32Array", numbers);
}

val WebEngine::quality() const {
  const incise::QualityStats stats = incise::measure_quality(engine_.mesh());
  val value = val::object();
  value.set("lrMin", stats.lr_min);
  value.set("lrMean", stats.lr_mean);
  value.set("lrMax", stats.lr_max);
  value.set("dihedralMinDeg", stats.dihedral_min_deg);
  value.set("dihedralMaxDeg", stats.dihedral_max_deg);
  return value;
}

unsigned WebEngine::pieces() const {
  return static_cast<unsigned>(incise::find_components(engine_.mesh()).count());
}

}  // namespace incise_web
