#pragma once
#include <string>
#include <string_view>

#include "paints/files/paint_draft.h"

namespace paints {

/// Readers of one format each: they say whether `text` is theirs, and fill a draft with it.

[[nodiscard]] bool is_xml(std::string_view text);
void read_cxf(std::string_view text, const ReadChoices& choices, PaintDraft& draft);

[[nodiscard]] bool is_cgats(std::string_view text);
void read_cgats(std::string_view text, const ReadChoices& choices, PaintDraft& draft);

[[nodiscard]] bool is_qtx(std::string_view text);
void read_qtx(std::string_view text, const ReadChoices& choices, PaintDraft& draft);

/// Whatever else is text: rows of cells.
void read_delimited(std::string_view text, const ReadChoices& choices, PaintDraft& draft);

}  // namespace paints
