// SPDX-License-Identifier: Apache-2.0
#include "cut/crumbs.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

constexpr std::size_t kMaxCrumbTets = 256;
constexpr std::size_t kMaxPieceSearch = 512;
/// A piece may look so many times too thick while it is searched: its walls come last.
constexpr double kWhileGrowing = 2.0;

class CrumbFinder {
 public:
  CrumbFinder(const TetMesh& mesh, const CrumbRules& rules, std::vector<IncisionFace>& incision,
              std::vector<IncisionFace>& dropped, CrumbScratch& scratch)
      : mesh_(mesh),
        rules_(rules),
        incision_(incision),
        dropped_(dropped),
        blocked_(scratch.blocked),
        state_(scratch.state) {
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      mark(incision_[i].a);
      mark(incision_[i].b);
    }
    is_dropped_.resize(incision_.size(), false);
  }
  CrumbFinder(const CrumbFinder&) = delete;
  CrumbFinder& operator=(const CrumbFinder&) = delete;
  ~CrumbFinder() {
    for (const TetId tet : touched_) blocked_[tet.value] = state_[tet.value] = 0;
  }

  std::uint64_t run() {
    std::uint64_t crumbs = 0;
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      for (const TetId seed : {incision_[i].a.tet(), incision_[i].b.tet()}) {
        if (state_[seed.value] == kUnseen && is_crumb(seed)) {
          crumbs += attach() ? 1U : 0U;
        }
      }
    }
    drop_faces();
    return crumbs;
  }

 private:
  enum State : std::uint8_t { kUnseen, kLarge, kCrumb };

  void mark(Side side) {
    blocked_.ensure(std::size_t{side.tet().value} + 1);
    state_.ensure(std::size_t{side.tet().value} + 1);
    blocked_[side.tet().value] = static_cast<std::uint8_t>(blocked_[side.tet().value] | 1U << side.side());
    touched_.push_back(side.tet());
  }
  [[nodiscard]] bool is_blocked(Side side) const {
    return ((unsigned{blocked_[side.tet().value]} >> side.side()) & 1U) != 0;
  }

  /// Floods from `seed` until the piece is complete or too large. Leaves its tets in `piece_`.
  bool is_crumb(TetId seed) {
    const double limit = rules_.limit(seed);
    Shaving shaving;
    piece_.assign(1, seed);
    state_[seed.value] = kCrumb;
    bool is_large = false;
    for (std::size_t i = 0; i < piece_.size() && !is_large; ++i) {
      add_to(shaving, piece_[i]);
      is_large = (shaving.volume >= limit && !is_thin(shaving, kWhileGrowing)) || piece_.size() > kMaxCrumbTets;
      for (unsigned s = 0; s < 4 && !is_large; ++s) {
        const Link link = mesh_.links(piece_[i])[s];
        if (link.is_boundary() || is_blocked(Side(piece_[i], s))) {
          continue;
        }
        const TetId next = link.side().tet();
        state_.ensure(std::size_t{next.value} + 1);
        blocked_.ensure(std::size_t{next.value} + 1);
        if (state_[next.value] == kLarge) {
          is_large = true;
        } else if (state_[next.value] == kUnseen) {
          state_[next.value] = kCrumb;
          touched_.push_back(next);
          piece_.push_back(next);
        }
      }
    }
    is_large |= shaving.volume >= limit && !(shaving.has_older_wall && is_thin(shaving, 1.0));
    if (is_large) {
      for (const TetId tet : piece_) {
        state_[tet.value] = kLarge;
      }
    }
    return !is_large;
  }
  /// What tells a shaving.
  struct Shaving {
    double volume = 0, walls = 0;  ///< twice the area of its walls
    bool has_older_wall = false;
  };
  void add_to(Shaving& shaving, TetId tet) const {
    shaving.volume += mesh_.rest_volume(tet);
    if (!(rules_.thin > 0)) return;
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      const Link link = mesh_.link(side);
      const bool is_wall = link.is_boundary() && link.tag() != 0, is_new = is_blocked(side);
      if (is_wall || is_new) shaving.walls += area_of(side);
      shaving.has_older_wall = shaving.has_older_wall || (is_wall && !is_new && rules_.is_older(side));
    }
  }
  /// Whether the walls on either side are at most `slack` times the greatest thickness apart, on the average.
  [[nodiscard]] bool is_thin(const Shaving& shaving, double slack) const {
    return 4 * shaving.volume <= slack * rules_.thin * shaving.walls;
  }
  [[nodiscard]] bool is_in_piece(TetId tet) const {
    return std::find(piece_.begin(), piece_.end(), tet) != piece_.end();
  }
  [[nodiscard]] double area_of(Side side) const {
    const auto v = mesh_.vertices(side);
    return (mesh_.rest(v[1]) - mesh_.rest(v[0])).cross(mesh_.rest(v[2]) - mesh_.rest(v[0])).norm();
  }
  /// Drops the faces between the crumb and the piece behind its largest face.
  bool attach() {
    struct Border {
      std::uint32_t face;
      TetId behind;
      double area;
    };
    std::vector<Border> borders;
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      const bool has_a = is_in_piece(incision_[i].a.tet()), has_b = is_in_piece(incision_[i].b.tet());
      if (has_a == has_b) continue;
      const auto [inside, behind] = has_a ? incision_[i] : IncisionFace{incision_[i].b, incision_[i].a};
      if (rules_.are_apart && rules_.are_apart(inside.tet(), behind.tet())) continue;
      borders.push_back({i, behind.tet(), area_of(behind)});
    }
    if (borders.empty()) {
      return false;
    }
    const auto largest = std::max_element(borders.begin(), borders.end(),
                                          [](const Border& x, const Border& y) { return x.area < y.area; });
    const std::vector<TetId> piece = piece_around(largest->behind);
    for (const Border& border : borders) {
      if (std::find(piece.begin(), piece.end(), border.behind) != piece.end()) {
        is_dropped_[border.face] = true;
      }
    }
    return true;
  }
  /// Some of the tets connected to `seed` without crossing the incision.
  [[nodiscard]] std::vector<TetId> piece_around(TetId seed) {
    std::vector<TetId> piece = {seed};
    for (std::size_t i = 0; i < piece.size() && piece.size() < kMaxPieceSearch; ++i) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(piece[i])[s];
        blocked_.ensure(std::size_t{piece[i].value} + 1);
        if (!link.is_boundary() && !is_blocked(Side(piece[i], s)) &&
            std::find(piece.begin(), piece.end(), link.side().tet()) == piece.end()) {
          piece.push_back(link.side().tet());
        }
      }
    }
    return piece;
  }
  void drop_faces() {
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      if (is_dropped_[i]) {
        dropped_.push_back(incision_[i]);
      } else {
        incision_[kept++] = incision_[i];
      }
    }
    incision_.resize(kept);
  }

  const TetMesh& mesh_;
  const CrumbRules& rules_;
  std::vector<IncisionFace>& incision_;
  std::vector<IncisionFace>& dropped_;
  ZeroedArray<std::uint8_t>&blocked_, &state_;
  std::vector<TetId> touched_;  // whose entries may not be zero
  std::vector<bool> is_dropped_;
  std::vector<TetId> piece_;
};

}  // namespace

std::uint64_t keep_crumbs(const TetMesh& mesh, const CrumbRules& rules, std::vector<IncisionFace>& incision,
                          std::vector<IncisionFace>& dropped, CrumbScratch& scratch) {
  return CrumbFinder(mesh, rules, incision, dropped, scratch).run();
}

}  // namespace v0
}  // namespace incise
