#include "planning/interval_search.h"

#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

// What is not worth the trouble: arrivals are told apart to this.
constexpr double kSoon_s = 1e-3;

}  // namespace

std::vector<Stay> IntervalSearch::Find(const Question& question) {
  question_ = &question;
  stays_.clear();
  open_.clear();
  stays_at_.assign(roadmap_.size(), {});
  KnowPlaces();
  left_s_.assign(roadmap_.size(), std::nullopt);
  for (const auto& [place, seconds] : question.starts) AddStay(place, seconds, -1, seconds);
  const std::size_t before = checks_.ways_asked();
  const auto enough = [&] { return checks_.ways_asked() - before >= question.most_ways; };
  while (!open_.empty() && !enough() && !question.cancelled()) {
    std::pop_heap(open_.begin(), open_.end());
    const Candidate next = open_.back();
    open_.pop_back();
    if (!Follow(next)) continue;
    std::vector<Stay> path;
    for (int at = static_cast<int>(stays_.size()) - 1; at >= 0; at = stays_[at].before) {
      path.push_back(stays_[at]);
    }
    std::ranges::reverse(path);
    return path;
  }
  return {};
}

double IntervalSearch::LeftSeconds(std::size_t place) {
  if (left_s_[place]) return *left_s_[place];
  double left_s = std::numeric_limits<double>::infinity();
  for (const std::size_t goal : question_->goals) {
    left_s = std::min(left_s, roadmap_.Seconds(place, goal));
  }
  left_s_[place] = left_s;
  return left_s;
}

void IntervalSearch::Propose(int stay, const Roadmap::Neighbor& to, double depart_s) {
  const Stay& from = stays_[stay];
  if (depart_s > from.leave_by_s || never_.contains({from.place, to.place})) return;
  const double arrival_s = depart_s + to.seconds;
  const double left_s = LeftSeconds(to.place);
  const double goal_s = arrival_s + left_s;
  if (goal_s >= question_->earlier_than_s || goal_s > space_.latest_s()) return;
  open_.push_back({arrival_s + question_->weight * left_s, stay, to, depart_s});
  std::push_heap(open_.begin(), open_.end());
}

// A greedy search comes to a safe interval once, however late.
std::optional<double> IntervalSearch::HeldUntil(std::size_t place, double arrival_s) const {
  if (stays_at_[place].empty()) return std::nullopt;
  const bool greedy = question_->weight > 1;
  const double waits_until_s =
      greedy ? KnownUntil(place, arrival_s).value_or(arrival_s) : arrival_s;
  for (const int i : stays_at_[place]) {
    const Stay& stay = stays_[i];
    if (stay.arrival_s <= waits_until_s && arrival_s <= stay.leave_by_s) return stay.leave_by_s;
  }
  return std::nullopt;
}

std::optional<double> IntervalSearch::KnownUntil(std::size_t place, double arrival_s) const {
  for (const auto& [from_s, until_s] : held_[place]) {
    if (from_s <= arrival_s && arrival_s <= until_s) return until_s;
  }
  return std::nullopt;
}

double IntervalSearch::LeaveBy(std::size_t place, double arrival_s) {
  if (const auto known_s = KnownUntil(place, arrival_s)) return *known_s;
  const double until_s = checks_.FreeUntil(roadmap_.Place(place), arrival_s, space_.latest_s());
  held_[place].emplace_back(arrival_s, until_s);
  return until_s;
}

void IntervalSearch::KnowPlaces() {
  held_.resize(roadmap_.size());
  taken_.resize(roadmap_.size());
}

double IntervalSearch::FreeFrom(std::size_t place, double arrival_s,
                                const std::function<bool()>* cancelled) {
  KnowPlaces();
  if (KnownUntil(place, arrival_s)) return arrival_s;
  double from_s = arrival_s;
  for (const auto& [taken_s, until_s, closely] : taken_[place]) {
    if (taken_s <= from_s && from_s < until_s) from_s = until_s;
  }
  const bool known = from_s > arrival_s;
  if (std::isinf(from_s) || (known && cancelled == nullptr)) return from_s;
  // A search that was cancelled goes on where it had come to.
  const ompl::base::State* const part = roadmap_.Place(place);
  const double free_s = cancelled == nullptr
                            ? checks_.FreeFrom(part, from_s)
                            : checks_.FreeFromClosely(part, from_s, space_.latest_s(), *cancelled);
  if (free_s > from_s) taken_[place].push_back({from_s, free_s, cancelled != nullptr});
  return free_s;
}

bool IntervalSearch::LookFiner() {
  if (!checks_.LookFiner()) return false;
  for (auto& intervals : taken_) {
    std::erase_if(intervals, [](const Taken& taken) { return !taken.closely; });
  }
  absl::erase_if(answers_, [](const auto& entry) { return !entry.second.free; });
  return true;
}

bool IntervalSearch::AddStay(std::size_t place, double arrival_s, int before, double departed_s) {
  const double leave_by_s = LeaveBy(place, arrival_s);
  const int stay = static_cast<int>(stays_.size());
  stays_.push_back({place, arrival_s, leave_by_s, before, departed_s});
  stays_at_[place].push_back(stay);
  if (std::ranges::find(question_->goals, place) != question_->goals.end()) {
    const auto there_s = question_->arrives(place, arrival_s, leave_by_s);
    if (there_s && *there_s < question_->earlier_than_s) {
      if (*there_s > arrival_s) stays_.push_back({place, *there_s, leave_by_s, stay, arrival_s});
      return true;
    }
  }
  const auto& near = roadmap_.Near(place);
  for (const Roadmap::Neighbor& to : near) Propose(stay, to, arrival_s);
  for (const std::size_t goal : question_->goals) {
    const bool proposed = std::ranges::find(near, goal, &Roadmap::Neighbor::place) != near.end();
    if (goal == place || proposed) continue;
    Propose(stay, {goal, roadmap_.Seconds(place, goal)}, arrival_s);
  }
  return false;
}

const WayAnswer& IntervalSearch::Ask(std::size_t from, std::size_t to, double depart_s,
                                     double arrival_s) {
  const auto [entry, fresh] =
      answers_.try_emplace({{from, to}, std::llround(1e9 * depart_s)}, WayAnswer{});
  if (fresh) {
    entry->second = checks_.Way(roadmap_.Place(from), roadmap_.Place(to), depart_s, arrival_s);
  }
  return entry->second;
}

bool IntervalSearch::Follow(const Candidate& candidate) {
  const auto [priority, stay, to, depart_s] = candidate;
  const std::size_t from = stays_[stay].place;
  const double arrival_s = depart_s + to.seconds;
  if (const auto held_until_s = HeldUntil(to.place, arrival_s)) {
    // Nothing is gained but by the next time that the place is free.
    Propose(stay, to, *held_until_s - to.seconds + kSoon_s);
    return false;
  }
  const bool goal = std::ranges::find(question_->goals, to.place) != question_->goals.end();
  const double free_s = FreeFrom(to.place, arrival_s, goal ? &question_->cancelled : nullptr);
  if (free_s > arrival_s) {
    Propose(stay, to, free_s - to.seconds + kSoon_s);
    return false;
  }
  const WayAnswer answer = Ask(from, to.place, depart_s, arrival_s);
  if (answer.free) {
    if (AddStay(to.place, arrival_s, stay, depart_s)) return true;
    Propose(stay, to, stays_.back().leave_by_s - to.seconds + kSoon_s);
  } else if (answer.never) {
    never_.insert({from, to.place});
    never_.insert({to.place, from});
  } else {
    Propose(stay, to, std::max(depart_s + 10 * kSoon_s, answer.not_before_s));
  }
  return false;
}

}  // namespace clearway
