// SPDX-License-Identifier: Apache-2.0
// First which vertices are near the sheet and what may keep them from taking part, nearest first; then, once the blade
// has gone, where each may move within the surfaces that it lies on (docs/internals.md, 3.5).
#include "cut/snapping.h"

#include <algorithm>
#include <cmath>

#include "cut/constants.h"
#include "cut/master_star.h"
#include "cut/old_children.h"
#include "cut/parity.h"
#include "cut/spacing.h"
#include "geom/constants.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

/// How a neighbour is joined to the centre of a link.
enum class Joint : std::uint8_t {
  kPlain,    ///< by an edge that is not flagged
  kFlagged,  ///< by a flagged edge
  kClose,    ///< whichever: the neighbour is close to the sheet itself, and decides nothing
};

/// A vertex of a link, for a small union-find.
struct LinkVertex {
  VertexId vertex;
  Joint joint;
  std::uint32_t parent;
};

/// The mean distance of a vertex from its neighbours. `scratch` is overwritten.
double mean_edge_length(const TetMesh& mesh, const ClosedComplex& complex, VertexId centre,
                        std::span<const std::uint32_t> star, std::vector<VertexId>& scratch) {
  scratch.clear();
  double sum = 0;
  for (const std::uint32_t master : star) {
    for (const VertexId v : complex[master].vertices) {
      if (v != centre && std::find(scratch.begin(), scratch.end(), v) == scratch.end()) {
        scratch.push_back(v);
        sum += (mesh.rest(v) - mesh.rest(centre)).norm();
      }
    }
  }
  return sum / static_cast<double>(scratch.size());
}

/// The link of a vertex: its neighbours, joined where a tet of the star joins them.
class LinkGraph {
 public:
  /// `is_close(VertexId)` tells which neighbours are close to the sheet. At rest those on walls of older cuts that are
  /// joined alike hang together: where the centre lies on the rim of such a cut, it is that which lies between them.
  template <class IsClose>
  void build(const TetMesh& mesh, const ClosedComplex& complex, VertexId centre, std::span<const std::uint32_t> star,
             IsClose&& is_close) {
    vertices_.clear();
    for (const std::uint32_t index : star) {
      const Master& master = complex[index];
      const unsigned c = corner_of(master, centre);
      std::array<std::uint32_t, 3> joined{};
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned other = kSideCorners[c][k];
        const VertexId v = master.vertices[other];
        const bool is_flagged = ((unsigned{master.flagged} >> kEdgeOfCorners[c][other]) & 1U) != 0;
        joined[k] = find_or_add(v, is_close(v) ? Joint::kClose : (is_flagged ? Joint::kFlagged : Joint::kPlain));
      }
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t a = joined[k], b = joined[(k + 1) % 3];
        if (vertices_[a].joint == vertices_[b].joint) {
          unite(a, b);
        }
      }
    }
    if (!complex.is_in_motion()) unite_walls(mesh);  // docs/decisions/0172
  }
  /// Whether the neighbours on either side of the sheet form at most one connected part each.
  [[nodiscard]] bool has_two_parts_at_most() {
    std::array<unsigned, 3> parts{};
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      parts[static_cast<std::size_t>(vertices_[i].joint)] += root(i) == i ? 1U : 0U;
    }
    return parts[0] <= 1 && parts[1] <= 1;
  }

 private:
  void unite_walls(const TetMesh& mesh) {
    std::array<std::uint32_t, 3> last = {kInvalidIndex, kInvalidIndex, kInvalidIndex};
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      if ((mesh.shape_of(vertices_[i].vertex) & shape::kWall) == 0) continue;
      std::uint32_t& known = last[static_cast<std::size_t>(vertices_[i].joint)];
      if (known != kInvalidIndex) unite(known, i);
      known = i;
    }
  }
  std::uint32_t find_or_add(VertexId vertex, Joint joint) {
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      if (vertices_[i].vertex == vertex) {
        return i;
      }
    }
    const auto index = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back({vertex, joint, index});
    return index;
  }
  std::uint32_t root(std::uint32_t i) {
    while (vertices_[i].parent != i) {
      i = vertices_[i].parent = vertices_[vertices_[i].parent].parent;
    }
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { vertices_[root(a)].parent = root(b); }

  std::vector<LinkVertex> vertices_;
};

// --- where a vertex may go
// ---------------------------------------------------------------------------------------------

/// What holds a vertex in place: the planes of the surfaces and material borders that it lies on.
struct Constraint {
  unsigned planes = 0;                               ///< 0 free, 1 within a plane, 2 along a line, 3 not at all
  Vec3 first = Vec3::Zero(), second = Vec3::Zero();  ///< unit normals
};

void add_plane(Constraint& constraint, const Vec3& normal) {
  const auto is_same = [&](const Vec3& n) { return n.cross(normal).squaredNorm() <= kOnePlane * kOnePlane; };
  if (constraint.planes >= 1 && is_same(constraint.first)) return;
  if (constraint.planes >= 2 && is_same(constraint.second)) return;
  if (constraint.planes == 0) constraint.first = normal;
  if (constraint.planes == 1) constraint.second = normal;
  constraint.planes = std::min(3U, constraint.planes + 1);
}

/// The unit normal of a side of a master, or zero for one without area.
Vec3 unit_normal_of(const TetMesh& mesh, const Master& master, unsigned side) {
  const auto& k = kSideCorners[side];
  const Vec3& a = mesh.rest(master.vertices[k[0]]);
  const Vec3 normal = (mesh.rest(master.vertices[k[1]]) - a).cross(mesh.rest(master.vertices[k[2]]) - a);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

/// Stands for the tag of a side between two materials.
constexpr std::uint32_t kBorder = kInvalidIndex;

/// Calls `visit(normal, tag)` for the surfaces and material borders that a vertex lies on, side by side; the tag is
/// that of a boundary side, or `kBorder`.
template <class Visit>
void for_each_surface(const TetMesh& mesh, const ClosedComplex& complex, VertexId vertex,
                      std::span<const std::uint32_t> star, Visit&& visit) {
  for (const std::uint32_t index : star) {
    const Master& master = complex[index];
    for (unsigned s = 0; s < 4; ++s) {
      if (master.vertices[s] == vertex) continue;
      const std::uint32_t behind = master.behind[s];
      if (behind == Master::kNone) {
        const Link link = complex.outside(mesh, master, s);
        if (link.is_boundary()) visit(unit_normal_of(mesh, master, s), link.tag());
      } else if (mesh.has_regions() &&
                 mesh.region(complex.children(complex[behind])[0]) != mesh.region(complex.children(master)[0])) {
        visit(unit_normal_of(mesh, master, s), kBorder);
      }
    }
  }
}

Constraint constraint_of(const TetMesh& mesh, const ClosedComplex& complex, VertexId vertex,
                         std::span<const std::uint32_t> star) {
  Constraint constraint;
  if ((mesh.shape_of(vertex) & shape::kPinched) != 0) {
    constraint.planes = 3;
  }
  for_each_surface(mesh, complex, vertex, star, [&](const Vec3& normal, std::uint32_t) {
    if (!normal.isZero(0.0) && constraint.planes < 3) add_plane(constraint, normal);
  });
  return constraint;
}

/// The direction in which a constrained vertex may approach a plane with the given normal; zero for none.
Vec3 direction_towards(const Vec3& normal, const Constraint& constraint) {
  switch (constraint.planes) {
    case 0:
      return normal;
    case 1:
      return normal - constraint.first.dot(normal) * constraint.first;
    case 2:
      return constraint.first.cross(constraint.second);
    default:
      return Vec3::Zero();
  }
}

struct Landing {
  Vec3 point;
  double distance;  ///< left between the point and the sheet
};

bool has_landed(const Landing& landing, const OnVertex& on) {
  return landing.distance <= 1e-9 * on.spacing;
}

/// Newton steps from the vertex to the sheet within its constraint; one step lands exactly on a plane.
Landing land_on_sheet(const Vec3& start, const OnVertex& on, const OwnSheet& sheet, const Constraint& constraint) {
  if (constraint.planes == 0) {
    return {on.target, 0.0};
  }
  Landing landing{start, on.distance};
  Vec3 target = on.target, normal = on.normal;
  for (unsigned round = 0; round < 4 && landing.distance > 1e-13 * on.spacing; ++round) {
    const Vec3 direction = direction_towards(normal, constraint);
    const double slope = direction.dot(normal);
    if (!(std::abs(slope) > 0.1)) {
      break;
    }
    const Vec3 next = landing.point + (normal.dot(target - landing.point) / slope) * direction;
    const SheetPlace hit = sheet.closest(next, on.spacing);
    if (!hit.is_valid() || !(hit.distance2 < landing.distance * landing.distance)) {
      break;
    }
    landing = {next, std::sqrt(hit.distance2)};
    target = hit.point;
    normal = hit.normal;
  }
  return landing;
}

// --- which vertices are close ----------------------------------------------------------------------------------------

struct Candidate {
  OnVertex on;
  std::uint32_t master;  ///< one that has the vertex
  bool is_coincident;
  bool is_sound = true;  ///< whichever of its neighbours take part; else it depends on those that do
  [[nodiscard]] double rank() const { return on.distance / on.spacing; }
  bool operator<(const Candidate& other) const {
    return rank() != other.rank() ? rank() < other.rank() : on.vertex < other.on.vertex;
  }
};

/// Whether the places of two neighbours on the sheet belong to one smooth part of it: not to two layers.
bool is_on_same_part(const OnVertex& on, const Vec3& place, const Vec3& normal) {
  return on.normal.dot(normal) > 0.3 && std::abs(on.normal.dot(place - on.target)) <= 0.3 * on.spacing;
}

/// Whether every flagged edge of a vertex crosses the part of the sheet that the vertex would snap to.
bool crosses_one_part(const ClosedComplex& complex, const OnVertex& on, std::span<const std::uint32_t> star) {
  for (const std::uint32_t index : star) {
    const Master& master = complex[index];
    const unsigned c = corner_of(master, on.vertex);
    for (unsigned other = 0; other < 4; ++other) {
      if (other == c) continue;
      const ClosedEdge& edge = complex.edge(master, c, other);
      if (edge.is_flagged() && !is_on_same_part(on, edge.position, edge.normal)) return false;
    }
  }
  return true;
}

/// The vertices that snapping considers in one step.
class CloseVertices {
 public:
  CloseVertices(const TetMesh& mesh, const OwnSheet& sheet, const SnapRules& rules, ClosedComplex& complex,
                SnapScratch& scratch)
      : mesh_(mesh), sheet_(sheet), snap_(rules.snap), rules_(rules), complex_(complex), scratch_(scratch) {}
  CloseVertices(const CloseVertices&) = delete;
  CloseVertices& operator=(const CloseVertices&) = delete;
  ~CloseVertices() {
    for (const Noted& noted : noted_) scratch_.index_of_vertex[noted.vertex.value] = 0;
  }

  void find(std::span<const std::uint32_t> masters) {
    scratch_.index_of_vertex.ensure(mesh_.vertex_slots());
    for (const std::uint32_t index : masters) note(index);
    for (std::uint32_t i = 0; i < noted_.size(); ++i) consider(i);
  }
  [[nodiscard]] const std::vector<Candidate>& all() const { return close_; }
  [[nodiscard]] const Candidate* find(VertexId vertex) const {
    const std::uint32_t index = scratch_.index_of_vertex[vertex.value];
    return index == 0 || noted_[index - 1].close == 0 ? nullptr : &close_[noted_[index - 1].close - 1];
  }

 private:
  struct Noted {
    VertexId vertex;
    std::uint32_t master;
    double longest2 = 0;        ///< squared length of the longest edge near the sheet: a bound of the mean of all
    bool has_odd_face = false;  ///< the front is still in its star
    std::uint32_t close = 0;    ///< 1 + index into `close_`
  };
  void note(std::uint32_t index) {
    const Master& master = complex_[index];
    const bool is_open = has_odd_face(master.flagged);
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = master.vertices[c];
      if (complex_.flagged_at(v) == 0 || complex_.is_on(v) || complex_.is_settled(v)) continue;
      std::uint32_t& at = scratch_.index_of_vertex[v.value];
      if (at == 0) {
        noted_.push_back({v, index});
        at = static_cast<std::uint32_t>(noted_.size());
      }
      Noted& noted = noted_[at - 1];
      noted.has_odd_face |= is_open;
      for (unsigned other = 0; other < 4; ++other) {
        noted.longest2 = std::max(noted.longest2, (mesh_.rest(master.vertices[other]) - mesh_.rest(v)).squaredNorm());
      }
    }
  }
  /// Most vertices are too far away whatever their mean edge, which takes a walk around the vertex: asked only then.
  void consider(std::uint32_t i) {
    const Noted noted = noted_[i];
    const VertexId v = noted.vertex;
    const double snap = noted.has_odd_face ? 0.0 : snap_;
    const bool is_on_wall = (mesh_.shape_of(v) & shape::kWall) != 0;
    const double longest = std::sqrt(noted.longest2);
    const double reach =
        is_on_wall ? parallel_reach() * uncut_length(longest, rules_.spacing) : std::max(kCoincident, snap) * longest;
    const SheetPlace hit = sheet_.closest(mesh_.rest(v), reach);
    if (!hit.is_valid()) return;
    const std::vector<std::uint32_t>& star = complex_.star(mesh_, noted.master, v);
    const double spacing = mean_edge_length(mesh_, complex_, v, star, neighbours_);
    const OnVertex on{v, spacing, std::sqrt(hit.distance2), hit.point, hit.normal};
    const bool is_older_cut = is_on_wall && is_on_older_cut(on, star);
    const bool is_coincident = is_older_cut || on.distance <= kCoincident * spacing;
    const bool may_take_part =
        is_older_cut || (is_coincident ? !waits_for_front(on, star)
                                       : on.distance <= snap * reach_of(on, star) * spacing && passed_around(star));
    if (!may_take_part) return;
    close_.push_back({on, noted.master, is_coincident});
    noted_[i].close = static_cast<std::uint32_t>(close_.size());
  }
  /// How far older walls attract, as a share of the length of edges before they were cut, for the wall has bent by as
  /// much: also where nothing else snaps, as far as one cut may miss itself.
  [[nodiscard]] double older_reach() const { return std::max(snap_, kLeastOlderReach); }
  [[nodiscard]] double parallel_reach() const { return std::max(kParallelReach * snap_, kLeastOlderReach); }
  [[nodiscard]] bool is_on_older_cut(const OnVertex& on, std::span<const std::uint32_t> star) const {
    const double reach = older_reach() * uncut_length(on.spacing, rules_.spacing);
    if (on.distance > std::max(reach, parallel_reach() * rules_.spacing)) return false;
    return lies_along(on, star, 1, snap_ > 0 && on.distance <= reach ? kSnapAlongOlder : kAlongExactly);
  }
  [[nodiscard]] bool passed_around(std::span<const std::uint32_t> star) const {
    return std::none_of(star.begin(), star.end(), [&](std::uint32_t m) { return has_odd_face(complex_[m].flagged); });
  }
  /// How far snapping reaches for a vertex, as a multiple of `snap`.
  [[nodiscard]] double reach_of(const OnVertex& on, std::span<const std::uint32_t> star) const {
    const bool is_on_wall = (mesh_.shape_of(on.vertex) & shape::kWall) != 0;
    if (is_on_wall || on.distance <= kBentReach * snap_ * on.spacing) {
      return 1.0;
    }
    const Constraint constraint = constraint_of(mesh_, complex_, on.vertex, star);
    if (has_landed(land_on_sheet(mesh_.rest(on.vertex), on, sheet_, constraint), on)) {
      return 1.0;
    }
    return kBentReach;
  }
  /// Whether a surface at a vertex lies along the sheet: one with a tag of at least `least_tag`, so 1 leaves out skin.
  [[nodiscard]] bool lies_along(const OnVertex& on, std::span<const std::uint32_t> star, std::uint32_t least_tag,
                                double cosine = kSnapAlong) const {
    bool lies_along = false;
    for_each_surface(mesh_, complex_, on.vertex, star, [&](const Vec3& normal, std::uint32_t tag) {
      lies_along |= tag != kBorder && tag >= least_tag && std::abs(normal.dot(on.normal)) > cosine;
    });
    return lies_along;
  }
  /// A vertex that coincides with the sheet absorbs what the sheet does around it, which is all of a cut that ends
  /// inside the faces beside it: it is split beside until the blade has passed. Not where the sheet lies on a surface:
  /// there is nothing to cut.
  [[nodiscard]] bool waits_for_front(const OnVertex& on, std::span<const std::uint32_t> star) const {
    return snap_ > 0 && !passed_around(star) && !lies_along(on, star, 0);
  }

  const TetMesh& mesh_;
  const OwnSheet& sheet_;
  double snap_;
  SnapRules rules_;
  ClosedComplex& complex_;
  SnapScratch& scratch_;
  std::vector<VertexId> neighbours_;
  std::vector<Noted> noted_;
  std::vector<Candidate> close_;
};

/// Those of the close vertices that may take part in the cut, nearest first.
std::vector<Candidate> find_candidates(const TetMesh& mesh, const CloseVertices& close, ClosedComplex& complex) {
  std::vector<Candidate> candidates;
  LinkGraph link;
  for (const Candidate& candidate : close.all()) {
    candidates.push_back(candidate);
    if (candidate.is_coincident) continue;
    const VertexId v = candidate.on.vertex;
    const auto is_close = [&](VertexId neighbour) {
      if (complex.is_on(neighbour)) return true;
      const Candidate* other = close.find(neighbour);
      return other != nullptr && is_on_same_part(candidate.on, other->on.target, other->on.normal);
    };
    const std::vector<std::uint32_t>& star = complex.star(mesh, candidate.master, v);
    link.build(mesh, complex, v, star, is_close);
    candidates.back().is_sound = link.has_two_parts_at_most();
    if ((mesh.shape_of(v) & shape::kPinched) != 0 || !crosses_one_part(complex, candidate.on, star)) {
      candidates.pop_back();
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

/// The vertices whose neighbours on either side hang together only as long as some of them do not take part. Where a
/// thin skin of tissue lies over the sheet two vertices beside each other would tear it, and one would not.
class LoneVertices {
 public:
  LoneVertices(const TetMesh& mesh, ClosedComplex& complex) : mesh_(mesh), complex_(complex) {}

  /// Whether a candidate may take part beside those that do already.
  [[nodiscard]] bool allow(const Candidate& candidate) {
    const auto stays_sound = [&](const Candidate& lone) { return is_sound(lone, candidate.on.vertex); };
    return (candidate.is_sound || is_sound(candidate, {})) && std::all_of(lone_.begin(), lone_.end(), stays_sound);
  }
  void note_chosen(const Candidate& candidate) {
    if (!candidate.is_sound) lone_.push_back(candidate);
  }

 private:
  /// With the vertices that take part, and one more.
  [[nodiscard]] bool is_sound(const Candidate& candidate, VertexId more) {
    const std::vector<std::uint32_t>& star = complex_.star(mesh_, candidate.master, candidate.on.vertex);
    link_.build(mesh_, complex_, candidate.on.vertex, star, [&](VertexId v) { return v == more || complex_.is_on(v); });
    return link_.has_two_parts_at_most();
  }

  const TetMesh& mesh_;
  ClosedComplex& complex_;
  LinkGraph link_;
  std::vector<Candidate> lone_;  // chosen in this step
};

/// Whether a fourth ON vertex would leave a tet without a side. A tet between two sheets, all of whose vertices
/// coincide with one or the other, keeps its own.
bool would_flatten_a_tet(const TetMesh& mesh, const Candidate& candidate, ClosedComplex& complex,
                         const std::vector<VertexId>& coincident) {
  for (const std::uint32_t index : complex.star(mesh, candidate.master, candidate.on.vertex)) {
    unsigned on = 0;
    bool are_coincident = candidate.is_coincident;
    for (const VertexId v : complex[index].vertices) {
      on += complex.is_on(v) ? 1U : 0U;
      are_coincident &= v == candidate.on.vertex || std::binary_search(coincident.begin(), coincident.end(), v);
    }
    if (on == 3 && !are_coincident) {
      return true;
    }
  }
  return false;
}

// --- moving ----------------------------------------------------------------------------------------------------------

double volume6(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

/// The live tets around a closed vertex, on all sides of the cut.
void gather_star(const TetMesh& mesh, ClosedComplex& complex, std::uint32_t master, VertexId vertex,
                 std::vector<TetId>& star) {
  star.clear();
  for (const std::uint32_t around : complex.star(mesh, master, vertex)) {
    for (const TetId tet : complex.children(complex[around])) {
      if (complex.closed_corner(mesh, tet, vertex) < 4) star.push_back(tet);
    }
  }
}

/// Whether every tet of the star keeps a quarter of its volume with the vertex moved, and the star all of it.
bool keeps_volumes(const TetMesh& mesh, const ClosedComplex& complex, VertexId vertex, const Vec3& moved,
                   std::span<const TetId> star) {
  double before = 0, after = 0;
  for (const TetId tet : star) {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = mesh.vertices(tet)[c];
      p[c] = complex.closed(v) == vertex ? moved : mesh.rest(v);
    }
    const double volume = volume6(p), old_volume = mesh.rest_volume6(tet);
    if (!(volume >= 0.25 * old_volume) || is_flat(p[0], p[1], p[2], p[3])) {
      return false;
    }
    before += old_volume;
    after += volume;
  }
  return std::abs(after - before) <= kSnappedVolume * before;
}

/// A rest point in the coordinates of the tet around one copy of a vertex that holds it best.
MaterialPlace place_beside(const TetMesh& mesh, VertexId copy, const Vec3& rest, std::span<const TetId> star) {
  MaterialPlace best;
  for (const TetId tet : star) {
    if (mesh.corner_of(tet, copy) == 4) continue;
    const MaterialPlace place = place_in(mesh, tet, rest);
    if (place.inside > best.inside) best = place;
    if (best.inside >= 0) break;
  }
  return best;
}

/// Moves a vertex and its copies, each with the values of its own side.
void move_with_copies(Transaction& transaction, const ClosedComplex& complex, VertexId vertex, const Vec3& rest,
                      std::span<const TetId> star) {
  const TetMesh& mesh = transaction.mesh();
  std::vector<VertexId> copies;
  for (const TetId tet : star) {
    const VertexId copy = mesh.vertices(tet)[complex.closed_corner(mesh, tet, vertex)];
    if (std::find(copies.begin(), copies.end(), copy) == copies.end()) copies.push_back(copy);
  }
  std::vector<MaterialPlace> places;
  for (const VertexId copy : copies) places.push_back(place_beside(mesh, copy, rest, star));
  for (std::size_t i = 0; i < copies.size(); ++i) {
    transaction.move(copies[i], rest, places[i].basis, places[i].weights);
  }
}

}  // namespace

std::vector<OnVertex> choose_on_vertices(const TetMesh& mesh, const OwnSheet& sheet, const SnapRules& rules,
                                         std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                         SnapScratch& scratch) {
  CloseVertices close(mesh, sheet, rules, complex, scratch);
  close.find(masters);
  const std::vector<Candidate> candidates = find_candidates(mesh, close, complex);
  for (const Candidate& candidate : candidates) {
    if (candidate.is_coincident) scratch.coincident.push_back(candidate.on.vertex);
  }
  std::sort(scratch.coincident.begin(), scratch.coincident.end());
  std::vector<OnVertex> chosen;
  LoneVertices lone(mesh, complex);
  for (const Candidate& candidate : candidates) {
    if (!candidate.is_coincident && !lone.allow(candidate)) continue;
    if (would_flatten_a_tet(mesh, candidate, complex, scratch.coincident)) continue;
    const VertexId v = candidate.on.vertex;
    if (!candidate.is_coincident && rules.hangs_together &&
        !rules.hangs_together(complex.star(mesh, candidate.master, v)))
      continue;
    lone.note_chosen(candidate);
    complex.set_on(v);
    for (const std::uint32_t index : complex.star(mesh, candidate.master, v)) {
      Master& master = complex[index];
      master.on = static_cast<std::uint8_t>(master.on | 1U << corner_of(master, v));
    }
    chosen.push_back(candidate.on);
    chosen.back().master = candidate.master;
  }
  return chosen;
}

std::uint64_t move_on_vertices(Transaction& transaction, const OwnSheet& sheet, double snap,
                               const std::vector<OnVertex>& chosen, ClosedComplex& complex) {
  const TetMesh& mesh = transaction.mesh();
  std::vector<TetId> star;
  std::uint64_t bent = 0;
  for (const OnVertex& on : chosen) {
    const std::uint32_t master = complex.master_at(on.vertex);
    if (on.distance <= kCoincident * on.spacing || master == Master::kNone) continue;
    gather_star(mesh, complex, master, on.vertex, star);
    const Vec3 start = mesh.rest(on.vertex);
    const Constraint constraint = constraint_of(mesh, complex, on.vertex, complex.star(mesh, master, on.vertex));
    const Landing landing = land_on_sheet(start, on, sheet, constraint);
    const bool is_short = (landing.point - start).norm() <= 1.5 * snap * on.spacing;
    if (has_landed(landing, on) && is_short && keeps_volumes(mesh, complex, on.vertex, landing.point, star)) {
      move_with_copies(transaction, complex, on.vertex, landing.point, star);
    } else {
      ++bent;
    }
  }
  return bent;
}

}  // namespace v0
}  // namespace incise
