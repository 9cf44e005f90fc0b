// SPDX-License-Identifier: Apache-2.0
#include "soak/tet_review.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>

#include "soak/face_list.h"

namespace incise::test {
namespace {

using Tet = std::array<std::uint32_t, 4>;
using Long3 = std::array<long double, 3>;
using Pair = std::pair<std::uint64_t, std::uint64_t>;

constexpr std::array<std::array<unsigned, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

// --- shape
// --------------------------------------------------------------------------------------------------------------------

Long3 between(const Vec3& a, const Vec3& b) {
  return {static_cast<long double>(b.x()) - a.x(), static_cast<long double>(b.y()) - a.y(),
          static_cast<long double>(b.z()) - a.z()};
}

Long3 cross(const Long3& a, const Long3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

long double dot(const Long3& a, const Long3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

long double length(const Long3& a) {
  return std::sqrt(dot(a, a));
}

long double volume_of(const TetSoup& soup, const Tet& t) {
  const Vec3& p = soup.points[t[0]];
  return dot(cross(between(p, soup.points[t[1]]), between(p, soup.points[t[2]])), between(p, soup.points[t[3]])) / 6;
}

double ratio_of(const TetSoup& soup, const Tet& t, long double volume) {
  long double longest = 0, area = 0;
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      longest = std::max(longest, length(between(soup.points[t[i]], soup.points[t[j]])));
    }
  }
  for (const auto& f : kFaces) {
    const Vec3& p = soup.points[t[f[0]]];
    area += length(cross(between(p, soup.points[t[f[1]]]), between(p, soup.points[t[f[2]]]))) / 2;
  }
  const long double ratio = longest * area / (3 * std::abs(volume));
  return std::isnan(ratio) ? HUGE_VAL : static_cast<double>(ratio);
}

void review_shapes(const TetSoup& soup, const std::vector<Tet>& tets, TetReview& found) {
  long double total = 0;
  for (const Tet& t : tets) {
    const long double volume = volume_of(soup, t);
    total += volume;
    if (!(volume > 0)) ++found.nonpositive;
    found.worst_ratio = std::max(found.worst_ratio, ratio_of(soup, t, volume));
  }
  found.volume = static_cast<double>(total);
}

// --- topology
// ----------------------------------------------------------------------------------------------------------------

std::size_t count_duplicates(std::vector<Tet> tets) {
  for (Tet& t : tets) std::sort(t.begin(), t.end());
  std::sort(tets.begin(), tets.end());
  return static_cast<std::size_t>(tets.end() - std::unique(tets.begin(), tets.end()));
}

std::size_t count_components(const std::vector<TetFace>& faces, std::size_t tets) {
  Groups groups(tets);
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    if (end == first + 2) groups.join(faces[first].tet, faces[first + 1].tet);
  });
  std::size_t count = 0;
  for (std::size_t t = 0; t < tets; ++t) count += groups.of(t) == t ? 1U : 0U;
  return count;
}

/// How many surfaces the boundary is made of, joined through the vertices of its faces.
std::size_t count_surfaces(const std::vector<TetFace>& faces, std::size_t points) {
  Groups groups(points);
  std::vector<bool> is_outer(points, false);
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    if (end != first + 1) return;
    for (const std::uint32_t v : faces[first].corners) {
      is_outer[v] = true;
      groups.join(faces[first].corners[0], v);
    }
  });
  std::size_t count = 0;
  for (std::size_t v = 0; v < points; ++v) count += is_outer[v] && groups.of(v) == v ? 1U : 0U;
  return count;
}

std::size_t count_bad_edges(const std::vector<TetFace>& faces) {
  std::vector<Pair> edges;
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    const auto& c = faces[first].corners;
    if (end == first + 1) edges.insert(edges.end(), {{c[0], c[1]}, {c[0], c[2]}, {c[1], c[2]}});
  });
  std::sort(edges.begin(), edges.end());
  std::size_t count = 0;
  for_each_run(edges, std::equal_to<>(),
               [&](std::size_t first, std::size_t end) { count += end - first == 2 ? 0U : 1U; });
  return count;
}

/// Where in all corners of all tets this one stands.
std::size_t corner_at(const std::vector<Tet>& tets, std::uint32_t tet, std::uint32_t vertex) {
  const auto corner = std::find(tets[tet].begin(), tets[tet].end(), vertex) - tets[tet].begin();
  return std::size_t{4} * tet + static_cast<std::size_t>(corner);
}

/// Pairs (vertex, group of its tets that hang together through faces that have the vertex), each once, ascending.
std::vector<Pair> umbrellas(const std::vector<Tet>& tets, const std::vector<TetFace>& faces) {
  Groups groups(4 * tets.size());
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    if (end != first + 2) return;
    for (const std::uint32_t v : faces[first].corners) {
      groups.join(corner_at(tets, faces[first].tet, v), corner_at(tets, faces[first + 1].tet, v));
    }
  });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < 4 * tets.size(); ++i) pairs.emplace_back(tets[i / 4][i % 4], groups.of(i));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void review_vertices(const std::vector<Tet>& tets, const std::vector<TetFace>& faces, TetReview& found) {
  for_each_run(
      umbrellas(tets, faces), [](const Pair& a, const Pair& b) { return a.first == b.first; },
      [&](std::size_t first, std::size_t end) {
        --found.loose_vertices;
        if (end - first > 1) ++found.singleton_vertices;
      });
}

bool is_strange(const Tet& t, std::size_t points) {
  for (unsigned i = 0; i < 4; ++i) {
    if (t[i] >= points || std::count(t.begin(), t.end(), t[i]) > 1) return true;
  }
  return false;
}

using Count = std::size_t TetReview::*;
constexpr std::array<std::pair<const char*, Count>, 8> kDefects = {{
    {"nonpositive tets", &TetReview::nonpositive},
    {"points that are not finite", &TetReview::nonfinite},
    {"tets with strange corners", &TetReview::strange_corners},
    {"duplicate tets", &TetReview::duplicate_tets},
    {"overshared faces", &TetReview::overshared_faces},
    {"bad boundary edges", &TetReview::bad_edges},
    {"singleton vertices", &TetReview::singleton_vertices},
    {"loose vertices", &TetReview::loose_vertices},
}};

}  // namespace

std::vector<TetFace> sorted_faces(const std::vector<Tet>& tets) {
  std::vector<TetFace> faces;
  faces.reserve(4 * tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    for (const auto& f : kFaces) {
      std::array<std::uint32_t, 3> corners = {tets[i][f[0]], tets[i][f[1]], tets[i][f[2]]};
      std::sort(corners.begin(), corners.end());
      faces.push_back({corners, static_cast<std::uint32_t>(i)});
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const TetFace& a, const TetFace& b) { return std::tie(a.corners, a.tet) < std::tie(b.corners, b.tet); });
  return faces;
}

TetReview review(const TetSoup& soup) {
  TetReview found;
  found.tets = soup.tets.size();
  found.loose_vertices = soup.points.size();
  for (const Vec3& p : soup.points) found.nonfinite += p.allFinite() ? 0U : 1U;
  std::vector<Tet> tets;
  for (const Tet& t : soup.tets) {
    if (!is_strange(t, soup.points.size())) tets.push_back(t);
  }
  found.strange_corners = soup.tets.size() - tets.size();
  review_shapes(soup, tets, found);
  const std::vector<TetFace> faces = sorted_faces(tets);
  for_each_face(faces,
                [&](std::size_t first, std::size_t end) { found.overshared_faces += end - first > 2 ? 1U : 0U; });
  found.duplicate_tets = count_duplicates(tets);
  found.components = count_components(faces, tets.size());
  found.surfaces = count_surfaces(faces, soup.points.size());
  found.bad_edges = count_bad_edges(faces);
  review_vertices(tets, faces, found);
  return found;
}

std::vector<std::string> grown_defects(const TetReview& before, const TetReview& after) {
  std::vector<std::string> words;
  for (const auto& [name, count] : kDefects) {
    if (after.*count <= before.*count) continue;
    words.push_back(std::string(name) + " " + std::to_string(before.*count) + " -> " + std::to_string(after.*count));
  }
  return words;
}

bool is_spotless(const TetReview& found) {
  return grown_defects({}, found).empty();
}

bool is_convex(const TetSoup& soup) {
  const std::vector<TetFace> faces = sorted_faces(soup.tets);
  bool is_convex = true;
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    if (!is_convex || end != first + 1) return;
    const auto& c = faces[first].corners;
    const Tet& t = soup.tets[faces[first].tet];
    const auto apex = *std::find_if(t.begin(), t.end(), [&](auto v) { return v != c[0] && v != c[1] && v != c[2]; });
    const Vec3& p = soup.points[c[0]];
    Vec3 normal = (soup.points[c[1]] - p).cross(soup.points[c[2]] - p).normalized();
    if (normal.dot(soup.points[apex] - p) > 0) normal = -normal;
    const double slack = 1e-9 * (soup.points[c[1]] - p).norm();
    is_convex =
        std::all_of(soup.points.begin(), soup.points.end(), [&](const Vec3& q) { return normal.dot(q - p) <= slack; });
  });
  return is_convex;
}

}  // namespace incise::test
