#include "cli/state_list.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "clearway/base/file.h"
#include "clearway/geometry/unit_quaternion.h"

namespace clearway::cli {
namespace {

const std::vector<std::string> kColumns = {"x", "y", "z", "yaw", "qx", "qy", "qz", "qw", "t"};

Eigen::Quaterniond Yaw(double yaw_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  for (const auto field : absl::StrSplit(line, ',')) {
    fields.emplace_back(absl::StripAsciiWhitespace(field));
  }
  return fields;
}

// One line, its fields named by the header.
class Row {
 public:
  Row(const std::vector<std::string>& header, const std::vector<std::string>& fields,
      const std::string& where)
      : header_(header), fields_(fields), where_(where) {}

  bool Has(const char* column) const { return Find(column) != header_.end(); }
  const std::string& Text(const char* column) const {
    return fields_[Find(column) - header_.begin()];
  }
  // NaN after an error, which status() then tells.
  double Number(const char* column) {
    const auto number = ParseFinite(Text(column));
    if (number.ok()) return *number;
    Fail(column, number.status());
    return std::nan("");
  }
  void Fail(const char* column, const absl::Status& status) {
    status_.Update(absl::InvalidArgumentError(
        absl::StrCat(where_, ", column ", column, ": ", status.message())));
  }
  const absl::Status& status() const { return status_; }

 private:
  std::vector<std::string>::const_iterator Find(const char* column) const {
    return std::find(header_.begin(), header_.end(), column);
  }

  const std::vector<std::string>& header_;
  const std::vector<std::string>& fields_;
  const std::string where_;
  absl::Status status_;
};

absl::StatusOr<TimedBase> StateOf(Row row) {
  TimedBase state;
  state.T_W_R.translation = {row.Number("x"), row.Number("y"), row.Number("z")};
  if (row.Has("yaw")) {
    state.T_W_R.rotation = Yaw(row.Number("yaw"));
  } else {
    const double x = row.Number("qx"), y = row.Number("qy"), z = row.Number("qz");
    const Eigen::Quaterniond q(row.Number("qw"), x, y, z);
    if (!IsNearlyUnit(q)) {
      row.Fail("qx", absl::InvalidArgumentError(absl::StrCat("the quaternion ", NotUnitText(q))));
    }
    state.T_W_R.rotation = q.normalized();
  }
  if (row.Has("t")) {
    const auto time = ParseTime(row.Text("t"));
    if (time.ok()) {
      state.time = *time;
    } else {
      row.Fail("t", time.status());
    }
  }
  if (!row.status().ok()) return row.status();
  return state;
}

absl::Status CheckHeader(const std::string& where, const std::vector<std::string>& header) {
  const auto has = [&header](const char* column) {
    return std::find(header.begin(), header.end(), column) != header.end();
  };
  for (const std::string& column : header) {
    const bool known = std::find(kColumns.begin(), kColumns.end(), column) != kColumns.end();
    if (!known || std::count(header.begin(), header.end(), column) > 1) {
      return absl::InvalidArgumentError(
          absl::StrCat(where, ": column '", column, "' is ", known ? "named twice" : "not known"));
    }
  }
  const bool quaternion = has("qx") && has("qy") && has("qz") && has("qw");
  const bool any_quaternion = has("qx") || has("qy") || has("qz") || has("qw");
  if (!has("x") || !has("y") || !has("z") || has("yaw") == any_quaternion ||
      quaternion != any_quaternion) {
    return absl::InvalidArgumentError(absl::StrCat(
        where, ": expected the columns x,y,z, then yaw or qx,qy,qz,qw, and t if wanted"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<TimedBase> ParseState(const std::string& text) {
  const std::vector<std::string> fields = Fields(text);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 4); ++i) {
    const auto number = ParseFinite(fields[i]);
    if (number.ok()) numbers.push_back(*number);
  }
  if (numbers.size() != 4 || fields.size() > 5) {
    return absl::InvalidArgumentError(absl::StrCat(
        "expected x,y,z,yaw or x,y,z,yaw,t (metres, radians, seconds), not '", text, "'"));
  }
  TimedBase state;
  state.T_W_R = {Yaw(numbers[3]), {numbers[0], numbers[1], numbers[2]}};
  if (fields.size() == 5) {
    const auto time = ParseTime(fields[4]);
    if (!time.ok()) return time.status();
    state.time = *time;
  }
  return state;
}

absl::StatusOr<std::vector<TimedBase>> ReadStates(const std::string& name, std::string_view bytes) {
  const auto text = WithoutByteOrderMark(name, bytes);
  if (!text.ok()) return text.status();
  std::vector<TimedBase> states;
  std::vector<std::string> header;
  int number = 0;
  for (std::string_view rest = *text; !rest.empty();) {
    ++number;
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
      return absl::InvalidArgumentError(absl::StrCat(
          name, ", line ", number, ": the last line does not end: the file seems cut off"));
    }
    std::string line(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    absl::StripAsciiWhitespace(&line);
    if (line.empty() || line.front() == '#') continue;
    const std::string where = absl::StrCat(name, ", line ", number);
    const std::vector<std::string> fields = Fields(line);
    if (header.empty()) {
      header = fields;
      if (const absl::Status status = CheckHeader(where, header); !status.ok()) return status;
      continue;
    }
    if (fields.size() != header.size()) {
      return absl::InvalidArgumentError(
          absl::StrCat(where, ": has ", fields.size(), " fields, the header has ", header.size()));
    }
    const auto state = StateOf(Row(header, fields, where));
    if (!state.ok()) return state.status();
    states.push_back(*state);
  }
  if (states.empty()) return absl::InvalidArgumentError(absl::StrCat(name, ": holds no states"));
  return states;
}

StateBatch BatchOf(const std::vector<TimedBase>& states, const std::vector<Pose>& T_R_L,
                   Time newest) {
  StateBatch batch;
  for (const TimedBase& state : states) {
    batch.times.push_back(state.time.At(newest));
    for (const Pose& T_R_Li : T_R_L) batch.T_W_L.push_back(state.T_W_R * T_R_Li);
  }
  return batch;
}

}  // namespace clearway::cli
