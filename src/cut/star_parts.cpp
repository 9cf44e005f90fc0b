// SPDX-License-Identifier: Apache-2.0
#include "cut/star_parts.h"

#include <algorithm>

namespace incise::inline v0 {

namespace {

/// Material stands where a vertex does within this share of a tet's size: the rounding of interpolation.
constexpr double kSamePlace = 1e-9;

}  // namespace

void StarParts::find_parts(const TetMesh& mesh, std::vector<StarTet>& star) {
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    index_of_tet_.ensure(std::size_t{star[i].tet.value} + 1);
    index_of_tet_[star[i].tet.value] = i + 1;
    star[i].part = 0;
  }
  sorted_.clear();
  parts_.clear();
  for (std::uint32_t seed = 0; seed < star.size(); ++seed) {
    if (star[seed].part != 0) continue;
    const auto part = static_cast<std::uint32_t>(parts_.size() + 1);
    parts_.push_back({static_cast<std::uint32_t>(sorted_.size()), 0, {}});
    queue_.assign(1, seed);
    star[seed].part = part;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const StarTet at = star[queue_[i]];
      sorted_.push_back(at);
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(at.tet)[s];
        if (s == at.corner || link.is_boundary()) continue;
        const std::size_t slot = link.side().tet().value;
        const std::uint32_t next = slot < index_of_tet_.capacity() ? index_of_tet_[slot] : 0;
        if (next != 0 && star[next - 1].part == 0) {
          star[next - 1].part = part;
          queue_.push_back(next - 1);
        }
      }
    }
    parts_.back().last = static_cast<std::uint32_t>(sorted_.size());
  }
  for (const StarTet& tet : star) index_of_tet_[tet.tet.value] = 0;
}

bool StarParts::is_taken(VertexId copy) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.copy == copy; });
}

void StarParts::keep_copies(const TetMesh& mesh, std::span<const StarTet> star) {
  for (Part& part : parts_) {
    for (std::uint32_t i = part.first; i < part.last && !part.copy.is_valid(); ++i) {
      if (star[i].is_new) continue;
      const VertexId copy = mesh.vertices(star[i].tet)[star[i].corner];
      if (!is_taken(copy)) part.copy = copy;
    }
  }
}

/// Where a vertex of a part stands: in the old child that reaches least beyond itself; in none, `inside` is -1e300.
MaterialPlace StarParts::place_of(const TetMesh& mesh, const OldChildren& old, VertexId vertex,
                                  std::span<const StarTet> part) {
  MaterialPlace best;
  for (const StarTet& tet : part) {
    if (tet.old == kInvalidIndex) continue;
    const TetVertices& corners = old.vertices(tet.old);
    if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) return {};  // there where it stands
    const MaterialPlace place = old.place_in(tet.old, mesh.rest(vertex));
    if (place.inside > best.inside) best = place;
  }
  return best;
}

/// A copy with the values that the part's side of the cut had there.
VertexId StarParts::make_copy(Transaction& transaction, const OldChildren& old, VertexId vertex,
                              std::span<const StarTet> part) {
  const TetMesh& mesh = transaction.mesh();
  const MaterialPlace place = place_of(mesh, old, vertex, part);
  if (place.inside <= -1e300) return transaction.copy_vertex(vertex);
  const VertexId copy = add_vertex_at(transaction, mesh.rest(vertex), place);
  transaction.set_origin(copy, mesh.origin(vertex));
  return copy;
}

/// Whether tets of a part that stay have a copy, and another one.
bool StarParts::has_other_copy(const TetMesh& mesh, std::span<const StarTet> part, VertexId copy) {
  const auto stays = std::find_if(part.begin(), part.end(), [](const StarTet& tet) { return !tet.is_new; });
  return stays != part.end() && mesh.vertices(stays->tet)[stays->corner] != copy;
}

/// The copy of a vertex, or itself, that the material of a part had before this step; of several, that of its first tet
/// from before. None where the material did not reach the vertex.
VertexId StarParts::copy_before(const TetMesh& mesh, const ClosedComplex& complex, const OldChildren& old,
                                VertexId vertex, std::span<const StarTet> part) {
  for (const StarTet& tet : part) {
    if (!tet.is_new) return mesh.vertices(tet.tet)[tet.corner];
  }
  for (const StarTet& tet : part) {
    if (tet.old == kInvalidIndex) continue;
    const TetVertices& corners = old.vertices(tet.old);
    const auto is_copy = [&](VertexId v) { return complex.closed(v) == vertex && mesh.is_live(v); };
    const auto had = std::find_if(corners.begin(), corners.end(), is_copy);
    if (had != corners.end()) return *had;
  }
  return {};
}

void StarParts::write_corners(Transaction& transaction, std::span<const StarTet> star) {
  const TetMesh& mesh = transaction.mesh();
  for (const Part& part : parts_) {
    for (std::uint32_t i = part.first; i < part.last; ++i) {
      if (mesh.vertices(star[i].tet)[star[i].corner] != part.copy) {
        transaction.set_corner(star[i].tet, star[i].corner, part.copy);
      }
    }
  }
  for (const Part& part : parts_) {
    const TetId known = mesh.tet_of(part.copy);
    if (!known.is_valid() || !mesh.is_live(known) || mesh.corner_of(known, part.copy) == 4) {
      transaction.set_tet_of(part.copy, star[part.first].tet);
    }
  }
}

void StarParts::set_shapes(Transaction& transaction, VertexId vertex, std::span<const StarTet> star,
                           std::uint32_t tag) {
  const TetMesh& mesh = transaction.mesh();
  const unsigned kept = mesh.shape_of(vertex) & (shape::kPinched | (parts_.size() == 1 ? shape::kFront : 0U));
  for (const Part& part : parts_) {
    unsigned bits = kept;
    for (std::uint32_t i = part.first; i < part.last; ++i) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(star[i].tet)[s];
        if (s == star[i].corner || !link.is_boundary()) continue;
        bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
        bits |= link.tag() == tag && parts_.size() == 1 ? shape::kFront : 0U;
      }
    }
    if (bits != mesh.shape_of(part.copy)) transaction.set_shape(part.copy, static_cast<std::uint8_t>(bits));
  }
}

void StarParts::bury(Transaction& transaction, ClosedComplex& complex, VertexId vertex, VertexId closed) {
  if (complex.has_copies(vertex)) {
    for (const VertexId copy : complex.copies_of(vertex)) {
      if (!is_taken(copy)) transaction.remove_vertex(copy);
    }
    complex.drop_copies(vertex);
  }
  if (closed != vertex) transaction.remove_vertex(vertex);
  for (const Part& part : parts_) {
    if (part.copy != closed) complex.add_copy(closed, part.copy);
  }
}

/// What a closed vertex that no part has taken is called from now on: as the first part's copy, or it takes its place.
VertexId StarParts::name(Transaction& transaction, VertexId vertex, bool may_be_named) {
  if (parts_.empty() || is_taken(vertex)) return vertex;
  const TetMesh& mesh = transaction.mesh();
  const VertexId kept = parts_.front().copy;
  if (may_be_named) return kept;
  if (mesh.current(kept) != mesh.current(vertex)) {
    transaction.move(vertex, mesh.rest(vertex), {kept, kept, kept, kept}, {1.0, 0.0, 0.0, 0.0});
  }
  parts_.front().copy = vertex;
  return vertex;
}

StarParts::Division StarParts::divide(Transaction& transaction, ClosedComplex& complex, const OldChildren& old,
                                      VertexId vertex, std::vector<StarTet>& star, const Home& home,
                                      const Settings& settings) {
  const TetMesh& mesh = transaction.mesh();
  find_parts(mesh, star);
  std::swap(star, sorted_);
  keep_copies(mesh, star);
  const auto tets_of = [&](const Part& part) { return std::span(star).subspan(part.first, part.last - part.first); };
  const auto were_apart = [&](const Part& part, VertexId copy) {
    const auto is_apart = [&](const StarTet& tet) { return settings.pieces->are_apart(tet.tet, copy); };
    const auto tets = tets_of(part);
    return settings.pieces != nullptr && settings.pieces->has_several() &&
           std::any_of(tets.begin(), tets.end(), is_apart);
  };
  const auto had = [&](const Part& part) {
    return settings.keeps_places ? copy_before(mesh, complex, old, vertex, tets_of(part)) : VertexId();
  };
  const auto may_take = [&](const Part& part, VertexId copy) {
    const bool is_elsewhere = settings.keeps_places && has_other_copy(mesh, tets_of(part), copy);
    return !is_elsewhere && !were_apart(part, copy);
  };
  for (Part& part : parts_) {
    if (part.copy.is_valid()) continue;
    const VertexId copy = home(tets_of(part));
    if (copy.is_valid() && !is_taken(copy) && may_take(part, copy)) part.copy = copy;
  }
  const auto was_elsewhere = [&](const Part& part) { return were_apart(part, vertex) || complex.has_copies(vertex); };
  const auto stands_in = [&](const Part& part) {
    if (!may_take(part, vertex)) return false;
    if (settings.makes_twins || !settings.keeps_places) return true;
    const MaterialPlace place = place_of(mesh, old, vertex, tets_of(part));
    const double tolerance =
        kSamePlace * (mesh.rest(vertex) - mesh.rest(mesh.vertices(star[part.first].tet)[0])).norm();
    return place.inside <= -1e300 || (place.current - mesh.current(vertex)).norm() <= tolerance;
  };
  for (Part& part : parts_) {
    if (!part.copy.is_valid() && !is_taken(vertex) && stands_in(part)) part.copy = vertex;
  }
  Division done;
  for (Part& part : parts_) {
    if (part.copy.is_valid()) continue;
    if (!is_taken(vertex) && !settings.may_be_named) {
      const MaterialPlace place = place_of(mesh, old, vertex, tets_of(part));
      transaction.move(vertex, mesh.rest(vertex), place.basis, place.weights);
      part.copy = vertex;
      continue;
    }
    const bool is_twin = settings.makes_twins && !(settings.keeps_places && was_elsewhere(part));
    const VertexId source = is_twin ? vertex : had(part);
    part.copy =
        source.is_valid() ? transaction.copy_vertex(source) : make_copy(transaction, old, vertex, tets_of(part));
    ++done.made;
  }
  done.closed = name(transaction, vertex, settings.may_be_named);
  write_corners(transaction, star);
  set_shapes(transaction, done.closed, star, settings.tag);
  bury(transaction, complex, vertex, done.closed);
  return done;
}

}  // namespace incise::inline v0
