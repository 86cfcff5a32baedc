#include "clearway/io/left_out.h"

#include <utility>

namespace clearway {

void LeftOut::AddRow(std::string reason) {
  ++rows;
  if (reasons.size() < kMaxReasons) reasons.push_back(std::move(reason));
}

void LeftOut::AddFrame(std::string reason) {
  ++frames;
  if (reasons.size() < kMaxReasons) reasons.push_back(std::move(reason));
}

void LeftOut::Add(const LeftOut& other) {
  rows += other.rows;
  frames += other.frames;
  for (const std::string& reason : other.reasons) {
    if (reasons.size() < kMaxReasons) reasons.push_back(reason);
  }
}

}  // namespace clearway
