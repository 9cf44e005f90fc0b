// SPDX-License-Identifier: Apache-2.0
// Forces are summed at the nodes of cells, a band matrix answers, turned with each node's part of the body, and the
// answer is taken as far as the true energy's slope says (docs/internals.md, 4).
#include "sim/body/coarse_lattice.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

using Mat24 = Eigen::Matrix<double, 24, 24>;

/// The stiffness of a cell by Young's modulus and volume, in two Gauss points along each axis.
Mat24 cell_stiffness(const Vec3& spacing) {
  constexpr double kLambda = kLatticePoisson / ((1 + kLatticePoisson) * (1 - 2 * kLatticePoisson)),
                   kMu = 0.5 / (1 + kLatticePoisson);
  constexpr std::array<double, 2> kPoints = {0.21132486540518712, 0.78867513459481288};
  Mat24 sum = Mat24::Zero();
  for (unsigned point = 0; point < 8; ++point) {
    std::array<Vec3, 8> slope;
    for (unsigned node = 0; node < 8; ++node) {
      Vec3 value, change;
      for (unsigned k = 0; k < 3; ++k) {
        const double x = kPoints[point >> k & 1U];
        const bool is_far = (node >> k & 1U) != 0;
        value.data()[k] = is_far ? x : 1 - x;
        change.data()[k] = (is_far ? 1 : -1) / spacing.data()[k];
      }
      slope[node] = Vec3(change.x() * value.y() * value.z(), value.x() * change.y() * value.z(),
                         value.x() * value.y() * change.z());
    }
    for (unsigned i = 0; i < 8; ++i) {
      for (unsigned j = 0; j < 8; ++j) {  // Hooke's law between two shape functions
        const Vec3 &a = slope[i], &b = slope[j];
        const Mat3 block = kLambda * a * b.transpose() + kMu * (b * a.transpose() + a.dot(b) * Mat3::Identity());
        sum.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) += 0.125 * block;
      }
    }
  }
  return sum;
}

/// The turning in a deformation, by Higham's iteration; none where it is flattened or turned inside out.
Mat3 cell_turning(const Mat3& deformation) {
  const double size = deformation.norm();
  if (!(size > 0) || !std::isfinite(size)) return Mat3::Identity();
  Mat3 turn = deformation / size;
  for (unsigned i = 0; i < 12; ++i) {
    if (!(turn.determinant() > 1e-9)) return Mat3::Identity();
    const Mat3 other = turn.inverse().transpose();
    turn = (0.5 * (turn + other)).eval();
  }
  return turn;
}

double dot(const std::array<float, 4>& a, const std::array<float, 4>& b) {
  double sum = 0;
  for (unsigned k = 0; k < 3; ++k) sum += static_cast<double>(a[k]) * static_cast<double>(b[k]);
  return sum;
}

}  // namespace

/// What the lattice is made of, by piece and by the place of a cell's first node.
struct CoarseLattice::Cells {
  std::vector<double> stiffness;      // Young's modulus · volume
  std::vector<std::uint8_t> is_used;  // by tets or vertices
};

// --- how it is made

const std::uint32_t* CoarseLattice::nodes_of(std::uint32_t piece) const {
  if (piece >= pieces_ || first_of_piece_[piece] == kNone) return nullptr;
  return numbers_.data() + first_of_piece_[piece];
}

template <class Visit>
void CoarseLattice::for_each_node(std::uint32_t piece, const Location& location, Visit&& visit) const {
  const std::uint32_t* numbers = nodes_of(piece);
  if (numbers == nullptr) return;
  const auto& [x, y, z] = location.share;
  const std::array<float, 2> along = {1 - x, x}, across = {1 - y, y}, up = {1 - z, z};
  for (unsigned k = 0; k < 8; ++k) {
    const std::uint32_t node = numbers[location.corner + offsets_[k]];
    if (node != kNone) visit(node, along[k & 1U] * across[k >> 1U & 1U] * up[k >> 2U]);
  }
}

void CoarseLattice::prepare(DeformableBody::State& state, double h) {
  if (!fits(state, h)) build(state, h);
  locations_.resize(state.places.size());
  slopes_.resize(state.places.size());
  before_.resize(state.places.size());
  steps_.resize(state.places.size());
  if (node_count_ > 0 && age_++ % kTurnEvery == 0) turn(state);
}

/// Holds come and go with cuts through what is held: a few of them do not matter.
bool CoarseLattice::fits(const DeformableBody::State& state, double h) const {
  const std::size_t holds = state.holds.size(), more = std::max(holds, holds_), less = std::min(holds, holds_);
  return h_ > 0 && h > 0.6 * h_ && h < 1.6 * h_ && pieces_ == state.pieces.size() && 10 * (more - less) <= less;
}

void CoarseLattice::build(DeformableBody::State& state, double h) {
  pieces_ = state.pieces.size();
  holds_ = state.holds.size();
  h_ = h;
  age_ = 0;
  node_count_ = 0;
  lay_out(state);
  if (grid_ == 0) return;
  Cells cells;
  number_nodes(state, cells);
  assemble(state, cells, h);
}

/// Sets the lattice's place and spacing: cells of about the same length along all axes, which fill the body's box.
void CoarseLattice::lay_out(const DeformableBody::State& state) {
  const double inf = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(inf), high = -low;
  double edges = 0;
  std::size_t vertices = 0;
  grid_ = 0;
  for (std::uint32_t v = 0; v < state.places.size(); ++v) {
    if (!state.is_live(VertexId(v))) continue;
    low = low.cwiseMin(state.rest[VertexId(v)]);
    high = high.cwiseMax(state.rest[VertexId(v)]);
    edges += 4 * static_cast<double>(state.motions[VertexId(v)].reach);  // reach is a quarter of the local edge length
    ++vertices;
  }
  if (vertices < kLeastLatticeVertices) return;
  const Vec3 size = high - low;
  const std::size_t most = std::clamp(vertices / kVerticesPerNode, std::size_t{8}, kMostLatticeNodes);
  double spacing =
      std::max(size.maxCoeff() / kMostLatticeCells, kLeastLatticeSpacing * edges / static_cast<double>(vertices));
  for (;; spacing *= 1.1) {
    std::size_t nodes = 1;
    for (unsigned k = 0; k < 3; ++k) {
      cells_[k] = static_cast<std::uint32_t>(std::max(1.0, std::ceil(size.data()[k] / spacing - 0.5)));
      nodes *= cells_[k] + 1;
    }
    if (nodes > most && nodes > 8) continue;
    grid_ = static_cast<std::uint32_t>(nodes);
    break;
  }
  low_ = low;
  for (unsigned k = 0; k < 3; ++k) spacing_.data()[k] = std::max(size.data()[k], 1e-9 * size.maxCoeff()) / cells_[k];
  std::array<unsigned, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](unsigned a, unsigned b) { return cells_[a] < cells_[b]; });
  std::uint32_t stride = 1;
  for (const unsigned k : axes) {
    strides_[k] = stride;
    stride *= cells_[k] + 1;
  }
  for (unsigned n = 0; n < 8; ++n) {
    offsets_[n] = (n & 1U) * strides_[0] + (n >> 1U & 1U) * strides_[1] + (n >> 2U) * strides_[2];
  }
}

CoarseLattice::Location CoarseLattice::location_of(const Vec3& rest) const {
  Location location;
  for (unsigned k = 0; k < 3; ++k) {
    const double along = (rest.data()[k] - low_.data()[k]) / spacing_.data()[k];
    const double cell = std::clamp(std::floor(along), 0.0, static_cast<double>(cells_[k] - 1));
    location.corner += static_cast<std::uint32_t>(cell) * strides_[k];
    location.share[k] = static_cast<float>(along - cell);
  }
  return location;
}

void CoarseLattice::locate(VertexId vertex, const Vec3& rest) {
  if (grid_ == 0) return;
  if (vertex.value >= locations_.size()) locations_.resize(vertex.value + 1);
  locations_[vertex] = location_of(rest);
}

/// Each piece has nodes of its own, where it is.
void CoarseLattice::number_nodes(const DeformableBody::State& state, Cells& cells) {
  std::vector<std::size_t> vertices(pieces_);
  for (std::uint32_t v = 0; v < state.places.size(); ++v) {
    if (state.is_live(VertexId(v))) ++vertices[state.piece_of[VertexId(v)]];
  }
  first_of_piece_.assign(pieces_, kNone);
  std::uint32_t slots = 0;
  for (std::size_t i = 0; i < pieces_; ++i) {
    if (vertices[i] < kLeastLatticeVertices) continue;
    first_of_piece_[i] = slots;
    slots += grid_;
  }
  numbers_.assign(slots, kNone);
  cells.stiffness.assign(slots, 0);
  cells.is_used.assign(slots, 0);
  locations_.resize(state.places.size());
  for (std::uint32_t v = 0; v < state.places.size(); ++v) {
    if (!state.is_live(VertexId(v))) continue;
    locate(VertexId(v), state.rest[VertexId(v)]);
    const std::uint32_t first = first_of_piece_[state.piece_of[VertexId(v)]];
    if (first != kNone) cells.is_used[first + locations_[VertexId(v)].corner] = 1;
  }
  for (std::uint32_t t = 0; t < state.tets.size(); ++t) {
    const TetVertices& corners = state.tets[TetId(t)];
    const std::uint32_t first = corners[0].is_valid() ? first_of_piece_[state.piece_of[corners[0]]] : kNone;
    if (first == kNone) continue;
    const std::array<Vec3, 4> p = state.corners_at_rest(TetId(t));
    const std::uint32_t cell = first + location_of(0.25 * (p[0] + p[1] + p[2] + p[3])).corner;
    const double young = state.materials.of(state.regions[TetId(t)]).young * state.unit();
    cells.stiffness[cell] += young * six_volumes(p) / 6;
    cells.is_used[cell] = 1;
  }
  for (std::uint32_t cell = 0; cell < slots; ++cell) {
    if (cells.is_used[cell] == 0) continue;
    for (const std::uint32_t offset : offsets_) numbers_[cell + offset] = 0;
  }
  for (std::uint32_t& number : numbers_) {
    if (number != kNone) number = node_count_++;
  }
}

void CoarseLattice::assemble(const DeformableBody::State& state, const Cells& cells, double h) {
  std::uint32_t reach = 0;
  for (std::uint32_t cell = 0; cell < cells.is_used.size(); ++cell) {
    if (cells.is_used[cell] != 0) reach = std::max(reach, numbers_[cell + offsets_[7]] - numbers_[cell]);
  }
  matrix_ = BandMatrix(std::size_t{3} * node_count_, std::size_t{3} * reach + 2);
  add_cells(cells);
  add_vertices(state, h);
  turns_.assign(node_count_, Mat3::Identity());
  nodes_.resize(node_count_);
  solution_.resize(std::size_t{3} * node_count_);
  if (!matrix_.factor()) node_count_ = 0;
}

void CoarseLattice::add_cells(const Cells& cells) {
  const Mat24 stiffness = cell_stiffness(spacing_);
  for (std::uint32_t cell = 0; cell < cells.stiffness.size(); ++cell) {
    if (!(cells.stiffness[cell] > 0)) continue;
    for (unsigned i = 0; i < 24; ++i) {
      const std::size_t row = std::size_t{3} * numbers_[cell + offsets_[i / 3]] + i % 3;
      for (unsigned j = 0; j < 24; ++j) {
        const std::size_t column = std::size_t{3} * numbers_[cell + offsets_[j / 3]] + j % 3;
        // A little more on the diagonal keeps rounding from making it indefinite.
        if (row >= column)
          matrix_.add(row, column,
                      (row == column ? 1 + 1e-9 : 1) * cells.stiffness[cell] *
                          stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
  }
}

/// Inertia, and springs where the body is held.
void CoarseLattice::add_vertices(const DeformableBody::State& state, double h) {
  for (std::uint32_t slot = 0; slot < state.places.size(); ++slot) {
    const VertexId v(slot);
    if (!state.is_live(v)) continue;
    double stiffness = state.mass_of(v) / (h * h);
    if (const auto hold = state.holds.find(slot); hold != state.holds.end()) {
      stiffness += std::min(hold->second.stiffness, kHoldStiffness * state.motions[v].diagonal);
    }
    const auto add_pair = [&](std::uint32_t i, std::uint32_t j, double value) {
      for (unsigned k = 0; k < 3 && i >= j; ++k) matrix_.add(std::size_t{3} * i + k, std::size_t{3} * j + k, value);
    };
    const std::uint32_t piece = state.piece_of[v];
    for_each_node(piece, locations_[v], [&](std::uint32_t i, float wi) {
      for_each_node(piece, locations_[v], [&](std::uint32_t j, float wj) {
        add_pair(i, j, stiffness * static_cast<double>(wi) * static_cast<double>(wj));
      });
    });
  }
}

// --- how it is used

/// Finds how the body has turned around each node: the lattice answers as if it had turned along.
void CoarseLattice::turn(const DeformableBody::State& state) {
  struct Sums {
    double mass = 0;
    Vec3 rest = Vec3::Zero(), place = Vec3::Zero();
    Mat3 product = Mat3::Zero();
  };
  std::vector<Sums> sums(node_count_);
  for (std::uint32_t slot = 0; slot < state.places.size(); ++slot) {
    const VertexId v(slot);
    if (!state.is_live(v)) continue;
    const Vec3 rest = state.rest[v] - low_, place = state.places[slot] - state.middle;
    const Mat3 product = place * rest.transpose();
    const double mass = state.mass_of(v);
    for_each_node(state.piece_of[v], locations_[v], [&](std::uint32_t node, float weight) {
      const double m = mass * static_cast<double>(weight);
      sums[node].mass += m;
      sums[node].rest += m * rest;
      sums[node].place += m * place;
      sums[node].product += m * product;
    });
  }
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    const Sums& s = sums[i];
    turns_[i] = s.mass > 0 ? cell_turning(s.product - s.place * s.rest.transpose() / s.mass) : Mat3(Mat3::Identity());
  }
}

/// From the forces on the nodes to their moves.
void CoarseLattice::answer() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    const Vec3 force(static_cast<double>(nodes_[i][0]), static_cast<double>(nodes_[i][1]),
                     static_cast<double>(nodes_[i][2]));
    const Vec3 turned = turns_[i].transpose() * force;
    for (unsigned k = 0; k < 3; ++k) solution_[std::size_t{3} * i + k] = turned.data()[k];
  }
  matrix_.solve(solution_);
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    const double* x = solution_.data() + std::size_t{3} * i;
    const Vec3 move = turns_[i] * Vec3(x[0], x[1], x[2]);
    for (unsigned k = 0; k < 3; ++k) nodes_[i][k] = static_cast<float>(move.data()[k]);
  }
}

/// Sums the forces up at the nodes; where the vertices are is kept.
void CoarseLattice::gather(const DeformableBody::State& state) {
  std::fill(nodes_.begin(), nodes_.end(), Row{});
  state.for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const Row& slope = slopes_[slot];
    for_each_node(state.piece_of[v], locations_[v], [&](std::uint32_t node, float weight) {
      for (unsigned k = 0; k < 4; ++k) nodes_[node][k] -= weight * slope[k];
    });
  });
}

/// What the nodes' moves are for the vertices; returns the length of the longest.
double CoarseLattice::spread(const DeformableBody::State& state) {
  state.for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    Row step{};
    for_each_node(state.piece_of[v], locations_[v], [&](std::uint32_t node, float weight) {
      for (unsigned k = 0; k < 4; ++k) step[k] += weight * nodes_[node][k];
    });
    steps_[slot] = step;
  });
  state.bones.make_rigid(state, steps_);
  double longest2 = 0;
  state.for_each_awake([&](std::uint32_t slot) {
    const double length2 = dot(steps_[slot], steps_[slot]);
    longest2 = length2 <= longest2 ? longest2 : length2;  // what is no number stays
  });
  return std::sqrt(longest2);
}

/// The slope of the energy along the steps.
double CoarseLattice::slope_along(DeformableBody::State& state) {
  state.find_slopes(slopes_.data()->data());
  double sum = 0;
  state.for_each_awake([&](std::uint32_t v) { sum += dot(slopes_[v], steps_[v]); });
  return sum;
}

void CoarseLattice::go(DeformableBody::State& state, double share) {
  const auto scale = static_cast<float>(share);
  state.for_each_awake([&](std::uint32_t v) {
    float* x = state.single(VertexId(v));
    for (unsigned k = 0; k < 3; ++k) x[k] = before_[v][k] + scale * steps_[v][k];
  });
  state.find_pressures();
}

void CoarseLattice::correct(DeformableBody::State& state) {
  if (node_count_ == 0 || 2 * state.order.awake_count() < state.order.moving_count()) return;
  state.find_slopes(slopes_.data()->data());
  gather(state);
  answer();
  const double longest = spread(state);
  if (!(longest > 0) || !std::isfinite(longest)) return;
  double at_start = 0;
  state.for_each_awake([&](std::uint32_t v) {
    const float* x = state.single(VertexId(v));
    before_[v] = {x[0], x[1], x[2], 0};
    at_start += dot(slopes_[v], steps_[v]);
  });
  const double first = std::min(1.0, kFarthestAnswer * spacing_.minCoeff() / longest);
  go(state, first);
  const double at_end = slope_along(state);
  // The slope is as good as linear: to where it is 0, or on as far as may be.
  const double curvature = at_end - at_start;
  double share =
      state.stars.stiffens ? 1.0 : kLongestAnswer;  // further on, tissue that stiffens may stand up against it
  if (curvature > 0) share = std::min(share, -at_start / curvature);
  if (!(at_start < 0) || !std::isfinite(at_end)) share = 0;
  go(state, share * first);
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
