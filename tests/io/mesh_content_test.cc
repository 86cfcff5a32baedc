// Mesh files that are cut off, or do not hold what they promise.
#include "io/mesh_content.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "clearway/io/mesh_file.h"
#include "io/tetrahedra_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

// By a name whose extension is theirs.
std::map<std::string, std::string> WholeFiles() {
  return {{"a.obj", kObj}, {"a.off", Off()}, {"a.stl", AsciiStl()}, {"b.stl", BinaryStl()}};
}

absl::StatusOr<Mesh> Read(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return ReadMesh(folder.Write(name, bytes));
}

std::string ErrorOf(const std::string& name, const std::string& bytes) {
  const auto mesh = Read(name, bytes);
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kInvalidArgument) << name;
  return std::string(mesh.status().message());
}

std::string With(const std::string& text, const std::string& from, const std::string& to) {
  EXPECT_THAT(text, HasSubstr(from));
  return absl::StrReplaceAll(text, {{from, to}});
}

TEST(MeshContent, Empty) {
  for (const char* extension : {".stl", ".obj", ".off", ".dae", ".gltf", ".glb"}) {
    const auto dut = CheckMeshContent(extension, "");
    EXPECT_TRUE(!dut.ok() || *dut->faces == 0) << extension;
  }
  EXPECT_FALSE(CheckMeshContent(".fbx", kObj).ok());
  EXPECT_FALSE(CheckMeshContent(".ply", AsciiPly()).ok());  // is read, not checked
}

TEST(MeshContent, WholeFilesAreRead) {
  for (const auto& [name, bytes] : WholeFiles()) {
    const auto mesh = Read(name, bytes);
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_EQ(mesh->triangles.size(), mesh->vertices.size()) << name;
    EXPECT_EQ(*CheckMeshContent(name.substr(1), bytes)->faces, mesh->triangles.size());
  }
}

TEST(MeshContent, AFileCutOffAtAnyByteIsRefusedOrWhole) {
  for (const auto& [name, bytes] : WholeFiles()) {
    const std::size_t faces = Read(name, bytes)->triangles.size();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const std::string cut = bytes.substr(0, size);
      if (!CheckMeshContent(name.substr(1), cut).ok()) continue;
      const auto mesh = Read(name, cut);
      if (!mesh.ok() || mesh->triangles.size() == faces) continue;
      // An OBJ file states no counts: where all vertices are used, the surface is open.
      ASSERT_EQ(name, "a.obj") << size;
      EXPECT_TRUE(cut.ends_with('\n'));
    }
  }
}

TEST(MeshContent, AnObjFileIsCutOffWhereVerticesBelongToNoFace) {
  const std::string whole = kObj;
  const std::string cut = whole.substr(0, whole.find("f 9 11 10"));
  EXPECT_THAT(ErrorOf("a.obj", cut), HasSubstr("4 of 12 vertices belong to no face, the first of "
                                               "them vertex 9: the file seems cut off"));
  EXPECT_THAT(ErrorOf("a.obj", whole.substr(0, whole.size() - 1)),
              HasSubstr("line 27: the last line does not end: the file seems cut off"));
}

TEST(MeshContent, ObjFacesNameVerticesThatAreThere) {
  const std::string whole = kObj;
  EXPECT_THAT(ErrorOf("a.obj", With(whole, "f 3 1 4", "f 3 1 99")),
              HasSubstr("line 10: vertex 99 is named; there are 4 so far"));
  EXPECT_THAT(ErrorOf("a.obj", With(whole, "f 3 1 4", "f 3 1 0")), HasSubstr("line 10"));
  EXPECT_THAT(ErrorOf("a.obj", With(whole, "f 3 1 4", "f 3 1")),
              HasSubstr("line 10: a face of 2 vertices"));
  EXPECT_THAT(ErrorOf("a.obj", With(whole, "f 3 1 4", "ff 3 1 4")),
              HasSubstr("line 10: 'ff' is not read"));
  EXPECT_THAT(ErrorOf("a.obj", With(whole, "v 0 1 0\n", "v 0 1\n")), HasSubstr("line 5: expected"));
  for (const char* same : {"f -2 -4 -1", "f 3/ 1/ 4/", "f 3 \\\n 1 4"}) {
    const auto mesh = Read("a.obj", With(whole, "f 3 1 4", same));
    EXPECT_TRUE(mesh.ok()) << same << mesh.status();
  }
}

TEST(MeshContent, CommentsOfObjFilesMayFollowAnything) {
  const auto whole = Read("a.obj", kObj);
  const std::string commented = absl::StrReplaceAll(
      kObj, {{"f 3 1 4", "f 3 1 4 # x"}, {"v 0 1 0", "v 0 1 0# x \\"}, {"o first", "o #first"}});
  const auto mesh = Read("a.obj", commented);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->vertices, whole->vertices);
  EXPECT_EQ(mesh->triangles, whole->triangles);
}

TEST(MeshContent, OffCountsAreThoseOfTheFile) {
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "12 12 0", "12 13 0")),
              HasSubstr("it states 13 faces and has 12"));
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "12 12 0", "12 11 0")),
              HasSubstr("more than the stated 12 vertices and 11 faces"));
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "12 12 0", "13 11 0")),
              HasSubstr("line 15: vertex 12 of 13 has 4 numbers in 4 words, the first has 3"));
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "3 8 11 10", "3 8 12 10")),
              HasSubstr("line 26: a face names vertex '12' of 12 (the first is 0)"));
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "3 8 11 10", "3 8 11")), HasSubstr("line 26"));
  EXPECT_THAT(ErrorOf("a.off", With(Off(), "12 12 0", "12 12")), HasSubstr("line 2"));
}

TEST(MeshContent, AnAsciiStlFileEndsAsItBegins) {
  const std::string whole = AsciiStl();
  EXPECT_THAT(ErrorOf("a.stl", whole.substr(0, whole.find("endsolid"))),
              HasSubstr("expected facet or endsolid after 4 facets; the file is cut off"));
  EXPECT_THAT(ErrorOf("a.stl", With(whole, "  endloop\n", "")),
              HasSubstr("line 7: expected endloop after 0 facets; found 'endfacet'"));
  EXPECT_THAT(ErrorOf("a.stl", With(whole, "vertex 1 0 0\n", "vertex 1 0\n")),
              HasSubstr("a number"));
  EXPECT_EQ(Read("a.stl", whole + whole)->triangles.size(), 8u);
}

TEST(MeshContent, AsciiStlFilesMayBeInUpperCase) {
  std::string stl = AsciiStl();
  for (char& c : stl) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto mesh = Read("a.stl", stl);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->triangles, Read("a.stl", AsciiStl())->triangles);
}

TEST(MeshContent, AsciiStlFilesMayBeginWithEmptyLines) {
  const std::string late = "\n \r\n\t" + AsciiStl();
  const auto mesh = Read("a.stl", late);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->triangles, Read("a.stl", AsciiStl())->triangles);
  EXPECT_THAT(ErrorOf("a.stl", With(late, "  endloop\n", "")), HasSubstr("line 9: "));
}

TEST(MeshContent, ABinaryStlFileHasTheSizeThatItStates) {
  EXPECT_THAT(ErrorOf("b.stl", BinaryStl().substr(0, 84 + 120)),
              HasSubstr("it states 4 facets, 284 bytes in all, and has 204 bytes (2 facets)"));
  EXPECT_THAT(ErrorOf("b.stl", BinaryStl() + std::string(50, '\0')), HasSubstr("334 bytes"));
}

TEST(MeshContent, ByteOrderMarksAreReadOver) {
  for (const auto& [name, bytes] : WholeFiles()) {
    if (name == "b.stl") continue;  // no text: its size is not what it states
    const auto mesh = Read(name, "\xEF\xBB\xBF" + bytes);
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    EXPECT_EQ(mesh->triangles.size(), Read(name, bytes)->triangles.size()) << name;
  }
  EXPECT_THAT(ErrorOf("a.obj", "\xFF\xFEv"), HasSubstr("UTF-16"));
}

}  // namespace
}  // namespace clearway
