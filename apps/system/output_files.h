#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

/// Takes the next piece of a file.
using TextSink = std::function<void(std::string_view)>;

struct OutputFile {
  std::filesystem::path path;
  std::string text;
  /// In place of `text`, for what is too large to be held in memory.
  std::function<void(const TextSink&)> pieces = {};
};

/// Early check, before long work: can files be made in `folder`, or the folder itself?
/// @throws spectra::FileError
void require_writable(const std::filesystem::path& folder);

/// Writes all of the files or none: each to a temporary beside its target, flushed to the disk,
/// then renamed in the given order. Missing folders are made; on failure nothing stays behind.
/// @throws spectra::FileError
void write_files(const std::vector<OutputFile>& files);

/// The same for one file that is too large to be held in memory: `write` fills the temporary, which
/// is there and empty.
/// @throws spectra::FileError, and whatever `write` throws
void write_file(const std::filesystem::path& path,
                const std::function<void(const std::filesystem::path& temporary)>& write);

/// From here on SIGINT, SIGTERM and SIGHUP remove temporaries, wait for renames under way and end
/// the program with 128 + signal. Call before any thread is started.
void exit_cleanly_on_signals();

}  // namespace apps
