#include "cli/source_notes.h"

#include "clearway/base/number_text.h"
#include "clearway/io/world_origin.h"
#include "clearway/map/resolution.h"

namespace clearway::cli {
namespace {

// Not an error: coarser maps are often wanted.
void NoteResolution(const FrameSource& source, const SceneParams& params, std::ostream& err) {
  if (SameResolution(source.resolution_m, params.resolution_m)) return;
  err << "note: these frames suit voxels of " << NumberText(source.resolution_m)
      << " m; the server has " << NumberText(params.resolution_m)
      << " m (clearway-server --scene-resolution-m)\n";
}

// Not an error either: it costs time to register scans.
void NotePoseError(const FrameSource& source, const SceneParams& params, std::ostream& err) {
  const bool drift = source.sensor_pose_error_m > 0 || source.sensor_pose_error_rad > 0;
  if (!drift || params.MendsSensorPoses()) return;
  err << "note: the sensor's poses are off by about " << source.sensor_pose_error_m
      << " m; the server takes them as they are (clearway-server --scene-sensor-pose-error-m "
      << source.sensor_pose_error_m << " --scene-sensor-pose-error-rad "
      << source.sensor_pose_error_rad << " registers scans to the map)\n";
}

// The server's maps are where the frames are.
void NoteOrigin(const FrameSource& source, std::ostream& err) {
  if (source.origin_m.isZero(0)) return;
  const std::string origin = OriginText(source.origin_m);
  err << "note: the origin " << origin << " is subtracted; clearway export --format ply --origin "
      << origin << " adds it to a map\n";
}

}  // namespace

void PrintSourceNotes(const FrameSource& source, const SceneParams& params, std::ostream& err) {
  NoteResolution(source, params, err);
  NotePoseError(source, params, err);
  NoteOrigin(source, err);
}

}  // namespace clearway::cli
