// SPDX-License-Identifier: MIT
/// Instruction sets that the compiler was allowed to use, as a constant. Compiled with the flags of all other code.

extern const unsigned tribo_cpu_needs;
const unsigned tribo_cpu_needs = 0
#ifdef __SSE4_2__
                                 | 1U
#endif
#ifdef __AVX2__
                                 | 2U
#endif
#ifdef __FMA__
                                 | 4U
#endif
#ifdef __BMI2__
                                 | 8U
#endif
#ifdef __AVX512F__
                                 | 16U
#endif
#ifdef __AVX512VL__
                                 | 32U
#endif
#ifdef __AVX512DQ__
                                 | 64U
#endif
#ifdef __AVX512BW__
                                 | 128U
#endif
#ifdef __AVX512VBMI2__
                                 | 256U
#endif
    ;
