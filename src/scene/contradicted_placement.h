// Motions and poses that an object's own points speak against.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "scene/earlier_views.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// Takes motions and poses out of the clues that put an object away from its points: its map would
// grow by what lies between. By how much is too far depends on what else speaks against them:
// - nothing: tens of metres, since the other end of a long object may come into sight;
// - the points fit the object where it was predicted: three times the 95 % bound and 0.15 m;
// - they spread wider than the object, turned as stated, but not as predicted: 0.5 m a side;
// - they are nearer to the prediction, within the bound: half the object's size and 1 m;
// - rays pass through it where it is said to be: its size and 1 m.
// The first and the third rest on the prediction. They count for three frames in a row: the side of
// a long object that fills what is seen of it looks alike wherever it goes, and the prediction may
// be what is wrong.
// The report names them. Without them an object is placed by prediction and its points, or begins
// anew (PlaceByPoints).
void LeaveOutContradicted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                          const SceneParams& params, EarlierViews& views, ClueMap& clues,
                          FrameReport& report);

}  // namespace clearway
