// SPDX-License-Identifier: Apache-2.0
// Leaves at interfaces are halved down to `size`, and further where two interfaces face each other across a thin
// label; far from all of them they stay coarse (docs/internals.md, 6).
#include "image/lattice.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Distance in spacings below which the two sides of a label make it thin.
constexpr double kThin = 3;
/// Two sides lie opposite each other where their normals are turned against each other at least this far (cosine).
constexpr double kOpposite = 0.5;
/// Shares below this make no interface.
constexpr double kShare = 0.15;

/// Finds labels that are thin near a point.
class Thinness {
 public:
  explicit Thinness(const LabelField& field)
      : field_(field), volume_(field.volume()), voxel_(volume_.spacing().minCoeff()), reach_(2.5 * volume_.spacing()) {}

  /// Whether an interface near `seed` has a label behind it that is thinner than `most`, mm.
  bool operator()(const Vec3& seed, double most) {
    if (volume_.uniform_label(seed - reach_, seed + reach_) != kMixed) return false;
    Vec3 p = seed, normal = Vec3::Zero();
    std::array<LabelIndex, 2> pair{};
    for (int step = 0; step < 3; ++step) {
      if (!find_interface(p, pair, normal, step)) return false;
    }
    if ((p - seed).norm() > 2 * reach_.norm()) return false;
    return is_thin(p, normal, pair[0], most) || is_thin(p, -normal, pair[1], most);
  }

 private:
  /// Moves a point towards the interface of the two labels around it, whose normal points into the first.
  bool find_interface(Vec3& p, std::array<LabelIndex, 2>& pair, Vec3& normal, int step) {
    field_.sample(p, 0, shares_);
    if (step == 0) {
      std::sort(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) {
        return a.value != b.value ? a.value > b.value : a.label < b.label;
      });
      if (shares_.size() < 2 || shares_.begin()[1].value < kShare) return false;
      pair = {shares_.begin()[0].label, shares_.begin()[1].label};
    }
    const Share *a = shares_.find(pair[0]), *b = shares_.find(pair[1]);
    if (a == nullptr || b == nullptr) return false;
    const Vec3 slope = a->slope - b->slope;
    const double slope2 = slope.squaredNorm();
    if (!(slope2 > 0)) return false;
    normal = slope / std::sqrt(slope2);
    const double away = (a->value - b->value) / std::sqrt(slope2);
    p -= std::clamp(away, -voxel_, voxel_) * normal;
    return true;
  }

  bool is_thin(const Vec3& p, const Vec3& into, LabelIndex label, double most) {
    if (label == 0) return false;
    for (double t = 0.75 * voxel_; t < most; t += 0.5 * voxel_) {
      const Vec3 at = p + t * into;
      if (volume_.at(at) == label) continue;
      field_.sample(at, 0, shares_);
      const Share* share = shares_.find(label);
      if (share == nullptr) return true;
      return share->slope.dot(into) < -kOpposite * share->slope.norm();
    }
    return false;
  }

  const LabelField& field_;
  const LabelVolume& volume_;
  double voxel_;
  Vec3 reach_;
  Shares shares_;
};

bool has_thin_label(const Octree& tree, std::size_t leaf, Thinness& is_thin) {
  const double edge = tree.edge(leaf);
  for (unsigned c = 0; c < 8; ++c) {
    const Vec3 corner(c & 1U ? 0.75 : 0.25, c & 2U ? 0.75 : 0.25, c & 4U ? 0.75 : 0.25);
    if (is_thin(tree.low(leaf) + edge * corner, kThin * edge)) return true;
  }
  return false;
}

/// The label of all of a leaf and what is around it by less than `margin`.
LabelIndex label_around(const LabelVolume& volume, const Octree& tree, std::size_t leaf, double margin) {
  const Vec3 out = Vec3::Constant(margin), low = tree.low(leaf);
  return volume.uniform_label(low - out, low + Vec3::Constant(tree.edge(leaf)) + out);
}

}  // namespace

double cubes_along(const LabelVolume& volume, double size) {
  Vec3 lo, hi;
  return volume.find_extent(lo, hi) ? (hi - lo).maxCoeff() / size + 4 : 0;
}

int count_halvings(double voxel, double size, int most_halvings) {
  int halvings = 0;
  while (halvings < most_halvings && size / (2 << halvings) > 0.99 * voxel) ++halvings;
  return halvings;
}

Octree make_octree(const LabelField& field, const LatticeOptions& options) {
  const LabelVolume& volume = field.volume();
  Vec3 lo, hi;
  (void)volume.find_extent(lo, hi);
  const double root = options.size * (1 << kDoublings);
  const double voxel = volume.spacing().minCoeff();
  const int halvings = count_halvings(voxel, options.size, options.most_halvings);
  const Vec3 pad = 0.5 * volume.spacing() + Vec3::Constant(2 * options.size);
  std::array<std::int32_t, 3> roots{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    roots[a] = static_cast<std::int32_t>(std::floor((hi[c] - lo[c] + 2 * pad[c]) / root)) + 1;
  }
  Octree tree(lo - pad, root, roots, kDoublings + halvings);
  Thinness is_thin(field);
  const double extent = (hi - lo + 2 * pad).maxCoeff();
  for (std::size_t n = 0; n < tree.nodes(); ++n) {
    const double edge = tree.edge(n);
    if (tree.level(n) < kDoublings) {
      const double margin = std::min((edge - options.size) / options.grade, extent);
      if (options.grade == 0 || label_around(volume, tree, n, margin) == kMixed) tree.split(n);
    } else if (tree.level(n) < kDoublings + halvings) {
      if (label_around(volume, tree, n, 0.25 * edge) == kMixed && has_thin_label(tree, n, is_thin)) tree.split(n);
    }
  }
  tree.balance();
  return tree;
}

LatticeTets make_lattice(const LabelField& field, const LatticeOptions& options) {
  const Octree tree = make_octree(field, options);
  std::vector<char> is_void(tree.nodes(), 0);
  for (std::size_t n = 0; n < tree.nodes(); ++n) {
    if (tree.is_leaf(n)) is_void[n] = label_around(field.volume(), tree, n, 0) == 0 ? 1 : 0;
  }
  return tree.fill([&](std::size_t n) { return is_void[n] != 0; });
}

}  // namespace image
}  // namespace v0
}  // namespace incise
