#include "clearway/io/ucy_people.h"

#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/word_table.h"

namespace clearway {
namespace {

constexpr WordFormat kFormat{.last = LastLine::kEnds, .separators = Separators::kCommasToo};
constexpr std::size_t kWords = 8;
constexpr double kMaxFrame = 1e9, kMaxId = 1e9;

absl::StatusOr<UcyPerson> TakePerson(Row& row) {
  if (row.size() != kWords) return row.WrongCount("eight: frame, id, x, z, y, vx, vz, vy");
  UcyPerson person;
  person.line = row.line();
  person.frame = row.NumberWithin(0, kMaxFrame);
  const double id = row.NumberWithin(1, kMaxId);
  person.p_W_m = {row.Coordinate(2), row.Coordinate(4)};
  person.v_W_mps = {row.Number(5), row.Number(7)};
  row.CheckNumbers(3, 4);
  row.CheckNumbers(6, 7);
  if (!row.status().ok()) return row.status();
  if (id != std::floor(id)) row.Fail(1, "a person's number");
  person.id = static_cast<int>(id);
  return person;
}

}  // namespace

absl::StatusOr<std::vector<UcyPerson>> ReadUcyPeople(const std::filesystem::path& path,
                                                     LeftOut& left_out) {
  std::vector<UcyPerson> people;
  std::map<std::pair<int, double>, int> lines;  // by id and frame
  const auto visit = [&](Row& row) -> absl::Status {
    const absl::StatusOr<UcyPerson> person = TakePerson(row);
    if (!person.ok() || !row.status().ok()) return person.status();
    const auto [first, is_new] = lines.try_emplace({person->id, person->frame}, row.line());
    if (!is_new) {
      return row.Error(absl::StrCat("a second row of person ", person->id, " in frame ",
                                    person->frame, "; the first: line ", first->second));
    }
    people.push_back(*person);
    return absl::OkStatus();
  };
  if (auto status = VisitWords(path, kFormat, left_out, visit); !status.ok()) return status;
  return people;
}

}  // namespace clearway
