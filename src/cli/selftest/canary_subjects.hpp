#pragma once
// What the numbers rest on, as expressions for the compiler: compiled for every instruction set with the flags of its kernels,
// each in a namespace of its own, and once more, in namespace unflagged, without those flags (tests/canaries/).

#define CANARY_SUBJECTS                                                                                                          \
    /* out[i] = (double)(float)in[i] */                                                                                          \
    void round_to_float(const double in[3], double out[3]);                                                                      \
    float multiply_add(float a, float b, float c);                                                                               \
    /* The same on vectors of intrinsics: the widest that this ISA has, and on 4 floats. */                                      \
    float multiply_add_widest(float a, float b, float c);                                                                        \
    float multiply_add_packed(float a, float b, float c);                                                                        \
    float smaller(float a, float b); /* a < b ? a : b */                                                                         \
    float larger(float a, float b);  /* a > b ? a : b */                                                                         \
    float smaller_packed(float a, float b);                                                                                      \
    float larger_packed(float a, float b);                                                                                       \
    float multiply(float a, float b);                                                                                            \
    float add(float a, float b);                                                                                                 \
    void divide(const float a[8], const float b[8], float out[8]);                                                               \
    void square_root(const float a[8], float out[8]);

namespace flagged {
CANARY_SUBJECTS
}
namespace unflagged {
CANARY_SUBJECTS
}
