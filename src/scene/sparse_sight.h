// What the beams of a sparse sensor leave out of an object.
#pragma once

#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// How far beams are apart, one above the other: half of what they look at there, or more, lies
// between such as are so far apart or farther.
struct BeamsApart {
  double rad = 0, m = 0;  // by the sensor, and at the object
};

// Of those that come through the box about the object's voxels at that stamp, by the rays of that
// stamp's cloud, from their own origins, one degree of azimuth after the other. z of O must point
// up. What hides less than half of the object's height makes no difference. Where no two beams come
// through above each other nobody knows: then it is 0. Metres are of how far the object is from
// where the first ray begins.
BeamsApart BeamsApartAt(const MovingObject& object, const LabelledCloud& cloud, Time stamp,
                        const SceneParams& params);

// Of an object's heights (layers of voxels across z of O, from the lowest that was hit to the
// highest, in all scans so far), the share that was not hit.
double ShareOfHeightsMissed(const MovingObject& object);

}  // namespace clearway
