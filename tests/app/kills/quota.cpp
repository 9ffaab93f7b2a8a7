// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/kills/quota.h"

#include "engine/io/base/files.h"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <cerrno>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>

namespace episcope::test {
namespace {

constexpr const char* kUsedUp = "quota of disk space is used up";

/// A filter of system calls, which refuses some of them with EDQUOT.
class SystemCalls {
 public:
  SystemCalls() { load(offsetof(seccomp_data, nr)); }

  void refuse(long call) { add({BPF_JMP | BPF_JEQ | BPF_K, 0, 1, number(call)}, kRefuse); }
  /// If the argument has one of the bits.
  void refuse_with(long call, int argument, std::uint32_t bits) {
    unless(call, 4);
    load(low_half(argument));
    add({BPF_JMP | BPF_JSET | BPF_K, 0, 1, bits}, kRefuse);
    load(offsetof(seccomp_data, nr));
  }
  /// But for the standard streams.
  void refuse_on_files(long call) {
    unless(call, 4);
    load(low_half(0));
    add({BPF_JMP | BPF_JGT | BPF_K, 0, 1, 2}, kRefuse);
    load(offsetof(seccomp_data, nr));
  }
  void begin() {
    program_.push_back(kAllow);
    const sock_fprog filter{static_cast<unsigned short>(program_.size()), program_.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) {
      throw std::runtime_error("system calls cannot be refused here");
    }
  }

 private:
  static constexpr sock_filter kRefuse{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | EDQUOT};
  static constexpr sock_filter kAllow{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW};

  static std::uint32_t number(long call) { return static_cast<std::uint32_t>(call); }
  static std::size_t low_half(int argument) {
    return offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(argument);
  }
  void load(std::size_t offset) {
    program_.push_back({BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)});
  }
  void unless(long call, std::uint8_t skipped) {
    program_.push_back({BPF_JMP | BPF_JEQ | BPF_K, 0, skipped, number(call)});
  }
  void add(sock_filter condition, sock_filter result) {
    program_.push_back(condition);
    program_.push_back(result);
  }

  std::vector<sock_filter> program_;
};

void refuse_new_files(std::uint64_t) {
  SystemCalls calls;
  calls.refuse_with(SYS_openat, 2, O_CREAT);
  calls.refuse(SYS_mkdirat);
#ifdef SYS_open
  calls.refuse_with(SYS_open, 1, O_CREAT);
  calls.refuse(SYS_mkdir);
#endif
  calls.begin();
}

void refuse_bytes(std::uint64_t) {
  SystemCalls calls;
  for (const long call : {SYS_write, SYS_pwrite64, SYS_writev, SYS_pwritev, SYS_pwritev2,
                          SYS_fallocate, SYS_sendfile, SYS_copy_file_range}) {
    calls.refuse_on_files(call);
  }
  calls.begin();
}

/// As disks of a network do.
void refuse_flushing(std::uint64_t) {
  SystemCalls calls;
  calls.refuse(SYS_fsync);
  calls.refuse(SYS_fdatasync);
  calls.begin();
}

void limit_size(std::uint64_t bytes) {
  io::report_file_size_limit();
  const rlimit limit{bytes, bytes};
  if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("no limit can be set");
}

}  // namespace

std::vector<Quota> quotas() {
  return {{"new files", kUsedUp, refuse_new_files},
          {"bytes", kUsedUp, refuse_bytes},
          {"flushing", kUsedUp, refuse_flushing},
          {"size", "larger than allowed", limit_size, true}};
}

}  // namespace episcope::test
