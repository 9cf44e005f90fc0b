// SPDX-License-Identifier: Apache-2.0
// Counts the defects of a soup of tets. Faces are matched by buckets of their lowest vertex, so that the
// work is a counting sort and many short sorts.
#include "incise/mesh/defects.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "incise/geom/predicates.h"
#include "mesh/packed_pair.h"

namespace incise {
inline namespace v0 {
namespace {

using Tet = std::array<std::uint32_t, 4>;

constexpr std::array<std::string_view, kDefectKinds> kDefectNames = {
    "inverted",       "zero_volume",      "unreferenced_vertices", "duplicate_vertices",
    "duplicate_tets", "overshared_faces", "nonmanifold_edges",     "singleton_vertices"};

// The vertices of the face opposite to each corner; order does not matter here.
constexpr std::array<std::array<std::uint8_t, 3>, 4> kFaceOf = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }
  [[nodiscard]] bool is_root(std::uint32_t i) const { return parent_[i] == i; }

 private:
  std::vector<std::uint32_t> parent_;
};

// Six times the signed volume, and the longest edge.
struct Shape {
  double volume6 = 0;
  double longest = 0;
};

Shape shape_of(const TetSoup& soup, const Tet& tet) {
  const Vec3& a = soup.points[tet[0]];
  const Vec3 ab = soup.points[tet[1]] - a;
  const Vec3 ac = soup.points[tet[2]] - a;
  const Vec3 ad = soup.points[tet[3]] - a;
  const double squared = std::max({ab.squaredNorm(), ac.squaredNorm(), ad.squaredNorm(), (ac - ab).squaredNorm(),
                                   (ad - ab).squaredNorm(), (ad - ac).squaredNorm()});
  return {ab.cross(ac).dot(ad), std::sqrt(squared)};
}

bool is_flat(const Shape& shape) {
  return !(std::abs(shape.volume6) / 6 > kFlatTetRatio * shape.longest * shape.longest * shape.longest);
}

// Numbers with equal keys stand next to each other, rising within.
struct KeyedTet {
  std::uint64_t low, high;
  std::uint32_t id;
  bool operator<(const KeyedTet& o) const { return std::tie(low, high, id) < std::tie(o.low, o.high, o.id); }
  [[nodiscard]] bool same_set(const KeyedTet& o) const { return low == o.low && high == o.high; }
};

// Tets whose vertex set an earlier tet has, rising.
std::vector<std::uint32_t> find_repeated_tets(const std::vector<Tet>& tets) {
  std::vector<KeyedTet> keys(tets.size());
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    Tet sorted = tets[t];
    std::sort(sorted.begin(), sorted.end());
    keys[t] = {pack(sorted[0], sorted[1]), pack(sorted[2], sorted[3]), t};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> repeated;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].same_set(keys[i - 1])) repeated.push_back(keys[i].id);
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

class Finder {
 public:
  explicit Finder(const TetSoup& soup) : soup_(soup), corners_(soup.tets.size() * 4), parts_(soup.tets.size()) {}

  Defects run() {
    count_signs();
    count_vertices();
    note(DefectKind::kDuplicateTets, found_.duplicate_tets, find_repeated_tets(soup_.tets));
    match_faces();
    count_boundary_edges();
    count_links();
    return std::move(found_);
  }

 private:
  struct Face {
    std::uint64_t upper;  // the two higher vertices
    std::uint32_t side;   // tet·4 + corner opposite
    bool operator<(const Face& o) const { return upper != o.upper ? upper < o.upper : side < o.side; }
  };

  std::vector<std::uint32_t>& examples(DefectKind kind) { return found_.examples[static_cast<std::size_t>(kind)]; }

  void note(DefectKind kind, std::uint64_t& count, std::uint32_t id) {
    ++count;
    if (examples(kind).size() < kDefectExamples) examples(kind).push_back(id);
  }
  void note(DefectKind kind, std::uint64_t& count, const std::vector<std::uint32_t>& ids) {
    for (const std::uint32_t id : ids) note(kind, count, id);
  }

  void count_signs() {
    std::array<std::uint64_t, 2> count = {};
    std::array<std::vector<std::uint32_t>, 2> first;
    for (std::uint32_t t = 0; t < soup_.tets.size(); ++t) {
      const Shape shape = shape_of(soup_, soup_.tets[t]);
      if (is_flat(shape)) {
        note(DefectKind::kZeroVolume, found_.zero_volume, t);
        continue;
      }
      const std::size_t sign = shape.volume6 < 0 ? 1 : 0;
      if (count[sign]++ < kDefectExamples) first[sign].push_back(t);
    }
    found_.negative = count[1] > count[0];
    found_.inverted = std::min(count[0], count[1]);
    examples(DefectKind::kInverted) = first[found_.negative ? 0 : 1];
  }

  void count_vertices() {
    std::vector<bool> used(soup_.points.size(), false);
    for (const Tet& tet : soup_.tets) {
      for (const std::uint32_t v : tet) used[v] = true;
    }
    std::vector<std::uint32_t> order;
    order.reserve(soup_.points.size());
    for (std::uint32_t v = 0; v < soup_.points.size(); ++v) {
      if (used[v]) {
        order.push_back(v);
      } else {
        note(DefectKind::kUnreferencedVertices, found_.unreferenced_vertices, v);
      }
    }
    note(DefectKind::kDuplicateVertices, found_.duplicate_vertices, find_repeated_points(std::move(order)));
  }

  std::vector<std::uint32_t> find_repeated_points(std::vector<std::uint32_t> order) const {
    const auto key = [this](std::uint32_t v) {
      const Vec3& p = soup_.points[v];
      return std::make_tuple(p.x(), p.y(), p.z());
    };
    std::sort(order.begin(), order.end(), [&key](std::uint32_t a, std::uint32_t b) {
      const auto ka = key(a);
      const auto kb = key(b);
      return ka < kb || (!(kb < ka) && a < b);
    });
    std::vector<std::uint32_t> repeated;
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (key(order[i]) == key(order[i - 1])) repeated.push_back(order[i]);
    }
    std::sort(repeated.begin(), repeated.end());
    return repeated;
  }

  // The vertices of a side, rising.
  [[nodiscard]] std::array<std::uint32_t, 3> face_at(std::uint32_t side) const {
    const Tet& tet = soup_.tets[side / 4];
    const auto& of = kFaceOf[side % 4];
    std::array<std::uint32_t, 3> face = {tet[of[0]], tet[of[1]], tet[of[2]]};
    std::sort(face.begin(), face.end());
    return face;
  }

  // Visits every face once with all of its tets.
  void match_faces() {
    const auto n_sides = static_cast<std::uint32_t>(soup_.tets.size() * 4);
    std::vector<std::uint32_t> begin(soup_.points.size() + 2, 0);
    for (std::uint32_t side = 0; side < n_sides; ++side) ++begin[face_at(side)[0] + 2];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Face> faces(n_sides);
    for (std::uint32_t side = 0; side < n_sides; ++side) {
      const auto face = face_at(side);
      faces[begin[face[0] + 1]++] = {pack(face[1], face[2]), side};
    }
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
      std::sort(faces.data() + begin[v], faces.data() + begin[v + 1]);
      match_bucket(faces.data() + begin[v], faces.data() + begin[v + 1]);
    }
    std::sort(overshared_.begin(), overshared_.end());
    note(DefectKind::kOversharedFaces, found_.overshared_faces, overshared_);
  }

  void match_bucket(const Face* first, const Face* last) {
    while (first != last) {
      const Face* next = std::find_if(first, last, [first](const Face& f) { return f.upper != first->upper; });
      const auto sharing = next - first;
      if (sharing == 1) boundary_.push_back(first->side);
      if (sharing == 2) link(first[0].side, first[1].side);
      if (sharing > 2) overshared_.push_back(first->side / 4);
      first = next;
    }
  }

  // Two tets of one face: one part, and one link at each of its three vertices.
  void link(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ta = a / 4;
    const std::uint32_t tb = b / 4;
    parts_.join(ta, tb);
    for (const std::uint8_t i : kFaceOf[a % 4]) {
      const auto& other = soup_.tets[tb];
      const auto j = std::find(other.begin(), other.end(), soup_.tets[ta][i]) - other.begin();
      if (j < 4) corners_.join(ta * 4 + i, tb * 4 + static_cast<std::uint32_t>(j));
    }
  }

  void count_boundary_edges() {
    std::vector<std::uint64_t> edges;
    edges.reserve(boundary_.size() * 3);
    for (const std::uint32_t side : boundary_) {
      const auto f = face_at(side);
      edges.insert(edges.end(), {pack(f[0], f[1]), pack(f[1], f[2]), pack(f[0], f[2])});
    }
    std::sort(edges.begin(), edges.end());
    for (auto first = edges.begin(); first != edges.end();) {
      const auto next = std::upper_bound(first, edges.end(), *first);
      if (next - first != 2) note_edge(*first);
      first = next;
    }
  }

  void note_edge(std::uint64_t edge) {
    ++found_.nonmanifold_edges;
    auto& ids = examples(DefectKind::kNonmanifoldEdges);
    if (ids.size() >= 2 * kDefectExamples) return;
    ids.push_back(static_cast<std::uint32_t>(edge >> 32U));
    ids.push_back(static_cast<std::uint32_t>(edge));
  }

  // Each set of linked corners belongs to one vertex; a vertex with two sets is singleton.
  void count_links() {
    std::vector<std::uint32_t> sets(soup_.points.size(), 0);
    for (std::uint32_t t = 0; t < soup_.tets.size(); ++t) {
      if (parts_.is_root(t)) ++found_.components;
      for (std::uint32_t i = 0; i < 4; ++i) {
        if (corners_.is_root(t * 4 + i)) ++sets[soup_.tets[t][i]];
      }
    }
    for (std::uint32_t v = 0; v < sets.size(); ++v) {
      if (sets[v] > 1) note(DefectKind::kSingletonVertices, found_.singleton_vertices, v);
    }
  }

  const TetSoup& soup_;
  UnionFind corners_;  // tet·4 + corner
  UnionFind parts_;
  std::vector<std::uint32_t> boundary_;    // sides
  std::vector<std::uint32_t> overshared_;  // first tets
  Defects found_;
};

std::array<std::uint64_t, kDefectKinds> counts_of(const Defects& d) {
  return {d.inverted,       d.zero_volume,      d.unreferenced_vertices, d.duplicate_vertices,
          d.duplicate_tets, d.overshared_faces, d.nonmanifold_edges,     d.singleton_vertices};
}

// Keeps the entries whose numbers are not in `dropped` (rising).
template <class T>
void drop_entries(std::vector<T>& values, const std::vector<std::uint32_t>& dropped) {
  std::size_t kept = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (next < dropped.size() && dropped[next] == i) {
      ++next;
      continue;
    }
    values[kept++] = values[i];
  }
  values.resize(kept);
}

}  // namespace

bool Defects::none() const {
  const auto counts = counts_of(*this);
  return std::all_of(counts.begin(), counts.end(), [](std::uint64_t n) { return n == 0; });
}

Defects find_defects(const TetSoup& soup) {
  return Finder(soup).run();
}

std::vector<std::uint32_t> find_duplicate_tets(const TetSoup& soup) {
  return find_repeated_tets(soup.tets);
}

std::vector<NamedDefect> list_defects(const Defects& defects) {
  const auto counts = counts_of(defects);
  std::vector<NamedDefect> list(kDefectKinds);
  for (std::size_t i = 0; i < kDefectKinds; ++i) list[i] = {kDefectNames[i], counts[i], defects.examples[i]};
  return list;
}

Normalised normalise(TetSoup& soup) {
  Normalised done;
  done.dropped_tets = find_repeated_tets(soup.tets);
  done.dropped = done.dropped_tets.size();
  if (done.dropped > 0) {
    if (!soup.regions.empty()) drop_entries(soup.regions, done.dropped_tets);
    drop_entries(soup.tets, done.dropped_tets);
  }
  for (Tet& tet : soup.tets) {
    if (is_flat(shape_of(soup, tet))) ++done.zero_volume;
    const auto& p = soup.points;
    if (orient3d(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) {
      std::swap(tet[2], tet[3]);
      ++done.flipped;
    }
  }
  return done;
}

}  // namespace v0
}  // namespace incise
