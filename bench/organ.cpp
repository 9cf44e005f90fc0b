// SPDX-License-Identifier: Apache-2.0
// Label images of known shapes made into tets: quality, errors, time.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>

#include "image/made_images.h"
#include "image/organ_judge.h"

namespace {

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

void measure(const MadeImage& made, double size, std::FILE* csv) {
  const incise::image::LabelImage image = to_image(made);
  incise::image::MeshLabelsOptions options;
  options.size = size;
  const double start = cpu_seconds();
  const auto mesh = incise::image::mesh_labels(image, options);
  const double cpu = cpu_seconds() - start, peak = peak_gb();
  if (!mesh) {
    std::printf("%s: %s\n", made.name.c_str(), mesh.error().message.c_str());
    return;
  }
  const OrganFigures f = judge(made, *mesh);
  std::string volumes;
  for (std::size_t l = 0; l < f.volume_error.size(); ++l) {
    char text[32];
    std::snprintf(text, sizeof(text), "%+.2f%s ", 100 * f.volume_error[l], made.is_wide[l] ? "" : "*");
    volumes += text;
  }
  std::printf("%-17s %8zu %6.1f %5.2f | %5.1f %6.1f %5.1f %5.2f | %5.3f %5.3f %5.2f | %-28s | %llu %llu %llu %s\n",
              made.name.c_str(), mesh->mesh.tet_count(), cpu, peak, f.quality.dihedral_min_deg,
              f.quality.dihedral_max_deg, f.quality.lr_max, f.quality.lr_mean, f.mean_error, f.p99_error, f.worst_error,
              volumes.c_str(), static_cast<unsigned long long>(f.nonmanifold_edges),
              static_cast<unsigned long long>(f.singleton_vertices), static_cast<unsigned long long>(f.surfaces),
              f.is_valid ? "valid" : "INVALID");
  if (csv == nullptr) return;
  for (char& c : volumes) c = c == ' ' ? ';' : c;
  std::fprintf(csv, "%s,%g,%zu,%.2f,%.2f,%.2f,%.2f,%.2f,%.3f,%.4f,%.4f,%.4f,%s,%llu,%llu,%llu,%d\n", made.name.c_str(),
               size, mesh->mesh.tet_count(), cpu, peak, f.quality.dihedral_min_deg, f.quality.dihedral_max_deg,
               f.quality.lr_max, f.quality.lr_mean, f.mean_error, f.p99_error, f.worst_error, volumes.c_str(),
               static_cast<unsigned long long>(f.nonmanifold_edges),
               static_cast<unsigned long long>(f.singleton_vertices), static_cast<unsigned long long>(f.surfaces),
               f.is_valid ? 1 : 0);
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  bool is_quick = false;
  int only = -1;
  double size = 4;
  for (int a = 1; a < argc; ++a) {
    if (std::strcmp(argv[a], "--quick") == 0) is_quick = true;
    if (std::strcmp(argv[a], "--out") == 0 && a + 1 < argc) folder = argv[a + 1];
    if (std::strcmp(argv[a], "--size") == 0 && a + 1 < argc) size = std::atof(argv[a + 1]);
    if (std::strcmp(argv[a], "--only") == 0 && a + 1 < argc) only = std::atoi(argv[a + 1]);
  }
  std::FILE* csv = folder.empty() ? nullptr : std::fopen((folder + "/organ.csv").c_str(), "w");
  std::printf("%-17s %8s %6s %5s | %5s %6s %5s %5s | %5s %5s %5s | %-28s | %s\n", "image, 4 mm", "tets", "cpu s", "GB",
              "least", "most", "L/r", "mean", "mean", "p99", "worst", "volumes, % (* thin)", "edges points skins");
  if (csv != nullptr) {
    std::fprintf(
        csv,
        "image,size_mm,tets,cpu_s,peak_gb,dihedral_min,dihedral_max,lr_max,lr_mean,error_mean_voxels,"
        "error_p99_voxels,error_max_voxels,volume_errors_pct,nonmanifold_edges,singleton_vertices,skins,valid\n");
  }
  int index = 0;
  for (const MadeImage& made : made_images()) {
    if (only < 0 || only == index) measure(made, size, csv);
    ++index;
  }
  if (!is_quick && (only < 0 || only == index)) measure(large_organ(), size, csv);
  if (csv != nullptr) std::fclose(csv);
  return 0;
}
