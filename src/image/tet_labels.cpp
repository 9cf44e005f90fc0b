// SPDX-License-Identifier: Apache-2.0
// Indicators at the middle and towards the corners say how much of each label a tet has; then a few rounds weigh that
// against the faces that it has with other labels.
#include "image/tet_labels.h"

#include <algorithm>
#include <cmath>

#include "incise/core/parallel.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Kernel for tets: this share of their longest edge.
constexpr double kTetWidth = 0.2;
/// What a face between two labels costs, as a share of the tet's own.
constexpr double kFaceCost = 0.12;
constexpr int kRounds = 4;

/// How much of some labels a tet has: those that it has most of.
struct TetShares {
  std::array<LabelIndex, 4> label = {0, 0, 0, 0};
  std::array<float, 4> value = {0, 0, 0, 0};

  [[nodiscard]] double of(LabelIndex wanted) const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (label[i] == wanted && value[i] > 0) return static_cast<double>(value[i]);
    }
    return 0;
  }
};

double longest_edge(const LabelledTets& mesh, const LabelledTets::Corners& tet) {
  double longest2 = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      longest2 = std::max(longest2, (mesh.points[tet[a]] - mesh.points[tet[b]]).squaredNorm());
    }
  }
  return std::sqrt(longest2);
}

TetShares most_of(Shares& sum) {
  std::sort(sum.begin(), sum.end(),
            [](const Share& a, const Share& b) { return a.value != b.value ? a.value > b.value : a.label < b.label; });
  TetShares out;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, sum.size()); ++i) {
    out.label[i] = sum.begin()[i].label;
    out.value[i] = static_cast<float>(sum.begin()[i].value / 6);
  }
  return out;
}

/// The shares at the middle, twice, and half way to the corners.
TetShares shares_of(const LabelField& field, const LabelledTets& mesh, const LabelledTets::Corners& tet) {
  Vec3 low = mesh.points[tet[0]], high = low, middle = Vec3::Zero();
  for (const std::uint32_t p : tet) {
    low = low.cwiseMin(mesh.points[p]);
    high = high.cwiseMax(mesh.points[p]);
    middle += 0.25 * mesh.points[p];
  }
  TetShares out;
  if (const LabelIndex only = field.volume().uniform_label(low, high); only != kMixed) {
    out.label[0] = only;
    out.value[0] = 1;
    return out;
  }
  const double width = kTetWidth * longest_edge(mesh, tet);
  Shares sum, part;
  const auto add = [&](const Vec3& p, double weight) {
    field.sample(p, width, part);
    for (const Share& share : part) {
      if (Share* to = sum.get(share.label)) to->value += weight * share.value;
    }
  };
  add(middle, 2);
  for (const std::uint32_t p : tet) add(0.5 * (middle + mesh.points[p]), 1);
  return most_of(sum);
}

/// The label that a tet would best have, seen its own shares and its neighbours.
LabelIndex best_label(const LabelledTets& mesh, const TetShares& shares, std::size_t tet,
                      const std::array<std::uint32_t, 4>& neighbours) {
  const LabelIndex mine = mesh.labels[tet];
  const auto score = [&](LabelIndex label) {
    double sum = shares.of(label);
    for (const std::uint32_t n : neighbours) sum += n != kNoTet && mesh.labels[n] == label ? kFaceCost : 0.0;
    return sum;
  };
  LabelIndex best = mine;
  double most = score(mine);
  for (const std::uint32_t n : neighbours) {
    if (n == kNoTet || mesh.labels[n] == mine) continue;
    if (const double other = score(mesh.labels[n]); other > most) {
      most = other;
      best = mesh.labels[n];
    }
  }
  return best;
}

}  // namespace

void label_tets(const LabelField& field, unsigned threads, LabelledTets& mesh) {
  std::vector<TetShares> shares(mesh.tets.size());
  parallel_blocks(mesh.tets.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) shares[t] = shares_of(field, mesh, mesh.tets[t]);
  });
  mesh.labels.resize(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = shares[t].label[0];
  const auto neighbours = find_neighbours(mesh);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = best_label(mesh, shares[t], t, neighbours[t]);
  }
}

}  // namespace image
}  // namespace v0
}  // namespace incise
