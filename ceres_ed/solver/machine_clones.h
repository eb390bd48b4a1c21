// Compiles a function for several machines.
#ifndef CERES_ED_SOLVER_MACHINE_CLONES_H_
#define CERES_ED_SOLVER_MACHINE_CLONES_H_

// For plain x86-64, AVX2 and AVX-512; the loader takes what the machine has. Sanitizers can't
// follow the indirection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CERES_ED_FOR_EACH_MACHINE \
  __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define CERES_ED_FOR_EACH_MACHINE
#endif

#endif  // CERES_ED_SOLVER_MACHINE_CLONES_H_
