// PLY meshes that are cut off, contradict themselves or are damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "io/ply_mesh.h"
#include "io/ply_mesh_reading.h"
#include "io/tetrahedra_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using testing_support::PlyErrorOf;
using testing_support::ReadPly;
using testing_support::With;

TEST(PlyMeshRefusal, AFileCutOffAtAnyByteIsRefused) {
  for (const std::string& bytes : {AsciiPly(), BinaryPly(), BinaryPly(true)}) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      PlyErrorOf(bytes.substr(0, size));
    }
  }
}

TEST(PlyMeshRefusal, CountsAreThoseOfTheFile) {
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "face 12", "face 13")),
              HasSubstr("the header states 13 of element face, and the file has 12"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "face 12", "face 11")),
              HasSubstr("10 bytes follow what the header states"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "vertex 12", "vertex 13")), HasSubstr("line 23"));
  EXPECT_THAT(PlyErrorOf(With(BinaryPly(), "face 4", "face 5")),
              HasSubstr("the header states 5 of element face, and the file has 4"));
  EXPECT_THAT(PlyErrorOf(With(BinaryPly(), "face 4", "face 3")),
              HasSubstr("13 bytes follow what the header states"));
  EXPECT_THAT(PlyErrorOf(With(BinaryPly(), "vertex 4", "vertex 5")),
              HasSubstr("face 0 has a list of 0 vertices; a face has 3 to 10000"));
}

TEST(PlyMeshRefusal, APromiseTakesNoMemory) {
  EXPECT_THAT(PlyErrorOf(With(BinaryPly(), "vertex 4", "vertex 30000002")), HasSubstr("cut off"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "face 12", "face 10000000")), HasSubstr("cut off"));
  for (const char* count : {"30000003", "4294967300", "18446744073709551615"}) {
    const auto mesh = ReadPly(With(AsciiPly(), "vertex 12", absl::StrCat("vertex ", count)));
    EXPECT_EQ(mesh.status().code(), absl::StatusCode::kResourceExhausted) << mesh.status();
  }
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "vertex 12", "vertex 18446744073709551616")),
              HasSubstr("is not a number of elements"));
  std::string other = With(BinaryPly(), "element face",
                           "element x 18446744073709551615\nproperty list uint float l\n"
                           "element face");
  EXPECT_THAT(PlyErrorOf(other), HasSubstr("of element x, and the file has"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "4294967295 8 11 10")), HasSubstr("fewer"));
}

TEST(PlyMeshRefusal, LimitsHold) {
  MeshFileOptions options;
  options.max_triangles = 11;
  EXPECT_EQ(ReadPly(AsciiPly(), options).status().code(), absl::StatusCode::kResourceExhausted);
  options.max_triangles = 12;
  EXPECT_TRUE(ReadPly(AsciiPly(), options).ok());
  options.max_triangles = 1;  // but the face is cut into two
  const auto quad = ReadPly(PlyFace({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), options);
  EXPECT_EQ(quad.status().code(), absl::StatusCode::kResourceExhausted);
}

TEST(PlyMeshRefusal, FacesOfOtherElementsAreRefused) {
  for (const char* name : {"polygon", "tristrips"}) {
    const std::string ply = With(AsciiPly(), "element face 12",
                                 absl::StrCat("element face 11\n"
                                              "property list uchar int vertex_indices\nelement ",
                                              name, " 1"));
    EXPECT_THAT(PlyErrorOf(ply), HasSubstr(absl::StrCat("element ", name, " lists vertices")));
  }
}

TEST(PlyMeshRefusal, FacesNameVerticesThatAreThere) {
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 12 10")),
              HasSubstr("line 34: face 11 names vertex 12 of 12 (the first is 0)"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 -1 10")), HasSubstr("vertex -1 of 12"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 9.5 10")), HasSubstr("vertex 9.5 of"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 nan 10")), HasSubstr("vertex nan of"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 11")),
              HasSubstr("line 34: face 11 of 12 has fewer numbers than the header states"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "3 8 11 10 9")),
              HasSubstr("line 34: face 11 has more numbers"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "-3 8 11 10")), HasSubstr("list of -3"));
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "3 8 11 10", "2 8 11")), HasSubstr("list of 2"));
  std::string binary = BinaryPly();
  binary[binary.size() - 4] = 9;
  EXPECT_EQ(PlyErrorOf(binary), "a.ply: face 3 names vertex 9 of 4 (the first is 0)");
}

TEST(PlyMeshRefusal, CoordinatesAreFinite) {
  for (const char* x : {"nan", "-inf", "1e999"}) {
    EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "2 0 3\n3 0", absl::StrCat(x, " 0 3\n3 0"))),
                HasSubstr("line 22: vertex 11 is not finite"));
  }
  EXPECT_THAT(PlyErrorOf(PlyFace({{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}})),
              HasSubstr("too large"));
  MeshFileOptions options;
  options.scale = 1e300;
  EXPECT_FALSE(ReadPly(With(AsciiPly(), "2 0 3\n3 0", "1e300 0 3\n3 0"), options).ok());
}

TEST(PlyMeshRefusal, HeadersThatAreNotUnderstoodAreRefused) {
  const std::string ply = AsciiPly();
  EXPECT_THAT(PlyErrorOf(With(ply, "property float z\n", "")),
              HasSubstr("without a property z; it "));
  EXPECT_THAT(PlyErrorOf(With(ply, "float z", "float x")), HasSubstr("has property x twice"));
  EXPECT_THAT(PlyErrorOf(With(ply, "float z", "list uchar float z")), HasSubstr("z is a list"));
  EXPECT_THAT(PlyErrorOf(With(ply, "list uchar int", "list float int")),
              HasSubstr("line 9: the length of a list cannot be a float"));
  EXPECT_THAT(PlyErrorOf(With(ply, "list uchar int", "list uchar")), HasSubstr("not 'list'"));
  EXPECT_THAT(PlyErrorOf(With(ply, "vertex_indices", "indices")), HasSubstr("must have one list"));
  EXPECT_THAT(
      PlyErrorOf(With(ply, "comment x", "element face 0\nproperty list int int vertex_index")),
      HasSubstr("line 9: a second element 'face'"));
  const std::string early =
      With(With(ply, "element face 12\nproperty list uchar int vertex_indices\n", ""), "comment x",
           "element face 12\nproperty list uchar int vertex_indices");
  EXPECT_THAT(PlyErrorOf(early), HasSubstr("element face stands before element vertex"));
}

TEST(PlyMeshRefusal, HeadersHaveLimits) {
  std::string elements = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 10'001; ++i) absl::StrAppend(&elements, "element e", i, " 0\n");
  EXPECT_EQ(ReadPly(elements).status().code(), absl::StatusCode::kResourceExhausted);
  std::string words = "comment";
  for (int i = 0; i < 100; ++i) words += " x";
  EXPECT_TRUE(ReadPly(With(AsciiPly(), "comment x", words)).ok());
  EXPECT_THAT(PlyErrorOf(With(AsciiPly(), "property float z", "property float z z z z z z")),
              HasSubstr("line 7: expected a property"));
}

// Assimp reads such files for ever, or aborts.
TEST(PlyMeshRefusal, DamagedHeadersAndRowsAreRefused) {
  const std::string ply = AsciiPly();
  EXPECT_THAT(PlyErrorOf(ply.substr(0, ply.find("ent face"))), HasSubstr("header does not end"));
  EXPECT_THAT(PlyErrorOf(With(ply, "ascii 1.0",
                              "ascii 1.\xf7\xb6\xcd\xd9\xa3\xf6\xee"
                              "0")),
              HasSubstr("line 2: format ascii"));
  EXPECT_THAT(PlyErrorOf(With(ply, "3 4 5 7", "\x13 4 5 7")), HasSubstr("line 28"));
  EXPECT_THAT(PlyErrorOf(With(ply, "float x\n", "float x\v")), HasSubstr("line 5"));
  EXPECT_THAT(PlyErrorOf(With(ply, "element face", "elmment face")), HasSubstr("'elmment' in the"));
  EXPECT_THAT(PlyErrorOf(With(ply, "end_header", "end\x82\xee\xa4\xd0_header")),
              HasSubstr("line 10"));
}

}  // namespace
}  // namespace clearway
