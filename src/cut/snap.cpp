// SPDX-License-Identifier: Apache-2.0
#include "cut/snap.h"

#include <algorithm>
#include <cmath>

#include "incise/geom/quality.h"

namespace incise::inline v0 {

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

/// Mean distance from a vertex to its neighbours. `scratch` is overwritten.
double mean_edge_length(const TetMesh& mesh, VertexId centre, const std::vector<TetId>& star,
                        std::vector<VertexId>& scratch) {
  scratch.clear();
  double sum = 0;
  for (const TetId tet : star) {
    for (const VertexId v : mesh.vertices(tet)) {
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
  /// `is_close(VertexId)` tells which neighbours are close to the sheet.
  template <class IsClose>
  void build(const TetMesh& mesh, VertexId centre, const std::vector<TetId>& star, const Neighbourhood& near,
             IsClose&& is_close) {
    vertices_.clear();
    for (const TetId tet : star) {
      const unsigned c = mesh.corner_of(tet, centre);
      const NearTet* near_tet = near.find(tet);
      std::array<std::uint32_t, 3> index{};
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned other = kSideCorners[c][k];
        const VertexId v = mesh.vertices(tet)[other];
        const bool is_flagged =
            near_tet != nullptr && ((unsigned{near_tet->flagged} >> kEdgeOfCorners[c][other]) & 1U) != 0;
        index[k] = find_or_add(v, is_close(v) ? Joint::kClose : (is_flagged ? Joint::kFlagged : Joint::kPlain));
      }
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t a = index[k], b = index[(k + 1) % 3];
        if (vertices_[a].joint == vertices_[b].joint) {
          unite(a, b);
        }
      }
    }
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

/// Normals this close are one plane; a vertex that slides in it changes no volume beyond rounding.
constexpr double kFlat = 1e-9;

void add_plane(Constraint& constraint, const Vec3& normal) {
  const auto is_same = [&](const Vec3& n) { return n.cross(normal).squaredNorm() <= kFlat * kFlat; };
  if (constraint.planes >= 1 && is_same(constraint.first)) return;
  if (constraint.planes >= 2 && is_same(constraint.second)) return;
  if (constraint.planes == 0) constraint.first = normal;
  if (constraint.planes == 1) constraint.second = normal;
  constraint.planes = std::min(3U, constraint.planes + 1);
}

/// The unit normal of a side, or zero for one without area.
Vec3 unit_normal_of(const TetMesh& mesh, Side side) {
  const auto face = mesh.vertices(side);
  const Vec3 normal = (mesh.rest(face[1]) - mesh.rest(face[0])).cross(mesh.rest(face[2]) - mesh.rest(face[0]));
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

Constraint constraint_of(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  Constraint constraint;
  if ((mesh.shape_of(vertex) & shape::kPinched) != 0) {
    constraint.planes = 3;
  }
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4 && constraint.planes < 3; ++s) {
      if (mesh.vertices(tet)[s] == vertex) {
        continue;
      }
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary() || (mesh.has_regions() && mesh.region(link.side().tet()) != mesh.region(tet))) {
        const Vec3 normal = unit_normal_of(mesh, Side(tet, s));
        if (!normal.isZero(0.0)) {
          add_plane(constraint, normal);
        }
      }
    }
  }
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
Landing land_on_sheet(const Vec3& start, const OnVertex& on, const Sheet& sheet, const Constraint& constraint) {
  if (constraint.planes == 0) {
    return {on.target, 0.0};
  }
  Landing landing{start, on.distance};
  Vec3 target = on.target;
  std::uint32_t triangle = on.triangle;
  for (unsigned round = 0; round < 4 && landing.distance > 1e-13 * on.spacing; ++round) {
    const Vec3 normal = sheet.normal(triangle).normalized();
    const Vec3 direction = direction_towards(normal, constraint);
    const double slope = direction.dot(normal);
    if (!(std::abs(slope) > 0.1)) {
      break;
    }
    const Vec3 next = landing.point + (normal.dot(target - landing.point) / slope) * direction;
    const auto hit = sheet.tree().closest(next, on.spacing);
    if (!hit.is_valid() || !(hit.distance2 < landing.distance * landing.distance)) {
      break;
    }
    landing = {next, std::sqrt(hit.distance2)};
    target = hit.point;
    triangle = hit.triangle;
  }
  return landing;
}

// --- which vertices are close
// -------------------------------------------------------------------------------------------

struct Candidate {
  OnVertex on;
  bool is_coincident;
  [[nodiscard]] double rank() const { return on.distance / on.spacing; }
  bool operator<(const Candidate& other) const {
    return rank() != other.rank() ? rank() < other.rank() : on.vertex < other.on.vertex;
  }
};

/// Snapping reaches a little further along a wall that an earlier cut left at the same place: it may have bent to a
/// vertex by `snap` of edges that have become shorter since.
constexpr double kWallReach = 1.75;
/// It reaches less far for vertices that cannot be moved onto the sheet, since the wall then bends to them.
constexpr double kBentReach = 0.5;
/// A wall whose normal has this cosine with the sheet's lies along it.
constexpr double kAlong = 0.9;
/// The vertices that snapping considers, with a way to find them by slot.
class CloseVertices {
 public:
  CloseVertices(const TetMesh& mesh, const Sheet& sheet, double snap, Neighbourhood& near, StarWalker& walker)
      : mesh_(mesh), sheet_(sheet), snap_(snap), near_(near), walker_(walker) {
    for (const CutEdge& edge : near.edges.edges()) {
      if (edge.is_flagged()) {
        note(edge.a);
        note(edge.b);
      }
    }
    for (const CutEdge& edge : near.edges.edges()) {
      measure(edge.a, edge);
      measure(edge.b, edge);
    }
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      consider(i);
    }
  }
  CloseVertices(const CloseVertices&) = delete;
  CloseVertices& operator=(const CloseVertices&) = delete;
  ~CloseVertices() {
    for (const Noted& noted : vertices_) {
      near_.index_of_vertex[noted.vertex.value] = 0;
    }
  }
  /// Those within reach.
  [[nodiscard]] const std::vector<Candidate>& all() const { return close_; }
  [[nodiscard]] const Candidate* find(VertexId vertex) const {
    const std::uint32_t index = near_.index_of_vertex[vertex.value];
    return index == 0 || vertices_[index - 1].close == 0 ? nullptr : &close_[vertices_[index - 1].close - 1];
  }

 private:
  struct Noted {
    VertexId vertex;
    double longest2 = 0;      ///< squared length of the longest edge near the sheet: a bound of the mean of all
    std::uint32_t close = 0;  ///< 1 + index into `close_`
  };
  void note(VertexId vertex) {
    std::uint32_t& index = near_.index_of_vertex[vertex.value];
    if (index == 0) {
      vertices_.push_back({vertex});
      index = static_cast<std::uint32_t>(vertices_.size());
    }
  }
  void measure(VertexId vertex, const CutEdge& edge) {
    if (const std::uint32_t index = near_.index_of_vertex[vertex.value]; index != 0) {
      double& longest2 = vertices_[index - 1].longest2;
      longest2 = std::max(longest2, (mesh_.rest(edge.b) - mesh_.rest(edge.a)).squaredNorm());
    }
  }
  /// Most vertices are too far away whatever their mean edge, which takes a walk around the vertex: asked only then.
  void consider(std::uint32_t i) {
    const VertexId v = vertices_[i].vertex;
    const bool is_on_wall = (mesh_.shape_of(v) & shape::kWall) != 0;
    const double share = std::max(kCoincident, is_on_wall ? kWallReach * snap_ : snap_);
    const auto hit = sheet_.tree().closest(mesh_.rest(v), share * std::sqrt(vertices_[i].longest2));
    if (!hit.is_valid()) {
      return;
    }
    const std::vector<TetId>& star = walker_.star(mesh_, v);
    const double spacing = mean_edge_length(mesh_, v, star, neighbours_), distance = std::sqrt(hit.distance2);
    const OnVertex on{v, spacing, distance, hit.point, hit.triangle};
    if (distance <= share * spacing && distance <= std::max(kCoincident, snap_ * reach_of(on, star)) * spacing) {
      close_.push_back({on, distance <= kCoincident * spacing});
      vertices_[i].close = static_cast<std::uint32_t>(close_.size());
    }
  }
  /// How far snapping reaches for a vertex, as a multiple of `snap`.
  [[nodiscard]] double reach_of(const OnVertex& on, const std::vector<TetId>& star) const {
    if (on.distance <= kBentReach * snap_ * on.spacing) {
      return 1.0;
    }
    const Constraint constraint = constraint_of(mesh_, on.vertex, star);
    if (has_landed(land_on_sheet(mesh_.rest(on.vertex), on, sheet_, constraint), on)) {
      return 1.0;
    }
    return lies_along_wall(on, star) ? kWallReach : kBentReach;
  }
  [[nodiscard]] bool lies_along_wall(const OnVertex& on, const std::vector<TetId>& star) const {
    const Vec3 normal = sheet_.normal(on.triangle).normalized();
    for (const TetId tet : star) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (mesh_.vertices(tet)[s] != on.vertex && link.is_boundary() && link.tag() != 0 &&
            std::abs(unit_normal_of(mesh_, Side(tet, s)).dot(normal)) > kAlong) {
          return true;
        }
      }
    }
    return false;
  }

  const TetMesh& mesh_;
  const Sheet& sheet_;
  double snap_;
  Neighbourhood& near_;
  StarWalker& walker_;
  std::vector<VertexId> neighbours_;
  std::vector<Noted> vertices_;
  std::vector<Candidate> close_;
};

/// Whether the places of two neighbours on the sheet belong to one smooth part of it: not to two layers.
bool is_on_same_part(const Sheet& sheet, const OnVertex& a, const OnVertex& b) {
  if (a.triangle == b.triangle) {
    return true;
  }
  const Vec3 n = sheet.normal(a.triangle).normalized(), m = sheet.normal(b.triangle).normalized();
  return n.dot(m) > 0.3 && std::abs(n.dot(b.target - a.target)) <= 0.3 * a.spacing;
}

/// Whether every flagged edge of a vertex crosses the part of the sheet that the vertex would snap to.
bool crosses_one_part(const TetMesh& mesh, const Sheet& sheet, const OnVertex& on, const std::vector<TetId>& star,
                      const Neighbourhood& near) {
  for (const TetId tet : star) {
    const NearTet* near_tet = near.find(tet);
    const unsigned c = mesh.corner_of(tet, on.vertex);
    for (unsigned other = 0; near_tet != nullptr && other < 4; ++other) {
      if (other == c) {
        continue;
      }
      const CutEdge& edge = near.edge(*near_tet, c, other);
      if (edge.is_flagged()) {
        const Vec3 crossing = mesh.rest(edge.a) + edge.t * (mesh.rest(edge.b) - mesh.rest(edge.a));
        if (!is_on_same_part(sheet, on, {edge.a, on.spacing, 0.0, crossing, edge.triangle})) {
          return false;
        }
      }
    }
  }
  return true;
}

/// Those of the close vertices that may take part in the cut, nearest first.
std::vector<Candidate> find_candidates(const TetMesh& mesh, const Sheet& sheet, double snap, Neighbourhood& near,
                                       StarWalker& walker) {
  const CloseVertices close(mesh, sheet, snap, near, walker);
  std::vector<Candidate> candidates;
  LinkGraph link;
  for (const Candidate& candidate : close.all()) {
    const VertexId v = candidate.on.vertex;
    const auto is_close = [&](VertexId neighbour) {
      const Candidate* other = close.find(neighbour);
      return other != nullptr && is_on_same_part(sheet, candidate.on, other->on);
    };
    const auto is_sound = [&] {
      const std::vector<TetId>& star = walker.star(mesh, v);
      link.build(mesh, v, star, near, is_close);
      return (mesh.shape_of(v) & shape::kPinched) == 0 && link.has_two_parts_at_most() &&
             crosses_one_part(mesh, sheet, candidate.on, star, near);
    };
    if (candidate.is_coincident || is_sound()) {
      candidates.push_back(candidate);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

/// Whether a fourth ON vertex would leave a tet without a side. A tet between two sheets, all of whose vertices
/// coincide with one or the other, keeps its own.
bool would_flatten_a_tet(const TetMesh& mesh, const Candidate& candidate, const Neighbourhood& near,
                         const std::vector<VertexId>& coincident, StarWalker& walker) {
  for (const TetId tet : walker.star(mesh, candidate.on.vertex)) {
    unsigned on = 0;
    bool are_coincident = candidate.is_coincident;
    for (const VertexId v : mesh.vertices(tet)) {
      on += near.is_on[v.value];
      are_coincident &= v == candidate.on.vertex || std::binary_search(coincident.begin(), coincident.end(), v);
    }
    if (on == 3 && !are_coincident) {
      return true;
    }
  }
  return false;
}

void mark_tets(const TetMesh& mesh, Neighbourhood& near) {
  for (NearTet& tet : near.tets) {
    for (unsigned c = 0; c < 4; ++c) {
      tet.on = static_cast<std::uint8_t>(tet.on | near.is_on[mesh.vertices(tet.id)[c].value] << c);
    }
  }
}

// --- moving ----------------------------------------------------------------------------------------------------------

double volume6(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

/// A move changes the volume of a star by rounding alone, or not at all: overlapping input tets would not obey.
constexpr double kVolumeTolerance = 1e-11;

/// Whether every tet of the star keeps a quarter of its volume with the vertex moved, and the star all of it.
bool keeps_volumes(const TetMesh& mesh, VertexId vertex, const Vec3& moved, const std::vector<TetId>& star) {
  double before = 0, after = 0;
  for (const TetId tet : star) {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = mesh.vertices(tet)[c];
      p[c] = v == vertex ? moved : mesh.rest(v);
    }
    const double volume = volume6(p), old_volume = mesh.rest_volume6(tet);
    if (!(volume >= 0.25 * old_volume) || is_flat(p[0], p[1], p[2], p[3])) {
      return false;
    }
    before += old_volume;
    after += volume;
  }
  return std::abs(after - before) <= kVolumeTolerance * before;
}

/// A rest point in the barycentric coordinates of a tet.
struct MaterialPoint {
  TetVertices basis;
  std::array<double, 4> weights;
};

/// The tet of the star that holds a rest point best, with its coordinates there.
MaterialPoint locate(const TetMesh& mesh, const Vec3& rest_point, const std::vector<TetId>& star) {
  MaterialPoint best{};
  double greatest = -1e300;
  for (const TetId tet : star) {
    const TetVertices& v = mesh.vertices(tet);
    std::array<Vec3, 4> p = {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])};
    const double whole = volume6(p);
    std::array<double, 4> weights{};
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3 kept = p[c];
      p[c] = rest_point;
      weights[c] = volume6(p) / whole;
      p[c] = kept;
    }
    const double least = *std::min_element(weights.begin(), weights.end());
    if (least > greatest) {
      greatest = least;
      best = {v, weights};
    }
    if (least >= 0) {
      break;
    }
  }
  return best;
}

}  // namespace

std::vector<OnVertex> choose_on_vertices(const TetMesh& mesh, const Sheet& sheet, double snap,
                                         Neighbourhood& neighbourhood, StarWalker& walker) {
  std::vector<OnVertex> chosen;
  const std::vector<Candidate> candidates = find_candidates(mesh, sheet, snap, neighbourhood, walker);
  std::vector<VertexId> coincident;
  for (const Candidate& candidate : candidates) {
    if (candidate.is_coincident) {
      coincident.push_back(candidate.on.vertex);
    }
  }
  std::sort(coincident.begin(), coincident.end());
  for (const Candidate& candidate : candidates) {
    if (!would_flatten_a_tet(mesh, candidate, neighbourhood, coincident, walker)) {
      neighbourhood.mark_on(candidate.on.vertex);
      chosen.push_back(candidate.on);
    }
  }
  mark_tets(mesh, neighbourhood);
  return chosen;
}

std::uint64_t move_on_vertices(Transaction& transaction, const Sheet& sheet, double snap,
                               const std::vector<OnVertex>& chosen, StarWalker& walker) {
  const TetMesh& mesh = transaction.mesh();
  std::uint64_t bent = 0;
  for (const OnVertex& on : chosen) {
    if (on.distance <= kCoincident * on.spacing) {
      continue;
    }
    const std::vector<TetId>& star = walker.star(mesh, on.vertex);
    const Vec3 start = mesh.rest(on.vertex);
    const Landing landing = land_on_sheet(start, on, sheet, constraint_of(mesh, on.vertex, star));
    const bool is_short = (landing.point - start).norm() <= 1.5 * snap * on.spacing;
    if (has_landed(landing, on) && is_short && keeps_volumes(mesh, on.vertex, landing.point, star)) {
      const MaterialPoint place = locate(mesh, landing.point, star);
      transaction.move(on.vertex, landing.point, place.basis, place.weights);
    } else {
      ++bent;
    }
  }
  return bent;
}

}  // namespace incise::inline v0
