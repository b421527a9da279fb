#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace apps {

struct OutputFile {
  std::filesystem::path path;
  std::string text;
};

/// Early check, before long work: can files be made in `folder`, or the folder itself?
/// @throws spectra::FileError
void require_writable(const std::filesystem::path& folder);

/// Writes all of the files or none: each to a temporary beside its target, flushed to the disk,
/// then renamed in the given order. Missing folders are made; on failure nothing stays behind.
/// @throws spectra::FileError
void write_files(const std::vector<OutputFile>& files);

/// From here on SIGINT, SIGTERM and SIGHUP remove temporaries, wait for renames under way and end
/// the program with 128 + signal. Call before any thread is started.
void exit_cleanly_on_signals();

}  // namespace apps
