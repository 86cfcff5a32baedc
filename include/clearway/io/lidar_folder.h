// Folders of labelled LiDAR scans with poses and boxes; the format is in docs/formats.md.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"

namespace clearway {

// Which of a folder's pairs of tables to read: poses.csv and objects.csv, poses_icp.csv and
// objects_icp.csv, or those of oxts. kAny: the first pair that is there, in this order. Those of
// oxts are of GPS and inertial sensors and drift: the frames' source says so.
enum class LidarPoses { kAny, kPlain, kIcp, kOxts };

// What frames say of the objects: world motions H_W = T_W_B(k) * T_W_B(k-1)^-1 (eq. 2), the
// boxes' poses T_W_B, or nothing.
enum class LidarObjects { kMotions, kPoses, kNone };

struct LidarFolderOptions {
  LidarPoses poses = LidarPoses::kAny;
  LidarObjects objects = LidarObjects::kMotions;
  // Motions begin at the first frame with a box that is at most so long before, or else at the
  // frame before. Over a longer time the noise of the boxes counts less in a velocity, and a turn
  // shows later.
  Duration motions_over = Duration::zero();
  int first_frame = 0;  // by the number in the tables; both ends belong to the range
  int last_frame = std::numeric_limits<int>::max();
  // Take a frame without a file of points for a scan without points; else it is an error.
  bool allow_missing_points = false;
  std::string sensor_id = "lidar";
};

// Where the sensor was at one frame.
struct RecordedPose {
  int frame = 0;
  Time stamp;
  Pose T_W_S;
};

// A labelled box: x along its length, z up, origin at its centre.
struct RecordedBox {
  int frame = 0;
  ObjectId id = 0;
  std::string type;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // length, width, height; 0 if not said
  Pose T_W_B;
  int n_points = 0;  // below 0 if the source does not say
};

// Rows of the tables that are left out, as if the tables did not have them.
struct RowsLeftOut {
  std::set<int> frames;                      // with all their boxes
  std::set<std::pair<int, ObjectId>> boxes;  // by frame and id

  bool Has(const RecordedPose& pose) const { return frames.contains(pose.frame); }
  bool Has(const RecordedBox& box) const {
    return frames.contains(box.frame) || boxes.contains({box.frame, box.id});
  }
};

// An opened folder, of these or of others that have poses and boxes. A value.
struct LidarFolder {
  // The frames of the range. Frame::sequence is the number in the tables, labels are track ids.
  // A motion is there when both boxes are, in frames of the range.
  FrameSource frames;
  // All of the tables, whatever the range: what really happened before and after.
  std::vector<RecordedPose> poses;  // ascending frames
  std::size_t first_pose = 0;       // frame k of the range has poses[first_pose + k]
  std::vector<RecordedBox> boxes;   // ascending (frame, id)
  // Frames of the range without a file of points, where they may be, and the file that is missing.
  std::vector<std::pair<int, std::filesystem::path>> missing_points;
  // The frames of the range of tables without these rows: only their number and how they are read.
  // Null if no reader made this.
  std::function<FrameSource(const RowsLeftOut&)> frames_without = nullptr;
};

// Reads the tables; points are read with each frame. Stamps are the column timestamp_ns, else
// 0.1 s times the frame's number. NOT_FOUND for a missing folder, table or file of points;
// INVALID_ARGUMENT for anything malformed, naming file, line and column, or the byte.
absl::StatusOr<LidarFolder> OpenLidarFolder(const std::filesystem::path& folder,
                                            const LidarFolderOptions& options = {});

}  // namespace clearway
