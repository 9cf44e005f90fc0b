// SPDX-License-Identifier: Apache-2.0
// All figures come from the mesh as it is at this moment: nothing is kept of a tet that may be gone with the next
// step.
#include "app/session/probe.h"

#include "app/text/formatted.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

std::string place_of(const ProbeInfo& probe) {
  if (probe.is_inside) return "inside";
  return probe.stroke > 0 ? formatted("wall of stroke {}", probe.stroke) : "skin";
}

}  // namespace

std::optional<ProbeInfo> probe(const TetMesh& mesh, Side side) {
  const TetId tet = side.tet();
  if (!mesh.is_live(tet)) return std::nullopt;
  ProbeInfo info;
  info.tet = tet;
  info.vertices = mesh.vertices(tet);
  info.region = mesh.region(tet);
  info.is_inside = !mesh.link(side).is_boundary();
  if (!info.is_inside) info.stroke = mesh.link(side).tag();
  const auto& [a, b, c, d] = info.vertices;
  info.lr = longest_edge_over_inradius(mesh.rest(a), mesh.rest(b), mesh.rest(c), mesh.rest(d));
  const DihedralExtremes angles = dihedral_extremes_deg(mesh.rest(a), mesh.rest(b), mesh.rest(c), mesh.rest(d));
  info.dihedral_min_deg = angles.least;
  info.dihedral_max_deg = angles.greatest;
  info.volume = mesh.rest_volume(tet);
  const double volume = signed_volume(mesh.current(a), mesh.current(b), mesh.current(c), mesh.current(d));
  info.stretch = info.volume != 0 ? volume / info.volume : 1;
  for (std::size_t i = 0; i < 4; ++i) info.corners[i] = mesh.current(info.vertices[i]).cast<float>();
  return info;
}

std::vector<std::string> to_lines(const ProbeInfo& probe) {
  const TetVertices& v = probe.vertices;
  return {
      formatted("Tet {}, vertices {} {} {} {}", probe.tet.value, v[0].value, v[1].value, v[2].value, v[3].value),
      formatted("Region {}, {}", probe.region, place_of(probe)),
      formatted("L/r {:.4g}, dihedral angles {:.1f} to {:.1f} deg", probe.lr, probe.dihedral_min_deg,
                probe.dihedral_max_deg),
      formatted("Volume {:.4g} at rest, now {:.3g} % of that", probe.volume, 100 * probe.stretch),
  };
}

}  // namespace app
}  // namespace v0
}  // namespace incise
