// SPDX-License-Identifier: Apache-2.0
// Tiny meshes in every format, by hand. Each holds the same two tets: regions 0 and 7 where the format can say so.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "incise/io/mesh_file.h"

namespace incise::test {

struct Fixture {
  std::string name;  // of the file
  std::string bytes;
  std::string other;  // bytes of the sibling, if it needs one
  bool regions = true;
};

// Binary content in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  Bytes& text(const std::string& t) {
    out_ += t;
    return *this;
  }
  template <class T>
  Bytes& put(T value) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (big_) raw.assign(raw.rbegin(), raw.rend());
    out_ += raw;
    return *this;
  }
  template <class T>
  Bytes& list(std::initializer_list<T> values) {
    for (const T value : values) put(value);
    return *this;
  }
  [[nodiscard]] std::string str() const { return out_; }

 private:
  bool big_;
  std::string out_;
};

inline io::MeshData two_tets() {
  io::MeshData data;
  data.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}};
  data.soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  data.soup.regions = {0, 7};
  return data;
}

inline std::string msh_2_binary(bool big) {
  Bytes b(big);
  b.text("$MeshFormat\n2.2 1 8\n").put<std::int32_t>(1).text("\n$EndMeshFormat\n$Nodes\n5\n");
  std::int32_t id = 0;
  for (const Vec3& p : two_tets().soup.points) b.put(++id).list<double>({p.x(), p.y(), p.z()});
  b.text("\n$EndNodes\n$Private\nabc\n$EndPrivate\n$Elements\n3\n");
  b.list<std::int32_t>({2, 1, 2}).list<std::int32_t>({1, 3, 1, 1, 2, 3});
  b.list<std::int32_t>({4, 2, 2}).list<std::int32_t>({2, 0, 1, 1, 2, 3, 4, 3, 7, 1, 2, 3, 4, 5});
  return b.text("\n$EndElements\n").str();
}

template <class Size>
std::string msh_4_binary(bool big) {
  Bytes b(big);
  const auto sizes = [&b](std::initializer_list<Size> values) {
    for (const Size value : values) b.put(value);
  };
  const auto ints = [&b](std::initializer_list<std::int32_t> values) { b.list(values); };
  b.text("$MeshFormat\n4.1 1 " + std::to_string(sizeof(Size)) + "\n").put(std::int32_t{1});
  b.text("\n$EndMeshFormat\n$Entities\n");
  sizes({0, 0, 0, 2});
  ints({1});
  b.list<double>({0, 0, 0, 1, 1, 1});
  sizes({0, 0});
  ints({2});
  b.list<double>({0, 0, 0, 1, 1, 1});
  sizes({1});
  ints({7});
  sizes({0});
  b.text("\n$EndEntities\n$Nodes\n");
  sizes({1, 5, 10, 14});
  ints({3, 1, 0});
  sizes({5, 10, 11, 12, 13, 14});
  for (const Vec3& p : two_tets().soup.points) b.list<double>({p.x(), p.y(), p.z()});
  b.text("\n$EndNodes\n$Elements\n");
  sizes({2, 2, 1, 2});
  ints({3, 1, 4});
  sizes({1, 1, 10, 11, 12, 13});
  ints({3, 2, 4});
  sizes({1, 2, 11, 12, 13, 14});
  return b.text("\n$EndElements\n").str();
}

inline std::string vtk_binary(bool split) {
  Bytes b(true);
  b.text("# vtk DataFile Version " + std::string(split ? "5.1" : "3.0") +
         "\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n");
  for (const Vec3& p : two_tets().soup.points) {
    b.list<float>({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  if (split) {
    b.text("\nMETADATA\nINFORMATION 0\n\nCELLS 3 8\nOFFSETS vtktypeint64\n").list<std::int64_t>({0, 4, 8});
    b.text("\nCONNECTIVITY vtktypeint64\n").list<std::int64_t>({0, 1, 2, 3, 1, 2, 3, 4});
  } else {
    b.text("\nCELLS 2 10\n").list<std::int32_t>({4, 0, 1, 2, 3, 4, 1, 2, 3, 4});
  }
  b.text("\nCELL_TYPES 2\n").list<std::int32_t>({10, 10});
  b.text("\nCELL_DATA 2\nFIELD FieldData 1\nRegion 1 2 unsigned_char\n").list<std::uint8_t>({0, 7});
  return b.text("\n").str();
}

inline std::string vtu(const std::string& root, const std::string& points, const std::string& cells,
                       const std::string& region, const std::string& tail) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" " + root +
         ">\n<UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<CellData>" + region +
         "</CellData>\n<Points>" + points + "</Points>\n<Cells>" + cells + "</Cells>\n</Piece></UnstructuredGrid>\n" +
         tail + "</VTKFile>\n";
}

inline std::string vtu_ascii() {
  return vtu("byte_order=\"BigEndian\"",
             "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1 1 1 "
             "1.5</DataArray>",
             "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 1 2 3 4</DataArray>"
             "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 8</DataArray>"
             "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 10</DataArray>",
             "<DataArray type=\"Int32\" Name=\"label\" format=\"ascii\">0 7</DataArray>", "");
}

inline std::string vtu_raw(bool big) {
  Bytes b(big);
  const auto begin = [&b](std::uint32_t bytes) { b.put(bytes); };
  begin(120);
  for (const Vec3& p : two_tets().soup.points) b.list<double>({p.x(), p.y(), p.z()});
  begin(32);
  b.list<std::int32_t>({0, 1, 2, 3, 1, 2, 3, 4});
  begin(16);
  b.list<std::int64_t>({4, 8});
  begin(2);
  b.list<std::uint8_t>({10, 10});
  begin(16);
  b.list<double>({0, 7});
  const auto array = [](const char* type, const char* name, int offset) {
    return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>";
  };
  return vtu(std::string("byte_order=\"") + (big ? "BigEndian\"" : "LittleEndian\""), array("Float64", "Points", 0),
             array("Int32", "connectivity", 124) + array("Int64", "offsets", 160) + array("UInt8", "types", 180),
             array("Float64", "region", 186), "<AppendedData encoding=\"raw\">_" + b.str() + "</AppendedData>");
}

inline std::string ply_binary(bool big) {
  Bytes b(big);
  b.text(std::string("ply\nformat binary_") + (big ? "big" : "little") +
         "_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty double z\nelement 3d_element "
         "2\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Vec3& p : two_tets().soup.points) {
    b.list<float>({static_cast<float>(p.x()), static_cast<float>(p.y())}).put(p.z());
  }
  for (const auto& t : two_tets().soup.tets) b.put<std::uint8_t>(4).list<std::uint32_t>({t[0], t[1], t[2], t[3]});
  return b.str();
}

/// One mesh in every format that can be written by hand.
inline std::vector<Fixture> fixtures() {
  const std::string rows = "0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1.5\n";
  return {
      {"medit.mesh",
       "MeshVersionFormatted 1\n# a comment\nDimension\n3\nVertices\n5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 1.5 "
       "1\nEdges\n1\n1 2 0\nTetrahedra\n2\n1 2 3 4 0\n2 3 4 5 7\nEnd\n",
       ""},
      {"v1.msh",
       "$NOD\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 1.5\n$ENDNOD\n$ELM\n3\n1 15 0 0 1 10\n2 4 0 1 4 10 20 "
       "30 40\n3 4 7 1 4 20 30 40 50\n$ENDELM\n",
       ""},
      {"v2.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"fat\"\n$EndPhysicalNames\n$Nodes\n5\n9 0 0 0\n7 "
       "1 "
       "0 0\n5 0 1 0\n3 0 0 1\n1 1 1 1.5\n$EndNodes\n$Elements\n3\n1 2 2 0 1 9 7 5\n2 4 2 0 1 9 7 5 3\n3 4 3 7 1 0 7 5 "
       "3 "
       "1\n$EndElements\n",
       ""},
      {"v41.msh",
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 2\n5 0 0 0 0\n1 0 0 0 1 1 1 0 0\n2 0 0 0 1 1 1.8e+308 1 "
       "7 "
       "0\n$EndEntities\n$Nodes\n2 5 1 5\n0 5 0 1\n1\n0 0 0\n2 1 1 4\n2\n3\n4\n5\n1 0 0 .5 .5\n0 1 0 .5 .5\n0 0 1 .5 "
       ".5\n1 1 1.5 .5 .5\n$EndNodes\n$Surface\n1\n1 2 3\n$EndSurface\n$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n3 2 4 "
       "1\n2 "
       "2 3 4 5\n$EndElements\n",
       ""},
      {"v2_little.msh", msh_2_binary(false), ""},
      {"v2_big.msh", msh_2_binary(true), ""},
      {"v41_little.msh", msh_4_binary<std::uint64_t>(false), ""},
      {"v41_big_short.msh", msh_4_binary<std::uint32_t>(true), ""},
      {"ascii.vtk",
       "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0 1 0 0\n0 1 0 0 0 1 "
       "1 "
       "1 1.5\nCELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10 10\nPOINT_DATA 5\nSCALARS t float 1\nLOOKUP_TABLE "
       "default\n1 2 3 4 5\nCELL_DATA 2\nSCALARS region int\nLOOKUP_TABLE default\n0 7\n",
       ""},
      {"binary.vtk", vtk_binary(false), ""},
      {"binary51.vtk", vtk_binary(true), ""},
      {"ascii.vtu", vtu_ascii(), ""},
      {"named.vtk", vtu_ascii(), ""},
      {"raw_little.vtu", vtu_raw(false), ""},
      {"raw_big.vtu", vtu_raw(true), ""},
      {"base1.ele", "# tabs and a comment\n2\t4\t1\n1\t1\t2\t3\t4\t0\n2\t2\t3\t4\t5\t7\n",
       "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1.5\n# end\n"},
      {"base0.ele", "2 4\n0 0 1 2 3 0\n1 1 2 3 4 7\n", "5\n" + rows},
      {"given.node", "5 3 1 1\n0 0 0 0 8 1\n1 1 0 0 8 1\n2 0 1 0 8 1\n3 0 0 1 8 0\n4 1 1 1.5 8 0\n",
       "2 4 1\n0 0 1 2 3 0\n1 1 2 3 4 7\n"},
      {"vega.veg",
       "# Vega\n*VERTICES\n5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1.5\n*ELEMENTS\nTETS\n2 4 0\n1 1 2 3 "
       "4\n2 2 "
       "3 4 5\n*MATERIAL BODY\nENU, 1000, 1e7, 0.45\n*SET region_7\n2,\n*REGION\nregion_7, BODY\n",
       ""},
      {"abaqus.inp",
       "** comment\n*Heading\n title\n*Node, NSET=all\n1, 0, 0, 0\n2, 1., 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, "
       "1.5\n*NODE PRINT\nU\n*Element, type=C3D4\n1, 1, 2, 3, 4\n2, 2,\n3, 4, 5\n*ELSET, ELSET=region_7, GENERATE\n2, "
       "2, "
       "1\n*STEP\n",
       ""},
      {"surgsim.ply",
       "ply\nformat ascii 1.0\ncomment a wound\nelement vertex 5\nproperty double x\nproperty double y\nproperty "
       "double "
       "z\nproperty double s\nelement face 1\nproperty list uint uint vertex_indices\nelement 3d_element 2\nproperty "
       "list "
       "uint uint vertex_indices\nelement material 1\nproperty double mass\nend_header\n0 0 0 .5\n1 0 0 .5\n0 1 0 "
       ".5\n0 0 "
       "1 .5\n1 1 1.5 .5\n3 0 1 2\n4 0 1 2 3\n4 1 2 3 4\n1000.0\n",
       "", false},
      {"little.ply", ply_binary(false), "", false},
      {"big.ply", ply_binary(true), "", false},
  };
}

inline Result<io::MeshFile> read_fixture(const Fixture& fixture, const std::string& bytes) {
  io::SiblingLoader sibling;
  if (!fixture.other.empty()) {
    sibling = [&fixture](const std::string&) -> Result<std::string> { return fixture.other; };
  }
  return io::read_mesh_bytes(bytes, fixture.name, sibling);
}

}  // namespace incise::test
