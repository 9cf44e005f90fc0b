// SPDX-License-Identifier: Apache-2.0
#include "support/folder.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "incise/io/mesh_file.h"
#include "incise/mesh/shapes.h"

namespace incise_test {
namespace {

namespace fs = std::filesystem;

}  // namespace

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "incise test XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return *this / name;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(path_)) found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string cube_mesh(unsigned n, double fraction) {
  incise::io::MeshData data;
  data.soup = incise::kuhn_cube(n);
  if (fraction > 0) incise::jitter(data.soup, fraction, 3);
  auto bytes = incise::io::write_mesh_bytes(".mesh", data);
  return bytes.ok() ? *bytes : std::string();
}

}  // namespace incise_test
