// SPDX-License-Identifier: Apache-2.0
#include "image/made_images.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace incise_test {
namespace {

using incise::Vec3;

const Vec3 kMiddle(64.3, 63.8, 64.1);  // of no voxel, and not symmetric to the lattice

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

struct Branch {
  Vec3 from, to;
  double radius;
};

/// A trunk that forks twice.
const std::vector<Branch>& branches() {
  static const std::vector<Branch> kAll = {{kMiddle + Vec3(0, 0, -40), kMiddle + Vec3(0, 0, -10), 8},
                                           {kMiddle + Vec3(0, 0, -10), kMiddle + Vec3(20, 4, 12), 5},
                                           {kMiddle + Vec3(0, 0, -10), kMiddle + Vec3(-18, -6, 14), 5},
                                           {kMiddle + Vec3(20, 4, 12), kMiddle + Vec3(30, 18, 30), 3},
                                           {kMiddle + Vec3(20, 4, 12), kMiddle + Vec3(22, -16, 32), 3},
                                           {kMiddle + Vec3(-18, -6, 14), kMiddle + Vec3(-30, 8, 32), 3},
                                           {kMiddle + Vec3(-18, -6, 14), kMiddle + Vec3(-20, -24, 30), 3}};
  return kAll;
}

std::int32_t tree_at(const Vec3& p) {
  if ((p - kMiddle).norm() > 52) return 0;
  for (const Branch& b : branches()) {
    if (distance_to_segment(p, b.from, b.to) < b.radius) return 2;
  }
  return 1;
}

std::int32_t sectors_at(const Vec3& p) {
  const Vec3 q = p - kMiddle;
  if (q.norm() > 48) return 0;
  if (0.2 * q.x() + q.y() < 0) return 1;
  return q.x() - 0.15 * q.z() > 0 ? 2 : 3;
}

std::int32_t spine_at(const Vec3& p) {
  const Vec3 q = p - kMiddle;
  if (Vec3(q.x(), q.y() + 4, 0).norm() > 42 || std::abs(q.z()) > 44) return 0;
  const double body = Vec3(q.x() / 22, q.y() / 16, 0).norm();
  const double ring = Vec3(q.x(), q.y() + 24, 0).norm();  // around the canal, behind the bodies
  if (body < 1) return std::abs(q.z() - 0.1 * q.y()) < 6 ? 2 : 1;
  return ring > 9 && ring < 14.5 && std::abs(q.z()) > 10 ? 1 : 3;
}

std::int32_t balls_at(const Vec3& p) {
  const double r = (p - kMiddle).norm();
  return r < 20 ? 2 : (r < 45 ? 1 : 0);
}

std::int32_t organ_at(const Vec3& p) {
  const Vec3 c(128.3, 127.1, 128.7), q = p - c;
  if (Vec3(q.x() - 85, q.y() + 10, 0).norm() < 18 && std::abs(q.z()) < 90) return 5;
  if (Vec3(q.x() / 75, q.y() / 60, q.z() / 85).norm() > 1) return 0;
  if ((q - Vec3(20, 15, 30)).norm() < 18) return 2;
  if ((q - Vec3(-30, -10, -35)).norm() < 12) return 3;
  const Vec3 axis(10 * std::sin(p.z() / 30) - 10, 12 * std::cos(p.z() / 35), q.z());
  return (q - axis).norm() < 9 ? 4 : 1;
}

/// A sequence that is the same everywhere.
class Sequence {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_ = 7;
};

std::array<std::size_t, 3> size_of(const MadeImage& made) {
  const auto along = [&](Eigen::Index a) {
    return static_cast<std::size_t>(std::lround(made.extent / made.spacing[a]));
  };
  return {along(0), along(1), along(2)};
}

}  // namespace

MadeImage ball_in_ball() {
  return {"ball in ball", balls_at, 128, Vec3::Ones(), 0, {1, 2}, {true, true}};
}

MadeImage triple_junctions() {
  return {"triple junctions", sectors_at, 128, Vec3(0.9, 0.9, 1.2), 0, {1, 2, 3}, {true, true, true}};
}

MadeImage thin_shell(double radius) {
  const Truth truth = [radius](const Vec3& p) {
    const double r = (p - kMiddle).norm();
    return r < radius - 2 ? 1 : (r < radius ? 2 : 0);
  };
  return {"thin shell", truth, 128, Vec3::Ones(), 0, {1, 2}, {true, false}};
}

MadeImage spine_segment() {
  return {"spine segment", spine_at, 128, Vec3(1, 1, 1.5), 0, {1, 2, 3}, {true, true, true}};
}

MadeImage vessel_tree() {
  return {"vessel tree", tree_at, 128, Vec3::Ones(), 0, {1, 2}, {true, false}};
}

MadeImage noisy_balls() {
  return {"noise", balls_at, 128, Vec3::Ones(), 0.05, {1, 2}, {true, true}};
}

MadeImage large_organ() {
  return {"organ of 256^3", organ_at, 256, Vec3::Ones(), 0, {1, 2, 3, 4, 5}, {true, true, true, true, true}};
}

MadeImage block(bool is_turned) {
  const Truth truth = [is_turned](const Vec3& p) {
    Vec3 q = p - Vec3(32.5, 32.5, 32.5);
    if (is_turned) q = Vec3(0.8 * q.x() + 0.6 * q.y(), 0.8 * q.y() - 0.6 * q.x(), q.z());
    if (is_turned) q = Vec3(q.x(), 0.96 * q.y() + 0.28 * q.z(), 0.96 * q.z() - 0.28 * q.y());
    return std::abs(q.x()) < 20 && std::abs(q.y()) < 14 && std::abs(q.z()) < 9 ? 1 : 0;
  };
  return {is_turned ? "block, turned" : "block", truth, 64, Vec3::Ones(), 0, {1}, {true}};
}

std::vector<MadeImage> made_images() {
  return {ball_in_ball(), triple_junctions(), thin_shell(), vessel_tree(), noisy_balls()};
}

incise::image::LabelImage to_image(const MadeImage& made) {
  incise::image::LabelImage image;
  image.size = size_of(made);
  for (std::size_t a = 0; a < 3; ++a) image.step[a] *= made.spacing[static_cast<Eigen::Index>(a)];
  image.labels = {0};
  image.labels.insert(image.labels.end(), made.labels.begin(), made.labels.end());
  image.voxels.reserve(image.size[0] * image.size[1] * image.size[2]);
  Sequence random;
  for (std::size_t k = 0; k < image.size[2]; ++k) {
    for (std::size_t j = 0; j < image.size[1]; ++j) {
      for (std::size_t i = 0; i < image.size[0]; ++i) {
        const Vec3 p =
            made.spacing.cwiseProduct(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        std::int32_t label = made.truth(p);
        if (made.noise > 0 && random.next() < made.noise) {
          label = image.labels[static_cast<std::size_t>(random.next() * static_cast<double>(image.labels.size()))];
        }
        image.voxels.push_back(static_cast<std::uint16_t>(image.find_label(label)));
      }
    }
  }
  return image;
}

std::vector<double> true_volumes(const MadeImage& made) {
  MadeImage clean = made;
  clean.noise = 0;
  const incise::image::LabelImage image = to_image(clean);
  std::vector<double> counts(image.labels.size(), 0);
  constexpr int kFine = 5;
  const auto sample = [&](std::size_t i, std::size_t j, std::size_t k) {
    for (int n = 0; n < kFine * kFine * kFine; ++n) {
      const Vec3 in((n % kFine + 0.5) / kFine - 0.5, (n / kFine % kFine + 0.5) / kFine - 0.5,
                    (n / kFine / kFine + 0.5) / kFine - 0.5);
      const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
      counts[image.find_label(made.truth(made.spacing.cwiseProduct(at + in)))] += 1.0 / (kFine * kFine * kFine);
    }
  };
  for (std::size_t k = 1; k + 1 < image.size[2]; ++k) {
    for (std::size_t j = 1; j + 1 < image.size[1]; ++j) {
      for (std::size_t i = 1; i + 1 < image.size[0]; ++i) {
        const std::uint16_t mine = image.voxels[image.index(i, j, k)];
        bool is_mixed = false;
        for (std::size_t n = 0; n < 27 && !is_mixed; ++n) {
          is_mixed = image.voxels[image.index(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1)] != mine;
        }
        if (is_mixed) {
          sample(i, j, k);
        } else {
          counts[mine] += 1;
        }
      }
    }
  }
  for (double& count : counts) count *= made.spacing.prod();
  counts.erase(counts.begin());
  return counts;
}

}  // namespace incise_test
