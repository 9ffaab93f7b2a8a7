// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/atomic_file.h"

#include "engine/core/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".part";

// Where a process number means the same process: the machine since it was started, and its
// container.
std::uint32_t machine() {
  static const std::uint32_t value = [] {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    std::string text = host.data(), boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    std::error_code ignored;
    text.append(boot).append(fs::read_symlink("/proc/self/ns/pid", ignored).string());
    return static_cast<std::uint32_t>(std::hash<std::string>()(text));
  }();
  return value;
}

// Tells this program from one that had the same number before.
std::uint32_t own_number() {
  static const std::uint32_t value = std::random_device()();
  return value;
}

// What the names of one machine begin with.
std::string beginning(const fs::path& target) {
  constexpr std::size_t kMostOfName = 200;  // leaves room for the rest
  return fmt::format(".{}.{:08x}-", target.filename().string().substr(0, kMostOfName), machine());
}

// Whether the program that made a name, of which this is what follows the beginning, has ended.
bool is_abandoned(std::string_view rest) {
  if (!rest.ends_with(kSuffix)) return false;
  const char* const end = rest.data() + rest.size();
  pid_t process = 0;
  const auto [after, error] = std::from_chars(rest.data(), end, process);
  if (error != std::errc() || process <= 0 || after == end || *after != '-') return false;
  if (process != ::getpid()) return ::kill(process, 0) != 0 && errno == ESRCH;
  std::uint32_t number = 0;
  const auto [behind, none] = std::from_chars(after + 1, end, number, 16);
  return none == std::errc() && behind != end && *behind == '-' && number != own_number();
}

/// Removes temporary files beside `target` that killed programs of this machine have left; failures
/// are ignored. Linear in the number of files of its folder.
void remove_abandoned(const fs::path& target) {
  const std::string begin = beginning(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begin)) continue;
    if (!is_abandoned(std::string_view(name).substr(begin.size()))) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
  }
}

fs::path resolve_link(const fs::path& named) {
  std::error_code error;
  if (!fs::is_symlink(named, error)) return named;
  const fs::path target = fs::weakly_canonical(named, error);
  return error ? named : target;
}

bool flush_to_disk(const fs::path& path, int flags) {
  const FileDescriptor file(path, flags);
  return file.ok() && ::fsync(file.id()) == 0;
}

constexpr double kMebibyte = 1 << 20;

/// Checks that `bytes` more fit on the disk that holds `folder`. Throws IoError naming `target`.
void require_space(const fs::path& target, const fs::path& folder, std::uintmax_t bytes) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  // Pseudo file systems report no capacity at all; there the write itself has to tell.
  if (error || space.capacity == 0 || space.available >= bytes) return;
  throw IoError(target, fmt::format("the disk is full: {:.1f} MiB are needed and {:.1f} MiB are "
                                    "free; free some space or choose another folder",
                                    static_cast<double>(bytes) / kMebibyte,
                                    static_cast<double>(space.available) / kMebibyte));
}

}  // namespace

std::string temporary_name(const fs::path& target) {
  static std::atomic<unsigned> next{0};
  return fmt::format("{}{}-{:08x}-{}{}", beginning(target), ::getpid(), own_number(), next++,
                     kSuffix);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

AtomicFile::AtomicFile(const fs::path& target, std::uintmax_t bytes)
    : named_(target), target_(resolve_link(target)) {
  std::error_code error;
  const auto status = fs::status(target_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    throw IoError(named_, "this is a folder; name a file in it");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw IoError(named_, "this is not a regular file and is not overwritten; choose another name");
  }
  remove_abandoned(target_);
  require_space(named_, folder_of(target_), bytes);
  temporary_ = folder_of(target_) / temporary_name(target_);
  errno = 0;
  const FileDescriptor file(temporary_, O_CREAT | O_EXCL | O_WRONLY);
  if (!file.ok()) {
    temporary_.clear();
    throw write_error(named_);
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  if (!flush_to_disk(temporary_, O_RDONLY)) throw write_error(named_);
  commit_unflushed();
  // The file is whole by now; a folder that cannot be flushed only risks the name after a crash.
  flush_folder(target_);
}

void AtomicFile::commit_unflushed() {
  errno = 0;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(named_);
  temporary_.clear();
}

void flush_folder(const fs::path& target) {
  flush_to_disk(folder_of(target), O_RDONLY | O_DIRECTORY);
}

void write_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
  AtomicFile file(target, bytes.size());
  {
    const FileDescriptor out(file.temporary(), O_WRONLY);
    if (!out.ok()) throw write_error(target);
    if (!write_all(out.id(), bytes)) throw write_error(target);
  }
  file.commit();
}

void write_atomically(const std::filesystem::path& target, std::string_view text) {
  write_atomically(target,
                   std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

AtomicFolder::AtomicFolder(const fs::path& target, std::uintmax_t bytes) : target_(target) {
  std::error_code error;
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::exists(target_, error) && !fs::is_directory(target_, error)) {
    throw IoError(target, "this is a file; name a new folder");
  }
  if (fs::is_directory(target_, error) && !fs::is_empty(target_, error)) {
    throw IoError(target, "the folder holds other files; name a new or an empty folder");
  }
  const fs::path parent = folder_of(target_);
  remove_abandoned(target_);
  require_space(target, parent, bytes);
  temporary_ = parent / temporary_name(target_);
  errno = 0;
  if (!fs::create_directory(temporary_, error)) {
    errno = error.value();
    temporary_.clear();
    throw write_error(target);
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(target_);
  temporary_.clear();
}

namespace {

struct LogContent {
  std::vector<LogRecord> records;
  std::size_t whole_bytes = 0;  ///< Of the signature and these records.
};

using LogBytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kSignature{'E', 'P', 'I', 'L', 'O', 'G', '1', '\n'};
constexpr std::size_t kFrame = 8;  // length and checksum, 32 bits each, lowest byte first
constexpr std::size_t kMaxRecord = std::size_t{1} << 31;

void put_number(std::size_t number, std::vector<std::uint8_t>& bytes) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

std::uint32_t number_at(LogBytes bytes) {
  return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

// It also covers the length: zeros are no record.
std::uint32_t checksum_of(LogBytes record) {
  return checksum(record) ^ static_cast<std::uint32_t>(record.size()) ^ 0xA5A5A5A5U;
}

// A record at the beginning of some bytes, and how many of them it takes with its frame.
struct Framed {
  LogBytes record;
  std::size_t size = 0;
};

std::optional<Framed> first_line(LogBytes bytes) {
  const auto end = std::ranges::find(bytes, '\n');
  if (end == bytes.end()) return std::nullopt;
  const auto length = static_cast<std::size_t>(end - bytes.begin());
  return Framed{bytes.first(length), length + 1};
}

std::optional<Framed> first_checked(LogBytes bytes) {
  if (bytes.size() < kFrame) return std::nullopt;
  const std::size_t length = number_at(bytes);
  if (bytes.size() - kFrame < length) return std::nullopt;
  const LogBytes record = bytes.subspan(kFrame, length);
  if (checksum_of(record) != number_at(bytes.subspan(4))) return std::nullopt;
  return Framed{record, kFrame + length};
}

/// The bytes of a log without records.
LogBytes log_signature(LogFraming framing) {
  return framing == LogFraming::Lines ? LogBytes{} : LogBytes{kSignature};
}

/// Adds a record to the bytes of a log. Throws InvalidInput if it is longer than 2 GiB.
void put_record(LogFraming framing, LogBytes record, std::vector<std::uint8_t>& bytes) {
  if (record.size() > kMaxRecord) throw InvalidInput("a record of more than 2 GiB cannot be kept");
  if (framing == LogFraming::Checked) {
    put_number(record.size(), bytes);
    put_number(checksum_of(record), bytes);
  }
  bytes.insert(bytes.end(), record.begin(), record.end());
  if (framing == LogFraming::Lines) {
    assert(std::ranges::find(record, '\n') == record.end());
    bytes.push_back('\n');
  }
}

/// Returns the records before the first truncated or damaged one, which a program that ends during
/// a write leaves. Empty if the bytes are no such log.
std::optional<LogContent> parse_log(LogFraming framing, LogBytes bytes) {
  const LogBytes signature = log_signature(framing);
  if (bytes.size() < signature.size() ||
      !std::ranges::equal(signature, bytes.first(signature.size()))) {
    return std::nullopt;
  }
  LogContent content{{}, signature.size()};
  const auto first = framing == LogFraming::Lines ? first_line : first_checked;
  while (const auto framed = first(bytes.subspan(content.whole_bytes))) {
    content.records.emplace_back(framed->record.begin(), framed->record.end());
    content.whole_bytes += framed->size;
  }
  return content;
}

bool lock(const FileDescriptor& file) {
  return ::flock(file.id(), LOCK_EX | LOCK_NB) == 0;
}

IoError not_a_log(const std::filesystem::path& path) {
  return {path, "this is not a log of this program; choose another file"};
}

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

/// Flushes an open file to the disk soon after each write, on a thread of its own, so that the
/// writer never waits for a disk. The file must outlive it.
class BackgroundFlush {
 public:
  /// Whether the present contents of the file and its name are on the disk.
  enum class Start { Flushed, Unflushed };

  BackgroundFlush(int descriptor, std::filesystem::path path, Start start)
      : descriptor_(descriptor),
        path_(std::move(path)),
        written_(start == Start::Unflushed ? 1 : 0),
        is_named_(start == Start::Flushed),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}
  /// Flushes first.
  ~BackgroundFlush() {
    thread_.request_stop();
    thread_.join();
  }
  BackgroundFlush(const BackgroundFlush&) = delete;
  BackgroundFlush& operator=(const BackgroundFlush&) = delete;

  /// Announces that something was written.
  void request() {
    const std::scoped_lock lock(mutex_);
    ++written_;
    changed_.notify_all();
  }
  /// Waits until everything written is on the disk, or until a flush fails.
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return flushed_ == written_ || error_ != 0; });
  }
  /// `errno` of a flush that failed; 0 = none did.
  [[nodiscard]] int error() const {
    const std::scoped_lock lock(mutex_);
    return error_;
  }

 private:
  void run(const std::stop_token& stop);

  const int descriptor_;
  const std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t written_ = 0;  ///< Counts requests,
  std::uint64_t flushed_ = 0;  ///< and those fulfilled.
  bool is_named_;              ///< Whether the name is on the disk.
  int error_ = 0;
  std::jthread thread_;
};

void BackgroundFlush::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return flushed_ != written_; });
    if (flushed_ == written_) return;
    const std::uint64_t reached = written_;
    lock.unlock();
    const int error = ::fdatasync(descriptor_) == 0 ? 0 : errno;
    if (!std::exchange(is_named_, true)) flush_folder(path_);
    lock.lock();
    flushed_ = reached;
    if (error != 0) error_ = error;
    changed_.notify_all();
  }
}

AppendLog::AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush)
    : path_(path), framing_(framing) {
  errno = 0;
  file_ = FileDescriptor(path, O_RDWR | O_CREAT | O_APPEND);
  if (!file_.ok()) throw write_error(path);
  if (!lock(file_)) {
    throw IoError(
        path, "another program is writing it; wait until it has finished or name another folder");
  }
  read_records();
  start_flush(flush, false);
}

AppendLog::AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush,
                     std::span<const LogRecord> records)
    : path_(path), framing_(framing) {
  const auto signature = log_signature(framing);
  LogRecord bytes(signature.begin(), signature.end());
  for (const LogRecord& record : records) put_record(framing, record, bytes);
  AtomicFile target(path, bytes.size());
  errno = 0;
  file_ = FileDescriptor(target.temporary(), O_WRONLY | O_APPEND);
  // Held before it has its name: nobody can take it for one that was left.
  if (!file_.ok() || !lock(file_) || !write_all(file_.id(), bytes)) throw write_error(path);
  bytes_ = bytes.size();
  std::error_code ignored;
  if (flush == LogFlush::AtOnce || std::filesystem::exists(path, ignored)) {
    target.commit();  // a loss of power must not cost the records that are there
    start_flush(flush, true);
  } else {
    target.commit_unflushed();
    start_flush(flush, false);
  }
}

AppendLog::~AppendLog() = default;

void AppendLog::start_flush(LogFlush flush, bool is_flushed) {
  if (flush == LogFlush::AtOnce) return;
  const auto start =
      is_flushed ? BackgroundFlush::Start::Flushed : BackgroundFlush::Start::Unflushed;
  flush_ = std::make_unique<BackgroundFlush>(file_.id(), path_, start);
}

void AppendLog::read_records() {
  LogRecord bytes;
  if (!read_all(file_.id(), bytes)) {
    throw IoError(path_, std::string("cannot be read: ") + std::strerror(errno));
  }
  const auto signature = log_signature(framing_);
  errno = 0;
  if (bytes.size() < signature.size() && std::ranges::equal(bytes, signature.first(bytes.size()))) {
    // New, or its program ended as it began to write.
    if (!write_all(file_.id(), signature.subspan(bytes.size()))) throw write_error(path_);
    bytes_ = signature.size();
    return;
  }
  auto content = parse_log(framing_, bytes);
  if (!content) throw not_a_log(path_);
  records_ = std::move(content->records);
  bytes_ = content->whole_bytes;
  if (bytes_ < bytes.size() && ::ftruncate(file_.id(), static_cast<off_t>(bytes_)) != 0) {
    throw write_error(path_);
  }
}

void AppendLog::append(std::span<const std::uint8_t> record) {
  LogRecord bytes;
  put_record(framing_, record, bytes);
  write(bytes);
}

void AppendLog::append(std::string_view record) {
  append({reinterpret_cast<const std::uint8_t*>(record.data()), record.size()});
}

void AppendLog::append_all(std::span<const LogRecord> records) {
  LogRecord bytes;
  for (const LogRecord& record : records) put_record(framing_, record, bytes);
  if (!bytes.empty()) write(bytes);
}

void AppendLog::write(std::span<const std::uint8_t> bytes) {
  require_sound();
  errno = 0;
  if (!write_all(file_.id(), bytes) || (!flush_ && ::fsync(file_.id()) != 0)) {
    const IoError error = write_error(path_);
    is_broken_ = ::ftruncate(file_.id(), static_cast<off_t>(bytes_)) != 0;
    throw error;
  }
  bytes_ += bytes.size();
  if (flush_) flush_->request();
}

void AppendLog::flush() {
  if (flush_) flush_->wait();
  require_sound();
}

void AppendLog::require_sound() {
  const int error = flush_ ? flush_->error() : 0;
  if (error == 0 && !is_broken_) return;
  errno = error;
  throw write_error(path_);
}

std::vector<LogRecord> read_log(const std::filesystem::path& path, LogFraming framing) {
  require_readable_file(path);
  const FileDescriptor file(path, O_RDONLY);
  LogRecord bytes;
  if (!file.ok() || !read_all(file.id(), bytes)) {
    throw IoError(path, "the file cannot be read; check its permissions");
  }
  auto content = parse_log(framing, bytes);
  if (!content) throw not_a_log(path);
  return std::move(content->records);
}

bool is_held(const std::filesystem::path& path) {
  const FileDescriptor file(path, O_RDONLY);
  return file.ok() && ::flock(file.id(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace episcope::io
