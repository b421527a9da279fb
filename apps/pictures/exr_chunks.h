#pragma once
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <cstdint>
#include <string>

namespace apps {

/// What is wrong with how the pixels of a part are stored, in words; empty: nothing. The library
/// takes what is missing of a chunk from memory that nobody wrote. Only compressions that allow it
/// are looked at: none, RLE and ZIP.

/// From the header alone: can a file of this size hold the part's first chunk?
[[nodiscard]] std::string implausible_size(const Imf::Header& header, std::int64_t file_bytes);

/// Chunk by chunk: does it hold as many bytes as its pixels take?
/// @throws Iex::BaseExc  if one is missing
[[nodiscard]] std::string short_chunk(Imf::MultiPartInputFile& file, int part);

}  // namespace apps
