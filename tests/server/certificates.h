// Certificates made by the openssl program.
#pragma once

#include <string>

#include "support/temporary_folder.h"

namespace clearway::testing_support {

// Each has a name and is two files, <name>.cert and <name>.key. One thread.
class Certificates {
 public:
  // Whether the openssl program is there.
  static bool CanBeMade();

  // One that signs itself and others.
  void MakeAuthority(const std::string& name) const;
  // One for the host localhost and the client `name`, that `authority` signs.
  void Make(const std::string& name, const std::string& authority, int days = 2) const;

  std::string Cert(const std::string& name) const { return (folder_ / (name + ".cert")).string(); }
  std::string Key(const std::string& name) const { return (folder_ / (name + ".key")).string(); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  void Run(const std::string& command) const;

  const TemporaryFolder folder_;
};

}  // namespace clearway::testing_support
