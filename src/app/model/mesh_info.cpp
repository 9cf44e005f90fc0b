// SPDX-License-Identifier: Apache-2.0
// Figures are gathered from the soup, before a mesh is built: a file that cannot be built can still be described.
#include "app/model/mesh_info.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/text/formatted.h"
#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::size_t kMaxRegionsShown = 12;
/// Percent of the time of a check of a million tets that has gone by after its stages.
constexpr std::size_t kInspected = 50, kBuilt = 70, kMeasured = 80;

void measure_extent(const TetSoup& soup, MeshInfo& info) {
  bool is_first = true;
  for (const auto& tet : soup.tets) {
    const Vec3& a = soup.points[tet[0]];
    const Vec3 ab = soup.points[tet[1]] - a;
    const Vec3 ac = soup.points[tet[2]] - a;
    info.volume += std::abs(ab.cross(ac).dot(soup.points[tet[3]] - a)) / 6;
    for (const std::uint32_t v : tet) {
      info.low = is_first ? soup.points[v] : info.low.cwiseMin(soup.points[v]).eval();
      info.high = is_first ? soup.points[v] : info.high.cwiseMax(soup.points[v]).eval();
      is_first = false;
    }
  }
}

void count_regions(const TetSoup& soup, MeshInfo& info) {
  if (soup.regions.empty()) {
    info.regions.emplace_back(0, soup.tets.size());
    return;
  }
  std::map<std::int32_t, std::uint64_t> counts;
  for (const std::int32_t region : soup.regions) ++counts[region];
  info.regions.assign(counts.begin(), counts.end());
}

// Defects that break the validity contract: all but equal positions.
bool breaks_contract(const Defects& d) {
  return d.inverted + d.zero_volume + d.unreferenced_vertices + d.duplicate_tets + d.overshared_faces +
             d.nonmanifold_edges + d.singleton_vertices >
         0;
}

Json json_of(const MeshInfo& info) {
  Json root;
  root["file"] = info.source.file;
  root["format"] = info.source.format;
  root["vertices"] = info.source.vertices;
  root["tets"] = info.source.tets;
  root["ten_node"] = info.source.ten_node;
  root["regions"] = Json::array();
  for (const auto& [label, tets] : info.regions) root["regions"].push_back({{"label", label}, {"tets", tets}});
  root["bounds"] = Json::array({encode(info.low), encode(info.high)});
  root["volume"] = encode(info.volume);
  for (const NamedDefect& defect : list_defects(info.defects)) root["defects"][std::string(defect.name)] = defect.count;
  for (const NamedDefect& defect : list_defects(info.defects)) {
    if (!defect.examples.empty()) root["examples"][std::string(defect.name)] = defect.examples;
  }
  root["components"] = info.defects.components;
  root["notes"] = info.source.notes;
  return root;
}

std::string region_text(const MeshInfo& info) {
  std::string text;
  for (std::size_t i = 0; i < info.regions.size() && i < kMaxRegionsShown; ++i) {
    text += formatted("{}{} ({} tets)", i == 0 ? "" : ", ", info.regions[i].first, info.regions[i].second);
  }
  if (info.regions.size() > kMaxRegionsShown) text += formatted(", {} more", info.regions.size() - kMaxRegionsShown);
  return text;
}

std::string defect_text(const NamedDefect& defect, DefectKind kind) {
  std::string text = formatted("    {:<22} {:>9}", defect.name, defect.count);
  if (defect.count == 0 || defect.examples.empty()) return text + "\n";
  const bool is_pair = kind == DefectKind::kNonmanifoldEdges;
  text += "   e.g.";
  for (std::size_t i = 0; i < defect.examples.size(); i += is_pair ? 2 : 1) {
    text += formatted(" {}", defect.examples[i]);
    if (is_pair && i + 1 < defect.examples.size()) text += formatted("-{}", defect.examples[i + 1]);
  }
  return text + "\n";
}

}  // namespace

MeshInfo inspect(const io::MeshFile& file, const std::filesystem::path& path) {
  MeshInfo info;
  info.source = describe(file, path);
  count_regions(file.data.soup, info);
  measure_extent(file.data.soup, info);
  info.defects = io::find_file_defects(file);
  TetSoup turned = file.data.soup;
  const Normalised changes = normalise(turned);
  if (changes.flipped > 0) {
    info.source.notes.push_back(formatted("tets of negative volume: {}; cutting turns them", changes.flipped));
  }
  if (changes.dropped > 0) {
    info.source.notes.push_back(formatted("exact duplicates of tets: {}; cutting drops them", changes.dropped));
  }
  return info;
}

Result<MeshCheck> check_mesh(io::MeshFile file, const std::filesystem::path& path,
                             const std::function<void(std::size_t done, std::size_t total)>& progress) {
  const auto tell = [&](std::size_t percent) {
    if (progress) progress(percent, 100);
  };
  MeshCheck check;
  tell(0);
  check.info = inspect(file, path);
  tell(kInspected);
  Result<io::LoadedMesh> loaded = io::build_mesh(std::move(file), path);
  if (!loaded.ok()) return loaded.error();
  tell(kBuilt);
  check.quality = measure_quality(loaded->mesh);
  tell(kMeasured);
  check.validity = validate(loaded->mesh, ValidateLevel::kGeometry);
  check.ok = check.validity.ok && !breaks_contract(check.info.defects);
  tell(100);
  return check;
}

std::string to_json(const MeshInfo& info) {
  return json_of(info).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_json(const MeshCheck& check) {
  Json root = json_of(check.info);
  root["quality"] = encode(check.quality);
  root["valid"] = check.ok;
  root["validity"] = encode(check.validity);
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const MeshInfo& info) {
  const io::MeshSource& source = info.source;
  std::string text = formatted("{}: {}\n", source.file, source.format);
  text += formatted("  vertices    {}{}\n", source.vertices, source.ten_node ? " (mid-edge nodes included)" : "");
  text += formatted("  tets        {}{}\n", source.tets, source.ten_node ? " of ten nodes" : "");
  text += formatted("  components  {}\n", info.defects.components);
  text += formatted("  regions     {}\n", region_text(info));
  text += formatted("  bounds      ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", info.low.x(), info.low.y(),
                    info.low.z(), info.high.x(), info.high.y(), info.high.z());
  text += formatted("  volume      {:.9g}\n", info.volume);
  text += info.defects.none() ? "  defects     none\n" : "  defects\n";
  if (!info.defects.none()) {
    const auto list = list_defects(info.defects);
    for (std::size_t i = 0; i < list.size(); ++i) text += defect_text(list[i], static_cast<DefectKind>(i));
  }
  for (const std::string& note : source.notes) text += formatted("  note        {}\n", note);
  return text;
}

std::string to_text(const MeshCheck& check) {
  const QualityStats& q = check.quality;
  std::string text = to_text(check.info);
  text += formatted("  L/r         min {:.4g}, mean {:.4g}, p99 {:.4g}, max {:.4g}; {:.3g} % over 200{}\n", q.lr_min,
                    q.lr_mean, q.lr_p99, q.lr_max, q.lr_over_200_pct,
                    q.flat_tets > 0 ? formatted("; {} flat", q.flat_tets) : std::string());
  text += formatted("  dihedral    {:.4g} to {:.4g} degrees\n", q.dihedral_min_deg, q.dihedral_max_deg);
  return text + (check.ok ? "  valid\n" : "  INVALID\n");
}

}  // namespace app
}  // namespace v0
}  // namespace incise
