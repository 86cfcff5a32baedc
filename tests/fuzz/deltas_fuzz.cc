// What a mirror gets. The first line says what it holds already: "empty" or "scene". Then the parts
// of deltas, each after its length (two bytes, the lower one first). A delta that can be applied
// gives a scene that can be read, and whose difference from nothing makes it again.
#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "fuzz/fuzz.h"
#include "support/frames.h"
#include "support/random_given.h"
#include "wire/delta_wire.h"

namespace clearway::fuzz {
namespace {

// Of the seeds: random frames with given objects.
ScenePtr MakeScene() {
  ThreadPool pool(1);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.2;
  params.solid = SolidMode::kCompletedHull;
  SceneBuilder builder(params, FrameLimits{}, pool);
  testing_support::RandomFrames frames(11);
  testing_support::Random given(11);
  for (int i = 0; i < 4; ++i) {
    RequireForeseen(builder.Apply(frames.Next()).status());
    testing_support::ChangeGivenRandomly(builder, given);
  }
  return builder.Publish();
}

std::string_view TakePart(std::string_view& input) {
  if (input.size() < 2) return input = {};
  const std::size_t size = static_cast<unsigned char>(input[0]) +
                           256 * static_cast<std::size_t>(static_cast<unsigned char>(input[1]));
  const std::string_view part = input.substr(2, size);
  input.remove_prefix(2 + part.size());
  return part;
}

void RequireReadable(const SceneSnapshot& scene) {
  const auto again = Apply(nullptr, Diff(nullptr, scene));
  Require(again.ok(), "the whole scene is no delta: " + again.status().ToString());
  Require(again->Hash() == scene.Hash(), "the whole scene makes another scene");
}

void Run(std::string_view input) {
  static const ScenePtr scene = MakeScene();
  const SceneSnapshot* const base = TakeLine(input) == "scene" ? scene.get() : nullptr;
  DeltaAssembler assembler;
  while (!input.empty()) {
    v1::SceneDeltaPart part;
    const std::string_view bytes = TakePart(input);
    if (!part.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return;
    const auto delta = assembler.Add(part);
    RequireForeseen(delta.status());
    if (!delta.ok()) return;
    if (!delta->has_value()) continue;
    const auto applied = Apply(base, **delta);
    RequireForeseen(applied.status());
    if (applied.ok()) RequireReadable(*applied);
    return;
  }
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
