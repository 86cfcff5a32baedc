// What a source and a server have that does not go together well, as notes.
#pragma once

#include <ostream>

#include "clearway/io/frame_source.h"
#include "clearway/scene/scene_params.h"

namespace clearway::cli {

// Voxels of another size, poses that drift, an origin that was moved: a line each.
void PrintSourceNotes(const FrameSource& source, const SceneParams& params, std::ostream& err);

}  // namespace clearway::cli
