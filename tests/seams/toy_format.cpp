// SPDX-License-Identifier: Apache-2.0
#include "seams/toy_format.h"

#include <limits>
#include <sstream>

namespace incise::test {
namespace {

Result<io::MeshData> read(std::string_view bytes, const std::string& name, const io::SiblingLoader& /*sibling*/) {
  std::istringstream in{std::string(bytes)};
  std::string word;
  std::size_t points = 0, tets = 0;
  io::MeshData data;
  in >> word >> points >> tets;
  for (std::size_t i = 0; i < points && in; ++i) {
    Vec3 p = Vec3::Zero();
    in >> p.x() >> p.y() >> p.z();
    data.soup.points.push_back(p);
  }
  for (std::size_t i = 0; i < tets && in; ++i) {
    std::array<std::uint32_t, 4> tet{};
    std::int32_t region = 0;
    in >> tet[0] >> tet[1] >> tet[2] >> tet[3] >> region;
    data.soup.tets.push_back(tet);
    data.soup.regions.push_back(region);
  }
  if (!in) return Error{ErrorCode::kBadFile, name + ": ends too early; write it again", {}};
  return data;
}

Result<std::string> write(const io::MeshData& data) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "toy " << data.soup.points.size() << ' ' << data.soup.tets.size() << '\n';
  for (const Vec3& p : data.soup.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (std::size_t i = 0; i < data.soup.tets.size(); ++i) {
    for (const std::uint32_t v : data.soup.tets[i]) out << v << ' ';
    out << (data.soup.regions.empty() ? 0 : data.soup.regions[i]) << '\n';
  }
  return out.str();
}

}  // namespace

io::MeshFormat toy_format() {
  return {"Toy", ".toy", [](std::string_view bytes) { return bytes.substr(0, 4) == "toy "; }, read, write};
}

}  // namespace incise::test
