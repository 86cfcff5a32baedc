#include "server/access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/status.h"

namespace clearway {
namespace {

using testing::HasSubstr;

Caller Anonymous() { return {"ipv4:127.0.0.1:1", {}, {}}; }

Caller WithToken(const std::string& token) {
  Caller caller = Anonymous();
  caller.authorizations = {"Bearer " + token};
  return caller;
}

Caller WithCertificate(const std::string& name) {
  Caller caller = Anonymous();
  caller.certificate_names = {name, "another"};
  return caller;
}

class AccessTest : public testing::Test {
 protected:
  void Restrict() {
    auto table = TokenTable::Parse("tokens", slam_.line + "\nfleet read certificate\n");
    ASSERT_TRUE(table.ok()) << table.status();
    dut_.Replace(*std::move(table));
  }
  void Refuses(const Caller& caller, const std::string& reason) {
    const absl::Status status = dut_.Identify(caller).status();
    EXPECT_TRUE(absl::IsUnauthenticated(status)) << status;
    EXPECT_EQ(ReasonOf(status), reason);
  }

  const NewToken slam_ = *MakeToken("slam", Role::kPush);
  AccessControl dut_;
};

TEST_F(AccessTest, WithoutATableEverybodyMayDoEverything) {
  EXPECT_EQ(dut_.Identify(Anonymous())->name, "ipv4:127.0.0.1:1");
  EXPECT_EQ(dut_.Identify(Anonymous())->role, Role::kAdmin);
  EXPECT_EQ(dut_.Identify(WithToken("any"))->role, Role::kAdmin);
  EXPECT_EQ(dut_.Identify(WithCertificate("robot"))->name, "robot");
}

TEST_F(AccessTest, WithATableOnlyThoseThatItNames) {
  Restrict();
  Refuses(Anonymous(), "NO_TOKEN");
  Refuses(WithCertificate("stranger"), "NO_TOKEN");
  Refuses(WithCertificate("slam"), "NO_TOKEN");  // the name of a token
  Refuses(WithToken("wrong"), "WRONG_TOKEN");
  Refuses(WithToken(""), "WRONG_TOKEN");
  const auto slam = dut_.Identify(WithToken(slam_.token));
  ASSERT_TRUE(slam.ok()) << slam.status();
  EXPECT_EQ(slam->name, "slam");
  EXPECT_EQ(slam->role, Role::kPush);
  EXPECT_EQ(dut_.Identify(WithCertificate("fleet"))->role, Role::kRead);
}

TEST_F(AccessTest, AWrongTokenIsNoHelpBesideACertificate) {
  Restrict();
  Caller caller = WithToken("wrong");
  caller.certificate_names = {"fleet"};
  Refuses(caller, "WRONG_TOKEN");
}

TEST_F(AccessTest, AuthorizationsOfOtherKinds) {
  Restrict();
  Caller caller = WithToken(slam_.token);
  caller.authorizations.push_back(caller.authorizations.front());
  Refuses(caller, "WRONG_TOKEN");
  for (const std::string& text :
       {slam_.token, "Basic " + slam_.token, "Bearer  " + slam_.token, std::string("Bearer")}) {
    caller.authorizations = {text};
    Refuses(caller, "WRONG_TOKEN");
  }
  caller.authorizations = {"bearer " + slam_.token};  // RFC 7235: the scheme is no password
  EXPECT_TRUE(dut_.Identify(caller).ok());
}

TEST_F(AccessTest, ATableCanBeReplaced) {
  Restrict();
  dut_.Replace(TokenTable());
  Refuses(WithToken(slam_.token), "WRONG_TOKEN");
  dut_.Replace(std::nullopt);
  EXPECT_EQ(dut_.Identify(Anonymous())->role, Role::kAdmin);
}

TEST_F(AccessTest, EachRoleIncludesThoseBeforeIt) {
  const std::vector<std::pair<std::string, Role>> needs = {{"CheckStates", Role::kRead},
                                                           {"PushFrames", Role::kPush},
                                                           {"Reset", Role::kAdmin},
                                                           {"NoSuchMethod", Role::kAdmin}};
  for (const auto& [method, needed] : needs) {
    EXPECT_EQ(RoleFor(method), needed) << method;
    for (const Role role : {Role::kRead, Role::kPush, Role::kAdmin}) {
      const absl::Status status = CheckRole({"slam", role}, method);
      EXPECT_EQ(status.ok(), role >= needed) << method << " " << ToText(role);
      EXPECT_TRUE(status.ok() || absl::IsPermissionDenied(status));
    }
  }
  EXPECT_THAT(std::string(CheckRole({"slam", Role::kPush}, "Reset").message()),
              HasSubstr("Reset needs the role admin; slam has push"));
}

}  // namespace
}  // namespace clearway
