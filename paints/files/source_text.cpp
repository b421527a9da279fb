#include "paints/files/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "appearance/spectra/text/utf8.h"

namespace paints {
namespace {

struct BinaryFormat {
  std::string_view magic;
  std::size_t at;
  const char* name;
  const char* remedy;
};

constexpr std::array<BinaryFormat, 11> kBinaryFormats{{
    {"ASEF", 0, "an ASE palette", "its colours carry no white; save them as CSV with hex or Lab"},
    {"8BCB", 0, "an ACB colour book", "save its colours as CSV with hex or Lab"},
    {"PK\x03\x04", 0, "a packed file: an Excel or OpenDocument table, or an SBZ palette",
     "save the table as CSV UTF-8"},
    {"\xD0\xCF\x11\xE0", 0, "an Excel workbook of the old kind", "save it as CSV UTF-8"},
    {"MATLAB 5.0 MAT-file", 0, "a MATLAB file", "save the matrix as CSV"},
    {"%PDF", 0, "a PDF", "ask for the table itself"},
    {"acsp", 36, "an ICC profile", "give the measurements it was made from"},
    {"\x89PNG", 0, "a picture", "give a table"},
    {"\xFF\xD8\xFF", 0, "a picture", "give a table"},
    {"\x1F\x8B", 0, "a compressed file", "unpack it first"},
    {"\x89HDF", 0, "an HDF5 file", "save the table as CSV"},
}};

[[noreturn]] void refuse(const std::string& path, spectra::CsvPlace place, std::string problem,
                         std::string remedy) {
  throw spectra::InputError(
      {{path, place.line, place.column, "", std::move(problem), std::move(remedy)}});
}

void refuse_binary(const std::string& path, std::string_view bytes) {
  for (const BinaryFormat& format : kBinaryFormats) {
    if (bytes.size() > format.at && bytes.substr(format.at).starts_with(format.magic)) {
      refuse(path, {}, fmt::format("this is {}", format.name), format.remedy);
    }
  }
}

void append_utf8(std::string& text, char32_t c) {
  const auto byte = [&](char32_t value) { text += static_cast<char>(value); };
  if (c < 0x80) {
    byte(c);
  } else if (c < 0x800) {
    byte(0xC0 | (c >> 6));
    byte(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    byte(0xE0 | (c >> 12));
    byte(0x80 | ((c >> 6) & 0x3F));
    byte(0x80 | (c & 0x3F));
  } else {
    byte(0xF0 | (c >> 18));
    byte(0x80 | ((c >> 12) & 0x3F));
    byte(0x80 | ((c >> 6) & 0x3F));
    byte(0x80 | (c & 0x3F));
  }
}

std::string from_utf16(const std::string& path, std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t at) -> char32_t {
    const auto first = static_cast<unsigned char>(bytes[at]),
               second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<char32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  for (std::size_t at = 2; at < bytes.size(); at += 2) {
    if (at + 1 == bytes.size()) {
      refuse(path, {}, "UTF-16 that ends inside a character", "save the file anew, in UTF-8");
    }
    const char32_t c = unit(at);
    const bool high = c >= 0xD800 && c < 0xDC00, low = c >= 0xDC00 && c < 0xE000;
    const char32_t next = high && at + 3 < bytes.size() ? unit(at + 2) : 0;
    if (low || (high && (next < 0xDC00 || next > 0xDFFF))) {
      refuse(path, {}, "UTF-16 with half a character", "save the file anew, in UTF-8");
    }
    append_utf8(text, high ? 0x10000 + ((c - 0xD800) << 10) + (next - 0xDC00) : c);
    if (high) at += 2;
  }
  return text;
}

std::string from_latin_1(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + 16);
  for (const char c : bytes) append_utf8(text, static_cast<unsigned char>(c));
  return text;
}

}  // namespace

SourceText decode(const std::string& path, std::string bytes) {
  refuse_binary(path, bytes);
  SourceText source;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    source.text = from_utf16(path, bytes, bytes[0] == '\xFE');
    source.notes.emplace_back("the text is UTF-16");
  } else if (spectra::first_invalid_utf8(bytes) < bytes.size()) {
    source.text = from_latin_1(bytes);
    source.notes.emplace_back("the text is no UTF-8 and was read as Latin-1");
  } else {
    source.text = std::move(bytes);
    if (source.text.starts_with("\xEF\xBB\xBF")) source.text.erase(0, 3);
  }
  if (const std::size_t nul = source.text.find('\0'); nul != std::string::npos) {
    refuse(path, LineIndex(source.text).place(nul), "NUL byte", "save the file as CSV in UTF-8");
  }
  if (trimmed(source.text).empty()) {
    refuse(path, {}, "the file is empty", "give a header row and one row per entry");
  }
  return source;
}

LineIndex::LineIndex(std::string_view text) : starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool ends =
        text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
    if (ends) starts_.push_back(i + 1);
  }
}

spectra::CsvPlace LineIndex::place(std::size_t offset) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  return {.line = static_cast<int>(next - starts_.begin()),
          .column = static_cast<int>(offset - *(next - 1)) + 1};
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return result;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace paints
