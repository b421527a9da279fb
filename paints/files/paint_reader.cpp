#include "paints/files/paint_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "appearance/spectra/text/input_bytes.h"
#include "paints/files/format_readers.h"
#include "paints/files/source_text.h"

namespace paints {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;

/// X-Rite's text formats, of which the wavelengths are not in the file.
void refuse_by_name(const std::string& path, std::string_view text) {
  const bool mif = text.find("ANGL=") != text.npos;
  const std::size_t line_end = text.find('\n');
  const std::string_view first_line = text.substr(0, line_end);
  const bool xtf = std::count(first_line.begin(), first_line.end(), '`') >= 3;
  if (!mif && !xtf) return;
  throw spectra::InputError(
      {{path, 1, 1, "", fmt::format("this is an X-Rite {} file", mif ? "MIF" : "XTF"),
        "its spectra carry no wavelengths; export CxF3, CGATS or CSV instead"}});
}

}  // namespace

PaintFile parse_paint_file(const std::string& path, std::string bytes, const ReadChoices& choices) {
  const SourceText source = decode(path, std::move(bytes));
  PaintDraft draft(path);
  draft.file.notes = source.notes;
  if (is_xml(source.text)) {
    read_cxf(source.text, choices, draft);
  } else if (is_cgats(source.text)) {
    read_cgats(source.text, choices, draft);
  } else if (is_qtx(source.text)) {
    read_qtx(source.text, choices, draft);
  } else {
    refuse_by_name(path, source.text);
    read_delimited(source.text, choices, draft);
  }
  return finish(std::move(draft), choices);
}

PaintSource paint_source(const std::string& path_and_choices) {
  PaintSource source{.path = path_and_choices, .choices = {}};
  const std::size_t mark = path_and_choices.rfind('?');
  if (mark == std::string::npos || std::filesystem::exists(path_and_choices)) return source;
  source.path = path_and_choices.substr(0, mark);
  std::string_view rest = std::string_view(path_and_choices).substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view choice = rest.substr(0, std::min(rest.find(','), rest.size()));
    const std::size_t equals = std::min(choice.find('='), choice.size());
    try {
      set_choice(source.choices, choice.substr(0, equals),
                 choice.substr(std::min(equals + 1, choice.size())));
    } catch (const std::invalid_argument& error) {
      throw spectra::InputError({{source.path, 0, 0, "", error.what(), "write FILE?KEY=VALUE"}});
    }
    rest.remove_prefix(std::min(choice.size() + 1, rest.size()));
  }
  return source;
}

PaintFile read_paint_file(const std::string& path_and_choices) {
  const auto [path, choices] = paint_source(path_and_choices);
  std::string bytes = spectra::read_input(path, kMaxBytes, "split the file");
  return parse_paint_file(path, std::move(bytes), choices);
}

}  // namespace paints
