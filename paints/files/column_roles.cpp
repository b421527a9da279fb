#include "paints/files/column_roles.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "paints/files/paint_draft.h"
#include "paints/files/source_text.h"

namespace paints {
namespace {

using Kind = ColourColumns::Kind;

/// A header cell without what varies: brackets and what is in them, blanks, marks, the white.
struct Word {
  std::string exact;  ///< case kept: Y is no y
  std::string text;   ///< in lower case
  std::optional<spectra::StatedWhite> white;
};

/// "D65/10", "D50 2", "D65_10" anywhere in the cell; 2 degrees if none are named.
std::optional<spectra::StatedWhite> white_in(const std::string& cell) {
  for (const char* name : {"D50", "D55", "D65", "D75"}) {
    const std::size_t at = cell.find(name);
    if (at == cell.npos) continue;
    const std::string rest = cell.substr(at + 3);
    const std::size_t digit = rest.find_first_of("0123456789");
    const bool ten = digit != rest.npos && digit <= 2 && rest.compare(digit, 2, "10") == 0;
    return spectra::StatedWhite{.illuminant = name, .observer_deg = ten ? 10 : 2};
  }
  return {};
}

Word word_of(const std::string& cell) {
  Word word{.white = white_in(cell)};
  int depth = 0;
  const std::size_t white_at = word.white ? cell.find(word.white->illuminant) : cell.npos;
  for (std::size_t i = 0; i < std::min(cell.size(), white_at); ++i) {
    const char c = cell[i];
    if (c == '(' || c == '[') ++depth;
    const bool mark = std::string_view(" \t*_-.:%'").find(c) != std::string_view::npos;
    if (depth == 0 && !mark) word.exact += c;
    if ((c == ')' || c == ']') && depth > 0) --depth;
  }
  word.text = lower(word.exact);
  return word;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

struct Triple {
  Kind kind;
  bool exact;  ///< upper and lower case count
  std::array<std::string_view, 3> words;
};

constexpr std::array<Triple, 17> kTriples{{
    {Kind::xyz, true, {"X", "Y", "Z"}},
    {Kind::xyz, false, {"xyzx", "xyzy", "xyzz"}},
    {Kind::xyz, false, {"ciex", "ciey", "ciez"}},
    {Kind::xyz, true, {"x", "y", "z"}},
    {Kind::xy_y, true, {"x", "y", "Y"}},
    {Kind::xy_y, false, {"xyyx", "xyyy", "xyycapy"}},
    {Kind::lab, false, {"l", "a", "b"}},
    {Kind::lab, false, {"labl", "laba", "labb"}},
    {Kind::lab, false, {"ciel", "ciea", "cieb"}},
    {Kind::lab, false, {"cielabl", "cielaba", "cielabb"}},
    {Kind::lab, false, {"lstar", "astar", "bstar"}},
    {Kind::rgb, false, {"r", "g", "b"}},
    {Kind::rgb, false, {"red", "green", "blue"}},
    {Kind::rgb, false, {"rgbr", "rgbg", "rgbb"}},
    {Kind::rgb, false, {"srgbr", "srgbg", "srgbb"}},
    {Kind::rgb, false, {"sr", "sg", "sb"}},
    {Kind::rgb, false, {"rgbred", "rgbgreen", "rgbblue"}},
}};

/// The columns of a triple, in this order and not yet taken.
std::vector<std::size_t> find_triple(const Triple& triple, const std::vector<Word>& words,
                                     const std::vector<bool>& taken) {
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < words.size() && found.size() < 3; ++c) {
    const std::string& word = triple.exact ? words[c].exact : words[c].text;
    if (!taken[c] && word == triple.words[found.size()]) found.push_back(c);
  }
  return found.size() == 3 ? found : std::vector<std::size_t>{};
}

}  // namespace

ColumnRoles roles_of(const std::vector<std::string>& header) {
  ColumnRoles roles;
  std::vector<Word> words;
  for (const std::string& cell : header) words.push_back(word_of(cell));
  std::vector<bool> taken(header.size(), false);
  const auto take = [&](std::size_t c) {
    taken[c] = true;
    return c;
  };
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (const auto nm = parse_wavelength(header[c])) roles.wavelengths.emplace_back(take(c), *nm);
  }
  for (const Triple& triple : kTriples) {
    const std::vector<std::size_t> columns = find_triple(triple, words, taken);
    if (columns.empty()) continue;
    for (const std::size_t c : columns) taken[c] = true;
    roles.colours.push_back(
        {.kind = triple.kind, .columns = columns, .white = words[columns[0]].white});
  }
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (taken[c]) continue;
    const std::string& w = words[c].text;
    if (is_one_of(w, {"hex", "hexcode", "hexvalue", "hexcolour", "hexcolor", "srgbhex", "rgbhex",
                      "srgb", "html", "htmlcode", "web", "webcolour", "webcolor"})) {
      roles.colours.push_back({.kind = Kind::hex, .columns = {take(c)}, .white = {}});
    } else if (!roles.lrv && is_one_of(w, {"lrv", "lrvvalue", "lightreflectancevalue"})) {
      roles.lrv = take(c);
    } else if (!roles.code &&
               is_one_of(w, {"code", "colourcode", "colorcode", "id", "sampleid", "sku", "ref",
                             "reference", "no", "number", "articleno", "productcode"})) {
      roles.code = take(c);
    } else if (!roles.name &&
               is_one_of(w, {"name", "colourname", "colorname", "colour", "color", "paint",
                             "paintname", "sample", "samplename", "title", "description", "label",
                             "bezeichnung", "farbe", "nom", "nombre"})) {
      roles.name = take(c);
    } else {
      roles.others.push_back(c);
    }
  }
  return roles;
}

const char* to_string(ColourColumns::Kind kind) {
  switch (kind) {
    case Kind::lab:
      return "Lab";
    case Kind::xyz:
      return "XYZ";
    case Kind::xy_y:
      return "xyY";
    case Kind::rgb:
      return "sRGB";
    case Kind::hex:
      return "hex";
  }
  return "";
}

}  // namespace paints
