// Random questions to load a server with.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "clearway/geometry/aabb.h"

namespace clearway {

// Where and when is asked. A plain value.
struct QuestionSpace {
  Aabb box_W;                  // positions, evenly
  Time from;                   // times, evenly from here on ...
  Duration span{0};            // ... to this much later,
  Duration step{100'000'000};  // in whole steps, as planners ask; zero: any time
};

// Random points and states; the same seed gives the same ones on every machine. One thread.
class RandomQuestions {
 public:
  RandomQuestions(const QuestionSpace& space, std::uint64_t seed) : space_(space), engine_(seed) {}

  std::vector<Eigen::Vector3f> Points(std::size_t count);
  std::vector<Time> Times(std::size_t count);
  // Each a pose of the robot's base R, turned about z, with every link at its place T_R_L.
  StateBatch States(std::size_t count, const std::vector<Pose>& T_R_L);

 private:
  double Uniform(double low, double high);
  Eigen::Vector3d Position();

  QuestionSpace space_;
  std::mt19937_64 engine_;
};

}  // namespace clearway
