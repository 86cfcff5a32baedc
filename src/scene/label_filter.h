// Points that a segmentation gave a wrong label.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "scene/given_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

struct LabelDoubts {
  std::size_t doubted = 0;                  // points
  std::vector<Eigen::Vector3f> believed_W;  // static ones where an object may be
};

// Doubts the labels (SceneParams::filter_labels) that the points around do not bear out, those of
// an object's few points that lie apart from all its others, and "static" beside an object's point
// in a voxel that an object of the scene is predicted to fill. Such points block their rays and hit
// nothing.
LabelDoubts LeaveOutDoubtful(const SceneObjects& objects, Time stamp, const SceneParams& params,
                             LabelledCloud& cloud);

}  // namespace clearway
