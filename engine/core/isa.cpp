// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/isa.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace episcope {
namespace {

Isa machine_isa() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq")) {
    return Isa::Avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::Avx2;
#endif
  return Isa::Baseline;
}

Isa wanted_isa() {
  const char* text = std::getenv("EPISCOPE_ISA");
  if (text == nullptr) return Isa::Avx512;
  for (const Isa isa : {Isa::Baseline, Isa::Avx2}) {
    if (std::string_view(text) == isa_name(isa)) return isa;
  }
  return Isa::Avx512;
}

}  // namespace

Isa best_isa() {
  static const Isa isa = std::min(machine_isa(), wanted_isa());
  return isa;
}

const char* isa_name(Isa isa) {
  constexpr const char* names[] = {"baseline", "avx2", "avx512"};
  return names[static_cast<int>(isa)];
}

}  // namespace episcope
