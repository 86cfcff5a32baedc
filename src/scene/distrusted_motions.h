// Motions and poses of which two views show that they are wrong.
#pragma once

#include <set>

#include "clearway/scene/scene_builder.h"
#include "scene/earlier_views.h"
#include "scene/given_object.h"

namespace clearway {

// Takes out of the clues what is said of objects that the views distrust already. What is left
// then, LeaveOutMismatched judges.
void LeaveOutDistrusted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                        const SceneParams& params, EarlierViews& views, ClueMap& clues,
                        FrameReport& report);

// Takes out what the views contradict from this frame on, and returns the objects that have to
// begin anew: their map is a smear of views at poses that were said. The report names them.
std::set<ObjectId> LeaveOutMismatched(const SceneObjects& objects, const LabelledCloud& cloud,
                                      Time stamp, const SceneParams& params, EarlierViews& views,
                                      ClueMap& clues, FrameReport& report);

}  // namespace clearway
