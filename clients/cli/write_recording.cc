#include "cli/write_recording.h"

#include "absl/strings/str_cat.h"
#include "clearway/io/file_type.h"
#include "clearway/io/recording.h"
#include "cli/message.h"
#include "cli/open_source.h"
#include "cli/progress.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

absl::StatusOr<Written> WriteAll(FrameReader& reader, FrameRange range, RecordingWriter& writer,
                                 const Terminal& terminal) {
  ProgressBar progress(terminal.err, terminal.err_is_terminal, range.size());
  Written written;
  absl::Status status;
  for (std::size_t k = range.first; k < range.end && status.ok() && !reader.stopped(); ++k) {
    const std::optional<Frame> frame = reader.Read(k);
    if (frame) {
      status = writer.Append(*frame);
      ++written.frames;
      written.points += frame->points_S.size();
    }
    progress.Update(written.frames + reader.unread(), written.points);
  }
  progress.Finish();
  if (status.ok() && (reader.stopped() || written.frames == 0)) status = reader.Result();
  if (status.ok()) status = writer.Close();
  if (!status.ok()) return status;
  return written;
}

}  // namespace

absl::Status CheckRecordingName(const std::string& out) {
  const std::string extension = LowerExtension(out);
  if (HasMapExtension(out) || extension == ".ply" || extension == ".pcd") {
    return UsageError(absl::StrCat("--out: '", out, "' is the name of a ",
                                   HasMapExtension(out) ? "map" : "point cloud",
                                   "; name a recording, as drive.cwr"));
  }
  if (out.starts_with("sim:")) {
    return UsageError(absl::StrCat("--out: '", out, "' names a simulation, not a file"));
  }
  return absl::OkStatus();
}

absl::StatusOr<Written> WriteRecording(const FrameSource& source, FrameReader& reader,
                                       FrameRange range, const std::string& path, bool overwrite,
                                       const Terminal& terminal) {
  RecordingOptions options;
  options.description = source.description;
  options.resolution_m = source.resolution_m;
  options.origin_m = source.origin_m;
  options.overwrite = overwrite;
  auto writer = RecordingWriter::Create(path, options);
  if (absl::IsAlreadyExists(writer.status())) {
    return absl::AlreadyExistsError(absl::StrCat(path, " exists; --force replaces it"));
  }
  if (!writer.ok()) return writer.status();
  return WriteAll(reader, range, **writer, terminal);
}

void PrintWritten(std::ostream& out, const std::string& path, const Written& written) {
  out << "wrote " << path << ": " << Plural(written.frames, "frame") << ", "
      << Plural(written.points, "point") << "\n"
      << "send it to a server with: clearway replay " << ShellQuoted(path) << "\n";
}

}  // namespace clearway::cli
