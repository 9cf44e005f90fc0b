// SPDX-License-Identifier: Apache-2.0
// Label images of known shapes made into tets: quality, errors, time.
#include <fmt/format.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "image/made_images.h"
#include "image/organ_judge.h"
#include "incise/image/image_file.h"
#include "incise/image/mesh_labels.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/defects.h"

namespace {

using namespace incise;
using namespace incise_test;

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_gb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1048576.0;
}

/// One mesh in figures.
struct Row {
  std::string made_by;
  double size = 0, cpu_s = 0, peak_gb = 0;
};

/// An image by its name, and which of its labels have a radius above two spacings.
struct Judged {
  std::string name;
  std::vector<bool> is_wide;
};

constexpr std::size_t kMostVolumes = 6;  // in one line

/// The error of each volume in percent; of an image of many labels the worst wide one.
std::string volumes_of(const Judged& judged, const OrganFigures& f) {
  std::string text;
  double worst = 0;
  int wide = 0;
  for (std::size_t l = 0; l < f.volume_error.size(); ++l) {
    text += fmt::format("{}{:+.2f}{}", l > 0 ? " " : "", 100 * f.volume_error[l], judged.is_wide[l] ? "" : "*");
    if (!judged.is_wide[l]) continue;
    ++wide;
    if (std::abs(f.volume_error[l]) > std::abs(worst)) worst = f.volume_error[l];
  }
  if (f.volume_error.size() <= kMostVolumes) return text;
  return fmt::format("worst of {} wide ones {:+.2f}", wide, 100 * worst);
}

void print(const Judged& made, const Row& row, const OrganFigures& f, std::FILE* csv) {
  fmt::print(
      "{:<17} {:<6} {:>8} {:>6.1f} {:>5.2f} | {:>5.1f} {:>6.1f} {:>6.1f} {:>5.2f} | {:>5.3f} {:>5.2f} {:>5.1f} | "
      "{:<30} | {} {} {} {}\n",
      made.name, row.made_by, f.quality.tets, row.cpu_s, row.peak_gb, f.quality.dihedral_min_deg,
      f.quality.dihedral_max_deg, f.quality.lr_max, f.quality.lr_mean, f.mean_error, f.p99_error, f.worst_error,
      volumes_of(made, f), f.nonmanifold_edges, f.singleton_vertices, f.surfaces, f.is_valid ? "valid" : "INVALID");
  std::fflush(stdout);
  if (csv == nullptr) return;
  fmt::print(csv, "{},{},{},{},{:.2f},{:.3f},{:.2f},{:.2f},{:.2f},{:.3f},{:.4f},{:.4f},{:.4f},{},{},{},{},{}\n",
             made.name, row.made_by, row.size, f.quality.tets, row.cpu_s, row.peak_gb, f.quality.dihedral_min_deg,
             f.quality.dihedral_max_deg, f.quality.lr_max, f.quality.lr_mean, f.mean_error, f.p99_error, f.worst_error,
             volumes_of(made, f), f.nonmanifold_edges, f.singleton_vertices, f.surfaces, f.is_valid ? 1 : 0);
}

constexpr const char* kCsvHead =
    "image,made_by,size_mm,tets,cpu_s,peak_gb,dihedral_min,dihedral_max,lr_max,lr_mean,error_mean_voxels,"
    "error_p99_voxels,error_max_voxels,volume_errors_pct,nonmanifold_edges,singleton_vertices,skins,valid\n";

void measure(const MadeImage& made, double size, std::FILE* csv) {
  const image::LabelImage labels = to_image(made);
  image::MeshLabelsOptions options;
  options.size = size;
  const double start = cpu_seconds();
  const auto mesh = image::mesh_labels(labels, options);
  const Row row = {"incise", size, cpu_seconds() - start, peak_gb()};
  if (!mesh) {
    fmt::print("{}: {}\n", made.name, mesh.error().message);
    return;
  }
  print({made.name, made.is_wide}, row, judge(made, mesh->mesh), csv);
}

/// Whether a label's radius, as a ball's of its volume and area, is above two spacings. Voxels have one and a half
/// times the area of what they stand for.
std::vector<bool> find_wide(const image::LabelImage& labels, const OrganTruth& truth, double size) {
  std::vector<double> areas(labels.labels.size(), 0);
  const auto& step = labels.step;
  std::array<std::size_t, 3> at{};
  for (at[2] = 0; at[2] < labels.size[2]; ++at[2]) {
    for (at[1] = 0; at[1] < labels.size[1]; ++at[1]) {
      for (at[0] = 0; at[0] < labels.size[0]; ++at[0]) {
        const std::uint16_t here = labels.voxels[labels.index(at[0], at[1], at[2])];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<std::size_t, 3> next = at;
          if (++next[axis] == labels.size[axis]) continue;
          const std::uint16_t there = labels.voxels[labels.index(next[0], next[1], next[2])];
          if (here == there) continue;
          const double area = step[(axis + 1) % 3].cross(step[(axis + 2) % 3]).norm() / 1.5;
          areas[here] += area;
          areas[there] += area;
        }
      }
    }
  }
  std::vector<bool> is_wide;
  for (std::size_t l = 0; l < truth.labels.size(); ++l) {
    const double area = areas[labels.find_label(truth.labels[l])];
    is_wide.push_back(3 * truth.volumes[l] > 2 * size * area);
  }
  return is_wide;
}

/// What another program made.
Result<TetMesh> read_peer(const std::string& file) {
  Result<io::MeshFile> read = io::read_mesh(file);
  if (!read) return read.error();
  normalise(read->data.soup);
  return TetMesh::build(std::move(read->data.soup));
}

/// Ours of a scan, or what another program made of it.
Status measure_scan(const std::string& path, Row row, const std::string& peer_file, std::FILE* csv) {
  const auto scan = image::read_labels(path);
  if (!scan) return scan.error();
  const OrganTruth truth = truth_of(scan->image);
  const Judged judged = {path.substr(path.find_last_of('/') + 1), find_wide(scan->image, truth, row.size)};
  Result<TetMesh> mesh = TetMesh();
  if (peer_file.empty()) {
    image::MeshLabelsOptions options;
    options.size = row.size;
    const double start = cpu_seconds();
    auto ours = image::mesh_labels(scan->image, options);
    if (!ours) return ours.error();
    row.cpu_s = cpu_seconds() - start;
    row.peak_gb = peak_gb();
    mesh = std::move(ours->mesh);
  } else {
    mesh = read_peer(peer_file);
    if (!mesh) return mesh.error();
  }
  print(judged, row, judge(truth, *mesh), csv);
  return {};
}

/// Judges what another program made of the image.
void measure_peer(const MadeImage& made, const Row& row, const char* file, std::FILE* csv) {
  const Result<TetMesh> mesh = read_peer(file);
  if (!mesh) fmt::print("{}: {}\n", made.name, mesh.error().message);
  if (mesh) print({made.name, made.is_wide}, row, judge(made, *mesh), csv);
}

/// Writes an image as INRIMAGE, which CGAL reads.
bool write_inr(const MadeImage& made, const std::string& file) {
  const image::LabelImage labels = to_image(made);
  std::string bytes = fmt::format(
      "#INRIMAGE-4#{{\nXDIM={}\nYDIM={}\nZDIM={}\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 "
      "bits\nCPU=decm\nVX={}\nVY={}\nVZ={}\n",
      labels.size[0], labels.size[1], labels.size[2], made.spacing.x(), made.spacing.y(), made.spacing.z());
  bytes += std::string(252 - bytes.size(), '\n') + "##}\n";
  for (const std::uint16_t voxel : labels.voxels) bytes += static_cast<char>(labels.labels[voxel]);
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return false;
  const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  return std::fclose(out) == 0 && is_written;
}

std::vector<MadeImage> all_images() {
  std::vector<MadeImage> images = made_images();
  images.push_back(large_organ());
  return images;
}

}  // namespace

// usage: organ [--quick] [--out FOLDER] [--size H] [--only N]     ours, of image N (0 to 5) or of all
//        organ --write-inr N FILE                                 the image for another program
//        organ --scan FILE [--size H] [--out FOLDER]              ours, of a label image of no known truth: a row more
//        organ --scan FILE --judge 0 NAME MESH CPU_SECONDS …      what another program made of it, likewise
//        organ --judge N NAME FILE CPU_SECONDS [--out FOLDER]     what that made of it: a row more
int main(int argc, char** argv) {
  std::string folder, peer, file, scan;
  bool is_quick = false;
  std::size_t only = 99;
  double size = 4, cpu_s = 0;
  const std::vector<MadeImage> images = all_images();
  for (int a = 1; a < argc; ++a) {
    const auto is = [&](const char* name, int values) { return std::strcmp(argv[a], name) == 0 && a + values < argc; };
    if (is("--quick", 0)) is_quick = true;
    if (is("--out", 1)) folder = argv[a + 1];
    if (is("--scan", 1)) scan = argv[a + 1];
    if (is("--size", 1)) size = std::atof(argv[a + 1]);
    if (is("--only", 1)) only = static_cast<std::size_t>(std::atoi(argv[a + 1]));
    if (is("--write-inr", 2))
      return write_inr(images[static_cast<std::size_t>(std::atoi(argv[a + 1])) % 6], argv[a + 2]) ? 0 : 1;
    if (is("--judge", 4)) {
      only = static_cast<std::size_t>(std::atoi(argv[a + 1])) % 6;
      peer = argv[a + 2];
      file = argv[a + 3];
      cpu_s = std::atof(argv[a + 4]);
    }
  }
  std::FILE* csv =
      folder.empty() ? nullptr : std::fopen((folder + "/organ.csv").c_str(), peer.empty() && scan.empty() ? "w" : "a");
  if (!scan.empty()) {
    const Status done = measure_scan(scan, {peer.empty() ? "incise" : peer, size, cpu_s, 0}, file, csv);
    if (!done.ok()) fmt::print("{}\n", done.error().message);
  } else if (!peer.empty()) {
    measure_peer(images[only], {peer, size, cpu_s, 0}, file.c_str(), csv);
  } else {
    fmt::print("{:<17} {:<6} {:>8} {:>6} {:>5} | {:>5} {:>6} {:>6} {:>5} | {:>5} {:>5} {:>5} | {:<30} | {}\n", "image",
               "by", "tets", "cpu s", "GB", "least", "most", "L/r", "mean", "error", "p99", "worst",
               "volumes, % (* thin)", "edges points skins");
    if (csv != nullptr) fmt::print(csv, "{}", kCsvHead);
    for (std::size_t i = 0; i < images.size() - (is_quick ? 1 : 0); ++i) {
      if (only == 99 || only == i) measure(images[i], size, csv);
    }
  }
  if (csv != nullptr) std::fclose(csv);
  return 0;
}
