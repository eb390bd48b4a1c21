// One function, compiled for several kinds of machine.
#ifndef CERES_ED_UTIL_FOR_EACH_MACHINE_H_
#define CERES_ED_UTIL_FOR_EACH_MACHINE_H_

// Before a function that isn't inline: compiles it for plain x86-64 and for AVX2, or for AVX-512,
// too; the loader takes what the machine has. AVX2 comes with fused multiplication, which rounds
// once where plain code rounds twice. Levels ("x86-64-v3") match by what a machine has, names of
// machines ("haswell") by its maker, too. Sanitizers can't follow the indirection.
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
