// SPDX-License-Identifier: Apache-2.0
// Checks the validity contract. Faces and edges are matched by sorting within the bucket of their lowest vertex.
#include "incise/mesh/validate.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "incise/geom/predicates.h"
#include "incise/mesh/star.h"
#include "mesh/packed_pair.h"
#include "mesh/sum_internal.h"

namespace incise {
inline namespace v0 {
namespace {

constexpr std::array<std::string_view, kViolationKinds> kViolationNames = {"count",
                                                                           "not_finite",
                                                                           "bad_corner",
                                                                           "bad_link",
                                                                           "face_mismatch",
                                                                           "bad_tet_of",
                                                                           "orphan_vertex",
                                                                           "duplicate_tet",
                                                                           "overshared_face",
                                                                           "unseparated_face",
                                                                           "nonmanifold_edge",
                                                                           "nonmanifold_cut_edge",
                                                                           "singleton_vertex",
                                                                           "singleton_cut_vertex",
                                                                           "not_positive",
                                                                           "volume_drift"};

std::array<std::uint32_t, 3> sorted_face(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  std::array<std::uint32_t, 3> face = {v[0].value, v[1].value, v[2].value};
  std::sort(face.begin(), face.end());
  return face;
}

/// Entries grouped by their lowest vertex: counted, then filled, then visited group by group in sorted order.
template <class Entry>
class Buckets {
 public:
  explicit Buckets(std::size_t n_vertices) : start_(n_vertices + 1, 0) {}
  void count(std::uint32_t vertex) { ++start_[vertex + std::size_t{1}]; }
  void allocate() {
    for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    entries_.resize(start_.back());
  }
  void add(std::uint32_t vertex, const Entry& entry) { entries_[start_[vertex]++] = entry; }
  /// After all were added: visits each run of entries with an equal key, `visit(vertex, first, last)`.
  template <class Visit>
  void for_each_run(Visit&& visit) {
    std::size_t begin = 0;
    for (std::uint32_t v = 0; v + std::size_t{1} < start_.size(); ++v) {
      const std::size_t end = start_[v];
      std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(begin),
                entries_.begin() + static_cast<std::ptrdiff_t>(end));
      while (begin < end) {
        std::size_t next = begin + 1;
        while (next < end && entries_[next].key == entries_[begin].key) ++next;
        visit(v, entries_.data() + begin, entries_.data() + next);
        begin = next;
      }
    }
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<Entry> entries_;
};

struct FaceEntry {
  std::uint64_t key = 0;  // the two higher vertices
  Side side;
  bool operator<(const FaceEntry& o) const { return key != o.key ? key < o.key : side < o.side; }
};

struct EdgeEntry {
  std::uint32_t key = 0;  // the higher vertex
  std::uint32_t is_wall = 0;
  bool operator<(const EdgeEntry& o) const { return key < o.key; }
};

struct TetEntry {
  std::uint64_t key = 0;  // the middle two vertices
  std::uint32_t highest = 0;
  TetId tet;
  bool operator<(const TetEntry& o) const {
    return std::tie(key, highest, tet.value) < std::tie(o.key, o.highest, o.tet.value);
  }
};

class Validator {
 public:
  Validator(const TetMesh& mesh, const ValidateOptions& options) : mesh_(mesh), options_(options) {}

  ValidityReport run(ValidateLevel level) {
    report_.level = level;
    check_counts();
    check_vertices();
    check_corners();
    const bool is_walkable = report_.count(ViolationKind::kBadCorner) == 0;
    if (level >= ValidateLevel::kTopology && is_walkable) check_topology();
    if (level >= ValidateLevel::kGeometry && is_walkable) check_volumes();
    return std::move(report_);
  }

 private:
  void note(ViolationKind kind, std::uint64_t first, std::uint64_t second = 0) {
    report_.ok = false;
    ++report_.counts[static_cast<std::size_t>(kind)];
    if (report_.first.size() < options_.max_listed) report_.first.push_back({kind, {first, second}});
  }

  void check_counts() {
    std::size_t tets = 0;
    std::size_t vertices = 0;
    mesh_.for_each_tet([&](TetId) { ++tets; });
    mesh_.for_each_vertex([&](VertexId) { ++vertices; });
    if (tets != mesh_.tet_count()) note(ViolationKind::kCount, mesh_.tet_count(), tets);
    if (vertices != mesh_.vertex_count()) note(ViolationKind::kCount, mesh_.vertex_count(), vertices);
  }

  void check_vertices() {
    mesh_.for_each_vertex([&](VertexId v) {
      if (!mesh_.rest(v).allFinite() || !mesh_.current(v).allFinite()) note(ViolationKind::kNotFinite, v.value);
    });
  }

  void check_corners() {
    mesh_.for_each_tet([&](TetId tet) {
      const TetVertices& corners = mesh_.vertices(tet);
      for (unsigned c = 0; c < 4; ++c) {
        const bool is_repeated = mesh_.corner_of(tet, corners[c]) != c;
        if (is_repeated || !mesh_.is_live(corners[c])) note(ViolationKind::kBadCorner, tet.value, c);
      }
    });
  }

  void check_topology() {
    check_links();
    check_tet_of();
    check_duplicates();
    check_faces();
    check_boundary_edges();
    if (report_.count(ViolationKind::kBadLink) == 0) check_stars();
  }

  void check_links() {
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (!link.is_boundary()) check_link(Side(tet, s), link);
      }
    });
  }

  void check_link(Side side, Link link) {
    if (!mesh_.is_live(link.side().tet()) || mesh_.link(link.side()) != Link(side) || link.side().tet() == side.tet()) {
      note(ViolationKind::kBadLink, side.tet().value, side.side());
    } else if (side < link.side() && sorted_face(mesh_, side) != sorted_face(mesh_, link.side())) {
      note(ViolationKind::kFaceMismatch, side.tet().value, side.side());
    }
  }

  void check_tet_of() {
    incident_.assign(mesh_.vertex_slots(), 0);
    mesh_.for_each_tet([&](TetId tet) {
      for (const VertexId v : mesh_.vertices(tet)) ++incident_[v.value];
    });
    mesh_.for_each_vertex([&](VertexId v) {
      const TetId tet = mesh_.tet_of(v);
      if (incident_[v.value] == 0) {
        note(ViolationKind::kOrphanVertex, v.value);
      } else if (!mesh_.is_live(tet) || mesh_.corner_of(tet, v) == 4) {
        note(ViolationKind::kBadTetOf, v.value);
      }
    });
  }

  void check_duplicates() {
    Buckets<TetEntry> buckets(mesh_.vertex_slots());
    const auto sorted = [&](TetId tet) {
      TetVertices v = mesh_.vertices(tet);
      std::sort(v.begin(), v.end());
      return v;
    };
    mesh_.for_each_tet([&](TetId tet) { buckets.count(sorted(tet)[0].value); });
    buckets.allocate();
    mesh_.for_each_tet([&](TetId tet) {
      const TetVertices v = sorted(tet);
      buckets.add(v[0].value, {pack(v[1].value, v[2].value), v[3].value, tet});
    });
    buckets.for_each_run([&](std::uint32_t, const TetEntry* first, const TetEntry* last) {
      for (const TetEntry* e = first + 1; e < last; ++e) {
        if (e->highest == (e - 1)->highest) note(ViolationKind::kDuplicateTet, e->tet.value);
      }
    });
  }

  // A face stands for both of its linked sides, or for one boundary side: each set of vertices may occur once.
  template <class Visit>
  void for_each_face(Visit&& visit) const {
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (link.is_boundary() || Side(tet, s) < link.side()) visit(Side(tet, s));
      }
    });
  }

  void check_faces() {
    Buckets<FaceEntry> buckets(mesh_.vertex_slots());
    for_each_face([&](Side side) { buckets.count(sorted_face(mesh_, side)[0]); });
    buckets.allocate();
    for_each_face([&](Side side) {
      const auto face = sorted_face(mesh_, side);
      buckets.add(face[0], {pack(face[1], face[2]), side});
    });
    buckets.for_each_run([&](std::uint32_t, const FaceEntry* first, const FaceEntry* last) {
      if (last - first == 1) return;
      const bool is_wall = std::any_of(first, last, [&](const FaceEntry& e) { return is_wall_side(e.side); });
      note(is_wall ? ViolationKind::kUnseparatedFace : ViolationKind::kOversharedFace, first->side.tet().value,
           first->side.side());
    });
  }

  [[nodiscard]] bool is_wall_side(Side side) const {
    const Link link = mesh_.link(side);
    return link.is_boundary() && link.tag() > 0;
  }

  template <class Visit>
  void for_each_boundary_side(Visit&& visit) const {
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        if (mesh_.links(tet)[s].is_boundary()) visit(Side(tet, s));
      }
    });
  }

  void check_boundary_edges() {
    Buckets<EdgeEntry> buckets(mesh_.vertex_slots());
    for_each_boundary_side([&](Side side) {
      const auto face = sorted_face(mesh_, side);
      buckets.count(face[0]);
      buckets.count(face[0]);
      buckets.count(face[1]);
    });
    buckets.allocate();
    for_each_boundary_side([&](Side side) {
      const auto face = sorted_face(mesh_, side);
      const std::uint32_t is_wall = is_wall_side(side) ? 1 : 0;
      buckets.add(face[0], {face[1], is_wall});
      buckets.add(face[0], {face[2], is_wall});
      buckets.add(face[1], {face[2], is_wall});
    });
    buckets.for_each_run([&](std::uint32_t vertex, const EdgeEntry* first, const EdgeEntry* last) {
      if (last - first == 2) return;
      const bool is_cut = std::any_of(first, last, [](const EdgeEntry& e) { return e.is_wall != 0; });
      note(is_cut ? ViolationKind::kNonmanifoldCutEdge : ViolationKind::kNonmanifoldEdge, vertex, first->key);
    });
  }

  void check_stars() {
    StarWalker walker;
    mesh_.for_each_vertex([&](VertexId v) {
      const TetId seed = mesh_.tet_of(v);
      if (!mesh_.is_live(seed) || mesh_.corner_of(seed, v) == 4) return;
      if (walker.star(mesh_, v).size() == incident_[v.value]) return;
      // One that the input was pinched at stays the input's, also where a cut has passed since.
      const bool is_cut = (mesh_.shape_of(v) & shape::kWall) != 0 && (mesh_.shape_of(v) & shape::kPinched) == 0;
      note(is_cut ? ViolationKind::kSingletonCutVertex : ViolationKind::kSingletonVertex, v.value);
    });
  }

  void check_volumes() {
    detail::Sum total;
    mesh_.for_each_tet([&](TetId tet) {
      total.add(mesh_.rest_volume(tet));
      const TetVertices& v = mesh_.vertices(tet);
      if (!(orient3d(mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]), mesh_.rest(v[3])) > 0)) {
        note(ViolationKind::kNotPositive, tet.value);
      }
    });
    report_.volume = total.value();
    if (!(options_.expected_volume > 0)) return;
    report_.volume_error = std::abs(report_.volume - options_.expected_volume) / options_.expected_volume;
    if (!(report_.volume_error <= options_.volume_tolerance)) note(ViolationKind::kVolumeDrift, 0);
  }

  const TetMesh& mesh_;
  const ValidateOptions& options_;
  std::vector<std::uint32_t> incident_;  // tets per vertex
  ValidityReport report_;
};

}  // namespace

std::string_view name_of(ViolationKind kind) {
  return kViolationNames[static_cast<std::size_t>(kind)];
}

ValidityReport validate(const TetMesh& mesh, ValidateLevel level, const ValidateOptions& options) {
  return Validator(mesh, options).run(level);
}

namespace {

/// How many of the input's defects of skin may have become the same defect of a cut wall: a wall passes along them now.
std::uint64_t defects_passed_by(ViolationKind kind, const ValidityReport& before, const ValidityReport& after) {
  const auto lost = [&](ViolationKind skin) {
    return before.count(skin) - std::min(before.count(skin), after.count(skin));
  };
  switch (kind) {
    case ViolationKind::kNonmanifoldCutEdge:
      return lost(ViolationKind::kNonmanifoldEdge);
    case ViolationKind::kSingletonCutVertex:
      return lost(ViolationKind::kSingletonVertex);
    case ViolationKind::kUnseparatedFace:
      return lost(ViolationKind::kOversharedFace);
    default:
      return 0;
  }
}

}  // namespace

ValidityChange compare_with_input(const ValidityReport& before, const ValidityReport& after) {
  ValidityChange change;
  for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
    if (after.counts[kind] <= before.counts[kind]) continue;
    const std::uint64_t grown = after.counts[kind] - before.counts[kind];
    const std::uint64_t passed_by = defects_passed_by(static_cast<ViolationKind>(kind), before, after);
    change.grown[kind] = grown - std::min(grown, passed_by);
    change.ok &= change.grown[kind] == 0;
  }
  return change;
}

}  // namespace v0
}  // namespace incise
