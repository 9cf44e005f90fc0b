// SPDX-License-Identifier: Apache-2.0
// Stars that fall into several pieces of a label give all but the largest to their neighbours, round by round; what
// does not settle is voted on, and in the end made uniform.
#include "image/mend_manifold.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr int kMendRounds = 80;
/// From the first round on what is in pieces goes to the label that most of the star has; from the second on all of the
/// star does.
constexpr int kStrictRound = 12, kStrictestRound = 24;

class ManifoldMender {
 public:
  explicit ManifoldMender(LabelledTets& mesh) : mesh_(mesh), neighbours_(find_neighbours(mesh)), stars_(mesh) {}

  ManifoldRepair run() {
    ManifoldRepair repair;
    std::vector<char> is_suspect(stars_.size(), 1), next(stars_.size(), 0);
    for (int round = 0; round < kMendRounds; ++round) {
      std::uint64_t changed = 0;
      repair.left = 0;
      for (std::size_t p = 0; p < stars_.size(); ++p) {
        if (is_suspect[p] == 0 || is_uniform(stars_[p])) continue;
        changed_.clear();
        is_strict_ = round >= kStrictRound;
        if (!mend_point(p)) continue;
        if (round >= kStrictestRound) make_uniform(stars_[p]);
        ++repair.left;
        changed += changed_.size();
        for (const std::uint32_t t : changed_) {
          for (const std::uint32_t v : mesh_.tets[t]) next[v] = 1;
        }
        next[p] = 1;
      }
      repair.relabelled += changed;
      std::swap(is_suspect, next);
      std::fill(next.begin(), next.end(), 0);
      if (repair.left == 0) break;
    }
    return repair;
  }

 private:
  [[nodiscard]] bool is_uniform(std::span<const std::uint32_t> star) const {
    return std::all_of(star.begin(), star.end(),
                       [&](std::uint32_t t) { return mesh_.labels[t] == mesh_.labels[star[0]]; });
  }

  /// Relabels around a point; false where nothing had to be.
  bool mend_point(std::size_t p) {
    const auto star = stars_[p];
    if (mend_pieces(star)) return true;
    for (const std::uint32_t t : star) {
      for (const std::uint32_t q : mesh_.tets[t]) {
        if (q <= p) continue;
        ring_.clear();
        for (const std::uint32_t r : star) {
          if (has_corner(r, q)) ring_.push_back(r);
        }
        if (!is_uniform(ring_) && mend_pieces(ring_)) return true;
      }
    }
    return false;
  }

  void make_uniform(std::span<const std::uint32_t> star) {
    votes_.clear();
    for (const std::uint32_t t : star) vote(mesh_.labels[t]);
    const LabelIndex label = most_voted();
    for (const std::uint32_t t : star) {
      if (mesh_.labels[t] == label) continue;
      mesh_.labels[t] = label;
      changed_.push_back(t);
    }
  }

  void vote(LabelIndex label) {
    const auto found = std::find_if(votes_.begin(), votes_.end(), [&](const auto& v) { return v.first == label; });
    if (found == votes_.end()) {
      votes_.emplace_back(label, 1);
    } else {
      ++found->second;
    }
  }

  /// The label of most votes, the lowest of equal ones; `kMixed` without votes.
  [[nodiscard]] LabelIndex most_voted() const {
    LabelIndex best = kMixed;
    int most = 0;
    for (const auto& [label, n] : votes_) {
      if (n > most || (n == most && label < best)) {
        best = label;
        most = n;
      }
    }
    return best;
  }

  [[nodiscard]] bool has_corner(std::uint32_t tet, std::size_t point) const {
    const auto& c = mesh_.tets[tet];
    return c[0] == point || c[1] == point || c[2] == point || c[3] == point;
  }

  /// Where a label of these tets, or all that are no background, are in several pieces, relabels all but the largest.
  bool mend_pieces(std::span<const std::uint32_t> tets) {
    return mend_pieces_alike(tets, [](LabelIndex label) { return label; }) ||
           mend_pieces_alike(tets, [](LabelIndex label) { return label == 0 ? LabelIndex{0} : LabelIndex{1}; });
  }

  template <class Kind>
  bool mend_pieces_alike(std::span<const std::uint32_t> tets, const Kind& kind) {
    find_pieces(tets, kind);
    std::size_t worst = tets.size();
    for (std::size_t i = 0; i < tets.size(); ++i) {
      if (piece_[i] != i) continue;
      for (std::size_t j = 0; j < tets.size(); ++j) {
        const bool is_rival = j != i && piece_[j] == j && kind(mesh_.labels[tets[j]]) == kind(mesh_.labels[tets[i]]);
        if (!is_rival || count_[i] > count_[j] || (count_[i] == count_[j] && i < j)) continue;
        if (worst == tets.size() || count_[i] < count_[worst]) worst = i;
      }
    }
    if (worst == tets.size()) return false;
    const LabelIndex to = new_label(tets, worst);
    if (to == kMixed) return false;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      if (piece_[i] == worst) {
        mesh_.labels[tets[i]] = to;
        changed_.push_back(tets[i]);
      }
    }
    return true;
  }

  /// Pieces of tets of one kind that faces connect within the set, numbered by their first tet.
  template <class Kind>
  void find_pieces(std::span<const std::uint32_t> tets, const Kind& kind) {
    piece_.resize(tets.size());
    std::iota(piece_.begin(), piece_.end(), std::size_t{0});
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (std::size_t i = 0; i < tets.size(); ++i) {
        for (const std::uint32_t n : neighbours_[tets[i]]) {
          const auto found = std::find(tets.begin(), tets.end(), n);
          if (n == kNoTet || found == tets.end()) continue;
          const auto j = static_cast<std::size_t>(found - tets.begin());
          if (kind(mesh_.labels[n]) != kind(mesh_.labels[tets[i]]) || piece_[j] == piece_[i]) continue;
          piece_[i] = piece_[j] = std::min(piece_[i], piece_[j]);
          is_changed = true;
        }
      }
    }
    count_.assign(tets.size(), 0);
    for (const std::size_t root : piece_) ++count_[root];
  }

  /// What a piece becomes: the label that it has most faces with; where that does not end, the one of most of the tets.
  LabelIndex new_label(std::span<const std::uint32_t> tets, std::size_t piece) {
    votes_.clear();
    const LabelIndex mine = mesh_.labels[tets[piece]];
    for (std::size_t i = 0; i < tets.size(); ++i) {
      if (is_strict_ && mesh_.labels[tets[i]] != mine) vote(mesh_.labels[tets[i]]);
      if (is_strict_ || piece_[i] != piece) continue;
      for (const std::uint32_t n : neighbours_[tets[i]]) {
        if (n != kNoTet && mesh_.labels[n] != mine) vote(mesh_.labels[n]);
      }
    }
    return most_voted();
  }

  LabelledTets& mesh_;
  std::vector<std::array<std::uint32_t, 4>> neighbours_;
  Stars stars_;
  std::vector<std::uint32_t> ring_, changed_;
  std::vector<std::size_t> piece_, count_;
  std::vector<std::pair<LabelIndex, int>> votes_;
  bool is_strict_ = false;
};

}  // namespace

ManifoldRepair mend_manifold(LabelledTets& mesh) {
  return ManifoldMender(mesh).run();
}

}  // namespace image
}  // namespace v0
}  // namespace incise
