// Notes what a frame's report says of single objects.
#pragma once

#include "clearway/scene/scene_builder.h"

namespace clearway {

// Counts the issue, and lists it unless the report lists kMaxObjectIssues already.
void AddIssue(const ObjectIssue& issue, FrameReport& report);

}  // namespace clearway
