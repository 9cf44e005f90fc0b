// SPDX-License-Identifier: Apache-2.0
// Stars are flooded without crossing the faces to be opened, and each further group gets a copy of its vertex; a face
// whose three vertices all stay is latent.
#include "lab/opening.h"

#include <algorithm>

#include "cut/pinched_edges.h"
#include "paper/dividable.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

/// Puts a copy in place of a vertex, in some tets.
void give_copy(Transaction& transaction, VertexId vertex, const std::vector<TetId>& group) {
  const VertexId copy = transaction.copy_vertex(vertex);
  for (const TetId tet : group) transaction.set_corner(tet, transaction.mesh().corner_of(tet, vertex), copy);
  transaction.set_tet_of(copy, group.front());
}

bool is_one_face(const TetMesh& mesh, const IncisionFace& face) {
  auto a = mesh.vertices(face.a), b = mesh.vertices(face.b);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace

std::uint64_t part_star(Transaction& transaction, VertexId vertex, const std::vector<TetId>& star,
                        const std::vector<Side>& blocked, StarWalker& walker) {
  std::vector<std::vector<TetId>> groups;
  std::vector<TetId> seen;  // ascending
  for (const TetId seed : star) {
    if (std::binary_search(seen.begin(), seen.end(), seed)) continue;
    groups.push_back(walker.flood(transaction.mesh(), vertex, seed,
                                  [&](Side side) { return std::binary_search(blocked.begin(), blocked.end(), side); }));
    seen.insert(seen.end(), groups.back().begin(), groups.back().end());
    std::sort(seen.begin(), seen.end());
  }
  if (groups.empty()) return 0;
  transaction.set_tet_of(vertex, groups.front().front());
  for (std::size_t k = 1; k < groups.size(); ++k) give_copy(transaction, vertex, groups[k]);
  return groups.size() - 1;
}

void open_faces(Transaction& transaction, const std::vector<IncisionFace>& faces, std::uint32_t tag,
                CutStatistics& statistics) {
  const TetMesh& mesh = transaction.mesh();
  std::vector<Side> blocked = sides_of(faces);
  std::sort(blocked.begin(), blocked.end());
  std::vector<VertexId> vertices;
  for (const IncisionFace& face : faces) {
    for (const VertexId v : mesh.vertices(face.a)) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  StarWalker walker;
  for (const VertexId v : vertices) {
    const std::vector<TetId> star = walker.star(mesh, v);
    statistics.copied_vertices += part_star(transaction, v, star, blocked, walker);
  }
  for (const IncisionFace& face : faces) {
    if (is_one_face(mesh, face)) {
      ++statistics.latent_faces;
      continue;
    }
    transaction.open(face.a, face.b, tag);
    mark_wall(transaction, face);
    ++statistics.incision_faces;
  }
}

void commit(const CutContext& context, Transaction& transaction, const std::vector<Side>& walls) {
  context.statistics.new_vertices += growth(0, transaction.new_vertices().size());
  context.journal.append_if_changed(transaction.commit());
  StarWalker walker;
  Transaction parting(context.mesh);
  context.statistics.pinched_edges += part_pinched_edges(parting, walls, walker);
  context.statistics.new_vertices += growth(0, parting.new_vertices().size());
  context.journal.append_if_changed(parting.commit());
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
