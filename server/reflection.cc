#include "server/reflection.h"

#include <dlfcn.h>

#include "absl/strings/str_cat.h"

namespace clearway {

absl::Status OfferReflection() {
  if (dlopen(CLEARWAY_REFLECTION_LIBRARY, RTLD_NOW) != nullptr) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("reflection: ", dlerror()));
}

}  // namespace clearway
