// Code for the machine at hand without -march.
#ifndef CERES_ED_UTIL_MULTIVERSION_H_
#define CERES_ED_UTIL_MULTIVERSION_H_

// Ahead of a function that isn't inline: it is compiled for plain x86-64 and for AVX2, and the
// loader takes what the machine has. Sanitizers can't follow the indirection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CERES_ED_FOR_EACH_MACHINE __attribute__((target_clones("arch=haswell", "default")))
#else
#define CERES_ED_FOR_EACH_MACHINE
#endif

#endif  // CERES_ED_UTIL_MULTIVERSION_H_
