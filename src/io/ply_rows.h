// The elements of a PLY file, one after the other.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "io/ply_header.h"

namespace clearway {

// Reads the numbers behind a header: an ascii element is a line, a binary one has no gaps. Errors
// are the reader's. One thread.
class PlyRows {
 public:
  // The reader must outlive it.
  PlyRows(PlyFormat format, PlyReader& reader) : format_(format), reader_(reader) {}

  // Reads the element's row i, all rows before which have been read, and calls visit(property,
  // number) for each number, the length of a list excepted. False after an error.
  template <class Visit>
  bool Read(const PlyElement& element, std::uint64_t i, Visit&& visit) {
    if (!Begin(element, i)) return false;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyElement::Property& property = element.properties[p];
      double number = 0, count = 1;
      if (property.count && !TakeCount(element, i, *property.count, count)) return false;
      for (double k = 0; k < count; ++k) {
        if (!Take(property.scalar, number)) return FailShort(element, i);
        visit(p, number);
      }
    }
    return End(element, i);
  }

  // Fails unless that was all.
  void CheckEnd();

  // How many rows of the element the rest of the file can hold at most.
  std::uint64_t MaxRows(const PlyElement& element) const;

 private:
  bool Begin(const PlyElement& element, std::uint64_t i);
  bool TakeCount(const PlyElement& element, std::uint64_t i, PlyScalar scalar, double& count);
  bool Take(PlyScalar scalar, double& number);
  bool End(const PlyElement& element, std::uint64_t i);
  // Return false.
  bool FailCutOff(const PlyElement& element, std::uint64_t i);
  bool FailShort(const PlyElement& element, std::uint64_t i);

  PlyFormat format_;
  PlyReader& reader_;
};

}  // namespace clearway
