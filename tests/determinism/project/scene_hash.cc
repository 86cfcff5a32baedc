// Prints the content of scenes, made of random frames with several parameters, as hashes.
#include <iostream>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

int main() {
  for (const bool variant : {false, true}) {
    clearway::SceneParams params;
    params.rays = {.max_range_m = 6, .discretize = variant};
    params.clear_objects_by_rays = variant;
    params.rest_distance_m = variant ? 0.5 : 0;
    params.keep_distance_m = variant ? 3 : 0;
    clearway::ThreadPool pool(2);
    clearway::SceneBuilder builder(params, {}, pool);
    clearway::testing_support::RandomFrames frames(variant);
    for (int k = 0; k < 25; ++k) {
      if (const auto report = builder.Apply(frames.Next()); !report.ok()) {
        std::cerr << report.status() << "\n";
        return 1;
      }
    }
    const clearway::ScenePtr scene = builder.Publish();
    std::cout << scene->static_map_W.observed_count() << " voxels, " << scene->objects.size()
              << " objects: " << scene->Hash() << "\n";
  }
}
