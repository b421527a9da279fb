#pragma once
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "appearance/spectra/text/csv_reader.h"

namespace apps::test {

namespace fs = std::filesystem;

/// A folder of its own that disappears again.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "roomhue-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }

  ~TemporaryFolder() { fs::remove_all(path_); }

  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string first_line(const fs::path& path) {
  const std::string text = read_text(path);
  return text.substr(0, text.find("\r\n"));
}

/// Names in a folder, hidden ones too.
inline std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct ProgramRun {
  int exit_code = -1;
  std::string out, err;
};

/// Runs the built program from the repository's root; `arguments` go through the shell.
inline ProgramRun roomhue(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = "cd '" SOURCE_DIR "' && '" ROOMHUE "' " + arguments + " >'" +
                              (folder / "out").string() + "' 2>'" + (folder / "err").string() + "'";
  const int status = std::system(command.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = read_text(folder / "out"),
          .err = read_text(folder / "err")};
}

inline nlohmann::json read_json(const fs::path& path) {
  return nlohmann::json::parse(read_text(path));
}

/// The cells of a CSV file, its header first.
inline std::vector<std::vector<std::string>> read_cells(const fs::path& path) {
  const spectra::CsvTable table = spectra::read_csv(path.string());
  std::vector<std::vector<std::string>> rows{table.header};
  for (const spectra::CsvRow& row : table.rows) rows.push_back(row.cells);
  return rows;
}

}  // namespace apps::test
