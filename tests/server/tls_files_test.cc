#include "server/tls_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing::HasSubstr;

// Certificates and keys made by the openssl program. One thread.
class TlsFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    umask(0077);  // keys that others can read are refused
    if (!Run("openssl version")) GTEST_SKIP() << "the openssl program is missing";
    ASSERT_TRUE(Make("ours", "-days 2"));
    ASSERT_TRUE(Make("other", "-days 2"));
  }
  static bool Run(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
  }
  // <name>.cert and <name>.key.
  bool Make(const std::string& name, const std::string& options,
            const std::string& key = "-newkey ec -pkeyopt ec_paramgen_curve:P-256") {
    return Run("openssl req -x509 " + key + " -nodes -subj /CN=localhost " + options + " -keyout " +
               Path(name + ".key") + " -out " + Path(name + ".cert"));
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::string Text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
  void Refuses(const std::string& cert, const std::string& key, const std::string& field,
               const std::string& part) {
    const absl::Status status = ReadTlsFiles(Path(cert), Path(key)).status();
    EXPECT_FALSE(status.ok());
    EXPECT_EQ(status.message().rfind(field + ": ", 0), 0u) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(part));
  }

  const TemporaryFolder folder_;
};

TEST_F(TlsFilesTest, APair) {
  const auto dut = ReadTlsFiles(Path("ours.cert"), Path("ours.key"));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->cert, Text("ours.cert"));
  EXPECT_EQ(dut->key, Text("ours.key"));
  EXPECT_EQ(dut->warning, "");
}

TEST_F(TlsFilesTest, AChainAndBothInOneFile) {
  folder_.Write("chain.cert", Text("ours.cert") + "words between\n" + Text("other.cert"));
  EXPECT_TRUE(ReadTlsFiles(Path("chain.cert"), Path("ours.key")).ok());
  Refuses("chain.cert", "other.key", "tls_key", "does not belong to tls_cert");
  folder_.Write("both.pem", Text("ours.key") + Text("ours.cert"));
  EXPECT_TRUE(ReadTlsFiles(Path("both.pem"), Path("both.pem")).ok());
}

TEST_F(TlsFilesTest, AKeyOfAnotherCertificate) {
  Refuses("ours.cert", "other.key", "tls_key", "other.key does not belong to tls_cert");
  ASSERT_TRUE(Make("rsa", "-days 2", "-newkey rsa:2048"));
  Refuses("ours.cert", "rsa.key", "tls_key", "does not belong to tls_cert");
}

TEST_F(TlsFilesTest, SwappedFiles) {
  Refuses("ours.key", "ours.key", "tls_cert", "swapped?");
  Refuses("ours.cert", "ours.cert", "tls_key", "swapped?");
}

TEST_F(TlsFilesTest, FilesThatCannotBeRead) {
  Refuses("missing", "ours.key", "tls_cert", "no such file");
  Refuses("ours.cert", "missing", "tls_key", "no such file");
  Refuses("", "ours.key", "tls_cert", "is a folder");
  folder_.Write("empty", "");
  Refuses("empty", "ours.key", "tls_cert", "is empty");
  folder_.Write("large", std::string((1 << 20) + 1, 'x'));
  Refuses("ours.cert", "large", "tls_key", "1048577 bytes; the limit is 1048576 bytes");
  EXPECT_FALSE(ReadTlsFiles("/dev/zero", Path("ours.key")).ok());
}

TEST_F(TlsFilesTest, FilesThatAreNoPem) {
  folder_.Write("words", "not a certificate\n");
  Refuses("words", "ours.key", "tls_cert", "holds no certificate in PEM");
  Refuses("ours.cert", "words", "tls_key", "holds no private key in PEM");
  ASSERT_TRUE(
      Run("openssl x509 -in " + Path("ours.cert") + " -outform DER -out " + Path("ours.der")));
  Refuses("ours.der", "ours.key", "tls_cert", "holds no certificate in PEM");
}

TEST_F(TlsFilesTest, DamagedPem) {
  std::string cert = Text("ours.cert"), key = Text("ours.key");
  folder_.Write("second.cert", cert + cert.substr(0, cert.size() / 2));
  Refuses("second.cert", "ours.key", "tls_cert", "certificate 2 cannot be read");
  cert[cert.size() / 2] = '*';
  folder_.Write("bad.cert", cert);
  Refuses("bad.cert", "ours.key", "tls_cert", "certificate 1 cannot be read");
  key[key.size() / 2] = '*';
  folder_.Write("bad.key", key);
  Refuses("ours.cert", "bad.key", "tls_key", "cannot be read");
}

TEST_F(TlsFilesTest, AnEncryptedKey) {
  ASSERT_TRUE(Run("openssl pkey -in " + Path("ours.key") + " -aes256 -passout pass:secret -out " +
                  Path("secret.key")));
  Refuses("ours.cert", "secret.key", "tls_key", "is encrypted");
}

TEST_F(TlsFilesTest, AKeyTooShortForTls) {
  ASSERT_TRUE(Make("short", "-days 2", "-newkey rsa:512"));
  Refuses("short.cert", "short.key", "tls_cert", "key too small");
}

TEST_F(TlsFilesTest, AKeyThatOthersCanRead) {
  ASSERT_EQ(chmod(Path("ours.key").c_str(), 0604), 0);
  Refuses("ours.cert", "ours.key", "tls_key", "others can read it");
}

TEST_F(TlsFilesTest, AnExpiredCertificate) {
  ASSERT_TRUE(Run("openssl x509 -in " + Path("ours.cert") + " -signkey " + Path("ours.key") +
                  " -days -1 -out " + Path("old.cert")));
  Refuses("old.cert", "ours.key", "tls_cert", "has expired");
  const auto dut = ReadTlsFiles(Path("ours.cert"), Path("ours.key"), Path("old.cert"));
  EXPECT_TRUE(absl::IsFailedPrecondition(dut.status())) << dut.status();
}

TEST_F(TlsFilesTest, AuthoritiesOfClients) {
  const auto dut = ReadTlsFiles(Path("ours.cert"), Path("ours.key"), Path("other.cert"));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->client_ca, Text("other.cert"));
  const absl::Status status =
      ReadTlsFiles(Path("ours.cert"), Path("ours.key"), Path("other.key")).status();
  EXPECT_THAT(std::string(status.message()), HasSubstr("tls_client_ca: "));
}

}  // namespace
}  // namespace clearway
