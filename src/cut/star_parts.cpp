// SPDX-License-Identifier: Apache-2.0
// Tets of a star are joined through their faces by flooding; then parts choose copies in turn: what they had, what
// stands on their side, the closed vertex, a new one (docs/internals.md, 3.9).
#include "cut/star_parts.h"

#include <algorithm>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

void StarParts::find_parts(const TetMesh& mesh, std::vector<StarTet>& star) {
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    index_of_tet_.ensure(std::size_t{star[i].tet.value} + 1);
    index_of_tet_[star[i].tet.value] = i + 1;
    star[i].part = 0;
  }
  sorted_.clear();
  parts_.clear();
  std::size_t found = 0;
  for (std::uint32_t seed = 0; seed < star.size(); ++seed) {
    if (star[seed].part != 0) continue;
    ++found;
    const auto part = static_cast<std::uint32_t>(parts_.size() + 1);
    parts_.push_back({static_cast<std::uint32_t>(sorted_.size()), 0, {}});
    queue_.assign(1, seed);
    star[seed].part = part;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const StarTet& at = star[queue_[i]];
      sorted_.push_back(at);
      if (found == star.size()) continue;  // nothing is left to be found
      const TetLinks& links = mesh.links(at.tet);
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = links[s];
        if (s == at.corner || link.is_boundary()) continue;
        const std::size_t slot = link.side().tet().value;
        const std::uint32_t next = slot < index_of_tet_.capacity() ? index_of_tet_[slot] : 0;
        if (next != 0 && star[next - 1].part == 0) {
          star[next - 1].part = part;
          queue_.push_back(next - 1);
          ++found;
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

/// Whether a part lies across the sheet from where its vertex stood until now.
bool StarParts::is_across(const Star& star, std::span<const StarTet> part) {
  if (star.settings.across.empty()) return false;
  unsigned ends = 0;
  for (const StarTet& tet : part) ends |= tet.ends;
  return ends == 2;
}

/// Whether an old child had the vertex together with a neighbour across the sheet: the cut was not there yet.
bool StarParts::had_across(const Star& star, std::uint32_t old) {
  const TetVertices& corners = star.old.vertices(old);
  const auto& across = star.settings.across;
  return std::any_of(corners.begin(), corners.end(), [&](VertexId v) {
    return std::find(across.begin(), across.end(), star.complex.closed(v)) != across.end();
  });
}

/// Where the vertex of a part stands: in the old child that reaches least beyond itself; in none, `inside` is -1e300.
MaterialPlace StarParts::place_of(const Star& star, std::span<const StarTet> part) {
  const bool is_beyond = is_across(star, part);
  MaterialPlace best;
  for (const StarTet& tet : part) {
    if (tet.old == kInvalidIndex) continue;
    const TetVertices& corners = star.old.vertices(tet.old);
    if (std::find(corners.begin(), corners.end(), star.vertex) != corners.end()) {
      if (is_beyond && !had_across(star, tet.old)) continue;  // what it takes over from the other side
      return {};                                              // there where it stands
    }
    const MaterialPlace place = star.old.place_in(tet.old, star.mesh.rest(star.vertex));
    if (place.inside > best.inside) best = place;
  }
  return best;
}

/// A copy with the values that the part's side of the cut had there.
VertexId StarParts::make_copy(Transaction& transaction, const Star& star, std::span<const StarTet> part) {
  const MaterialPlace place = place_of(star, part);
  if (place.inside <= -1e300) return transaction.copy_vertex(star.vertex);
  const VertexId copy = add_vertex_at(transaction, star.mesh.rest(star.vertex), place);
  transaction.set_origin(copy, star.mesh.origin(star.vertex));
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
                           const StrokeTags& tags) {
  const TetMesh& mesh = transaction.mesh();
  const unsigned kept = mesh.shape_of(vertex) & (shape::kPinched | (parts_.size() == 1 ? shape::kFront : 0U));
  for (const Part& part : parts_) {
    unsigned bits = kept;
    for (std::uint32_t i = part.first; i < part.last; ++i) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(star[i].tet)[s];
        if (s == star[i].corner || !link.is_boundary()) continue;
        bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
        bits |= tags.own(link) && parts_.size() == 1 ? shape::kFront : 0U;
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

/// Whether material of a part was of another piece than a vertex is.
bool StarParts::were_apart(const Star& star, const Part& part, VertexId copy) {
  const MaterialPieces* pieces = star.settings.pieces;
  if (pieces == nullptr || !pieces->has_several()) return false;
  const auto tets = star.tets_of(part);
  return std::any_of(tets.begin(), tets.end(), [&](const StarTet& tet) { return pieces->are_apart(tet.tet, copy); });
}

bool StarParts::may_take(const Star& star, const Part& part, VertexId copy) {
  const bool is_elsewhere = star.settings.keeps_places && has_other_copy(star.mesh, star.tets_of(part), copy);
  return !is_elsewhere && !were_apart(star, part, copy);
}

/// Whether a part may take the closed vertex as it stands.
bool StarParts::stands_in(const Star& star, const Part& part) {
  if (!may_take(star, part, star.vertex)) return false;
  if (star.settings.makes_twins || !star.settings.keeps_places) return true;
  const TetMesh& mesh = star.mesh;
  const auto tets = star.tets_of(part);
  const MaterialPlace place = place_of(star, tets);
  const double tolerance = kSamePlace * (mesh.rest(star.vertex) - mesh.rest(mesh.vertices(tets[0].tet)[0])).norm();
  return place.inside <= -1e300 || (place.current - mesh.current(star.vertex)).norm() <= tolerance;
}

void StarParts::take_homes(const Star& star, const Home& home) {
  for (Part& part : parts_) {
    if (part.copy.is_valid()) continue;
    const VertexId copy = home(star.tets_of(part));
    if (copy.is_valid() && !is_taken(copy) && may_take(star, part, copy)) part.copy = copy;
  }
}

void StarParts::take_vertex(const Star& star) {
  for (Part& part : parts_) {
    if (!part.copy.is_valid() && !is_taken(star.vertex) && stands_in(star, part)) part.copy = star.vertex;
  }
}

/// Moves the closed vertex, which no part has taken, to where the material of a part has it.
void StarParts::move_vertex(Transaction& transaction, const Star& star, Part& part) {
  const MaterialPlace place = place_of(star, star.tets_of(part));
  transaction.move(star.vertex, star.mesh.rest(star.vertex), place.basis, place.weights);
  part.copy = star.vertex;
}

/// The vertex that a part's copy starts as; none where it starts as the old child of one of its tets has it.
VertexId StarParts::source_of(const Star& star, const Part& part) {
  const auto was_elsewhere = [&] {
    return were_apart(star, part, star.vertex) || star.complex.has_copies(star.vertex);
  };
  if (star.settings.makes_twins && !(star.settings.keeps_places && was_elsewhere())) return star.vertex;
  if (!star.settings.keeps_places || is_across(star, star.tets_of(part))) return {};
  return copy_before(star.mesh, star.complex, star.old, star.vertex, star.tets_of(part));
}

/// Gives a copy to every part that has none yet; returns how many it made.
std::uint64_t StarParts::make_copies(Transaction& transaction, const Star& star) {
  std::uint64_t made = 0;
  for (Part& part : parts_) {
    if (part.copy.is_valid()) continue;
    if (!star.settings.may_be_named && !is_taken(star.vertex)) {
      move_vertex(transaction, star, part);
      continue;
    }
    const VertexId source = source_of(star, part);
    part.copy = source.is_valid() ? transaction.copy_vertex(source) : make_copy(transaction, star, star.tets_of(part));
    ++made;
  }
  return made;
}

StarParts::Division StarParts::divide(Transaction& transaction, ClosedComplex& complex, const OldChildren& old,
                                      VertexId vertex, std::vector<StarTet>& tets, const Home& home,
                                      const Settings& settings) {
  const TetMesh& mesh = transaction.mesh();
  find_parts(mesh, tets);
  std::swap(tets, sorted_);
  const Star star{mesh, complex, old, vertex, tets, settings};
  keep_copies(mesh, tets);
  take_homes(star, home);
  take_vertex(star);
  Division done;
  done.made = make_copies(transaction, star);
  done.closed = name(transaction, vertex, settings.may_be_named);
  write_corners(transaction, tets);
  set_shapes(transaction, done.closed, tets, settings.tags);
  bury(transaction, complex, vertex, done.closed);
  return done;
}

}  // namespace v0
}  // namespace incise
