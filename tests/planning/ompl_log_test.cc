#include "clearway/planning/ompl_log.h"

#include <gmock/gmock.h>
#include <ompl/util/Console.h>

#include <utility>
#include <vector>

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(OmplLog, MessagesGoWhereTheProgramWantsThem) {
  std::vector<std::pair<OmplLevel, std::string>> dut;
  WriteOmplLog([&](OmplLevel level, const std::string& text) { dut.emplace_back(level, text); });
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  OMPL_INFORM("Inferred cell size %d", 3);
  OMPL_WARN("slow");
  OMPL_ERROR("bad");
  EXPECT_THAT(dut, ElementsAre(Pair(OmplLevel::kInfo, "Inferred cell size 3"),
                               Pair(OmplLevel::kWarning, "slow"), Pair(OmplLevel::kError, "bad")));
  EXPECT_THAT(testing::internal::GetCapturedStdout(), IsEmpty());
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
  ompl::msg::noOutputHandler();
}

}  // namespace
}  // namespace clearway
