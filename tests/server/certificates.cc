#include "server/certificates.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "absl/strings/str_cat.h"

namespace clearway::testing_support {
namespace {

constexpr char kNewKey[] = " -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes ";

}  // namespace

bool Certificates::CanBeMade() { return std::system("openssl version >/dev/null 2>&1") == 0; }

void Certificates::Run(const std::string& command) const {
  EXPECT_EQ(std::system(absl::StrCat(command, " >/dev/null 2>&1").c_str()), 0) << command;
}

void Certificates::MakeAuthority(const std::string& name) const {
  Run(absl::StrCat("openssl req -x509", kNewKey, "-days 2 -subj /CN=", name, " -keyout ", Key(name),
                   " -out ", Cert(name)));
}

void Certificates::Make(const std::string& name, const std::string& authority, int days) const {
  const std::string request = (folder_ / (name + ".csr")).string();
  Run(absl::StrCat("openssl req", kNewKey, "-subj /CN=", name,
                   " -addext subjectAltName=DNS:localhost -keyout ", Key(name), " -out ", request));
  Run(absl::StrCat("openssl x509 -req -in ", request, " -CA ", Cert(authority), " -CAkey ",
                   Key(authority), " -CAcreateserial -copy_extensions copy -days ", days, " -out ",
                   Cert(name)));
}

}  // namespace clearway::testing_support
