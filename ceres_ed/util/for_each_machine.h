// Compiles a function for several kinds of processor.
#ifndef CERES_ED_UTIL_FOR_EACH_MACHINE_H_
#define CERES_ED_UTIL_FOR_EACH_MACHINE_H_

// Put the macro before a function that is not inline. The function is then compiled for plain
// x86-64 and for AVX2 (and for AVX-512 with the second macro), and the loader chooses the version
// that the processor supports. AVX2 includes fused multiplication, which rounds once where plain
// code rounds twice. Levels ("x86-64-v3") are matched by what a processor supports; names of
// processors ("haswell") are also matched by the manufacturer. Sanitizers do not support this
// mechanism.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CERES_ED_FOR_EACH_MACHINE __attribute__((target_clones("arch=x86-64-v3", "default")))
#define CERES_ED_FOR_EACH_MACHINE_WITH_AVX512 \
  __attribute__((target_clones("avx512f", "arch=x86-64-v3", "default")))
#else
#define CERES_ED_FOR_EACH_MACHINE
#define CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
#endif

#endif  // CERES_ED_UTIL_FOR_EACH_MACHINE_H_
