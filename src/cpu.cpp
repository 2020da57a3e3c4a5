// SPDX-License-Identifier: MIT
/// Runs before all other code. On a CPU without the required instructions it prints a message instead of failing with
/// an illegal instruction. In an installed package it starts the build for the newest instruction set of this CPU.
/// Compiled for any x86-64.

#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

extern const unsigned tribo_cpu_needs;  // cpu_needs.cpp

#if defined(__x86_64__) && defined(__GNUC__)
namespace {

const char* missing() {
  __builtin_cpu_init();
  if ((tribo_cpu_needs & 1U) && !__builtin_cpu_supports("sse4.2")) return "SSE 4.2";
  if ((tribo_cpu_needs & 2U) && !__builtin_cpu_supports("avx2")) return "AVX2";
  if ((tribo_cpu_needs & 4U) && !__builtin_cpu_supports("fma")) return "FMA";
  if ((tribo_cpu_needs & 8U) && !__builtin_cpu_supports("bmi2")) return "BMI2";
  if ((tribo_cpu_needs & 16U) && !__builtin_cpu_supports("avx512f")) return "AVX-512";
  if ((tribo_cpu_needs & 32U) && !__builtin_cpu_supports("avx512vl")) return "AVX-512 VL";
  if ((tribo_cpu_needs & 64U) && !__builtin_cpu_supports("avx512dq")) return "AVX-512 DQ";
  if ((tribo_cpu_needs & 128U) && !__builtin_cpu_supports("avx512bw")) return "AVX-512 BW";
  if ((tribo_cpu_needs & 256U) && !__builtin_cpu_supports("avx512vbmi2")) return "AVX-512 VBMI2";
  return nullptr;
}

// Runs before the constructors of all other code (101 is the highest priority available to programs).
__attribute__((constructor(101))) void check_cpu(int, char** arguments, char**) {
#ifdef TRIBO_LEVELS_FOLDER
  // The path is relative to the program, so that an installation can be moved.
  char self[4096];
  const auto length = readlink("/proc/self/exe", self, sizeof self);
  if (length > 0 && std::getenv("TRIBO_BASELINE") == nullptr) {
    std::string folder(self, static_cast<std::size_t>(length));
    folder.erase(folder.rfind('/'));
    __builtin_cpu_init();
    for (const char* level : {__builtin_cpu_supports("x86-64-v4") ? "x86-64-v4" : "",
                              __builtin_cpu_supports("x86-64-v3") ? "x86-64-v3" : ""}) {
      if (*level == '\0') continue;
      const std::string better = folder + "/" TRIBO_LEVELS_FOLDER "/tribo-" + level;
      execv(better.c_str(), arguments);  // returns only if the file does not exist
    }
  }
#else
  static_cast<void>(arguments);
#endif
  if (const char* what = missing()) {
    std::fprintf(stderr,
                 "error: this program was built for a CPU with %s, which this one lacks. Build it on this machine "
                 "(scripts/run), or for any x86-64 with cmake -DTRIBO_ARCH= ...\n",
                 what);
    std::_Exit(5);
  }
}

}  // namespace
#endif
