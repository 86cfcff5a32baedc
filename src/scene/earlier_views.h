// Views of the last two seconds, and what was said of their objects since.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "scene/compared_views.h"
#include "scene/given_object.h"
#include "scene/object_update.h"

namespace clearway {

// Tells whether the motions and poses that a source states agree with what is seen of the objects:
// from one frame to the next errors are small, but they add up. A value; copies share the clouds.
class EarlierViews {
 public:
  // Whether views contradicted what is said of the object, and have not agreed with it since for as
  // long as it took to tell: for 1 to 1.5 s.
  bool Distrusts(ObjectId id) const { return distrusted_.contains(id); }

  // Whether a frame is late: it is not judged.
  bool IsLate(Time stamp) const { return stamp < newest_; }

  // What speaks against the clue, which has a motion or pose, or did when it was distrusted.
  // `bound` is that of predictions by what is said.
  std::optional<Mismatch> Judge(ObjectId id, const ObjectClue& clue, const PositionBound& bound,
                                const LabelledCloud& cloud, Time stamp, const SceneParams& params);

  // Whether a prediction alone may speak against what is said of the object: not after it did so
  // in three frames in a row.
  bool MayDoubt(ObjectId id) const;
  void NoteDoubt(ObjectId id, Time stamp, bool doubted);

  // Ends a frame, after which the scene has those objects. Keeps its cloud if it is time for
  // another view, and forgets old ones.
  void Keep(LabelledCloud cloud, Time stamp, const SceneObjects& objects);

 private:
  // Where an object went since a view, the newest last.
  struct Moved {
    Time until;
    Pose H_W;
  };
  struct Said {
    std::vector<Moved> moved;   // never empty
    std::optional<Pose> T_W_B;  // at the view

    void Add(const Moved& step);
  };
  struct View {
    Time stamp;
    std::shared_ptr<const LabelledCloud> cloud;
    std::map<ObjectId, Said> said;
  };
  struct Distrust {
    Mismatch mismatch;
    Time judged_at;
    Duration least;  // for which it has to be right
  };

  struct Doubts {
    int in_a_row = 0;
    Time newest;
  };

  // H_W from the view on; none if a motion between is missing.
  static std::optional<Pose> Followed(const ObjectClue& clue, Time stamp, Said& said);
  std::optional<Distrust> MismatchWithViews(ObjectId id, const ObjectClue& clue,
                                            const PositionBound& bound, const LabelledCloud& cloud,
                                            Time stamp, const SceneParams& params);
  // Where a motion was left out for another reason, the object went as the scene has it.
  void GoOn(const MovingObject& object, Time stamp);
  void ForgetViews(Time stamp);
  bool IsTimeFor(const LabelledCloud& cloud, Time stamp) const;

  std::vector<View> views_;  // the oldest first
  std::map<ObjectId, Distrust> distrusted_;
  std::map<ObjectId, Doubts> doubts_;
  std::map<ObjectId, Pose> T_W_B_now_;  // of the frame that is judged
  Time newest_ = Time::min();
};

}  // namespace clearway
