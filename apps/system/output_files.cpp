#include "apps/system/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <thread>

#include "appearance/spectra/text/input_error.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

/// Held while temporaries become files, so that a signal cannot end the program half-way.
std::mutex& commit_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Temporaries and folders that disappear again unless keep() is called.
class Unfinished {
 public:
  Unfinished() {
    const std::scoped_lock lock(commit_mutex());
    active() = this;
  }

  ~Unfinished() {
    const std::scoped_lock lock(commit_mutex());
    remove_all();
  }

  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  void add(const fs::path& path) {
    const std::scoped_lock lock(commit_mutex());
    paths_.push_back(path);
  }

  void keep() { paths_.clear(); }

  /// The caller holds commit_mutex().
  void remove_all() {
    std::error_code ignored;
    for (auto path = paths_.rbegin(); path != paths_.rend(); ++path) fs::remove(*path, ignored);
    paths_.clear();
    active() = nullptr;
  }

  static Unfinished*& active() {
    static Unfinished* unfinished = nullptr;
    return unfinished;
  }

 private:
  std::vector<fs::path> paths_;  // in the order they were made: folders before what is in them
};

[[noreturn]] void fail(const fs::path& path, const std::string& problem) {
  throw spectra::FileError(fmt::format("{}: cannot be written: {}", path.string(), problem));
}

[[noreturn]] void fail(const fs::path& path) { fail(path, std::strerror(errno)); }

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void make_folders(const fs::path& folder, Unfinished& unfinished) {
  if (folder.empty() || fs::is_directory(folder)) return;
  make_folders(folder.parent_path(), unfinished);
  if (::mkdir(folder.c_str(), 0777) == 0) {
    unfinished.add(folder);
  } else if (errno != EEXIST) {
    fail(folder);
  }
}

/// A link is followed, so that the file it names is replaced and not the link.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  if (!fs::is_regular_file(status)) fail(path, "it exists and is no regular file");
  return fs::canonical(path);
}

/// A file that is there, open for writing.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC)) {
    if (descriptor_ < 0) fail(path_);
  }

  ~OpenFile() { ::close(descriptor_); }

  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count <= 0 && errno != EINTR) fail(path_);
      if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void flush() const {
    if (::fsync(descriptor_) != 0) fail(path_);
  }

 private:
  const fs::path& path_;
  int descriptor_;
};

/// What a file is called while it is being written, and where it goes.
struct Staged {
  fs::path temporary, target;
};

/// Removes what a killed run left: temporaries of this target, a minute old, whose process is gone.
void clear_leftovers(const fs::path& target) {
  constexpr auto kQuiet = std::chrono::minutes(1);
  const std::string before = "." + target.filename().string() + ".", after = ".tmp";
  std::error_code ignored;
  for (fs::directory_iterator at(folder_of(target), ignored), end; at != end;
       at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(before) || !name.ends_with(after)) continue;
    const std::string number =
        name.substr(before.size(), name.size() - before.size() - after.size());
    int process = 0;
    const auto [stop, error] =
        std::from_chars(number.data(), number.data() + number.size(), process);
    if (error != std::errc() || stop != number.data() + number.size() || process <= 0) continue;
    const bool gone = ::kill(process, 0) != 0 && errno == ESRCH;
    std::error_code vanished;
    const fs::file_time_type written = at->last_write_time(vanished);
    const bool quiet = !vanished && written < fs::file_time_type::clock::now() - kQuiet;
    if (gone && quiet) fs::remove(at->path(), ignored);
  }
}

/// Makes missing folders and the temporary, empty and beside its target.
Staged stage(const fs::path& path, Unfinished& unfinished) {
  make_folders(folder_of(path), unfinished);
  const fs::path target = target_of(path);
  clear_leftovers(target);
  const fs::path temporary =
      folder_of(target) / fmt::format(".{}.{}.tmp", target.filename().string(), ::getpid());
  unfinished.add(temporary);
  const int descriptor =
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(temporary);
  ::close(descriptor);
  return {.temporary = temporary, .target = target};
}

void commit(const std::vector<Staged>& files, Unfinished& unfinished) {
  const std::scoped_lock lock(commit_mutex());
  for (const auto& [temporary, target] : files) {
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail(target);
  }
  unfinished.keep();
}

}  // namespace

void require_writable(const fs::path& folder) {
  fs::path existing = folder.empty() ? fs::path(".") : folder;
  while (!existing.empty() && !fs::exists(fs::symlink_status(existing))) {
    existing = existing.parent_path();
  }
  if (existing.empty()) existing = ".";
  if (!fs::is_directory(existing)) fail(existing, "it is no folder");
  if (::access(existing.c_str(), W_OK | X_OK) != 0) fail(existing);
}

void write_files(const std::vector<OutputFile>& files) {
  Unfinished unfinished;
  std::vector<Staged> staged;
  for (const OutputFile& file : files) {
    staged.push_back(stage(file.path, unfinished));
    const OpenFile out(staged.back().temporary);
    out.write(file.text);
    if (file.pieces) file.pieces([&](std::string_view text) { out.write(text); });
    out.flush();
  }
  commit(staged, unfinished);
}

void write_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  Unfinished unfinished;
  const Staged file = stage(path, unfinished);
  write(file.temporary);
  OpenFile(file.temporary).flush();
  commit({file}, unfinished);
}

void exit_cleanly_on_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    sigwait(&signals, &signal);
    const std::scoped_lock lock(commit_mutex());
    if (Unfinished::active() != nullptr) Unfinished::active()->remove_all();
    ::_exit(128 + signal);
  }).detach();
}

}  // namespace apps
