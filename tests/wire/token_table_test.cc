#include "clearway/wire/token_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

using testing::HasSubstr;

TEST(TokenTable, Empty) {
  for (const char* text : {"", "\n", "# nobody\n\n  \t\n"}) {
    const auto dut = TokenTable::Parse("tokens", text);
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_TRUE(dut->entries().empty());
    EXPECT_EQ(dut->FindToken(""), nullptr);
    EXPECT_EQ(dut->FindCertificate(""), nullptr);
  }
}

TEST(TokenTable, FindsWhoATokenBelongsTo) {
  const auto slam = MakeToken("slam", Role::kPush), ops = MakeToken("ops", Role::kAdmin);
  ASSERT_TRUE(slam.ok() && ops.ok());
  const auto dut = TokenTable::Parse("tokens", "# comment\n" + slam->line + "  # the car\r\n\n\t" +
                                                   ops->line + "\nfleet read certificate");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_NE(dut->FindToken(slam->token), nullptr);
  EXPECT_EQ(dut->FindToken(slam->token)->name, "slam");
  EXPECT_EQ(dut->FindToken(slam->token)->role, Role::kPush);
  EXPECT_EQ(dut->FindToken(ops->token)->role, Role::kAdmin);
  for (const std::string& wrong :
       {std::string(), slam->token.substr(1), slam->token + " ", slam->line, std::string("slam"),
        MakeToken("slam", Role::kPush)->token}) {
    EXPECT_EQ(dut->FindToken(wrong), nullptr) << wrong;
  }
  ASSERT_NE(dut->FindCertificate("fleet"), nullptr);
  EXPECT_EQ(dut->FindCertificate("fleet")->role, Role::kRead);
  EXPECT_EQ(dut->FindCertificate("slam"), nullptr) << "has a token";
  EXPECT_EQ(dut->FindCertificate("Fleet"), nullptr);
}

TEST(TokenTable, ErrorsNameTheLine) {
  const std::string good = MakeToken("a", Role::kRead)->line;
  std::vector<std::pair<std::string, std::string>> wrong = {
      {"slam push", "has 2 words"},
      {"sl/am push certificate", "is not a name"},
      {"slam Push certificate", "is not a role"},
      {"slam root certificate", "is not a role"},
      {"slam push sha256:12", "64 hexadecimal digits"},
      {"slam push secret", "64 hexadecimal digits"}};
  wrong.emplace_back(good + " more", "has 4 words");
  wrong.emplace_back(good, "is there twice");
  wrong.emplace_back(absl::StrCat(std::string(65, 'a'), " push certificate"), "is not a name");
  const std::string zeros(64, '0'), letters(64, 'g');
  wrong.emplace_back(absl::StrCat("slam push sha256:", letters), "64 hexadecimal digits");
  wrong.emplace_back(absl::StrCat("slam push sha1:", zeros), "64 hexadecimal digits");
  for (const auto& [line, part] : wrong) {
    const absl::Status status = TokenTable::Parse("tokens", good + "\n" + line + "\n").status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << line;
    EXPECT_THAT(std::string(status.message()), HasSubstr("tokens, line 2: "));
    EXPECT_THAT(std::string(status.message()), HasSubstr(part));
  }
}

TEST(TokenTable, TokensDiffer) {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) tokens.insert(MakeToken("a", Role::kRead)->token);
  EXPECT_EQ(tokens.size(), 1000u);
  EXPECT_GE(tokens.begin()->size(), 43u) << "256 bits";
}

TEST(TokenTable, NamesAreWords) {
  for (const char* name : {"", "a b", "a\n", "#a", "a\x1b[0m", "\xC3\xA4"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(MakeToken(name, Role::kRead).status())) << name;
  }
  EXPECT_TRUE(MakeToken("Robot-7.planner_1@site", Role::kRead).ok());
}

}  // namespace
}  // namespace clearway
