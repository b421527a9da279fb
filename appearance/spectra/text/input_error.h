#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace spectra {

/// One fault of an input file: where, what, and how to mend it.
struct Fault {
  std::string file;
  int line = 0;         ///< from 1; 0: the file as a whole
  int column = 0;       ///< from 1, in bytes
  std::string pointer;  ///< JSON pointer, or the column name of a CSV
  std::string problem;
  std::string remedy;
};

/// "rooms/den.json:14:22: /surfaces/floor: 1.2 is out of range; give a number from 0 to below 1"
[[nodiscard]] std::string to_string(const Fault& fault);

/// Every fault that was found in the input, in the order of the file. Exit code 3.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);

  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A file cannot be read or written. Exit code 4.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spectra
