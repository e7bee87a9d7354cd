// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes from STL files and from the files of LIGGGHTS's dump mesh/vtk, and the file of a step.
#include <cstdint>
#include <cstring>

#include "io/input_error.h"
#include "io/mesh_file.h"
#include "meshes.h"
#include "scratch_folder.h"
#include "solid/closed_mesh.h"

namespace spherocylinder {
namespace {

// A header of 80 bytes, the number of triangles, and of each normal, corners and two bytes.
std::string binary_stl(const Triangles &mesh)
{
  std::string bytes(80, ' ');
  const auto add = [&](const auto &value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  add(static_cast<std::uint32_t>(mesh.size()));
  for (const Triangle &t : mesh) {
    for (const Vec3 &p : {Vec3{0, 0, 0}, t.a, t.b, t.c})
      for (const double x : {p.x, p.y, p.z}) add(static_cast<float>(x));
    add(std::uint16_t{0});
  }
  return bytes;
}

// As dump mesh/vtk writes it: three points of its own for each triangle, and a number.
std::string vtk_text(const Triangles &mesh)
{
  const std::size_t n = mesh.size();
  std::string text = fmt::format(
      "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS {} float\n",
      3 * n);
  for (const Triangle &t : mesh)
    for (const Vec3 &p : {t.a, t.b, t.c}) text += fmt::format("{:f} {:f} {:f}\n", p.x, p.y, p.z);
  text += fmt::format("CELLS {} {}\n", n, 4 * n);
  for (std::size_t i = 0; i < n; i++)
    text += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  text += fmt::format("CELL_TYPES {}\n", n);
  for (std::size_t i = 0; i < n; i++) text += "5\n";
  text += fmt::format("CELL_DATA {}\nSCALARS meshid float 1\nLOOKUP_TABLE default\n", n);
  for (std::size_t i = 0; i < n; i++) text += "1.000000\n";
  return text;
}

class MeshFile : public ScratchFolder {
 protected:
  std::string refusal(const std::string &name)
  {
    try {
      read_mesh(path(name));
    } catch (const InputError &error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(MeshFile, AllFormatsGiveTheSameBox)
{
  const Triangles box = box_mesh({0.125, 0.375, -0.5, 0.5, 0, 2});
  write("a.stl", stl_text(box));
  write("b.STL", binary_stl(box));
  write("c.vtk", vtk_text(box));
  for (const char *name : {"a.stl", "b.STL", "c.vtk"}) {
    const auto mesh = read_mesh(path(name));
    EXPECT_EQ(mesh->GetNumberOfPoints(), 8) << name;
    EXPECT_EQ(mesh->GetNumberOfPolys(), 12) << name;
    EXPECT_EQ(fault_of_surface(mesh), std::nullopt) << name;
    EXPECT_NEAR(ClosedMesh(mesh).volume(), 0.25 * 1.0 * 2.0, 1e-9) << name;
  }
}

TEST_F(MeshFile, WhatIsNoMeshIsRefused)
{
  write("cut.stl", binary_stl(box_mesh({0, 1, 0, 1, 0, 1})).substr(0, 300));
  write("nothing.vtk", "# vtk DataFile Version 2.0\nx\nASCII\nDATASET POLYDATA\n");
  write("words.vtk", "words\n");
  std::string nan = stl_text(box_mesh({0, 1, 0, 1, 0, 1}));
  nan.replace(nan.find("vertex 0 "), 9, "vertex nan ");
  write("nan.stl", nan);
  write("point.stl", stl_text({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}));
  for (const char *name : {"cut.stl", "nothing.vtk", "words.vtk", "nan.stl", "point.stl"}) {
    const std::string sentence = refusal(name);
    EXPECT_EQ(sentence.find(path(name) + ": "), 0u) << name << " " << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
  EXPECT_EQ(refusal("cut.stl"), path("cut.stl") + ": ends after 4 triangles, wanted 12");
}

TEST_F(MeshFile, OfAStep)
{
  for (const char *name : {"m_0.stl", "m_050.stl", "m_500.stl", "m_x.stl", "m_5.vtk"})
    write(name, "");
  EXPECT_EQ(mesh_file_at(path("any.stl"), 7), path("any.stl"));
  EXPECT_EQ(mesh_file_at(path("m_*.stl"), 0), path("m_0.stl"));
  EXPECT_EQ(mesh_file_at(path("m_*.stl"), 50), path("m_050.stl"));
  EXPECT_EQ(mesh_file_at(path("m_*.stl"), 500), path("m_500.stl"));
  const auto refusal_of = [&](const std::string &name, std::int64_t step) -> std::string {
    try {
      return mesh_file_at(path(name), step);
    } catch (const InputError &error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal_of("m_*.stl", 5),
            path("m_*.stl") + ": there is no file of step 5, wanted one for each step drawn");
  EXPECT_NE(refusal_of("*_*.stl", 5).find("must hold one * at most"), std::string::npos);
  EXPECT_NE(refusal_of("*/m_5.stl", 5).find("must hold one * at most"), std::string::npos);
  EXPECT_NE(refusal_of("none/m_*.stl", 5).find("there is no file of step 5"), std::string::npos);
  write("m_0050.stl", "");
  EXPECT_NE(refusal_of("m_*.stl", 50).find("are both of step 50"), std::string::npos);
}

}  // namespace
}  // namespace spherocylinder
