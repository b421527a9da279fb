#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "appearance/spectra/text/input_error.h"

namespace scenes {

/// A piece of a line, and where it stands.
struct Token {
  std::string_view text;
  int line = 0, column = 0;  ///< from 1; column in bytes
};

/// A file of lines that may end in CR LF, LF or CR; a byte order mark and what follows an
/// end-of-file character (Ctrl-Z) do not count.
class LuminaireText {
 public:
  LuminaireText(std::string path, std::string bytes);
  LuminaireText(const LuminaireText&) = delete;
  LuminaireText& operator=(const LuminaireText&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

  [[nodiscard]] const std::vector<std::string_view>& lines() const { return lines_; }

  /// A whole line, blanks around it cut off; empty beyond the end.
  [[nodiscard]] Token line(std::size_t index) const;

 private:
  std::string path_, bytes_;
  std::vector<std::string_view> lines_;
};

/// What stands from a line on, one after the other, between blanks, tabs, commas and line ends. Two
/// commas with nothing in between have an empty token between them.
class TokenStream {
 public:
  /// `text` must outlive the stream.
  TokenStream(const LuminaireText& text, std::size_t first_line)
      : text_(&text), line_(first_line) {}

  [[nodiscard]] std::optional<Token> next();

  /// The last token that was read.
  [[nodiscard]] const Token& last() const { return last_; }

  [[nodiscard]] bool met_comma() const { return met_comma_; }

 private:
  [[nodiscard]] Token take(std::size_t length);

  const LuminaireText* text_;
  std::size_t line_ = 0, at_ = 0;
  bool after_comma_ = false, met_comma_ = false;
  Token last_{.text = {}, .line = 1, .column = 1};
};

/// @throws spectra::FileError  if it cannot be read
/// @throws spectra::InputError  if it is empty or larger than 128 MiB
[[nodiscard]] LuminaireText read_luminaire_text(const std::string& path);

/// Faults of one file; beyond the first hundred they are only counted.
class LuminaireFaults {
 public:
  explicit LuminaireFaults(std::string path) : path_(std::move(path)) {}

  void add(const Token& place, std::string problem, std::string remedy);
  void add(const std::vector<spectra::Fault>& faults);  ///< of another file

  [[nodiscard]] bool none() const { return faults_.empty(); }

  /// @throws spectra::InputError  in the order of the file, if there are any
  void throw_faults();

 private:
  std::string path_;
  std::vector<spectra::Fault> faults_;
  std::size_t more_ = 0;
};

/// What is allowed of the numbers of such a file.
inline constexpr double kMostIntensities = 1e7;
inline constexpr double kMostSize_m = 100;

/// All of the text as a finite number, plus sign allowed.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

/// As UTF-8: bytes that are none are Latin-1. Control characters become blanks.
[[nodiscard]] std::string readable(std::string_view bytes);

/// In quotes, at most 24 characters, for messages.
[[nodiscard]] std::string quoted(std::string_view bytes);

/// "1 angle", "2 angles"
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace scenes
