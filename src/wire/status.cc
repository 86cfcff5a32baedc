#include "wire/status.h"

#include <cctype>
#include <map>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/rpc/error_details.pb.h"

namespace clearway {
namespace {

constexpr char kTypePrefix[] = "type.googleapis.com/";
constexpr char kDomain[] = "clearway";

template <class Detail>
std::string TypeUrl() {
  return kTypePrefix + Detail::descriptor()->full_name();
}

template <class Detail>
std::optional<Detail> DetailOf(const absl::Status& status) {
  const auto payload = status.GetPayload(TypeUrl<Detail>());
  Detail detail;
  if (!payload || !detail.ParseFromString(std::string(*payload))) return std::nullopt;
  return detail;
}

template <class Detail>
void Attach(const Detail& detail, absl::Status& status) {
  status.SetPayload(TypeUrl<Detail>(), absl::Cord(detail.SerializeAsString()));
}

const char* DefaultReason(absl::StatusCode code) {
  switch (code) {
    case absl::StatusCode::kInvalidArgument:
      return "BAD_FIELD";
    case absl::StatusCode::kNotFound:
      return "NOT_FOUND";
    case absl::StatusCode::kAlreadyExists:
      return "ALREADY_EXISTS";
    case absl::StatusCode::kFailedPrecondition:
      return "WRONG_ORDER";
    case absl::StatusCode::kResourceExhausted:
      return "LIMIT_EXCEEDED";
    case absl::StatusCode::kUnavailable:
      return "UNAVAILABLE";
    case absl::StatusCode::kCancelled:
      return "CANCELLED";
    case absl::StatusCode::kDeadlineExceeded:
      return "DEADLINE_EXCEEDED";
    case absl::StatusCode::kUnimplemented:
      return "UNIMPLEMENTED";
    default:
      return "SERVER_FAULT";
  }
}

// Where the field at the start of the message ends; 0 if there is none.
std::size_t FieldEnd(const std::string& message) {
  std::size_t end = 0;
  const auto belongs = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '[' ||
           c == ']' || c == '=';
  };
  while (end < message.size() && belongs(message[end])) ++end;
  const bool separated = end < message.size() && absl::StrContains(":, ", message.substr(end, 1));
  const bool named = end > 0 && (std::islower(static_cast<unsigned char>(message[0])) != 0);
  return separated && named ? end : 0;
}

}  // namespace

absl::Status FieldError(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, ": ", what));
}

absl::Status LimitError(const std::string& field, std::uint64_t size, std::uint64_t limit) {
  return absl::ResourceExhaustedError(
      absl::StrCat(field, ": holds ", size, "; the limit is ", limit));
}

absl::Status WithFieldPrefix(const std::string& prefix, const absl::Status& status) {
  if (FieldOf(status).empty()) return status;
  absl::Status prefixed(status.code(), absl::StrCat(prefix, std::string(status.message())));
  status.ForEachPayload(
      [&](auto url, const absl::Cord& payload) { prefixed.SetPayload(url, payload); });
  return prefixed;
}

absl::Status WithReason(absl::Status status, const std::string& reason) {
  google::rpc::ErrorInfo info;
  info.set_reason(reason);
  info.set_domain(kDomain);
  Attach(info, status);
  return status;
}

std::string FieldOf(const absl::Status& status) {
  const std::string message(status.message());
  return message.substr(0, FieldEnd(message));
}

google::rpc::Status ToProto(const absl::Status& status) {
  google::rpc::Status proto;
  proto.set_code(static_cast<int>(status.code()));
  proto.set_message(std::string(status.message()));
  if (status.ok()) return proto;

  absl::Status detailed = status;
  if (!DetailOf<google::rpc::ErrorInfo>(status)) {
    detailed = WithReason(detailed, DefaultReason(status.code()));
  }
  if (const std::string field = FieldOf(status);
      status.code() == absl::StatusCode::kInvalidArgument && !field.empty()) {
    google::rpc::BadRequest bad;
    bad.add_field_violations()->set_field(field);
    bad.mutable_field_violations(0)->set_description(proto.message());
    Attach(bad, detailed);
  }
  if (absl::IsUnavailable(status) || absl::IsResourceExhausted(status)) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_nanos(absl::IsUnavailable(status) ? 500'000'000 : 100'000'000);
    Attach(retry, detailed);
  }
  std::map<std::string, std::string> details;  // absl keeps them in no certain order
  detailed.ForEachPayload([&](auto url, const absl::Cord& payload) {
    details[std::string(url)] = std::string(payload);
  });
  for (const auto& [url, payload] : details) {
    google::protobuf::Any* detail = proto.add_details();
    detail->set_type_url(url);
    detail->set_value(payload);
  }
  return proto;
}

absl::Status FromProto(const google::rpc::Status& proto) {
  if (proto.code() == 0) return absl::OkStatus();
  const bool canonical = proto.code() > 0 && proto.code() <= 16;
  absl::Status status(
      canonical ? static_cast<absl::StatusCode>(proto.code()) : absl::StatusCode::kUnknown,
      proto.message());
  for (const google::protobuf::Any& detail : proto.details()) {
    status.SetPayload(detail.type_url(), absl::Cord(detail.value()));
  }
  return status;
}

std::string ReasonOf(const absl::Status& status) {
  const auto info = DetailOf<google::rpc::ErrorInfo>(status);
  return info ? info->reason() : "";
}

std::string BadFieldOf(const absl::Status& status) {
  const auto bad = DetailOf<google::rpc::BadRequest>(status);
  return bad && bad->field_violations_size() > 0 ? bad->field_violations(0).field() : "";
}

std::optional<Duration> RetryDelayOf(const absl::Status& status) {
  const auto retry = DetailOf<google::rpc::RetryInfo>(status);
  if (!retry) return std::nullopt;
  return std::chrono::seconds(retry->retry_delay().seconds()) +
         Duration(retry->retry_delay().nanos());
}

}  // namespace clearway
