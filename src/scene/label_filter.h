// Points that a segmentation gave a wrong label.
#pragma once

#include <cstddef>

#include "scene/given_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// Doubts the labels (SceneParams::filter_labels) that the points around do not bear out, those of
// an object's few points that lie apart from all its others, and "static" in a voxel that an object
// of the scene is predicted to fill. Such points block their rays and hit nothing. Returns how
// many.
std::size_t LeaveOutDoubtful(const SceneObjects& objects, Time stamp, const SceneParams& params,
                             LabelledCloud& cloud);

}  // namespace clearway
