// Random damage to mesh files is refused or gives a mesh, and harms nobody.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "clearway/io/mesh_file.h"
#include "io/mesh_example.h"
#include "io/tetrahedra_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

constexpr int kMutants = 300;

class MeshMutation : public testing::Test {
 protected:
  void TryMutantsOf(const std::string& name, const std::string& whole) {
    ASSERT_TRUE(ReadMesh(folder_.Write(name, whole)).ok()) << name;
    for (int i = 0; i < kMutants; ++i) {
      const auto dut = ReadMesh(folder_.Write(name, Mutant(whole)));
      if (!dut.ok()) {
        EXPECT_NE(dut.status().message(), "");
        continue;
      }
      for (const auto& triangle : dut->triangles) {
        for (const std::uint32_t index : triangle) ASSERT_LT(index, dut->vertices.size()) << i;
      }
    }
  }

  TemporaryFolder folder_;

 private:
  std::size_t Below(std::size_t count) { return random_() % std::max<std::size_t>(count, 1); }

  // With one to three places changed, removed, doubled or cut off.
  std::string Mutant(std::string bytes) {
    for (std::size_t k = 1 + Below(3); k > 0 && !bytes.empty(); --k) {
      const std::size_t at = Below(bytes.size()), count = 1 + Below(8);
      switch (Below(5)) {
        case 0:
          bytes[at] = static_cast<char>(random_());
          break;
        case 1:
          bytes[at] = "0123456789-. \n"[Below(14)];
          break;
        case 2:
          bytes.erase(at, count);
          break;
        case 3:
          bytes.insert(Below(bytes.size()), bytes.substr(at, count));
          break;
        default:
          if (Below(4) == 0) bytes.resize(at);
      }
    }
    return bytes;
  }

  std::mt19937 random_{11};
};

TEST_F(MeshMutation, Ply) {
  TryMutantsOf("a.ply", AsciiPly());
  TryMutantsOf("a.ply", BinaryPly());
  TryMutantsOf("a.ply", BinaryPly(/*big_endian=*/true));
}

TEST_F(MeshMutation, Stl) {
  TryMutantsOf("a.stl", AsciiStl());
  TryMutantsOf("a.stl", BinaryStl());
}

TEST_F(MeshMutation, Obj) { TryMutantsOf("a.obj", kObj); }

TEST_F(MeshMutation, Off) { TryMutantsOf("a.off", Off()); }

TEST_F(MeshMutation, Collada) { TryMutantsOf("a.dae", Dae()); }

TEST_F(MeshMutation, Gltf) {
  folder_.Write("a.bin", GltfBuffer());
  TryMutantsOf("a.gltf", GltfText(GltfJson(), "a.bin"));
  TryMutantsOf("a.glb", Glb(GltfJson()));
}

// Deep trees use up the stack of whoever walks through them, long lists of attributes his time.
TEST_F(MeshMutation, FilesMadeToHarmAreRefused) {
  MeshFileOptions options;
  options.max_time = std::chrono::milliseconds(500);
  const auto expect_refused = [&](const std::string& name, const std::string& bytes) {
    const auto dut = ReadMesh(folder_.Write(name, bytes), options);
    EXPECT_FALSE(dut.ok()) << name;
  };
  std::string deep, nodes, ends, attributes;
  for (int i = 0; i < 300'000; ++i) {
    deep += "[";
    nodes += "<node>";
    ends += "</node>";
    attributes += absl::StrCat(" a", i, "='1'");
  }
  expect_refused("a.gltf", R"({"asset": {"version": "2.0"}, "extensionsRequired": [)" + deep +
                               std::string(deep.size(), ']') + "]}");
  expect_refused("a.dae", "<COLLADA version='1.4.1'><library_nodes>" + nodes + ends +
                              "</library_nodes></COLLADA>");
  expect_refused("a.dae", "<COLLADA version='1.4.1'" + attributes + "></COLLADA>");
}

}  // namespace
}  // namespace clearway
