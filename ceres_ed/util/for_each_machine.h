// One function, compiled for several kinds of machine.
#ifndef CERES_ED_UTIL_FOR_EACH_MACHINE_H_
#define CERES_ED_UTIL_FOR_EACH_MACHINE_H_

// Before a function: compiles it for plain x86-64 and for AVX2; the loader takes what the machine
// has. AVX2 comes with fused multiplication, which rounds once where plain code rounds twice.
// Sanitizers can't follow the indirection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CERES_ED_FOR_EACH_MACHINE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define CERES_ED_FOR_EACH_MACHINE
#endif

#endif  // CERES_ED_UTIL_FOR_EACH_MACHINE_H_
