// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Instruction sets that the hot kernels are compiled for. A source named by
/// `episcope_add_kernels` is compiled once for each, in a namespace of its own; its callers choose
/// by `best_isa()`. Such a source must include nothing that defines inline functions of external
/// linkage (no standard containers or algorithms): the linker could keep the copy compiled for the
/// wider instruction set and call it everywhere.
enum class Isa { Baseline, Avx2, Avx512 };

/// The widest set that this machine supports. The environment variable EPISCOPE_ISA (baseline,
/// avx2, avx512) restricts it, for tests and comparisons.
[[nodiscard]] Isa best_isa();

[[nodiscard]] const char* isa_name(Isa isa);

}  // namespace episcope

/// Declares the kernel table, or function, of each namespace:
/// EPISCOPE_DECLARE_KERNEL(extern const ForestKernel kForestKernel);
#define EPISCOPE_DECLARE_KERNEL(...) \
  namespace baseline {               \
  __VA_ARGS__;                       \
  }                                  \
  namespace avx2 {                   \
  __VA_ARGS__;                       \
  }                                  \
  namespace avx512 {                 \
  __VA_ARGS__;                       \
  }

/// The kernel table `name` of the namespace for `isa`; where only the baseline is built, that one.
#ifdef EPISCOPE_BASELINE_ONLY
#define EPISCOPE_CHOOSE_KERNEL(isa, name) (baseline::name)
#else
#define EPISCOPE_CHOOSE_KERNEL(isa, name)          \
  ((isa) == ::episcope::Isa::Avx512 ? avx512::name \
   : (isa) == ::episcope::Isa::Avx2 ? avx2::name   \
                                    : baseline::name)
#endif

namespace episcope {

/// Processor for a computation; Auto takes a GPU if there is one and the computation supports it.
enum class Device { Auto, Cpu, Cuda };

}  // namespace episcope
