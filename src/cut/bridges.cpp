// SPDX-License-Identifier: Apache-2.0
// A window is a set of inner faces that the surface closes off all around: opened, it parts what lies on its two sides,
// unless that hangs together elsewhere. The sides are told apart in a ball around the seam, so the cost does not depend
// on the body, and the front of the cut, where both sides hang together, is found where it is near.
#include "cut/bridges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cut/constants.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

/// The middle of a tet, or of a side, in the rest shape.
template <class Element>
Vec3 middle_of(const TetMesh& mesh, Element element) {
  const auto& vertices = mesh.vertices(element);
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : vertices) sum += mesh.rest(v);
  return sum / static_cast<double>(vertices.size());
}

class BridgeCutter {
 public:
  BridgeCutter(Transaction& transaction, const SurfaceIndex& surface, const SweptTriangles& swept, double spacing,
               std::uint32_t tag)
      : transaction_(transaction),
        mesh_(transaction.mesh()),
        surface_(surface),
        swept_(swept),
        tree_(swept.points, swept.triangles),
        spacing_(spacing),
        tag_(tag) {}

  void open_around(const Vec3& place) {
    gather(place);
    find_faces();
    keep_windows();
    if (!windows_.empty()) {
      find_sides();
      hang_crumbs();
      open_between_sides(place);
    }
    for (const TetId tet : tets_) index_of_[tet.value] = 0;
  }
  [[nodiscard]] const std::vector<Side>& opened() const { return opened_; }

 private:
  /// An inner face between two tets near the place.
  struct Face {
    Side side;
    std::array<std::uint32_t, 2> tets;  ///< indices
    double area = 0;
    bool is_window = true;
  };
  struct Edge {
    VertexId a, b;
    TetId tet;
    std::uint32_t face;
  };
  struct StarPart {
    VertexId vertex;
    std::vector<TetId> tets;
  };
  struct Part {
    double volume = 0, walls = 0;  ///< `walls`: their area
    bool reaches_out = false;
    std::uint32_t side = kInvalidIndex;  ///< the part that it belongs to, itself where it is no crumb
  };

  [[nodiscard]] double area_of(Side side) const {
    const auto v = mesh_.vertices(side);
    return (mesh_.rest(v[1]) - mesh_.rest(v[0])).cross(mesh_.rest(v[2]) - mesh_.rest(v[0])).norm() / 2.0;
  }

  /// The tets near a place that walls near it lead to.
  void gather(const Vec3& place) {
    tets_.clear();
    const double reach = kBridgeBall * spacing_;
    const auto add = [&](TetId tet) {
      index_of_.ensure(std::size_t{tet.value} + 1);
      if (index_of_[tet.value] != 0 || (middle_of(mesh_, tet) - place).squaredNorm() > reach * reach) return;
      tets_.push_back(tet);
      index_of_[tet.value] = static_cast<std::uint32_t>(tets_.size());
    };
    std::vector<Side> walls;
    surface_.for_each_near(mesh_, {place - Vec3::Constant(reach), place + Vec3::Constant(reach)}, [&](Side side) {
      if (mesh_.link(side).tag() != 0) walls.push_back(side);
    });
    std::sort(walls.begin(), walls.end());
    for (const Side side : walls) add(side.tet());
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      for (const Link link : mesh_.links(tets_[i])) {
        if (!link.is_boundary()) add(link.side().tet());
      }
    }
  }
  [[nodiscard]] std::uint32_t index_of(TetId tet) const {
    return tet.value < index_of_.capacity() ? index_of_[tet.value] - 1U : kInvalidIndex;
  }

  /// The faces on the sweep all of whose vertices are on the surface, sound when they were loaded.
  void find_faces() {
    faces_.clear();
    for (std::uint32_t i = 0; i < tets_.size(); ++i) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side side(tets_[i], s);
        const Link link = mesh_.link(side);
        if (link.is_boundary() || link.side() < side) continue;
        const std::uint32_t other = index_of(link.side().tet());
        if (other != kInvalidIndex && is_on_surface(side) && is_on_sweep(side))
          faces_.push_back({side, {i, other}, area_of(side)});
      }
    }
  }
  [[nodiscard]] bool is_on_surface(Side side) const {
    const auto v = mesh_.vertices(side);
    return std::all_of(v.begin(), v.end(), [&](VertexId u) {
      const std::uint8_t bits = mesh_.shape_of(u);
      return (bits & (shape::kSkin | shape::kWall)) != 0 &&
             (bits & shape::kPinched) == 0;  // else its star is not known
    });
  }
  [[nodiscard]] bool is_on_sweep(Side side) const {
    const Vec3 middle = middle_of(mesh_, side);
    const TriangleTree::Hit hit = tree_.closest(middle, kOnSweep * spacing_);
    if (!hit.is_valid()) return false;
    if (hit.distance2 <= std::pow(kOnSweepExactly * spacing_, 2)) return true;
    const auto& t = swept_.triangles[hit.triangle];
    const Vec3 normal = (swept_.points[t[1]] - swept_.points[t[0]]).cross(swept_.points[t[2]] - swept_.points[t[0]]);
    return std::abs((middle - hit.point).dot(normal)) >= kBesideSweep * std::sqrt(hit.distance2) * normal.norm();
  }

  /// Leaves those that are closed off by the surface all around, as far as the ball tells: no edge of theirs lies
  /// inside the body without another one of them beside it.
  void keep_windows() {
    edges_.clear();
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const auto v = mesh_.vertices(faces_[f].side);
      for (unsigned k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
        edges_.push_back({a, b, faces_[f].side.tet(), f});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& x, const Edge& y) {
      if (x.a != y.a) return x.a < y.a;
      return x.b != y.b ? x.b < y.b : x.face < y.face;
    });
    drop_faces_with_free_edges();
    windows_.clear();
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].is_window) windows_.push_back(f);
    }
  }
  void drop_faces_with_free_edges() {
    std::vector<std::array<std::size_t, 2>> inner;  // the ranges of edges inside the body and the ball
    for (std::size_t first = 0, last = 0; first < edges_.size(); first = last) {
      while (last < edges_.size() && edges_[last].a == edges_[first].a && edges_[last].b == edges_[first].b) ++last;
      const Edge& edge = edges_[first];
      bool is_near = true;
      const auto note = [&](TetId tet) { is_near = is_near && index_of(tet) != kInvalidIndex; };
      const bool is_inside = walk_edge_ring(
          mesh_, edge.a, edge.b, edge.tet, [](Side) { return false; }, note);
      if (is_inside && is_near) inner.push_back({first, last});
    }
    for (bool has_dropped = true; has_dropped;) {
      has_dropped = false;
      for (const auto& [first, last] : inner) {
        std::uint32_t count = 0, face = 0;
        for (std::size_t i = first; i < last; ++i) {
          if (!faces_[edges_[i].face].is_window) continue;
          ++count;
          face = edges_[i].face;
        }
        if (count != 1) continue;
        faces_[face].is_window = false;
        has_dropped = true;
      }
    }
  }

  /// What hangs together without the windows.
  void find_sides() {
    std::vector<std::uint8_t> blocked(4 * tets_.size(), 0);
    for (const std::uint32_t f : windows_) {
      const Side side = faces_[f].side, behind = mesh_.link(side).side();
      blocked[4 * faces_[f].tets[0] + side.side()] = blocked[4 * faces_[f].tets[1] + behind.side()] = 1;
    }
    parts_.clear();
    part_of_.assign(tets_.size(), kInvalidIndex);
    std::vector<std::uint32_t> queue;
    for (std::uint32_t seed = 0; seed < tets_.size(); ++seed) {
      if (part_of_[seed] != kInvalidIndex) continue;
      const auto part = static_cast<std::uint32_t>(parts_.size());
      parts_.emplace_back();
      queue.assign(1, seed);
      part_of_[seed] = part;
      for (std::size_t k = 0; k < queue.size(); ++k) {
        const std::uint32_t i = queue[k];
        parts_[part].volume += mesh_.rest_volume(tets_[i]);
        for (unsigned s = 0; s < 4; ++s) {
          const Link link = mesh_.links(tets_[i])[s];
          const bool is_blocked = blocked[4 * i + s] != 0;
          if (is_blocked || (link.is_boundary() && link.tag() != 0)) parts_[part].walls += area_of({tets_[i], s});
          if (link.is_boundary() || is_blocked) continue;
          const std::uint32_t next = index_of(link.side().tet());
          if (next == kInvalidIndex) {
            parts_[part].reaches_out = true;
          } else if (part_of_[next] == kInvalidIndex) {
            part_of_[next] = part;
            queue.push_back(next);
          }
        }
      }
    }
  }

  /// What lies all within the ball, or is a shaving, belongs to the side that it shares the largest face with.
  void hang_crumbs() {
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      if (part.reaches_out && 2.0 * part.volume > kShaving * spacing_ * part.walls) parts_[p].side = p;
    }
    std::vector<std::uint32_t> by_area = windows_;
    std::sort(by_area.begin(), by_area.end(), [&](std::uint32_t x, std::uint32_t y) {
      return faces_[x].area != faces_[y].area ? faces_[x].area > faces_[y].area : faces_[x].side < faces_[y].side;
    });
    const auto hang_next = [&] {
      return std::any_of(by_area.begin(), by_area.end(), [&](std::uint32_t f) {
        std::uint32_t &a = part_behind(f, 0).side, &b = part_behind(f, 1).side;
        if ((a == kInvalidIndex) == (b == kInvalidIndex)) return false;
        a = b = std::min(a, b);
        return true;
      });
    };
    while (hang_next()) {
    }
  }
  Part& part_behind(std::uint32_t face, unsigned which) { return parts_[part_of_[faces_[face].tets[which]]]; }

  void open_between_sides(const Vec3& place) {
    std::vector<Side> opening;
    std::vector<VertexId> vertices;
    const double reach = kOpenWithin * spacing_;
    for (const std::uint32_t f : windows_) {
      const std::uint32_t a = part_behind(f, 0).side, b = part_behind(f, 1).side;
      if (a == b || a == kInvalidIndex || b == kInvalidIndex) continue;
      const Side side = faces_[f].side;
      if ((middle_of(mesh_, side) - place).squaredNorm() > reach * reach) continue;
      opening.push_back(side);
      opening.push_back(mesh_.link(side).side());
      const auto v = mesh_.vertices(side);
      vertices.insert(vertices.end(), v.begin(), v.end());
    }
    std::sort(opening.begin(), opening.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<StarPart> parts;  // all of them first: an open face leads to no star any more
    for (const VertexId vertex : vertices) find_parts(vertex, opening, parts);
    for (const Side side : opening) {
      if (!mesh_.link(side).is_boundary()) transaction_.open(side, mesh_.link(side).side(), tag_);
    }
    opened_.insert(opened_.end(), opening.begin(), opening.end());
    for (std::size_t i = 0; i < parts.size(); ++i)
      give_copy(parts[i], i == 0 || parts[i - 1].vertex != parts[i].vertex);
  }
  /// Adds the parts of a vertex's star, the faces to be opened taken away, where there are several.
  void find_parts(VertexId vertex, std::span<const Side> opening, std::vector<StarPart>& parts) {
    const auto is_opening = [&](Side side) { return std::binary_search(opening.begin(), opening.end(), side); };
    std::vector<TetId> rest = walker_.star(mesh_, vertex);
    const std::size_t all = rest.size();
    while (!rest.empty()) {
      const std::vector<TetId>& part = walker_.flood(mesh_, vertex, rest.front(), is_opening);
      if (part.size() == all) return;
      parts.push_back({vertex, part});
      rest.erase(std::remove_if(rest.begin(), rest.end(), [&](TetId tet) { return walker_.is_seen(tet); }), rest.end());
    }
  }
  void give_copy(const StarPart& part, bool is_first) {
    const VertexId copy = is_first ? part.vertex : transaction_.copy_vertex(part.vertex);
    for (const TetId tet : part.tets) {
      if (!is_first) transaction_.set_corner(tet, mesh_.corner_of(tet, part.vertex), copy);
    }
    transaction_.set_tet_of(copy, part.tets.front());
    transaction_.set_shape(
        copy, static_cast<std::uint8_t>(shape_by_faces(mesh_, copy, part.tets) & ~unsigned{shape::kFront}));
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const SurfaceIndex& surface_;
  const SweptTriangles& swept_;
  TriangleTree tree_;
  double spacing_;
  std::uint32_t tag_;
  StarWalker walker_;
  std::vector<TetId> tets_;              // near the place
  ZeroedArray<std::uint32_t> index_of_;  // by slot: 1 + index into them
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> windows_;  // indices of faces
  std::vector<std::uint32_t> part_of_;  // by tet
  std::vector<Part> parts_;
  std::vector<Side> opened_;
};

/// The middles of cells, a spacing wide, in which there are walls near the joints.
std::vector<Vec3> places_of(const TetMesh& mesh, const SurfaceIndex& surface, const SweptTriangles& joints,
                            double spacing) {
  const TriangleTree tree(joints.points, joints.triangles);
  using Cell = std::array<std::int64_t, 3>;
  std::vector<Cell> cells;
  const Vec3 margin = Vec3::Constant(kNearJoint * spacing);
  const Box box = tree.bounds();
  surface.for_each_near(mesh, {box.lo - margin, box.hi + margin}, [&](Side side) {
    if (mesh.link(side).tag() == 0) return;
    const Vec3 middle = middle_of(mesh, side);
    if (!tree.closest(middle, kNearJoint * spacing).is_valid()) return;
    const Vec3 from_low = (middle - surface.bounds().lo) / spacing;
    cells.push_back({std::llround(from_low.x()), std::llround(from_low.y()), std::llround(from_low.z())});
  });
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<Vec3> places;
  for (const Cell& cell : cells) {
    const auto [x, y, z] = cell;
    const Vec3 from_low(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    places.emplace_back(surface.bounds().lo + spacing * from_low);
  }
  return places;
}

}  // namespace

std::vector<Side> cut_bridges(Transaction& transaction, const SurfaceIndex& surface, const SweptTriangles& swept,
                              const SweptTriangles& joints, double spacing, std::uint32_t tag) {
  BridgeCutter opening(transaction, surface, swept, spacing, tag);
  for (const Vec3& place : places_of(transaction.mesh(), surface, joints, spacing)) opening.open_around(place);
  return opening.opened();
}

}  // namespace v0
}  // namespace incise
