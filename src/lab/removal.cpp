// SPDX-License-Identifier: Apache-2.0
// Crossed tets go, their neighbours' sides become walls, and what then hangs at a vertex or an edge alone is parted.
#include "lab/removal.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lab/opening.h"
#include "paper/contact.h"
#include "paper/crossing.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

/// The tets with a crossed edge, ascending.
std::vector<TetId> find_crossed(const TetMesh& mesh, const Sheet& sheet, unsigned threads) {
  Neighbourhood near;
  find_crossings(mesh, sheet, find_near_tets(mesh, sheet, threads), near, threads);
  std::vector<TetId> crossed;
  for (const NearTet& tet : near.tets) {
    const bool is_crossed = std::any_of(tet.edges.begin(), tet.edges.end(),
                                        [&](std::uint32_t e) { return near.edges[e].crossings.count > 0; });
    if (is_crossed) crossed.push_back(tet.id);
  }
  return crossed;
}

using Star = std::pair<VertexId, std::vector<TetId>>;

/// The tets around the vertices of `removed` that stay.
std::vector<Star> find_stars(const TetMesh& mesh, const std::vector<TetId>& removed, StarWalker& walker) {
  std::vector<VertexId> vertices;
  for (const TetId tet : removed) vertices.insert(vertices.end(), mesh.vertices(tet).begin(), mesh.vertices(tet).end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Star> stars;
  for (const VertexId v : vertices) {
    stars.emplace_back(v, walker.star(mesh, v));
    std::erase_if(stars.back().second,
                  [&](TetId tet) { return std::binary_search(removed.begin(), removed.end(), tet); });
  }
  return stars;
}

/// Turns the faces between what goes and what stays into walls. Returns them.
std::vector<Side> remove(Transaction& transaction, const std::vector<TetId>& removed, std::uint32_t tag) {
  const TetMesh& mesh = transaction.mesh();
  std::vector<Side> walls;
  for (const TetId tet : removed) {
    for (const Link link : mesh.links(tet)) {
      const bool stays = !link.is_boundary() && !std::binary_search(removed.begin(), removed.end(), link.side().tet());
      if (stays) walls.push_back(link.side());
    }
  }
  for (const Side wall : walls) {
    transaction.set_link(wall, Link::boundary(tag));
    for (const VertexId v : mesh.vertices(wall)) {
      transaction.set_shape(v, static_cast<std::uint8_t>(mesh.shape_of(v) | shape::kWall));
    }
  }
  for (const TetId tet : removed) transaction.remove_tet(tet);
  return walls;
}

}  // namespace

Status remove_elements(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  const std::vector<TetId> removed = find_crossed(context.mesh, sheet, threads);
  context.statistics.cut_tets += removed.size();
  StarWalker walker;
  Transaction transaction(context.mesh);
  const std::vector<Star> stars = find_stars(context.mesh, removed, walker);
  const std::vector<Side> walls = remove(transaction, removed, tag);
  context.statistics.incision_faces += growth(0, walls.size());
  for (const auto& [vertex, star] : stars) {
    if (star.empty()) {
      transaction.remove_vertex(vertex);
    } else {
      context.statistics.copied_vertices += part_star(transaction, vertex, star, {}, walker);
    }
  }
  commit(context, transaction, walls);
  return {};
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
