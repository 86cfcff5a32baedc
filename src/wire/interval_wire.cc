#include "wire/interval_wire.h"

#include "absl/strings/str_cat.h"
#include "wire/check_wire.h"
#include "wire/geometry_wire.h"
#include "wire/motion_wire.h"

namespace clearway {
namespace {

void Write(const TimeInterval& interval, v1::TimeWindow* proto) {
  proto->set_from_ns(ToNanoseconds(interval.from));
  proto->set_until_ns(ToNanoseconds(interval.until));
}

TimeInterval ReadWindow(bool present, const v1::TimeWindow& proto, FieldReader& read) {
  read.Require(present, "window", "is missing");
  return {TimeFromNanoseconds(proto.from_ns()), TimeFromNanoseconds(proto.until_ns())};
}

}  // namespace

void Write(std::span<const Pose> T_W_L, const TimeInterval& window,
           const SafeIntervalOptions& options, v1::FindSafeIntervalsRequest* proto) {
  Write(options.check, proto->mutable_options());
  Write(window, proto->mutable_window());
  proto->set_look_every_ns(options.look_every.count());
  for (const Pose& pose : T_W_L) Append(pose, proto->mutable_world_from_link());
}

absl::StatusOr<SafeIntervalQuestion> ReadSafeIntervalQuestion(
    const v1::FindSafeIntervalsRequest& proto, std::size_t links, const ServerLimits& limits) {
  absl::StatusOr<CheckOptions> check = ReadCheckOptions("options", proto.options(), limits);
  if (!check.ok()) return check.status();
  SafeIntervalQuestion question;
  question.options.check = *std::move(check);
  if (proto.has_look_every_ns()) question.options.look_every = Duration(proto.look_every_ns());
  FieldReader read;
  question.window = ReadWindow(proto.has_window(), proto.window(), read);
  const std::size_t configurations = proto.world_from_link().translations_m_size() / (3 * links);
  read.AtMost("world_from_link", configurations, limits.max_states_per_batch);
  if (read.ok()) {
    question.T_W_L = read.Poses("world_from_link", proto.world_from_link(), configurations * links);
  }
  if (!read.ok()) return read.status();
  return question;
}

void Write(const TimeInterval& window, const DepartureIntervalOptions& options,
           v1::FindDepartureIntervalsRequest* proto) {
  Write(options.motion, proto->mutable_motions());
  Write(window, proto->mutable_window());
  proto->set_resolution_ns(options.resolution.count());
}

absl::StatusOr<TimeInterval> ReadDepartureWindow(const v1::FindDepartureIntervalsRequest& proto) {
  FieldReader read;
  const TimeInterval window = ReadWindow(proto.has_window(), proto.window(), read);
  if (!read.ok()) return read.status();
  return window;
}

Duration ReadResolution(const v1::FindDepartureIntervalsRequest& proto) {
  return proto.has_resolution_ns() ? Duration(proto.resolution_ns())
                                   : DepartureIntervalOptions{}.resolution;
}

void Write(const std::vector<std::vector<TimeInterval>>& intervals, v1::TimeIntervals* proto) {
  for (const std::vector<TimeInterval>& of_item : intervals) {
    proto->add_counts(static_cast<std::uint32_t>(of_item.size()));
    for (const TimeInterval& interval : of_item) {
      proto->add_from_ns(ToNanoseconds(interval.from));
      proto->add_until_ns(ToNanoseconds(interval.until));
    }
  }
}

absl::StatusOr<std::vector<std::vector<TimeInterval>>> ReadTimeIntervals(
    const v1::TimeIntervals& proto, std::size_t items) {
  std::uint64_t all = 0;
  for (const std::uint32_t count : proto.counts()) all += count;
  const auto fits = [](int size, std::uint64_t wanted) {
    return static_cast<std::uint64_t>(size) == wanted;
  };
  if (!fits(proto.counts_size(), items) || !fits(proto.from_ns_size(), all) ||
      !fits(proto.until_ns_size(), all)) {
    return absl::InternalError(absl::StrCat(
        "the server's reply does not have the intervals of each of ", items, " items"));
  }
  std::vector<std::vector<TimeInterval>> intervals(items);
  int next = 0;
  for (std::size_t i = 0; i < items; ++i) {
    for (std::uint32_t left = proto.counts(static_cast<int>(i)); left > 0; --left, ++next) {
      intervals[i].push_back(
          {TimeFromNanoseconds(proto.from_ns(next)), TimeFromNanoseconds(proto.until_ns(next))});
    }
  }
  return intervals;
}

}  // namespace clearway
