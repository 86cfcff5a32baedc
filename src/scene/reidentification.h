// Objects that were lost behind something and are seen again under another id.
#pragma once

#include <optional>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// What is known for longer is another object, or it would have been known again.
inline constexpr Duration kYoung = std::chrono::seconds(2);
inline bool IsYoung(const MovingObject& object, Time stamp) {
  return stamp - object.first_seen <= kYoung;
}

// What was not seen for so long has gone out of sight: longer than the time between two scans of a
// sensor, whatever other sensors see meanwhile.
inline constexpr Duration kOutOfSight = std::chrono::milliseconds(250);

// A flank without its ends: nobody knows where exactly it fits.
inline constexpr Duration kFirstGlimpse = std::chrono::milliseconds(600);

// Whether it is time to join it to what it was before. For a first glimpse is waited, unless it has
// gone out of sight.
bool IsToBeJoined(const MovingObject& object, Time stamp);

// How much may then be doubted that they are one, in parts of what is enough alone. Each scan shows
// more, and of another one of nearly the same shape first little to doubt: so of what was glimpsed
// little may be doubted, and more of what was looked at for longer.
double MayBeDoubted(const MovingObject& object);

// So far beyond what was seen of an object before there is hardly anything of it.
inline constexpr double kReachesBeyond_voxels = 3;

struct PlaceIfSame {
  Pose T_W_L;  // where `lost` was to be when `young` was first seen
  double tolerance_m;
  double height_tolerance_m;  // of that, along z of W
};

// None if `young` is nowhere near, whatever may be seen of it yet; if it could be another one like
// it, as poses are off by so much; or if that is beyond the horizon.
std::optional<PlaceIfSame> PlaceToBeSeenAgain(const MovingObject& lost, const MovingObject& young,
                                              const SceneParams& params);

// Where the frame L of `lost` is in the frame Y of `young` (T_Y_L) if that is the same object:
// where `young` was first seen its voxels fit those of `lost`, near where that one was to be then;
// both are about as large, as far as `young` was seen; and both go about alike. None if `young` may
// be another one, or one of them has been seen too little to tell. `lost` must not have been seen
// since `young` was first.
std::optional<Pose> SeenAgain(const MovingObject& lost, const MovingObject& young,
                              const SceneParams& params);

// How far above or below where it was to be `lost` would be then, in parts of what is tolerated.
// Infinite where PlaceToBeSeenAgain is none.
double HeightOff(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                 const SceneParams& params);

// Whether that may be so with L at T_Y_L: near where it was to be (HeightOff at most 1), the voxels
// fit there, and both are about as large.
bool FitsThere(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
               const SceneParams& params);

// `lost` as it goes on, at the stamp, with the voxels and poses of `young`, and with what was
// stated of its future. It keeps its id and its frame; the ids of `young` name it too.
MovingObject Joined(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                    Time stamp, const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
