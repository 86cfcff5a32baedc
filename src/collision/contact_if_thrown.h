// What an exception of the narrow phase means.
#pragma once

namespace clearway {

// The distance that `compute` returns; 0, a contact, if it throws: libccd gives up on some
// degenerate contacts.
template <class Compute>
double ContactIfThrown(Compute compute) {
  try {
    return compute();
  } catch (...) {
    return 0;
  }
}

}  // namespace clearway
