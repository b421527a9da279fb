#include "scenes/models/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include "appearance/spectra/text/input_bytes.h"
#include "appearance/spectra/text/input_error.h"

namespace scenes {
namespace {

constexpr std::size_t kMostFaults = 100, kMostCorners = 5'000'000, kMostCornersOfFace = 1000;
constexpr std::size_t kMostBytes = 512ULL << 20U;
constexpr double kMostPlace = 1e6;

template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

class ObjReader {
 public:
  explicit ObjReader(std::string path)
      : path_(std::move(path)),
        text_(spectra::read_input(path_, kMostBytes, "simplify the model")) {}

  ObjFile read() {
    std::size_t at = 0;
    while (at < text_.size() && faults_.size() < kMostFaults && !too_large_) {
      ++line_;
      read_line(next_line(at));
    }
    for (const auto& [keyword, count] : skipped_) {
      file_.notes.push_back(fmt::format("{} lines of \"{}\" are left out", count, keyword));
    }
    if (faults_.empty() && file_.faces.empty())
      fault("the file has no face", "give one with \"f\"");
    if (!faults_.empty()) throw spectra::InputError(faults_);
    return std::move(file_);
  }

 private:
  /// One line; lines that end in a backslash go on.
  std::string next_line(std::size_t& at) {
    std::string line;
    for (bool more = true; more && at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      std::string_view piece(text_.data() + at, end - at);
      at = end + 1;
      while (!piece.empty() && piece.back() == '\r') piece.remove_suffix(1);
      more = piece.ends_with('\\');
      if (more) piece.remove_suffix(1), ++continued_;
      line += piece;
      if (more) line += ' ';
    }
    return line;
  }

  void read_line(const std::string& line) {
    const std::vector<std::string_view> words = words_of(line);
    if (!words.empty()) {
      const std::string_view keyword = words.front();
      if (keyword == "v") {
        read_corner(words);
      } else if (keyword == "f") {
        read_face(words);
      } else if (keyword == "usemtl") {
        material_ = words.size() > 1 ? std::string(words[1]) : "";
      } else if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "surf") {
        ++skipped_[std::string(keyword)];
      }
    }
    line_ += continued_;
    continued_ = 0;
  }

  static std::vector<std::string_view> words_of(std::string_view line) {
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t from = line.find_first_not_of(" \t", at);
      if (from == line.npos) break;
      at = std::min(line.find_first_of(" \t", from), line.size());
      words.push_back(line.substr(from, at - from));
    }
    return words;
  }

  void read_corner(const std::vector<std::string_view>& words) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    bool sound = words.size() >= 4;
    for (std::size_t k = 0; sound && k < 3; ++k) {
      const auto value = number<double>(words[k + 1]);
      sound = value && std::abs(*value) <= kMostPlace;  // NaN is not
      if (sound) p[static_cast<Eigen::Index>(k)] = *value;
    }
    if (!sound) fault("a corner needs three numbers up to a million", "write v X Y Z");
    if (file_.corners.size() == kMostCorners) {
      fault("more than five million corners", "simplify the model");
      too_large_ = true;
    }
    file_.corners.push_back(p);
  }

  /// Corners as i, i/t, i//n or i/t/n; from 1, or from the end if below 0.
  void read_face(const std::vector<std::string_view>& words) {
    ObjFile::Face face{.corners = {}, .material = material_, .line = line_};
    const auto known = static_cast<long>(file_.corners.size());
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto index = number<long>(words[k].substr(0, words[k].find('/')));
      const long from_zero = !index ? -1 : *index < 0 ? known + *index : *index - 1;
      if (from_zero < 0 || from_zero >= known) {
        return fault(fmt::format("\"{}\" is none of the {} corners so far", words[k], known),
                     "count from 1, or backwards from -1");
      }
      face.corners.push_back(static_cast<int>(from_zero));
    }
    if (face.corners.size() < 3 || face.corners.size() > kMostCornersOfFace) {
      return fault(fmt::format("a face of {} corners", face.corners.size()), "give 3 to 1000");
    }
    file_.faces.push_back(std::move(face));
  }

  void fault(std::string problem, std::string remedy) {
    faults_.push_back({.file = path_,
                       .line = line_,
                       .column = 1,
                       .problem = std::move(problem),
                       .remedy = std::move(remedy)});
  }

  std::string path_, text_, material_;
  ObjFile file_;
  bool too_large_ = false;
  int line_ = 0, continued_ = 0;
  std::map<std::string, int> skipped_;
  std::vector<spectra::Fault> faults_;
};

}  // namespace

ObjFile read_obj(const std::string& path) { return ObjReader(path).read(); }

}  // namespace scenes
